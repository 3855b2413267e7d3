// 2:9 must have a length
plane { 0, 1 }
