// 2:31 did you mean 'count'?
global_settings { radiosity { cuont 10 } }
