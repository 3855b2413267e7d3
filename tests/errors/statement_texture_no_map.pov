// 2:25 needs a texture_map
sphere { 0, 1 texture { bozo } }
