// 2:14 domain error in sqrt
#declare A = sqrt(-1);
