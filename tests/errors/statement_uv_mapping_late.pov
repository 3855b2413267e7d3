// 2:32 before the texture
sphere { 0, 1 texture {}       uv_mapping }
