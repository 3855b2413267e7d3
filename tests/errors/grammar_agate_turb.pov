// 2:30 keyword 'agate_turb' can only be used in agate
sphere { 0, 1 pigment { bozo agate_turb 1 } }
