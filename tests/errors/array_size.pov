// 2:20 invalid dimension size
#declare P = array[0];
