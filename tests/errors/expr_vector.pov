// 2:41 float expected but vector
#declare A = array[1]; #declare B = sin(<1,2,3>);
