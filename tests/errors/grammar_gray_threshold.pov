// 2:46 gray_threshold must be from 0.0 to 1.0
global_settings { radiosity { gray_threshold 2 } }
