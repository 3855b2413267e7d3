// 2:19 too many array dimensions
#declare P = array[1][1][1][1][1][1];
