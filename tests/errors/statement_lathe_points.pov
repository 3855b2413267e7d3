// 2:23 at least 2
lathe { linear_spline 1, <0,0> }
