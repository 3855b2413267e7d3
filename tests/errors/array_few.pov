// 2:30 insufficient number of initializers: 2 of 3
#declare P = array[3] { 1, 2 }
