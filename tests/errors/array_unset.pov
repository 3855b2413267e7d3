// 3:14 uninitialized array element
#declare P = array[3];
#declare A = P[1];
