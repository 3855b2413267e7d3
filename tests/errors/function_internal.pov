// 2:23 internal(61) is needed
#declare f = function { internal(61) } #declare A = f(1, 2, 3, 4);
