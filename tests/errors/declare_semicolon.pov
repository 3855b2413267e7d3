// 2:20 require semi-colon
#declare A = <1,2,3>  #declare B = 2;
