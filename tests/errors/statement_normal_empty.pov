// 2:24 no normal type given
sphere { 0, 1 normal { } }
