// 2:41 file type not supported here
sphere { 0, 1 pigment { image_map { pot "test.png" } } }
