// 2:17 expected read, write or append
#fopen F "name" backwards
