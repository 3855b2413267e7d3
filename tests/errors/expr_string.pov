// 2:19 string comparison operator
#declare A = ("a" + "b");
