// 3:2 #ifdef has no #end
#declare A = 1;
#ifdef (A)
