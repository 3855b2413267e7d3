// Trap 38: a standard file that is included turns a scene without #version into one of 3.7, though
// the file itself asks for 3.5: it puts back what it found. (That assumed_gamma becomes 1 with this
// is in tests/test_convert_world.c. A file of its own, since no #version may stand in it.)
#include "check.inc"
#declare Before = version;
#include "colors.inc"
Check("38: before", Before, 3.7)
Check("38: behind the file", version, 3.7)
#debug concat("@version ", str(version, 0, 2), "\n")
sphere { 0, 1 }
