// 2:42 cannot open density file 'nope'
sphere { 0, 1 pigment { density_file df3 "nope" } }
