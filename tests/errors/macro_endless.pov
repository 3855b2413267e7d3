// 2:12 does 'M' call itself without end
#macro M() M() #end
M()
