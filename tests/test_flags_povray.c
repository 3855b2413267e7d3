// SPDX-License-Identifier: MIT
// no_image, no_reflection, no_shadow, hollow, double_illuminate and inverse in trees, against
// POV-Ray's pictures: seen straight, through glass, in a mirror and by shadows.
#include "tests/povray_table.h"

static const char STAGE[] =
    "#declare R = pigment { rgb <1, 0.2, 0.1> }\n"
    "#declare G = pigment { rgb <0.2, 0.9, 0.3> }\n"
    "#declare B = pigment { rgb <0.2, 0.3, 1> }\n"
    "#declare Glass = texture { pigment { rgbt <0.9, 0.95, 1, 0.7> } finish { reflection 0.1 } }\n"
    "#declare Two = texture { pigment { R } } #declare Sides = texture { pigment { B } }\n"
    "#declare Floor = plane { y, -1.5 pigment { rgb 0.6 } finish { reflection 0.3 } }\n"
    "#declare Mirror = plane { z, 4 pigment { rgb 0.1 } finish { reflection 0.7 } }\n"
    "#declare Pane = box { <-3, -1.5, -2>, <0.5, 3, -1.9> texture { Glass } interior { ior 1.1 } "
    "}\n"
    "#declare Room = union { object { Floor } object { Mirror } object { Pane } }\n"
    "background { rgb <0.4, 0.5, 0.7> } light_source { <4, 8, -6>, 1 }\n"
    "camera { location <1, 1.6, -5> right 4/3*x look_at 0 angle 50 }\n";

#define BALLS(flag) "sphere { -0.6*x, 1 pigment { R } } sphere { 0.6*x, 1 pigment { G } " flag " }"
#define TREE(head, flag, tail)                                                                     \
    "object { Room } " head " { union { " BALLS(flag) " box { <-0.4, 0.6, -0.4>, <0.4, 1.4, 0.4> " \
                                                      "pigment { B } } " flag                      \
                                                      " } sphere { y, 0.7 pigment { B } } " tail   \
                                                      " }"
// A merge around a tree, with a hidden ball and a clear one.
#define AROUND(tree, flag)                                                                         \
    "object { Room } merge { " tree " { " BALLS("") " } sphere { 1.2*y, 0.7 pigment { B } " flag   \
                                                    " } sphere { 0.4, 0.9 texture { Glass } } }"

static const char *const SCENES[] = {
    // 0-2: a child of a union that is one object is hidden from refracted rays only; below others
    "object { Room } union { " BALLS("no_image") " split_union off }",
    TREE("union", "no_image", "split_union off"),
    TREE("difference", "no_image", ""),
    // 3-5: a hidden child of a merge hides nothing of the others
    "object { Room } merge { " BALLS("no_image") " }",
    AROUND("union", "no_image"),
    AROUND("intersection", "no_reflection"),
    // 6-8: mirrors and shadows
    "object { Room } merge { " BALLS("no_reflection") " }",
    TREE("union", "no_shadow", "split_union off"),
    AROUND("merge", "no_shadow"),
    // 9: fog goes on where all around is hollow
    "plane { y, -1.5 pigment { rgb 0.6 } } fog { fog_type 1 distance 6 rgb <0.9, 0.8, 0.3> }"
    "intersection { sphere { 0, 1.4 } union { box { -0.9, 0.9 hollow off } sphere { y, 0.6 } }"
    " texture { Glass } interior { ior 1 } hollow translate -1.2*x }"
    "union { sphere { 0, 1 hollow } sphere { x, 1 } texture { Glass } interior { ior 1 }"
    " split_union off translate x }",
    // 10: the outermost word on double_illuminate counts
    "object { Floor } union { union { disc { 0, <0.6, -1, 0.2>, 1 double_illuminate } disc { y, "
    "<1, -1, -0.4>, 1.3 } } disc { x, <-1, -1, -0.5>, 1 } pigment { R } double_illuminate off }",
    // 11: the sides of an inverse quadric stay as they are; its inside does not
    "object { Floor } quadric { <1, 2, 1>, <0.3, 0, 0>, <0, 0.2, 0>, -1 texture { Two }"
    " interior_texture { Sides } inverse translate -1.5*x }"
    "difference { box { <-1, -1, -0.4>, <1, 1, 1> texture { Two } interior_texture { Sides } }"
    " quadric { <1, 2, 1>, <0.3, 0, 0>, <0, 0.2, 0>, -0.7 texture { Two } interior_texture { Sides "
    "}"
    " } translate x }",
};

int main(void) {
    return povray_table_run(&(PovrayTable){.name = "flags_povray",
                                           .stage = STAGE,
                                           .scenes = SCENES,
                                           .count = sizeof SCENES / sizeof *SCENES,
                                           .share = 0.002});
}
