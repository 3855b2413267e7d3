// 2:11 '.' found instead
#declare V.y = 1;
