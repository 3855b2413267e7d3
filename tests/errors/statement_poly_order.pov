// 2:8 from 2 to 35
poly { 99, <1> }
