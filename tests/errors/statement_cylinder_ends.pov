// 2:12 the same point
cylinder { x, x, 1 }
