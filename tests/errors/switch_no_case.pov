// 2:13 not followed by #case
#switch (1) sphere { 0, 1 } #end
