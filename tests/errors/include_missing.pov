// 2:10 cannot open include file 'nope.inc'
#include "nope.inc"
