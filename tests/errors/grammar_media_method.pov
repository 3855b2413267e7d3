// 2:48 sample method must be in the range from 1 to 3
sphere { 0, 1 hollow interior { media { method 4 } } }
