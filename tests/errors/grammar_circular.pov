// 2:33 circular area light must have more than 1 point per axis
light_source { 0 rgb 1 circular }
