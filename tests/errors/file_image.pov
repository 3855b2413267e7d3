// 2:43 cannot open image file 'nope.png'
sphere { 0, 1 pigment { image_map { png   "nope.png" } } }
