// 2:14 illegal escape
#declare S = "\q";
