// 2:19 found instead
global_settings { wobble 3 }
