// Colour expressions: five components in single precision.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare Red = rgb <1, 0, 0>;
#declare Full = rgbft <0.125, 0.25, 0.5, 0.75, 1>;
#declare V = <0.25, 0.5, 0.75>;

#declare C = rgb 0.1;
#if (str(C.red, 0, 10) != "0.1000000015") #error "a colour is in single precision\n" #end
#declare C = rgb V;
CheckV("rgb of a vector", C, V)
#declare C = rgbf 0.5;
CheckV("a float fills all that are expected", C, <0.5, 0.5, 0.5, 0.5, 0>)
#declare C = rgbt 0.5;
CheckV("rgbt", C, <0.5, 0.5, 0.5, 0, 0.5>)
#declare C = rgbft 0.5;
CheckV("rgbft", C, <0.5, 0.5, 0.5, 0.5, 0.5>)
#declare C = color 1;
CheckV("color 1 fills filter and transmit", C, <1, 1, 1, 1, 1>)
#declare C = 1 - Red;
CheckV("1 - Red", C, <0, 1, 1, 1, 1>)
#declare C = Red*V;
CheckV("a vector clears filter and transmit", C, <0.25, 0, 0>)
#declare C = color red 1;
CheckV("red", C, <1, 0, 0>)
#declare C = color Red filter 0.25;
CheckV("filter after a name", C, <1, 0, 0, 0.25>)
#declare C = rgb V transmit 0.5;
CheckV("transmit after rgb", C, <0.25, 0.5, 0.75, 0, 0.5>)
#declare C = red 1 blue 0.5;
CheckV("red blue", C, <1, 0, 0.5>)
#declare C = colour Red*0.5 green 2;
CheckV("green after an expression", C, <0.5, 2, 0>)
#declare C = color <1, 0, 0.5>;
CheckV("color of a vector", C, <1, 0, 0.5>)
#declare C = color rgb <1, 0, 0.5>;
CheckV("color rgb", C, <1, 0, 0.5>)
#declare C = rgb 1*2;
CheckV("rgb takes a whole expression", C, <2, 2, 2>)
#declare C = rgb <1, 0, 0>*0.5 + <0, 1, 0>;
CheckV("rgb and a sum", C, <0.5, 1, 0>)
#declare C = rgb 1 < 2;
CheckV("rgb and a comparison", C, <1, 1, 1>)
#declare C = Full;
CheckV("a name", C, Full)
Check("gray", Full.gray, 0.297*0.125 + 0.589*0.25 + 0.114*0.5)
Check("filter", Full.filter, 0.75)
Check("transmit", Full.transmit, 1)
Check("t", Full.t, 0.75)
Check("x", Full.x, 0.125)
#macro Pass(P) CheckV("as an argument", P, <1, 0.5, 0>) #end
Pass(rgb <1, 0.5, 0>)
Pass(color red 1 green 0.5)
#declare Palette = array[2] { rgb <1, 0, 0>, color green 1 }
CheckV("in an array", Palette[1], <0, 1, 0>)

// sRGB to linear light, since assumed_gamma is 1; the curve in single precision
#macro Linear(S) (S <= 0.04045 ? S/12.92 : pow((S + 0.055)/1.055, 2.4)) #end
#declare C = srgb <0.5, 0.02, 1>;
#if (abs(C.red - Linear(0.5)) > 1e-7 | abs(C.green - Linear(0.02)) > 1e-8 | C.blue != 1)
  #error "srgb\n"
#end
#declare C = srgbft <0, 0, 0, 0.5, 0.25>;
CheckV("srgbft leaves filter and transmit", C, <0, 0, 0, 0.5, 0.25>)
#declare C = srgbt 1;
CheckV("srgbt", C, <1, 1, 1, 0, 1>)
sphere { 0, 1 }
