// 2:51 a colour
sphere { 0, 1 pigment { gradient x color_map { [0 <1,0,0>] } } }
