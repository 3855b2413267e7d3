// 3:3 cannot be passed to a macro before
#macro M(A) #end
M(B)
