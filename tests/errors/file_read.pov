// 2:8 expected a file identifier
#read (F, A)
