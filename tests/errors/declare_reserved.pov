// 2:10 reserved words cannot be declared
#declare sphere = 3;
