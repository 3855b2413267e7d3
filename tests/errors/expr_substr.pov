// 2:20 illegal parameters in substr
#declare A = substr("abc", 2, 5);
