// 3:17 takes 2 arguments, only 1
#declare f = function(x, y) { x }
#declare A = f(1);
