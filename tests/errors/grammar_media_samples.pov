// 2:49 number of samples
sphere { 0, 1 hollow interior { media { samples 0 } } }
