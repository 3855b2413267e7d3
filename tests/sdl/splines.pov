// Splines of all kinds, against their definitions.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare S = spline { 0, <0, 0, 0>, -1, <-1, 0, 0> 2, <2, 0, 5> 1, <1, 1, 0> } // sorted when read
CheckV("linear is the default", S(1.5), <1.5, 0.5, 2.5>)
CheckV("cubic", S(0.5, cubic_spline), <0.5, 0.5625, -0.3125>)
CheckV("natural", S(0.5, natural_spline), <0.5, 0.575, -0.375>)
CheckV("quadratic uses the key before", S(0.5, quadratic_spline), <0.5, 0.375, 0>)
CheckV("first segment: the key after", S(-0.5, quadratic_spline), <-0.5, -0.125, 0>)
CheckV("before the first key", S(-9), <-1, 0, 0>)
CheckV("after the last", S(9, natural_spline), <2, 0, 5>)
CheckV("cubic begins at the second key", S(-0.5, cubic_spline), <0, 0, 0>)
CheckV("cubic ends at the last but one", S(1.5, cubic_spline), <1, 1, 0>)
#declare One = spline { cubic_spline 3, <1, 2, 3, 4, 5> }
CheckV("one key", One(7), <1, 2, 3, 4, 5>)
#declare Two = spline { cubic_spline 1, 4 2, 6 }
CheckV("two keys: their mean", Two(1.1), <5, 5>)
#declare Replaced = spline { 0, 1 1, 2 2, 3 1, 5 2, 7 }
CheckV("an equal key replaces, but not the last", Replaced(1) + Replaced(2), <8, 8>)
#declare More = spline { S quadratic_spline 3, <3, 3, 3> }
CheckV("extended", More(3), <3, 3, 3>)
CheckV("the old one stays", S(3), <2, 0, 5>)

// keys of unequal distance: a cubic polynomial's slopes by central differences, non-uniform
#declare T0 = -0.5; #declare T1 = 0.25; #declare T2 = 2; #declare T3 = 2.5;
#declare U4 = spline { cubic_spline T0, <1, 7> T1, <3, -1> T2, <-2, 4> T3, <0, 0> }
#macro Hermite(P0, P1, P2, P3, T)
  #local H = T2 - T1;
  #local R = (T - T1)/H;
  #local M1 = ((P1 - P0)/(T1 - T0) + (P2 - P1)/H)/2*H;
  #local M2 = ((P2 - P1)/H + (P3 - P2)/(T3 - T2))/2*H;
  (P1*(1 + 2*R)*(1 - R)*(1 - R) + M1*R*(1 - R)*(1 - R) + P2*R*R*(3 - 2*R) - M2*R*R*(1 - R))
#end
#for (T, T1, T2, 0.125)
  Check("cubic u", U4(T).u, Hermite(1, 3, -2, 0, T))
  Check("cubic v", U4(T).v, Hermite(7, -1, 4, 0, T))
#end
sphere { 0, 1 }
