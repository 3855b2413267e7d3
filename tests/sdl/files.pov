// #fopen, #write, #read, #fclose. (Here what is written stays in memory.)
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#fopen Out "sdl_files.tmp" write
#write (Out, "1,-2.5,<1,2,3>,\"str\",<1,2>,+7,<1,-2,3,4>\n")
#fclose Out
Check("closed", defined(Out), 0)
#fopen In "sdl_files.tmp" read
#read (In, A, B, C, D)
Check("floats", A*10 + B, 7.5)
CheckV("vector", C, <1, 2, 3>)
CheckS("string", D, "str")
#read (In, E, F)
CheckV("uv", E, <1, 2>)
Check("sign", F, 7)
Check("not at the end", defined(In), 1)
#read (In, G)
CheckV("four", G, <1, -2, 3, 4>)
Check("the end was met after the last item", defined(In), 0)

// a missing comma loses the next item
#fopen Out "sdl_files.tmp" write
#write (Out, "1 2 3 4")
#fclose Out
#fopen In "sdl_files.tmp" read
#declare All = "";
#while (defined(In)) #read (In, Item) #declare All = concat(All, str(Item, 0, 0)) #end
CheckS("items", All, "133")

// numbers are written with six digits, vectors in brackets with a blank behind
#fopen Out "sdl_files.tmp" write
#write (Out, "#declare Got = \"", 1.23456789, ",", <1, 2.5, 3>, 1, 2, <1, 2>, 1e10, "\"\n")
#fclose Out
#fopen Out "sdl_files.tmp" append
#write (Out, "#declare Appended = 7;\n")
#fclose Out
#include "sdl_files.tmp"
CheckS("formats", Got, "1.23457,<1,2.5,3> 12<1,2> 1e+10")
Check("append", Appended, 7)
#fopen Out "sdl_files.tmp" write
#write (Out, "5,6")
#fclose Out
#declare Known = 1;
#declare Text = "x"
#fopen In "sdl_files.tmp" read
#read (In, Known, Text)
Check("into variables", Known + Text, 11)
#fclose In
sphere { 0, 1 }
