// 2:34 require semi-colon
#macro F(N) #if (N <= 1) 1 #else 2 #end #end
#declare B = F(5);
