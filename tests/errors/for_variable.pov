// 2:2 must remain defined and numerical
#for (I, 0, 3) #declare I = x; #end
