// 3:4 ';' found instead
#macro M() #end
M();
