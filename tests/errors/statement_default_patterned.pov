// 2:12 must be plain
#default { texture { checker } }
