// 2:26 expected '>'
#declare V = <1,2,3,4,5, 6>;
