// 2:30 keyword 'control0' can only be used in quilted
sphere { 0, 1 pigment { bozo control0 1 } }
