// 2:21 conditional must evaluate to a float
#declare A = (<1,2> ? 1 : 2);
