// Widths, precedence, comparisons, member access, literals.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare V = <1, 2, 3>;
#declare U2 = <5, 6>;
#declare W = <1, 2, 3, 4>;

// precedence and signs
Check("sum", 2 + 3*4 - 5, 9)
Check("left", 10 - 3 - 2, 5)
Check("division", 8/2/2, 2)
Check("signs", +-+2, -2)
Check("minus minus", 1--1, 2)
Check("times minus", 2*-3, -6)
Check("missing comma", 1 -2, -1)
CheckV("missing comma in vector", <1 -2, 3>, <-1, 3>)
Check("equal precedence", (1 | 1 & 0), 0)
Check("equal precedence 2", (0 & 1 | 1), 1)
Check("not", !0 + !5*10 + !1e-11, 2)
Check("choice", (0 ? 2 : 0 ? 4 : 5), 5)
Check("nested choice", (1 ? 0 ? 1 : 2 : 3), 2)
CheckV("choice of vectors", (1 ? V : 2), V)
Check("choice in a function's parentheses", abs(1 < 2), 1)

// truth and equality with tolerance, order without
Check("tiny is false", (1e-11 ? 1 : 0), 0)
Check("fuzzy equal", (1 = 1 + 1e-11), 1)
Check("exact less", (1 < 1 + 1e-11), 1)
Check("fuzzy less or equal", (1 <= 1 - 1e-11), 1)
Check("fuzzy not equal", (1 != 1 + 1e-11), 0)
Check("chain", (3 > 2 > 1), 0)
CheckV("component-wise", (V < <2, 2, 2>), <1, 0, 0>)
CheckV("component-wise not", !<0, 2, 0>, <1, 0, 1>)
CheckV("float left of vector", (2 < V), <0, 0, 1>)

// strings compare at the start of a relation
Check("string equal", ("abc" = "abc"), 1)
Check("string less", ("abc" < "abd"), 1)
Check("string order", ("b" > "abd"), 1)
Check("string not equal", ("b" != "b"), 0)
Check("string and number", (1 & "a" = "b"), 0)

// widths
CheckV("float times vector", 2*V, <2, 4, 6>)
CheckV("component-wise product", V*<2, 3, 4>, <2, 6, 12>)
CheckV("component-wise quotient", 1/V, <1, 1/2, 1/3>)
CheckV("pad with zero", U2 + V, <6, 8, 3>)
CheckV("wider right", U2*W, <5, 12, 0, 0>)
CheckV("axes", -x + y*2 - z, <-1, 2, -1>)
CheckV("u and v", u + 2*v, <1, 2>)
CheckV("trailing comma", <1, 2, 3,>, V)
CheckV("no comma", <1, 2 3>, V)
CheckV("five", <1, 2, 3, 4, 5>*<0, 0, 0, 1, 1>, <0, 0, 0, 4, 5>)

// member access binds tightest; at the start of a sum it leaves the other components behind
Check("member", V.y, 2)
Check("member of minus", -V.y, -2)
Check("member of parentheses", (V*2).z, 6)
Check("member of a call", vcross(x, y).z, 1)
Check("t", W.t, 4)
Check("quirk", vlength(V.y), sqrt(4 + 4 + 9))
Check("no quirk", vlength(1*V.y), sqrt(12))
Check("quirk in a vector of two", vlength(U2.v), sqrt(36 + 36))
Check("float as vector", vlength(2), sqrt(12))
Check("uv as vector", vlength(U2), sqrt(61))

// numbers
Check("5.", 5., 5)
Check(".5", .5, 0.5)
Check("1e3", 1e3 + 1E-3 + 1e+2, 1100.001)
Check("1e", 1e, 1)
Check("leading zeros", 007, 7)
sphere { 0, 1 }
