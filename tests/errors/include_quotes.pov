// 2:10 The name of an include file stands in quotes: "colors..."
#include colors.inc
