// 2:35 no comma may stand
bicubic_patch { type 1 u_steps 3, v_steps 3
