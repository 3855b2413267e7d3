// 2:32 undeclared identifier 'g'
#declare f = function(x) { x + g }
