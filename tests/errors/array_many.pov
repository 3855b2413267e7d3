// 2:31 number 3 found instead
#declare P = array[2] { 1, 2, 3 }
