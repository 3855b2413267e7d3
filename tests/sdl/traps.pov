// The fifty traps of the language in their order. Where the right outcome is an error, the file of
// tests/errors that has its place and words is named; where a text cannot ask for it, the test of
// the scene that is made. Lines that begin with @ must be POV-Ray's.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"

// ---- expressions ------------------------------------------------------------------------------

// 1: a member at the start of a vector argument leaves the other components behind
#declare V1 = <1, 2, 3>;
Check("1: member first", vlength(V1.y), sqrt(17))
Check("1: member after a product", vlength(1*V1.y), sqrt(12))
Check("1: member where a float is wanted", abs(V1.y), 2)

// 2: a missing comma makes a sign a subtraction
CheckV("2: two components", <1 -2, 3>, <-1, 3>)
CheckS("2: two components", vstr(3, <1 -2, 3>, ",", 0, 0), "-1,3,0")
CheckV("2: with the comma", <1, -2, 3>, V1*<1, -1, 1>)

// 3: '>' and '=' without a blank are one token (errors/lex_glued.pov)
Check("3: with a blank", ((<1, 2, 3> = <1, 2, 4>).x), 1)
Check("3: the third differs", ((<1, 2, 3> = <1, 2, 4>).z), 0)

// 4: after a colour keyword '<' compares (errors/statement_checker_vectors.pov), elsewhere vectors
// may touch
#declare P4 = pigment { checker rgb <1, 1, 1>, <0, 0, 0> }
#declare P4 = pigment { checker rgb <1, 1, 1> rgb <0, 0, 0> }
#declare F4 = function { pigment { P4 } }
CheckV("4: both colours were read", F4(0.5, 0.5, 0.5) - F4(1.5, 0.5, 0.5), <1, 1, 1>)
triangle { <0, 0, 0><1, 0, 0><0, 1, 0> }

// 5: comparisons and ?: in parentheses and in functions of one argument only (errors/expr_add.pov)
#declare A = (1 < 2 ? 3 : 4);
Check("5: choice", A, 3)
Check("5: one argument", abs(1 < 2), 1)
Check("5: parentheses in a longer list", max((1 < 2), 0), 1)

// 6: a float where a colour is wanted fills filter and transmit, 1 - Colour too
#declare C6 = color 1;
CheckS("6: color 1", vstr(5, C6, " ", 0, 0), "1 1 1 1 1")
#declare Red = rgb <1, 0, 0>;
#declare C6 = 1 - Red;
CheckS("6: 1 - Red", vstr(5, C6, " ", 0, 0), "0 1 1 1 1")
#declare C6 = rgb 1;
CheckS("6: rgb 1", vstr(5, C6, " ", 0, 0), "1 1 1 0 0")

// 7: & and | are of one rank, but not inside functions
#declare F7 = function(x) { 1 | 1 & 0 }
Check("7: from left to right", (1 | 1 & 0), 0)
Check("7: & first in a function", F7(0), 1)

// 8: vstr does not promote a float
CheckS("8: vstr", vstr(3, 5, ",", 0, 0), "5,0,0")
Check("8: vlength does", vlength(5), sqrt(75))

// 9: #read loses every second item where commas are missing
#fopen Out "sdl_traps.tmp" write
#write (Out, "1 2 3 4\n")
#fclose Out
#fopen In "sdl_traps.tmp" read
#declare Items = "";
#while (defined(In)) #read (In, Item) #declare Items = concat(Items, str(Item, 0, 0), " ") #end
CheckS("9: items", substr(Items, 1, 4), "1 3 ")

// ---- symbols, macros, loops -------------------------------------------------------------------

// 10: #local on a parameter changes the caller's variable
#macro M10(P) #local P = P + 1; #end
#declare Q = 1;
M10(Q)
M10((Q))
Check("10: once", Q, 2)

// 11: #declare finds a caller's local of the same name
#macro Inner() #declare X11 = 7; #end
#macro Outer() #local X11 = 1; Inner() Check("11: the local", X11, 7) #end
Outer()
Check("11: no global was made", defined(X11), 0)

// 12: a value inside a last #if needs parentheses around the call (errors/macro_value_in_if.pov)
#macro Factorial(N) #if (N <= 1) 1 #else (N*Factorial(N - 1)) #end #end
#declare A = (Factorial(5));
Check("12: in parentheses", A, 120)

// 13: a directive behind a value sees the assignment done
#declare S13 = "old"  #declare S13 = "new" #declare T13 = S13
CheckS("13: strings", T13, "new")
#declare A = 1; #declare A = A + 1; #if (A = 2) #declare A = 5; #end
Check("13: numbers", A, 5)

// 14: scale with two components: z is 0 and becomes 1; translate fills with 0
#declare O14 = sphere { 1, 1 scale <1, 2> }
CheckV("14: scale", max_extent(O14), <2, 4, 2>)
#declare O14 = sphere { 1, 1 translate <1, 2> }
CheckV("14: translate", max_extent(O14), <3, 4, 2>)

// 15: the variable of #for ends one step past the end and can be changed inside
#for (I, 0, 1, 0.25) #end
Check("15: past the end", I, 1.25)
#declare Rounds = 0;
#for (J, 0, 3) #declare J = J + 1; #declare Rounds = Rounds + 1; #end
Check("15: changed", J*10 + Rounds, 42)
#macro M15() #for (Own, 0, 1) #end Check("15: in the macro", Own, 2) #end
M15()
Check("15: local to the macro", defined(Own), 0)

// 16: #switch falls through, #range includes its ends, #break inside #if ends the loop
#declare Seen = "";
#macro Note(S) #declare Seen = concat(Seen, S) #end
#switch (3) #range (1, 3) Note("a") #case (9) Note("b") #break #else Note("c") #end
#for (I, 0, 5) #if (I = 2) #break #end Note(str(I, 0, 0)) #end
CheckS("16: order", Seen, "ab01")
#switch (1) #range (1, 3) Note("d") #end
CheckS("16: the lower end, no #break", Seen, "ab01d")

// 17: #break outside a loop returns from the macro
#declare Seen = "";
#macro M17() Note("1") #if (1) #break #end Note("2") #end
M17()
Note("3")
CheckS("17: order", Seen, "13")

// 18: tiny values are false, equality is fuzzy, '<' is exact
Check("18: truth", (1e-11 ? 1 : 0), 0)
Check("18: equality", (1 = 1 + 1e-11), 1)
Check("18: order", (1 < 1 + 1e-11), 1)
Check("18: all beyond the tolerance", (1e-9 ? 1 : 0)*10 + (1 = 1 + 1e-9), 10)

// 19: skipped text is read as tokens (errors/lex_period.pov); words and braces in it are free
#if (0) the cats meow { ( < 5.6 #end

// 20: one semicolon too many after a number is allowed, none after a call
// (errors/macro_semicolon.pov)
#declare A = 5;;
Check("20: surplus", A, 5)

// 21: the elements of an array are of one kind, 0 is no vector (errors/array_type.pov)
#declare P21 = array[3] { x, y, 0*x }
CheckV("21: vectors", P21[0] + P21[1] + P21[2], <1, 1, 0>)

// 22: subscripts are cut off, with a small tolerance
#declare P22 = array[3] { 10, 20, 30 }
Check("22: cut off", P22[2.7], 30)
Check("22: tolerance", P22[0.99999999999], 20)
Check("22: beyond it", P22[0.999999], 10)

// 23: macros may hold pieces of statements, loops pieces of vectors
#macro Open() sphere { 0, #end
#declare O23 = Open() 2 }
CheckV("23: a piece", max_extent(O23), <2, 2, 2>)
CheckV("23: components", <#for (I, 1, 3) I, #end>, <1, 2, 3>)

// 24: u is x and v is y, values are taken when the function is made; a parameter must be a new name
// (errors/function_parameter.pov)
#declare K = 5;
#declare F24 = function(u, v) { x + 10*y + K }
#declare K = 50;
Check("24: value", F24(1, 2), 26)

// 25: words of one letter are reserved (errors/macro_reserved.pov): u v x y z t
CheckV("25: axes", u + 2*v, <1, 2>)
CheckV("25: axes", x + 2*y + 3*z, <1, 2, 3>)
CheckV("25: t", 4*t, <0, 0, 0, 4>)
#macro M25(V) V + 1 #end
Check("25: capitals are free", M25(2), 3)

// 26: seed gives numbers in order of creation; the generator is a linear congruence
#declare R1 = seed(42);
#declare R2 = seed(0);
Check("26: number", R2 - R1, 1)
CheckS("26: of 42", str(rand(R1), 0, 10), "0.7235829112")
CheckS("26: of 0", str(rand(R2), 0, 10), "0.0000028743")
CheckS("26: same seed, same numbers", str(rand(seed(42)), 0, 10), "0.7235829112")

// 27: colours are in single precision, vectors are not
#declare C27 = rgb 0.1;
CheckS("27: colour", str(C27.red, 0, 10), "0.1000000015")
#declare V27 = <0.1, 0.1, 0.1>;
CheckS("27: vector", str(V27.x, 0, 10), "0.1000000000")

// 28: #debug shows whole lines only (its other half is the end of this file)
#debug "@shown"
#debug " once the line ends\n"

// ---- objects and textures ---------------------------------------------------------------------

// 29: a name alone is an object, but not as the first item of a CSG
// (errors/statement_union_names.pov)
#declare A = sphere { 0, 1 }
A
#declare O29 = union { sphere { 3, 1 } A }
CheckV("29: a name as a later item", min_extent(O29), -<1, 1, 1>)
#declare O29 = union { object { A translate 5*x } A }
CheckV("29: and behind an object", max_extent(O29), <6, 1, 1>)

// 30: no commas between the words of a patch (errors/statement_patch_comma.pov), type is needed
// (errors/statement_patch_type.pov)
#macro Rows()
  <0,1,0><1,1,0><2,1,0><3,1,0> <0,2,0><1,2,0><2,2,0><3,2,0> <0,3,0><1,3,0><2,3,0><3,3,0>
#end
#declare O30 = bicubic_patch { type 1 u_steps 3 v_steps 3 <0,0,0><1,0,0><2,0,0><3,0,0> Rows() }
CheckV("30: the patch", trace(O30, <1.5, 1, -5>, z), <1.5, 1, 0>)

// 31: names and no commas between the points; uv_vectors right before them
// (errors/statement_patch_uv_last.pov)
#declare Corner = <0, 0, 0>;
#declare F = 0.01;
#declare O31 = bicubic_patch {
  type 1 flatness F v_steps 3 u_steps 3 uv_vectors <0,0><1,0><1,1><0,1>
  Corner <1,0,0>, Corner + 2*x <3,0,0> Rows()
}
CheckV("31: the patch", trace(O31, <1.5, 2, -5>, z), <1.5, 2, 0>)

// 32: a second texture is a layer, a pigment replaces (layers in test_convert_texture.c)
#declare S32 = sphere { 0, 1 texture { pigment { rgb <0, 1, 0> } } }
object { S32 texture { pigment { rgbt <1, 0, 0, 0.5> } } }
object { S32 pigment { rgbt <1, 0, 0, 0.5> } }

// 33: a child with any item of a texture inherits nothing (unions_pass_on in test_convert.c)
union { sphere { 0, 1 finish { ambient 1 } } sphere { 9, 1 } pigment { rgb <1, 0, 0> } }

// 34: the default texture is that at the end of the statement (defaults in
// test_convert_texture.c)
#declare S34 = sphere { 0, 1 }
#default { pigment { rgb <1, 0, 0> } }
object { S34 }

// 35: transforms reach what stands before them only (of textures:
// transforms_reach_what_is_there in test_convert_texture.c; a clip shows it to trace)
sphere { <1, 0, 0>, 1 translate -0.75*x pigment { gradient x } }
#declare O35 = sphere { 0, 1 translate 2*x clipped_by { plane { x, 2 } } }
CheckV("35: the clip stays", trace(O35, 9*x, -x), <1, 0, 0>)
#declare O35 = sphere { 0, 1 clipped_by { plane { x, 0.5 } } translate 2*x }
CheckV("35: the clip moves", trace(O35, <9, 0.9, 0>, -x), <2 + sqrt(0.19), 0.9, 0>)

// 36: two textures behind #declare are one layered texture (layers in
// test_convert_texture.c)
#declare T36 = texture { pigment { rgb <1, 0, 0> } } texture { pigment { rgbt <0, 1, 0, 0.25> } }
sphere { 0, 1 texture { T36 } }

// 37: an image without an ending has that of the output, png (errors/file_image_ending.pov)
#declare P37 = pigment { image_map { "test" } }
#declare P38 = pigment { image_map { png "test.png" } }
#declare F37 = function { pigment { P37 } }
#declare F38 = function { pigment { P38 } }
CheckV("37: the same image", F37(0.3, 0.7, 0), F38(0.3, 0.7, 0))

// 38: see traps_version.pov

// 39: transforms of a camera work after look_at (test_convert_world.c); its type is the
// first item (errors/statement_camera_type.pov)
camera { orthographic location <0, 0, -5> translate x look_at 0 }

// 40: a light without a colour is black (test_convert.c); spotlight stands before what
// belongs to it (errors/statement_light_radius.pov)
light_source { <1, 2, 3> }
light_source { <1, 2, 3> rgb 1 spotlight radius 5 }

// 41: a bare vector is no pigment (errors/statement_pigment_vector.pov) and no entry of a map
// (errors/statement_map_vector.pov); behind "color" it is a colour
#declare Pink = rgb <1, 0, 0.5>;
#declare F41 = function { pigment { gradient x color_map { [0 color <1, 0, 0.5>] [1 Pink] } } }
CheckV("41: color and a name", F41(0.5, 0, 0), Pink)

// 42: rgb is no part of an expression (errors/expr_rgb.pov), it takes a whole one
#declare C42 = rgb <1, 0, 0>*0.5 + <0, 1, 0>;
CheckV("42: whole", C42, <0.5, 1, 0>)

// 43: comments nest
#declare Seen = "";
/* a /* b */ Note("inside") */ Note("code")
CheckS("43: comments", Seen, "code")

// 44: strings are of units of 16 bits; zeros by a negative length; strcmp is a difference; val
// reads hexadecimal numbers
CheckS("44: str", str(3.14159, -8, 3), "0003.142")
Check("44: strcmp", strcmp("a", "c"), -2)
Check("44: val", val("0x10"), 16)
Check("44: strlen", strlen("\u00e9"), 1)

// 45: an argument that is a name alone goes by reference, an element of an array too
#macro Increase(P) #declare P = P + 1; #end
#declare A = array[2] { 1, 2 }
Increase(A[1])
Increase(A[0]+0)
Check("45: elements", A[0]*10 + A[1], 13)

// 46: a variable may change its kind, a function may not be declared again
// (errors/declare_function.pov)
#undef A
#declare A = 5;
#declare A = "text";
CheckS("46: another kind", A, "text")
#declare F46 = function(x) { x }
#undef F46
#declare F46 = function(x) { 2*x }
Check("46: after #undef", F46(3), 6)

// 47: the semicolon is needed behind numbers only (errors/declare_semicolon.pov)
#declare S47 = "a"  #declare O47 = sphere { 0, 1 }  #declare A47 = <1, 2, 3>;
Check("47: all there", defined(S47) + defined(O47) + defined(A47), 3)

// 48: members by any name if there are enough components; t is the fourth, gray is luma
#declare C48 = rgbft <1, 0.5, 0, 0.25, 0.75>;
Check("48: x", C48.x, 1)
Check("48: t", C48.t, 0.25)
Check("48: transmit", C48.transmit, 0.75)
CheckS("48: gray", str(C48.gray, 0, 4), "0.5915")
Check("48: colour's names on a vector", V1.red + 10*V1.green + 100*V1.blue, 321)

// 49: int and div overflow without a word, mod has the sign of its first
CheckS("49: int", str(int(3e9), 0, 0), "-2147483648")
CheckS("49: div", str(div(1, 0), 0, 0), "-2147483648")
Check("49: mod", mod(-7, 3), -1)

// 50: macros without commas, in their head and in their call; one may trail
#macro M50(A B) A*10 + B #end
Check("50: no commas", M50(1 2), 12)
Check("50: one trails", M50(1 2,), 12)
#macro M50(A, B,) A*10 + B #end
Check("50: in the head too", M50(3, 4), 34)

// 28, the other half: this line never ends
#debug "@lost at the end"
