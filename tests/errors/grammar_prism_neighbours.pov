// 2:28 Too few points in prism
prism { cubic_spline 0, 1, 6, <0,0>, <1,0>, <1,1>, <0,1>, <0,0>, <1,0> }
