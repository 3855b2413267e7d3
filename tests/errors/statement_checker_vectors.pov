// 2:50 found instead
sphere { 0, 1 pigment { checker rgb <1,1,1> <0,0,0> } }
