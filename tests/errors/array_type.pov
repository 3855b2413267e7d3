// 2:31 attempted to redefine vector identifier as float
#declare P = array[3] { x, y, 0 }
