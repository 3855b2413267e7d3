// Conditionals and loops.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare Trace = "";
#macro Note(S) #declare Trace = concat(Trace, S) #end
#macro Expect(S) CheckS("order", Trace, S) #declare Trace = "" #end

#for (I, 0, 1, 0.25) Note(str(I, 0, 2)) #end
Expect("0.000.250.500.751.00")
Check("the variable stays past the end", I, 1.25)
#for (J, 0, 3) #declare J = J + 1; #end
Check("and may be changed", J, 4)
#for (K, 3, 1, -1) Note(str(K, 0, 0)) #end
Expect("321")
#for (K, 3, 1) Note("never") #end
Expect("")
#declare Sum = 0;
#for (I, 1, 10) #for (J, 1, I) #declare Sum = Sum + 1; #end #end
Check("nested", Sum, 55)
#for (I, 0, 5) #if (I = 2) #break #end Note(str(I, 0, 0)) #end
Expect("01")

#local N = 0;
#while (N < 5) #local N = N + 1; #if (N = 2) #else Note(str(N, 0, 0)) #end #end
Expect("1345")
#while (N > 0) #local N = N - 1; #while (1) #if (N < 3) #break #end Note("a") #break #end #end
Expect("aa")

#switch (3) #range (1, 3) Note("a") #case (9) Note("b") #break #else Note("c") #end
Expect("ab")
#switch (7) #case (1) Note("x") #else Note("else") #end
Expect("else")
#switch (1) #case (1) Note("1") #case (2) Note("2") #else Note("e") #end
Expect("12e")
#switch (5) #case (1) Note("x") #break #case (5) #if (1) Note("5") #break #end Note("no") #end
Expect("5")
#switch (1 + 1e-11) /* blank */ #debug "" #case (1) Note("tolerance") #end
Expect("tolerance")
#switch (2) #case (1) Note("no") #end
Expect("")

#if (0) Note("1") #elseif (0) Note("2") #elseif (1) Note("3") #else Note("4") #end
Expect("3")
#if (1) Note("1") #elseif (1) Note("2") #else Note("3") #end
Expect("1")
#if (0) #macro Hidden() #end #if (1) #else #end unknown { ( words #nonsense #switch (1) #end #end
#ifndef (Hidden) Note("hidden") #end
Expect("hidden")
#ifdef (Trace) #ifndef (Trace) Note("no") #else Note("yes") #end #end
Expect("yes")
#
  /* blanks may follow the hash */ if (1) Note("hash") #  end
Expect("hash")

// an include may leave an #if open for the file that includes it
#include "half_open.inc"
  Note("open")
#end
Expect("open")
#declare V = <1, #if (1) 2 #else 3 #end, #include "two_components.inc"
CheckV("half a vector from an include", V, <1, 2, 8, 9>)
sphere { 0, 1 }
