// 2:33 slice vector is zero
julia_fractal { <0,0,0,1> slice <0,0,0,0>, 0 }
