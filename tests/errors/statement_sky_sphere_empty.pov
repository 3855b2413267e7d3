// 2:14 'pigment' in 'sky_sphere'
sky_sphere { }
