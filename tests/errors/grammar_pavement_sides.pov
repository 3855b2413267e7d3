// 2:25 number_of_sides of pavement must be 3, 4 or 6
sphere { 0, 1 pigment { pavement number_of_sides 9 } }
