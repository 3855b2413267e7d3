// 2:14 undeclared identifier 'C'
#declare B = C;
