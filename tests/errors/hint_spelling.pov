// 3:14 (did you mean 'Radius'?)
#declare Radius = 1;
#declare A = Raduis;
