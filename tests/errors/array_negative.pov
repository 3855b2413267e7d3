// 3:16 negative subscript
#declare P = array[3];
#declare A = P[-1];
