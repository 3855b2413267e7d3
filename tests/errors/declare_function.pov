// 3:10 redeclaring functions
#declare f = function(x) { x }
#declare f = function(x) { 2*x }
