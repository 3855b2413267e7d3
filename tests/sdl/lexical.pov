/* Tokens: /* comments nest */ , */
#version 3.7; // to the end of the line
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare A=1;#declare B=2;/**/Check("tight",A+B,3)//
Check("blanks"
	,
	A /* in */ + // between
	B, 3)
#declare _name_1 = 4;
Check("identifiers", _name_1, 4)
#declare Redd = 1; #declare red_ = 2; #declare grey = 3;
Check("near reserved words", Redd + red_ + grey, 6)
CheckS("comment signs in strings", "/* // */", concat("/", "* ", "/", "/ *", "/"))
#if (0) a word, { ( [ 5 "string" $ ^ % ~ ' @ ` \ #end
Check("glued", (A<B)+(A<=B)+(B>=A)+(A!=B), 4)
CheckV("vectors glued to operators", <A,B,-A>*-B, <-2,-4,2>)
#declare X=(A>B?A:B); Check("choice glued", X, 2)
sphere{0,1}
