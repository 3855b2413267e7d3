// 2:56 ']'
sphere { 0, 1 pigment { gradient x color_map { [0 rgb 1, ] } } }
