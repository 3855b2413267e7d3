// 2:36 cannot be used in 'pigment'
sphere { 0, 1 pigment { gradient x texture_map { [0 T] } } }
