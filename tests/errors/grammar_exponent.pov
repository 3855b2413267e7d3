// 2:30 keyword 'exponent' can only be used in mandel or julia
sphere { 0, 1 pigment { bozo exponent 2 } }
