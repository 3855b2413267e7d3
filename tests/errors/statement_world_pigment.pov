// 2:1 'pigment' found
pigment { rgb 1 }
