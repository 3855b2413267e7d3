// Arrays of one to five dimensions.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare P = array[3] { 10, 20, 30 }
Check("subscripts truncate with a tolerance", P[2.7] + P[0.99999999999] + P[-1e-11], 60)
#declare M = array[2][3] { { 1, 2, 3 }, { 4, 5, 6 }, };
Check("two dimensions", M[0][2]*10 + M[1][0], 34)
Check("sizes", dimensions(M)*100 + dimension_size(M, 1)*10 + dimension_size(M, 2), 223)
Check("no such dimension", dimension_size(M, 3) + dimension_size(M, 0), 0)
#declare Five = array[1][2][1][2][2];
#declare Five[0][1][0][1][0] = 7;
Check("five dimensions", Five[0][1][0][1][0]*10 + dimensions(Five), 75)
#declare Copy = M;
#declare Copy[1][2] = 60;
Check("copies are deep", M[1][2]*100 + Copy[1][2], 660)
#declare Rows = array[2];
#declare Rows[0] = array[2] { 1, 2 }
#declare Rows[1] = array[3] { 7, 8, 9 }
Check("arrays of arrays", Rows[1][2]*10 + dimension_size(Rows[1], 1), 93)
#macro Change(Row) #declare Row[0] = 100; #end
Change(Rows[0])
Check("a row by reference", Rows[0][0], 100)

#declare Sparse = array[3];
#declare Sparse[1] = 5;
Check("set or not", defined(Sparse[0]) + 10*defined(Sparse[1]) + 100*defined(Sparse), 110)
#undef Sparse[1]
Check("emptied", defined(Sparse[1]), 0)
#ifdef (Sparse[2]) #error "unset element\n" #end

#declare Points = array[2][2] { { x, y }, { z, <1, 2, 3> } }
CheckV("vectors", Points[1][1] + Points[0][1], <1, 3, 3>)
#declare Functions = array[2] { function(x) { x + 1 }, function(x) { x*2 } }
Check("functions", Functions[0](5)*100 + Functions[1](5), 610)
#declare Objects = array[2];
#for (I, 0, 1) #declare Objects[I] = sphere { I, 1 } #end
object { Objects[1] }
#declare Textures = array[1] { texture { pigment { rgb 1 } } }
sphere { 0, 1 texture { Textures[0] } }
#declare Index = array[2] { 1, 0 }
Check("subscript of a subscript", P[Index[Index[1]]], 20)
#declare Size = 2;
#declare Filled = array[Size*2];
#local I = 0;
#while (I < dimension_size(Filled, 1)) #declare Filled[I] = I*I; #local I = I + 1; #end
Check("filled by a loop", Filled[3], 9)
sphere { 0, 1 }
