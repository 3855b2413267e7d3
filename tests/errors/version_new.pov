// 2:10 requires pov-ray version 4.00
#version 4.0;
