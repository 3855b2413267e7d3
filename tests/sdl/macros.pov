// Macros: token text, arguments, recursion.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"

#macro Factorial(N) #if (N <= 1) 1 #else (N*Factorial(N - 1)) #end #end
#declare A = (Factorial(5));
Check("recursion", A, 120)
#macro Depth(N) #if (N < 80) Depth(N + 1) #else #declare Deepest = N; #end #end
Depth(1)
Check("deep recursion", Deepest, 80)

// any token text: half a statement, components, an operator
#macro Open() sphere { 0, #end
Open() 1 }
#macro Components() 1, 2, 3 #end
CheckV("components", <Components()>, <1, 2, 3>)
#macro Plus() + #end
Check("operator", (2 Plus() 3), 5)
#macro Two(P, Q) P*10 + Q #end
Check("textual", Two(3, 4)*2, 38)
#declare T = Two(1, 2);
Check("as a value", T, 12)
#macro Sum(P, Q) (P + Q) #end
Check("nested calls", Sum(Sum(1, 2), Sum(3, Sum(4, 5))), 15)

// commas are optional, one may trail
#macro Pair(P Q) Check("first", P, 1) Check("second", Q, 2) #end
Pair(1, 2) Pair(1 2) Pair(1 2,)

// arguments are values of any kind
#macro Kinds(Number, Vector, String, Function, Array, Object)
  Check("number", Number, 1)
  CheckV("vector", Vector, <1, 2, 3>)
  CheckS("string", String, "s")
  Check("function", Function(2), 4)
  Check("array", Array[1], 8)
  object { Object }
#end
#declare F = function(x) { x*x }
Kinds(1, <1, 2, 3>, "s", F, array[2] { 7, 8 }, sphere { 0, 1 })

// arrays and their elements go by reference
#macro SetFirst(P) #declare P[0] = 100; #end
#macro Set(P, Value) #declare P = Value; #end
#declare R = array[2] { 1, 2 }
SetFirst(R) Set(R[1], 200)
Check("array by reference", R[0] + R[1], 300)
#macro SetLocal(P) #local P[1] = 5; #end
SetLocal(R)
Check("#local element of a parameter", R[1], 5)

// a definition inside a body; a parameter named like a macro; redefinition
#macro Maker() #macro Made(P) (P*2) #end #end
Maker()
Check("made", Made(21), 42)
#macro UsesName(Made) Check("parameter", Made, 5) #end
UsesName(5)
#macro Made(P) (P*3) #end
Check("redefined", Made(2), 6)

// #break outside a loop returns; directives between any two tokens
#declare Reached = 0;
#macro Early() #declare Reached = 1; #if (1) #break #end #declare Reached = 2; #end
Early()
Check("early return", Reached, 1)
CheckV("a loop inside a vector", <#for (I, 1, 3) I, #end>, <1, 2, 3>)
Check("a condition inside an argument", abs(#if (1) -5 #else 6 #end), 5)
#macro Nested() #local I = 0; #while (I < 3) #if (I = 1) Check("one", I, 1) #end #local I = I + 1; #end I #end
Check("loop before the value", Nested(), 3)
sphere { 0, 1 }
