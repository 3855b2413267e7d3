// 2:10 too many nested include files
#include "include_itself.pov"
