// String functions, escapes, number formats.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
CheckS("concat", concat("a" "b", "c"), "abc")
CheckS("substr", substr("hello", 2, 3), "ell")
CheckS("substr whole", substr("hello", 1, 5), "hello")
CheckS("substr truncates", substr("hello", 2.9, 1.9), "e")
CheckS("case", concat(strupr("aBcz"), strlwr("ABcZ")), "ABCZabcz")
CheckS("chr", concat("[", chr(65), chr(0), "]"), "[A]")
CheckS("str", str(2.5, 0, 0), "2")
CheckS("str rounds as C", str(3.5, 0, 0), "4")
CheckS("str default", str(2, 0, -1), "2.000000")
CheckS("str zeros", str(3.14159, -8, 3), "0003.142")
CheckS("str width", str(3.14159, 10, 3), "     3.142")
CheckS("str minus", str(-3.14159, -10, 3), "-00003.142")
CheckS("str too long", str(1e300, 0, 0), "1e+300")
CheckS("str truncates its numbers", str(5, 4.9, 1.9), " 5.0")
CheckS("vstr", vstr(3, <1, 2, 3>, ",", 0, 1), "1.0,2.0,3.0")
CheckS("vstr does not repeat a float", vstr(3, 5, ",", 0, 0), "5,0,0")
CheckS("vstr at most five", vstr(9, <1, 2>, " ", 0, 0), "1 2 0 0 0")
CheckS("vstr at least two", vstr(1, <1, 2, 3>, " ", 0, 0), "1 2")
CheckS("datetime", datetime(0), "2000-01-01 00:00:00Z")
CheckS("datetime", datetime(1234.5), "2003-05-19 12:00:00Z")
CheckS("datetime format", datetime(1.5, "%H:%M %j"), "12:00 002")
Check("escapes", asc("\n") + asc("\t") + asc("\\") + asc("\"") + asc("\'"), 10 + 9 + 92 + 34 + 39)
Check("control escapes", asc("\a") + asc("\b") + asc("\f") + asc("\r") + asc("\v"), 7 + 8 + 12 + 13 + 11)
Check("unicode", asc("\u20ac"), 8364)
Check("units", strlen("\u00e9\u20acx"), 3)
Check("units in substr", asc(substr("a\u20acb", 2, 1)), 8364)
Check("chr of a unit", asc(chr(8364)), 8364)
Check("over two lines", strlen("a
b"), 3)
#declare Name = "text";
#declare Copy = Name
#declare Name = 5; // another type
CheckS("strings are copied", Copy, "text")
#macro Last(S) substr(S, strlen(S), 1) #end
CheckS("a macro's string", Last("abc"), "c")
#declare Words = array[2] { "one", concat("t", "wo") }
CheckS("in an array", concat(Words[0], Words[1]), "onetwo")
sphere { 0, 1 }
