// 2:22 has no inverse
sphere { 0, 1 matrix <1,1,0, 1,1,0, 0,0,1, 0,0,0> }
