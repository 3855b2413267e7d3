// 2:34 must have a length
sphere { 0, 1 pigment { gradient 0 } }
