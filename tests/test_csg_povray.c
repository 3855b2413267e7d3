// SPDX-License-Identifier: MIT
// Intersections, differences, merges and clips, converted and traced here, against POV-Ray's
// pictures of the same texts. Patches are its own triangles, so that every pixel may agree.
#include "tests/povray_table.h"

static const char STAGE[] =
    "#declare R = pigment { rgb <1, 0.2, 0.1> }\n"
    "#declare G = pigment { rgb <0.2, 0.9, 0.3> }\n"
    "#declare B = pigment { rgb <0.2, 0.3, 1> }\n" TABLE_PATCH
    "#declare Floor = plane { y, -1.5 pigment { checker rgb 0.3 rgb 0.9 } }\n"
    "#declare Eye = camera { location <1, 1.6, -4> right 4/3*x look_at 0 angle 50 }\n"
    "background { rgb <0.4, 0.5, 0.7> } light_source { <4, 8, -6>, 1 }\n";

static const char *const SCENES[] = {
    // 0: a lens, a cut of three colours, each surface with its own texture
    "camera { Eye } object { Floor }"
    "intersection { sphere { -0.6*x, 1.2 pigment { R } } sphere { 0.6*x, 1.2 pigment { G } }"
    " plane { y, 0.3 pigment { B } } }",
    // 1: differences with the parent's texture, nested
    "camera { Eye } object { Floor }"
    "difference { difference { box { -1, 1 } sphere { <0.3, 0.3, -1>, 0.8 pigment { R } } }"
    " union { cylinder { -2*y, 2*y, 0.4 } torus { 1, 0.35 rotate 20*x } } pigment { B }"
    " finish { phong 0.6 } rotate 25*y }",
    // 2: the inverse of an intersection, seen from within its walls
    "camera { location <-1.6, 0, 0> look_at <0, 0.1, 0.1> angle 100 }"
    "difference { box { -3, 3 pigment { B } }"
    " intersection { sphere { -0.3*x, 1 pigment { R } } sphere { 0.8*x, 1 pigment { G } } }"
    " finish { ambient 1 diffuse 0 } }",
    // 3: a patch has no inside
    "camera { Eye } object { Floor }"
    "difference { sphere { <-0.6, 0.3, 0>, 0.9 pigment { R } } object { P pigment { G } } }"
    "intersection { sphere { <0.9, 0.3, 0>, 0.6 pigment { R } } object { P pigment { B } } }",
    // 4: a hole in a patch; clipped triangles and discs
    "camera { Eye } object { Floor }"
    "difference { object { P pigment { G } } sphere { <0, 0.3, 0>, 0.6 } }"
    "union { triangle { <-2, -1, 1>, <2, -1, 1>, <0, 2, 1.4> } disc { <0, 0.5, 1.2>, z, 1, 0.3 }"
    " pigment { R } clipped_by { box { <-1, -1.2, 0>, <1.2, 0.8, 2> } } }",
    // 5: clips: on primitives, by several bodies, on a union around a patch
    "camera { Eye } object { Floor }"
    "sphere { <-1, 0, 0>, 0.9 pigment { R } clipped_by { plane { y, 0.3 } plane { x, -0.8 } } }"
    "union { object { P scale 0.6 pigment { G } } sphere { 0, 0.3 pigment { B } }"
    " clipped_by { sphere { 0, 0.6 } } translate <0.9, 0, -0.3> }",
    // 6: a clipped member of a difference, clips that are trees
    "camera { Eye } object { Floor }"
    "difference { box { -1, 1 pigment { R } } sphere { -z, 1 pigment { G }"
    " clipped_by { plane { y, 0.2 inverse } } } rotate 30*y }"
    "torus { 1.4, 0.2 pigment { B } clipped_by { difference { box { -2, 2 } box { 0, 3 } } } }",
    // 7: glass: walls counted by the bodies a ray is in
    "camera { Eye } object { Floor }"
    "difference { sphere { 0, 1.2 } box { <-0.5, -0.5, -2>, <0.5, 0.5, 2> } "
    " pigment { rgbt <0.9, 1, 0.9, 0.8> } finish { specular 0.5 reflection 0.1 }"
    " interior { ior 1.4 } rotate 30*y }",
    // 8: open and closed cones, infinite members, inverse
    "camera { Eye } object { Floor }"
    "intersection { cone { -y, 1.2, y, 0.3 open pigment { R } } box { -0.9, 0.9 inverse"
    " scale <2, 0.3, 2> pigment { G } } }"
    "intersection { plane { z, 2 pigment { B } } plane { -z, -1.8 } cylinder { 0, 5*z, 2 }"
    " pigment { G } }",
    // 9: flags: who casts shadows, what mirrors and cameras do not see
    "camera { Eye } plane { y, -1.5 pigment { rgb 0.5 } finish { reflection 0.4 } }"
    "intersection { sphere { -1.3*x, 0.8 no_shadow } box { <-2, -1, -1>, <0, 0.4, 1> no_image"
    " no_reflection } pigment { R } }"
    "difference { sphere { 1.3*x, 0.8 } cylinder { <1.3,0,-2>, <1.3,0,2>, 0.3 } pigment { G }"
    " no_reflection no_shadow }",
    // 10: surfaces that coincide
    "camera { location <0, 0, -6> right 4/3*x angle 50 }"
    "intersection { box { -1, 1 pigment { R } } box { <-1, -1, -1>, <1, 0.5, 3> pigment { G } }"
    " translate <-1.2, 0.3, 0> }"
    "intersection { intersection { box { -1, 1 pigment { R } } box { <-1, -1, -1>, <1, 0.5, 3>"
    " pigment { G } } } box { -9, 8 pigment { B } } translate <1.2, 0.3, 0> }",
    // 11: cutaway_textures
    "camera { Eye } object { Floor }"
    "difference { box { -1, 1 pigment { R } } sphere { <1, 1, -1>, 1.1 } cutaway_textures }"
    "intersection { sphere { <1.5, -0.6, -1>, 0.6 pigment { G } } plane { y, -0.4 }"
    " cutaway_textures }",
    // 12: the camera in a body, fog-free glass around it
    "camera { location <0.1, 0.2, -0.2> look_at <1, 0.1, 1> angle 90 } object { Floor }"
    "intersection { sphere { 0, 1 } box { -0.8, 0.8 } pigment { rgbt <1, 0.8, 0.6, 0.7> }"
    " interior { ior 1.3 } }",
    // 13: unions in intersections in merges
    "camera { Eye } object { Floor }"
    "merge { intersection { union { sphere { -0.7*x, 0.7 } sphere { 0.5*x, 0.8 } } box { <-2,-0.4,"
    "-2>, <2, 0.5, 2> } pigment { rgbt <1, 0.5, 0.4, 0.5> } } cylinder { -y, y, 0.4 pigment { rgbt"
    " <0.3, 1, 0.4, 0.5> } } object { P scale 0.5 pigment { B } } }",
    // 14: surfaces without end, clipped by what is turned with them
    "camera { Eye } object { Floor } quartic { <0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,"
    " -0.1666, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0, -1, 0, 0, 0, 0, 0> clipped_by { quadric { <1, "
    "1, 0>, 0, 0, -1 } plane { z, 1.4142 } plane { -z, 0 } } pigment { R } rotate <-60, 20, 40>"
    " translate <-0.9, -0.5, 0> }"
    "intersection { cubic { <1, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1, 0, 0, -0.2> }"
    " plane { x, 1 } plane { -x, 1 } plane { <1, 1, 0>, 1 } plane { <-1, -1, 0.2>, 1 } plane { z, 1"
    " } plane { -z, 1 } pigment { G } rotate <20, 30, 10> translate x }",
};

int main(void) {
    return povray_table_run(&(PovrayTable){.name = "csg_povray",
                                           .stage = STAGE,
                                           .scenes = SCENES,
                                           .count = sizeof SCENES / sizeof *SCENES,
                                           .share = 0.005});
}
