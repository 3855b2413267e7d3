// 2:14 '{' found instead
#declare A = { 1 };
