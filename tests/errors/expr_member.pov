// 2:22 bad operands for period operator
#declare A = <1,2,3>.t;
