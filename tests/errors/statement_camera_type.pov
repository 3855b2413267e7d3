// 2:29 must be the first item
camera { location <0,0,-5>  orthographic look_at 0 }
