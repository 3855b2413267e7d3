// 2:10 'v' found instead
#macro M(v) #end
