// 2:2 invalid context for #break
#break
