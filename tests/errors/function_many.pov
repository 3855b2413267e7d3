// 3:19 expected ')'
#declare f = function(x) { x }
#declare A = f(1, 2);
