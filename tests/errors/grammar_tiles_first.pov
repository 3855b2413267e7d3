// 2:33 First texture missing from tiles
sphere { 0, 1 texture { tiles { tile2 texture { } } } }
