// 2:22 ';' found instead
#include "colors.inc";
