// 2:20 Maximum number of samples per interval smaller than minimum number
media { samples 7, 3 }
