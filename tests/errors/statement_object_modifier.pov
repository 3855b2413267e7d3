// 2:15 wobble
sphere { 0, 1 wobble }
