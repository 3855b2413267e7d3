// The standard includes, with and without their extension, and what they compute.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#include "stdinc.inc"
#include "textures.inc"
#include "metals.inc"
#include "golds.inc"
#include "woods.inc"
#include "stones.inc"
#include "glass"
#include "skies.inc"
#include "stars.inc"
#include "arrays.inc"
#include "strings.inc"
#include concat("col", "ors.inc")
#include "finish.inc"
#include "shapes3.inc"
#include "screen.inc"
#include "sunpos.inc"
#include "rad_def.inc"
#include "ior.inc"
#include "meshmaker.inc"
#version 3.7; // not all of them restore it
CheckV("colors", Orange, <1, 0.5, 0>)
CheckS("strings", CRGBStr(<1, 0.5, 0>, 0, 1), "color rgb <   1.0, 0.5, 0.0>")
CheckS("Triangle_Str", VStr2D(<1, 2>), VStr2D(x + 2*y))
Check("math", Mean(array[3] { 1, 2, 6 }) + clamp(5, 0, 1) + sind(30), 3 + 0 + 0.5)
CheckV("VPow", VPow(<1, 2, 3>, 2), <1, 4, 9>)
Check("VAngleD", VAngleD(x, y), 90)
CheckV("vtransform", VProject_Plane(<1, 2, 3>, y), <1, 0, 3>)
#declare R = seed(1);
Check("rand.inc", (SRand(R) <= 1), 1)
Check("RRand", (RRand(2, 3, R) >= 2), 1)
#declare Data = array[5] { 3, 1, 2, 5, 4 }
Sort_Array(Data)
Check("Sort_Array", Data[0]*10000 + Data[1]*1000 + Data[2]*100 + Data[3]*10 + Data[4], 12345)
Parse_String("#declare Parsed = 42;")
Check("Parse_String", Parsed, 42)
sphere { 0, 1 }
