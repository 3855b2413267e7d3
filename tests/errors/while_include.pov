// 1:2 must end in the file
#while (1) #include "half_loop.inc"
