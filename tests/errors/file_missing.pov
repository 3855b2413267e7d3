// 2:2 cannot open file 'nope.txt'
#fopen F "nope.txt" read
