// 2:44 pretrace must be greater than 0
global_settings { radiosity { pretrace_end 0 } }
