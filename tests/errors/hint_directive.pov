// 2:2 (did you mean 'include'?)
#includ "colors.inc"
