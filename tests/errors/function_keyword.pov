// 2:28 cannot stand in a function
#declare f = function(x) { rand(1) }
