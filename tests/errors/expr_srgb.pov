// 2:14 cannot parse srgb colors before assumed_gamma
#declare A = srgb 1;
