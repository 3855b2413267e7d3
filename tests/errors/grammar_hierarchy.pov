// 2:15 keyword 'hierarchy' cannot be used with this object
sphere { 0, 1 hierarchy off }
