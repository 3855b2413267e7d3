// 3:10 is a macro and cannot be declared
#macro M() #end
#declare M = 1;
