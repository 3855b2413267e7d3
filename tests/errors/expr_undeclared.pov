// 2:15 undeclared identifier 'Redd' found instead
#declare A = (Redd);
