// 3:23 expected 'parameter identifier'
#declare K = 1;
#declare g = function(K) { K }
