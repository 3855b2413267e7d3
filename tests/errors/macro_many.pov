// 3:5 expected ')' in 'M'
#macro M(A) #end
M(1 2)
