// SPDX-License-Identifier: MIT
// What was found in scenes of others: each text once came out otherwise than POV-Ray's picture of
// it.
#include "tests/povray_table.h"

static const char STAGE[] = "#declare Eye = camera { location <0, 1, -4> right 4/3*x look_at 0 }\n"
                            "background { rgb <0.4, 0.5, 0.7> } light_source { <4, 8, -6>, 1 }\n"
                            "camera { Eye }\n";

static const char *const SCENES[] = {
    // 0: small triangles far from the origin, mirrors of a fine pattern far away. Their planes were
    // those of the points in single precision: nearly all of the reflection was elsewhere.
    "#declare M = mesh { #for (I, -4, 3) #for (J, -4, 3)\n"
    "triangle { <5000.1+I*0.7, 3000.3+J*0.7, 0.01*J>, <5000.1+(I+1)*0.7, 3000.3+J*0.7, 0.02*I>,\n"
    "<5000.1+I*0.7, 3000.3+(J+1)*0.7, 0> } #end #end }\n"
    "object { M translate <-5000.1, -3000.3, 0> pigment { rgb 0 } finish { reflection 1 } }\n"
    "plane { z, -1000 pigment { gradient x triangle_wave color_map { [0.5 rgb 0] [0.5 rgb x] } }\n"
    "finish { ambient 1 diffuse 0 } }",
    // 1: a roughness of 0 was refused: the highlight covers all that is lit
    "sphere { -1.1*x, 1 pigment { rgb <0.6, 0.1, 0.1> } finish { specular 0.5 roughness 0 } }\n"
    "sphere { 1.1*x, 1 pigment { rgb <0.1, 0.6, 0.1> }\n"
    "finish { specular albedo 0.5 roughness 0 } }",
    // 2: a reflection exponent of 0 was refused: only what is bright is reflected
    "sphere { 0, 1 pigment { rgb 0.3 } finish { reflection { 0.2, 0.9 exponent 0 } } }\n"
    "plane { y, -1 pigment { checker rgb 1 rgb 0.5 } finish { ambient 1 diffuse 0 } }",
    // 3: rays in glass that end just before the container of an isosurface does had a hit there,
    // nearer than the accuracy: a seam along its edges
    "isosurface { function { x*x + z*z + y*y*0.2 - 1 } contained_by { box { <-2, -0.6, -2>,\n"
    "<2, 0.6, 2> } } accuracy 0.02 max_gradient 5 max_trace 10 interior { ior 1.5 }\n"
    "pigment { rgbf <1, 0.6, 0.6, 0.7> } finish { phong 1 reflection 0.3 } rotate x*20 }\n"
    "plane { y, -2 pigment { checker rgb 1 rgb 0.2 } }",
    // 4: a union that grows in a loop was refused when it was 1000 unions deep
    "#declare U = sphere { -2*x, 0.2 pigment { rgb x } }\n"
    "#for (I, 1, 2500) #declare U = union { object { U }\n"
    "sphere { <I/625 - 2, 0.5*sin(I/50), 0>, 0.06 pigment { rgb <I/2500, 1, 0> } } } #end\n"
    "object { U rotate 20*x }",
    // 5: transforms between the object of a pattern and its list were refused
    "box { -1, 1 rotate <20, 30, 0> pigment { object { torus { 0.8, 0.3 } scale <1, 2, 1>\n"
    "rotate 60*x translate 0.3*y color rgb <1, 0.8, 0.2>, color rgb <0.1, 0.3, 0.9> } } }",
};

int main(void) {
    return povray_table_run(&(PovrayTable){.name = "found_povray",
                                           .stage = STAGE,
                                           .scenes = SCENES,
                                           .count = sizeof SCENES / sizeof *SCENES,
                                           .share = 0.001});
}
