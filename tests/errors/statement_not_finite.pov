// 2:1 not finite
sphere { 0, 1e400 }
