// 2:20 '<' found instead
#declare B = max(1 < 2, 0);
