// 3:15 found instead
#declare T = texture { }
sphere { 0, 1 T }
