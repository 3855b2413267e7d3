// 2:16 '>' found instead
#declare V = <1>;
