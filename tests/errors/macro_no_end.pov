// 2:2 #macro has no #end
#macro M(A) #if (1) #end
