// 2:42 quaternion only supports sqr and cube
julia_fractal { <0,0,0,1> quaternion     sin }
