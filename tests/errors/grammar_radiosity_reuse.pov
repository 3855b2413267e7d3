// 2:29 Radiosity maximum_reuse must be larger than minimum_reuse
global_settings { radiosity { minimum_reuse 3 maximum_reuse 0.2 } }
