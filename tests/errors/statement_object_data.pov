// 2:15 sphere
sphere { 0, 1 sphere { 0, 1 } }
