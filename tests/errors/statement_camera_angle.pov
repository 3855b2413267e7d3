// 2:10 less than 180
camera { angle 180 }
