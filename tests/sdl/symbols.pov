// Scopes, #declare, #local, #undef, semicolons.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"

// #local on a parameter that was given as a name changes the caller's variable
#macro Increment(P) #local P = P + 1; #end
#declare Q = 1;
Increment(Q) Increment((Q)) Increment(+Q) Increment(Q + 0)
Check("by reference only as a bare name", Q, 2)

// scopes are dynamic: #declare finds the caller's local
#macro Inner() #declare Found = 7; #end
#macro Outer() #local Found = 1; Inner() Check("the caller's local", Found, 7) #end
Outer()
Check("nothing was made global", defined(Found), 0)

#macro MakeGlobal() #declare Made = 3; #end
MakeGlobal()
Check("global from a macro", Made, 3)
#macro Shadow() #local Made = 5; #declare Made = 6; Check("shadow", Made, 6) #end
Shadow()
Check("unchanged", Made, 3)

// #undef removes the innermost; on a parameter only the parameter
#macro Drop(P) #undef P Check("gone", defined(P), 0) #end
Drop(Q)
Check("the caller keeps it", Q, 2)
#undef Made
Check("gone", defined(Made), 0)

// the next directive sees the finished assignment
#declare S1 = "old"  #declare S1 = "new" #declare T1 = S1
CheckS("no look-ahead", T1, "new")

#declare A = 5;; // one surplus semicolon
Check("surplus", A, 5)
#declare B = A;
#declare A = "text";
Check("copied", B, 5)
CheckS("another type", A, "text")
#declare V = <1, 2>;
#declare V = V + <3, 4>;
CheckV("of itself", V, <4, 6>)
#declare O = sphere { 0, 1 }
#declare O2 = O
Check("objects", defined(O) + defined(O2), 2)

// a macro's own local as its value, and as an argument that cannot be a reference
#macro Five() #local L = 5; L #end
#declare F = Five();
Check("local value", F + Five(), 10)
#macro Change(P) #declare P = 99; Check("changed", P, 99) #end
Change(Five())
Check("not visible", defined(L), 0)
#macro Text() #local Z = "zz"; Z #end
CheckS("local string", Text(), "zz")

// names that exist before the scene are variables
#declare image_width = 3;
Check("image_width", image_width, 3)
CheckS("input_file_name", input_file_name, "symbols.pov")

// locals of an include end with it; its globals stay
#include "scopes.inc"
Check("include", defined(OfInclude) + 10*GlobalOfInclude, 20)
#ifdef (sphere) #error "a reserved word is not declared\n" #end
#declare deprecated once "old name" Old = 3;
Check("deprecated", Old, 3)

#declare Before = version;
#version 3.5;
Check("version", version, 3.5)
#version unofficial 3.6;
Check("unofficial", version, 3.6)
#version Before;
Check("version of a name", version, 3.7)
sphere { 0, 1 }
