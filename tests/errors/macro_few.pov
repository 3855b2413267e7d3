// 3:4 expected 2 parameters for macro 'M' but only 1 found
#macro M(A, B) #end
M(1)
