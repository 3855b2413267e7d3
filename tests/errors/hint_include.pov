// 2:14 (metals.inc declares it: #include "metals.inc")
#declare T = T_Chrome_5E
