// 2:33 cannot be used with 'checker'
sphere { 0, 1 pigment { checker color_map { [0 rgb 1] } } }
