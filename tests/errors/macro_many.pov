// 3:5 Expected ')' behind the 1 argument of macro 'M'
#macro M(A) #end
M(1 2)
