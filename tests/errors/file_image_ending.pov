// 2:37 cannot open image file 'no_such_picture'
sphere { 0, 1 pigment { image_map { "no_such_picture" } } }
