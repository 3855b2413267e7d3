// 2:47 recursion_limit must be in the range 1 to 20
global_settings { radiosity { recursion_limit 50 } }
