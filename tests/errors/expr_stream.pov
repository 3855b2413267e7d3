// 2:14 illegal random number generator
#declare A = rand(3);
