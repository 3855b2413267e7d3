// 2:33 'gradient' found
sphere { 0, 1 pigment { scale 2 gradient x } }
