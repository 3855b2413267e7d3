// 3:11 object identifier
#declare A = sphere { 0, 1 }
union { A A }
