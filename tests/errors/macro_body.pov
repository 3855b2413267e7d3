// 2:21 undeclared identifier 'Nothing' found
#macro M() #if (1 > Nothing) #end #end
M()
