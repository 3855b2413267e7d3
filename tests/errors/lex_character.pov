// 2:10 illegal character in input file, value is c3
#declare é = 1;
