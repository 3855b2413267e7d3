// 2:45 nearest_count must be a value from 1 to 20
global_settings { radiosity { nearest_count 0 } }
