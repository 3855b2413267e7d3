// 2:64 uv_vectors must be the last
bicubic_patch { type 1 uv_vectors <0,0> <1,0> <1,1> <0,1>      u_steps 3
