// 2:25 found instead
sphere { 0, 1 pigment { <1,0,0> } }
