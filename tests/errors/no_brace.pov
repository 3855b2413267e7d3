// 3:1 No matching } in 'sphere', end of file found
sphere { 0, 1
