// 2:13 '>=' found instead
#if ((<1,2,3>=<1,2,4>).x) #end
