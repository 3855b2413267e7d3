// 2:32 tiling number must be in the range from 1 to 27
sphere { 0, 1 pigment { tiling 99 } }
