// 3:30 point 2 of the patch (group 1, position 2) is not finite
#declare Big = 1e300;
bicubic_patch { type 1 <0,0> <Big*Big,0,0> }
