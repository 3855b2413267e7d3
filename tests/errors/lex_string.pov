// 2:14 no end quote
#declare S = "abc
