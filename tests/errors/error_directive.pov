// 2:10 #error: stop here
#if (1) #error "stop here\n" #end
