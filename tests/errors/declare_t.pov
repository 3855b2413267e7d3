// 2:14 Expected a value for #declare, 't' found
#declare A = t * 4;
