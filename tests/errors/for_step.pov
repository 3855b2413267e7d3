// 2:2 increment must be non-zero
#for (I, 0, 3, 0) #end
