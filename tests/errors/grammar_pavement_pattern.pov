// 2:25 pattern of a pavement with 4 sides and 2 tiles must be from 1 to 1, not 4
sphere { 0, 1 pigment { pavement number_of_sides 4 number_of_tiles 2 pattern 4 } }
