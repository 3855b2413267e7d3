// 2:19 greater than 0
global_settings { assumed_gamma 0 }
