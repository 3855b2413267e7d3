// What #version changes in the language itself. Pictures: tests/test_versions.c; what is refused:
// tests/grammar.txt.
#version 3.7;
#include "check.inc"
#version 3.649;
Check("rounded to hundredths", version, 3.65)
#version 3.1;

// Before 1.5 a number is one factor: a sign begins the next component.
#version 1.4
#declare V = <1 -2 3>
#declare F = 2
#declare W = <F -F +F>
#version 1.5
#declare X = <1 -2, 3, 4>
#version 3.7;
Check("1.4, vector", V.y, -2)
Check("1.4, vector of names", vlength(W - <2, -2, 2>), 0)
Check("1.5, vector", X.x, -1)

// Semicolons are asked for from 3.5 on.
#version 3.49;
#declare A = 5
#declare B = A
#declare C = rgb <1, 2, 3>
#version 3.7;
Check("3.49, no semicolons", B + C.green, 7)

// A colour's name may be followed by its parts before 3.5.
#declare Red = rgb <1, 0, 0>;
#version 3.1;
#declare Glass = Red filter 0.5
#declare Dim = Red * 0.5
#version 3.7;
Check("3.1, parts behind a name", Glass.filter, 0.5)
Check("3.1, a product", Dim.red, 0.5)

// Bytes above 127 stay as they are before 3.5, and are blanks from then on.
#version 3.1;
#declare Old = asc("é");
#version 3.5;
#declare New = asc("é");
#version 3.7;
Check("3.1, byte", Old, 233)
Check("3.5, byte", New, 32)

// The kind of noise follows the version until it is chosen.
#declare P = <0.3, 1.7, 2.9>;
#version 3.1;
#declare T1 = vturbulence(2, 0.5, 6, P);
#version 3.5;
#declare T2 = vturbulence(2, 0.5, 6, P);
#version 3.1;
#declare N1 = function { pattern { bozo } }
#declare B1 = N1(0.3, 1.7, 2.9);
#version 3.7;
#declare B2 = N1(0.3, 1.7, 2.9);
#debug concat("@T1 ", vstr(3, T1, " ", 0, 17), "\n")
#debug concat("@T2 ", vstr(3, T2, " ", 0, 17), "\n")
#debug concat("@B1 ", str(B1, 0, 17), "\n")
#debug concat("@B2 ", str(B2, 0, 17), "\n")
global_settings { assumed_gamma 1 noise_generator 3 }
#version 3.1;
#declare T3 = vturbulence(2, 0.5, 6, P);
#declare B3 = N1(0.3, 1.7, 2.9);
#version 3.7;
#debug concat("@T3 ", vstr(3, T3, " ", 0, 17), "\n")
#debug concat("@B3 ", str(B3, 0, 17), "\n")
Check("another noise from 3.5 on", (B1 != B2), 1)
Check("chosen noise stays", (B3 != B1), 1)

// Textures of old are read.
#version 2.0
sphere { <0 0 0> 1 texture { color red 1 phong 1 } }
#version 3.7;
