// SPDX-License-Identifier: MIT
// cutaway_textures against POV-Ray's pictures: which surfaces show what, how much of each, and what
// shines through them.
#include "tests/povray_table.h"

static const char STAGE[] =
    "#declare R = pigment { rgb <1, 0.2, 0.1> }\n"
    "#declare G = pigment { rgb <0.2, 0.9, 0.3> }\n"
    "#declare B = pigment { checker rgb <0.2, 0.3, 1> rgb <0.9, 0.9, 0.2> scale 0.3 }\n"
    "#declare T = texture { pigment { rgbt <0.3, 0.8, 1, 0.7> } finish { phong 0.8 } "
    "}\n" TABLE_PATCH "#declare Floor = plane { y, -1.5 pigment { checker rgb 0.3 rgb 0.9 } }\n"
    "#declare Eye = camera { location <1, 2, -4> right 4/3*x look_at 0 angle 50 }\n"
    "background { rgb <0.4, 0.5, 0.7> } light_source { <4, 8, -6>, 1 }\n"
    "#default { pigment { rgb <0.9, 0.5, 0.9> } }\n"
    "camera { Eye } object { Floor }\n";

static const char *const SCENES[] = {
    // 0: a union is cut: each part shows its own, both where they overlap
    "difference { union { box { <-1.4, -1, -1>, <0.3, 1, 1> pigment { R } } sphere { 0.6*x, 1.1"
    " pigment { B } } } cylinder { <-2, 0.5, -1>, <2, 0.5, -1>, 0.8 } cutaway_textures }",
    // 1: an intersection shows all, those not cut included
    "intersection { sphere { -0.4*x, 1.2 pigment { R } } sphere { 0.4*x, 1.2 pigment { B } }"
    " plane { y, 0.3 } plane { -z, 0.3 } cutaway_textures }",
    // 2: the word on the outer or the inner of two: the textures are those of the outer
    "intersection { difference { sphere { 0, 1.2 pigment { R } } box { <-2, 0.2, -2>, 2 } }"
    " sphere { 0.5*y, 1.3 pigment { G } } plane { -z, 0.6 } cutaway_textures translate -1.2*x }"
    "intersection { difference { sphere { 0, 1.2 pigment { R } } box { <-2, 0.2, -2>, 2 }"
    " cutaway_textures } sphere { 0.5*y, 1.3 pigment { G } } plane { -z, 0.6 pigment { B } }"
    " translate 1.2*x }",
    // 3: no texture anywhere; a texture only in what is taken away
    "difference { sphere { -1.2*x, 1 } box { <-2, 0, -2>, <2, 2, 2> } cutaway_textures }"
    "difference { sphere { 1.2*x, 1 } box { <-2, 0, -2>, <2, 2, 2> pigment { R } }"
    " cutaway_textures }",
    // 4: children of unions and merges have the default; of an inverted union they do not
    "difference { sphere { -1.2*x, 1 pigment { R } } union { box { <-2, 0.3, -2>, 2 }"
    " cylinder { <-2, 0, -1>, <2, 0, -1>, 0.5 } } cutaway_textures }"
    "intersection { sphere { 1.2*x, 1 pigment { B } } merge { box { -2, <2, -0.2, 2> }"
    " cylinder { <1, -1, -0.5>, <1, 1, -0.5>, 0.6 } } cutaway_textures }",
    // 5: a union below a difference and an intersection inside out, both with some texture
    "difference { box { <-2.2, -1, -1>, <-0.2, 1, 1> pigment { R } } union { sphere { <-1, 1, -1>, "
    "0.8 pigment { G } } cylinder { <-1.6, -2, -1>, <-1.6, 2, -1>, 0.4 } } cutaway_textures }"
    "difference { box { <0.2, -1, -1>, <2.2, 1, 1> pigment { R } } intersection { sphere { <1, 1, "
    "-1>, 0.9 } cylinder { <1, -2, -1>, <1, 2, -1>, 0.6 } pigment { B } } cutaway_textures }",
    // 6: the clips of a child do not count for its texture
    "intersection { union { sphere { 0, 1.2 pigment { R } clipped_by { plane { x, 0 } } }"
    " sphere { 0, 1.3 pigment { G } clipped_by { plane { -x, 0.2 } } } } plane { y, 0.3 }"
    " cutaway_textures }",
    // 7: blobs and meshes ask their parts, which have nothing
    "difference { sphere { -1.2*x, 1 pigment { R } } blob { threshold 0.5 sphere { <-1.2, 0.6, "
    "-0.8>, 1.4, 1 } } cutaway_textures }"
    "difference { box { <0.2, -1, -1>, <2, 1, 1> pigment { G } } mesh { triangle { <0, 0, -1.5>, "
    "<2.5, 0, -1.5>, <1.2, 2, -1> } triangle { <0, 0, -1.5>, <1.2, 2, -1>, <1.2, 0.5, 1> } triangle"
    " { <2.5, 0, -1.5>, <1.2, 2, -1>, <1.2, 0.5, 1> } triangle { <0, 0, -1.5>, <2.5, 0, -1.5>, "
    "<1.2, 0.5, 1> } inside_vector y } cutaway_textures }",
    // 8: what has no inside: patches, triangles, a disc, polygons
    "intersection { object { P } sphere { 0, 1.2 pigment { B } } sphere { x, 1.2 pigment { R } }"
    " cutaway_textures }"
    "difference { sphere { <-1, 0, -1>, 0.8 pigment { G } } triangle { <-2, -1, -1>, <0, -1, -1>, "
    "<-1, 2, -0.8> } disc { <-1, 0, -1>, y, 0.6 } polygon { 4, <-2, 0.2, -2>, <0, 0.2, -2>, "
    "<-1, 0.3, 0>, <-2, 0.2, -2> } cutaway_textures }",
    // 9: clear ones, with an interior, and their shadows
    "difference { union { box { <-1.4, -1, -1>, <0.3, 0.8, 1> texture { T } } sphere { 0.6*x, 1"
    " pigment { R } } } cylinder { <-2, 0.6, -1>, <2, 0.6, -1>, 0.8 } cutaway_textures"
    " interior { ior 1.2 fade_distance 1 fade_power 2 } }",
    // 10: clear and coloured ones mixed: partial shadows of the floor's checks
    "intersection { sphere { -0.4*x, 1.2 pigment { rgbf <1, 0.4, 0.3, 0.8> } } sphere { 0.4*x, 1.2"
    " texture { T } } plane { y, 0.3 } cutaway_textures no_image }",
    // 11: an inner texture; letters, without light, since their outlines are rounded otherwise
    "#default { finish { ambient 1 diffuse 0 } }"
    "difference { sphere { -1.2*x, 1 pigment { R } } box { <-3, 0.2, -3>, 3 texture { pigment { G }"
    " } interior_texture { pigment { B } } } cutaway_textures }"
    "difference { box { <0.1, -1, -1>, <2.4, 0.5, 1> pigment { R } } text { internal 1 \"Oi\" 3, 0"
    " scale 1.6 translate <0.4, -0.6, -2> } cutaway_textures }"
    "intersection { box { <-1.5, -1, -1.5>, <0, 0.2, 1> pigment { R } } text { internal 1 \"O\" 3, "
    "0"
    " scale 1.6 translate <-1.3, -0.6, -2> } cutaway_textures }",
    // 12: the inside of a difference that is turned round; one taken from another
    "intersection { difference { box { -3, 3 pigment { R } } sphere { 0, 1 pigment { B } } inverse "
    "}"
    " plane { y, 0.4 } plane { -z, 0.7 } cutaway_textures translate -1.2*x }"
    "difference { box { -0.9, 0.9 pigment { G } } difference { sphere { <0, 0.8, -0.8>, 1 pigment {"
    " R } } box { <-2, 0.8, -2>, 2 } } cutaway_textures translate 1.3*x }",
    // 13: a merge and a clipped union around: their children count; a plain union does not
    "merge { difference { sphere { -0.4*x, 1 pigment { R } } plane { -y, -0.3 } cutaway_textures }"
    " sphere { <0.3, 0, 0.6>, 0.9 pigment { G } } translate -1.1*x }"
    "union { difference { sphere { 0, 1 pigment { R } } plane { -y, -0.3 } cutaway_textures }"
    " box { <-2, 0, 0.3>, <2, 0.5, 2> pigment { G } } clipped_by { plane { x, 0.6 } }"
    " translate 1.2*x }",
    // 14: bounded and whole unions around, copies, transforms after the textures
    "#declare Half = difference { sphere { 0, 1 pigment { B } } box { <-2, 0.1, -2>, 2 }"
    " cutaway_textures }"
    "union { object { Half translate -1.2*x } object { Half rotate -40*z scale <0.8, 1.1, 1>"
    " translate 1.2*x } split_union off }",
    // 15: patterns of textures, layers, mapping by u and v of the cutting surface
    "difference { box { <-2.2, -1, -1>, <-0.2, 1, 1> texture { gradient x texture_map { [0 pigment"
    " { R }] [1 T] } scale 0.5 } } sphere { <-1, 1, -1>, 0.9 } cutaway_textures }"
    "difference { box { <0.2, -1, -1>, <2.2, 1, 1> pigment { uv_mapping B } } sphere { <1.2, 1, "
    "-1>, 1.1 } uv_mapping cutaway_textures }",
    // 16: the second child turned round keeps nothing of its textures: the default for the whole
    "difference { box { -0.9, 0.9 } union { sphere { <0, 0.8, -0.8>, 1 pigment { R } } box { <-2, "
    "0.6, -2>, <0, 2, 2> } } cutaway_textures }",
    // 17: a mesh with a texture on some faces has none for the others, as a part of a cut
    "#declare TR = texture { pigment { R } }"
    "intersection { mesh { triangle { <-2, -1, 0>, <0, -1, 0>, <-1, 1, 0.4> texture { TR } }"
    " triangle { <0, -1, 0>, <-1, 1, 0.4>, <1, 1, 0> } } sphere { 0, 3 pigment { B } }"
    " cutaway_textures }"
    "mesh { triangle { <0.5, -1, -1>, <1.5, -1, -1>, <1, 0, -1> texture { TR } }"
    " triangle { <1, 0, -1>, <1.5, -1, -1>, <2, 0, -1> } }",
    // 18: more children than the hit has room for, each alike
    "intersection { union { sphere { 0.10*x, 1 pigment { R } } sphere { 0.12*x, 1 pigment { R } }"
    " sphere { 0.14*x, 1 pigment { R } } sphere { 0.16*x, 1 pigment { G } } sphere { 0.18*x, 1"
    " pigment { G } } sphere { 0.2*x, 1 pigment { B } } sphere { 0.22*x, 1 pigment { R } } sphere {"
    " 0.24*x, 1 pigment { R } } sphere { 0.26*x, 1 pigment { G } } sphere { -0.4*x, 1 pigment { R }"
    " } } plane { y, 0.3 } cutaway_textures }",
};

int main(void) {
    return povray_table_run(&(PovrayTable){.name = "cutaway_povray",
                                           .stage = STAGE,
                                           .scenes = SCENES,
                                           .count = sizeof SCENES / sizeof *SCENES,
                                           .share = 0.002});
}
