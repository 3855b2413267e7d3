// 3:16 array subscript out of range
#declare P = array[3];
#declare A = P[3];
