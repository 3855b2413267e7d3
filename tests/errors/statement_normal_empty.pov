// 2:24 needs a pattern
sphere { 0, 1 normal { } }
