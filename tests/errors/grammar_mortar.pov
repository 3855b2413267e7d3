// 2:30 keyword 'mortar' can only be used in brick
sphere { 0, 1 pigment { bozo mortar 1 } }
