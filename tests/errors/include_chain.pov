// 1:15 undeclared identifier 'Missing'
#include "broken.inc"
