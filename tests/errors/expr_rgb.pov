// 2:16 expected numeric expression, 'rgb' found
#declare C = 2*rgb 1;
