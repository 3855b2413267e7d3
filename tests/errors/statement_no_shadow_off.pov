// 2:25 found instead
sphere { 0, 1 no_shadow off }
