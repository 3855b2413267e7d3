// SPDX-License-Identifier: MIT
// The whole way of a texture: text, nodes, scene, picture. Each row is one texture on a curved
// patch, rendered by POV-Ray and by us with POV-Ray's triangles, so that both meet the surface at
// the same points. What may differ is a pixel on an edge between two triangles or two colours,
// where the last bit of the point decides.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "texture_rows.h"

#define P(text)                                                                                    \
    { "", "pigment { " text " }" }
#define MAP " color_map { [0 rgb <0.9,0.1,0>] [0.3 rgb <0.1,0.8,0.2>] [0.7 rgb 1] [1 rgb 0.05] } "

static const TextureRow PATTERNS[] = {
    P("agate agate_turb 0.7 scale 0.8"),
    P("agate" MAP "turbulence <0.3,0.1,0.5> octaves 4 lambda 2.5 omega 0.4"),
    P("average pigment_map { [1 bozo scale 0.4] [2.5 gradient y" MAP "] } rotate 20*z"),
    P("boxed scale 3 translate 0.2"),
    P("bozo scale 0.5"),
    P("bozo" MAP "turbulence 0.6 scale <0.3,0.6,0.4> rotate 30 noise_generator 1"),
    P("spotted scale 0.3 noise_generator 3"),
    P("brick scale 0.15"),
    P("brick pigment { gradient x scale 0.3 } pigment { bozo scale 0.2 } brick_size <1,0.5,0.7> "
      "mortar 0.1 rotate 10"),
    P("cells" MAP "scale 0.4 rotate <20,30,40>"),
    P("checker rgb x turbulence 0.3 scale 0.7"),
    P("crackle scale 0.6"),
    P("crackle form <-0.7,0.9,0.4> metric 3 offset 0.1" MAP "scale 0.7"),
    P("crackle solid scale 0.4 metric 1"),
    P("cubic rotate <20,30,0> translate <0.3,0.2,0>"),
    P("cubic rgb 0, rgb 1, rgb x rotate <-20,130,0>"),
    P("cylindrical scale 2 rotate 90*x" MAP "frequency 3 phase 0.2 sine_wave"),
    P("dents scale 0.3"),
    P("gradient <1,2,0.5>" MAP "scallop_wave frequency 2"),
    P("granite scale 2" MAP),
    P("granite noise_generator 1 turbulence 0.2 sine_wave"),
    P("hexagon rotate 80*x scale 0.4"),
    P("hexagon pigment { marble } rotate 90*x scale 0.6"),
    P("leopard scale 0.1"),
    P("marble turbulence 0.7 scale 0.5"),
    P("marble" MAP "warp { turbulence 0.5 } scale 0.7 rotate 40*y ramp_wave"),
    P("onion scale 0.4 poly_wave 2"),
    P("planar scale 2.5" MAP "cubic_wave turbulence 0.3"),
    P("quilted control0 0.4 control1 0.8 scale 0.6"),
    P("radial rotate 90*x frequency 6"),
    P("ripples scale 0.3 frequency 1.5 phase 0.3"),
    P("spherical scale 3 frequency 4 triangle_wave"),
    P("spiral1 3 scale 0.8 turbulence 0.2"),
    P("spiral2 5" MAP "scale 1.2"),
    P("square rotate 75*x scale 0.5"),
    P("triangular rotate 75*x scale 0.6"),
    P("waves scale 0.4"),
    P("wood scale 0.5"),
    P("wood turbulence <0.2,0.1,0> octaves 3 scale 0.3 rotate <5,80,0>"),
    P("wrinkles scale 0.7" MAP),
};

static const TextureRow WARPS[] = {
    P("gradient x" MAP "scale 0.5 warp { repeat 1.1*y offset <0.2,0,0> flip x }"),
    P("radial warp { repeat 1.3*x flip <1,1,0> } warp { repeat 0.9*y } translate 0.2 rotate 7*z"),
    P("checker rgb 0 rgb 1 scale 0.3 warp { black_hole <0.4,0.1,0>, 1.6 strength 1.5 falloff 3 }"),
    P("checker scale 0.3 warp { black_hole <0,0,0>, 0.7 inverse repeat <2,1.8,2> "
      "turbulence <0.4,0.3,0.2> }"),
    P("gradient x" MAP "scale 0.1 warp { planar <1,1,1>, 0.3 } rotate 20"),
    P("checker scale <0.1,0.2,1> warp { spherical orientation y dist_exp 1 }"),
    P("checker scale <0.08,0.3,1> warp { cylindrical } rotate 80*x"),
    P("checker scale <0.06,0.1,5> warp { toroidal orientation z dist_exp 0.5 major_radius 1.4 }"),
    P("gradient y" MAP "scale 0.1 warp { cubic } rotate <30,20,10>"),
    P("gradient x" MAP "scale 2 warp { turbulence <0.5,0.3,0.2> octaves 3 lambda 3 omega 0.6 } "
      "rotate 30*z warp { turbulence 0.2 } scale 0.4 turbulence 0.3"),
    {"", "uv_mapping pigment { bozo scale 0.1 warp { repeat 0.5*x } }"},
    {"", "pigment { gradient y pigment_map { [0.2 rgb x] [0.3 wood scale 0.2 rotate 90*y] "
         "[0.8 granite turbulence 0.4] } turbulence 0.3 }"},
    {"", "texture { pigment { bozo scale 0.5 color_map { [0.3 rgb x] [0.6 rgbt 1] } } } "
         "texture { pigment { spotted color_map { [0.4 rgbf 1] [0.5 rgb <0,0,1>] } scale 0.2 } } "},
    {"", "pigment { bozo } #declare M = pigment { marble turbulence 0.4 color_map { [0 rgb x] "
         "[1 rgb y] } scale 0.5 } #declare G = pigment { M gradient y } pigment { G }"},
};

static const TextureRow OTHER_PATTERNS[] = {
    P("slope y" MAP),
    P("slope { <1,2,-1>, 0.3, 0.8 }" MAP),
    P("slope { -z, 0.2, 0.9 altitude <0,1,0.3>, -2, 3 }" MAP),
    P("slope { point_at <1,2,-4> }" MAP "triangle_wave frequency 2"),
    P("aoi" MAP "frequency 2"),
    {"", "pigment { slope z" MAP "} normal { bumps 0.5 scale 0.3 }"},
    {"", "texture { pigment { aoi" MAP "} normal { bumps 0.5 scale 0.3 no_bump_scale } } texture { "
         "pigment { slope x color_map { [0.4 rgbt 1] [0.5 rgb z] } } }"},
    {"", "pigment { rgb 0.8 } normal { slope x, 0.5 }"},
    P("function { sin(x * 4) * y + z * 0.3 }" MAP),
    {"functions.inc", "pigment { function { f_noise3d(x * 3, y, z) + f_ridged_mf(x, y, z, 0.3, 2, "
                      "4, 0.6, 1.2, 2) * 0.3 }" MAP "scale 0.7 turbulence 0.2 }"},
    {"",
     "#declare F = function { pattern { granite scale 0.8 triangle_wave } } #declare G = function "
     "{ pigment { bozo color_map { [0 rgb x] [1 rgb <0,1,1>] } scale 0.5 } } pigment { function { "
     "F(x, y, z) * 0.7 + G(x, y, z).red * 0.3 }" MAP "}"},
    {"", "pigment { rgb 0.8 } normal { function { sin(x * 9) * cos(y * 7) }, 0.4 }"},
    P("pigment_pattern { bozo color_map { [0 rgb x] [0.6 rgb 1] [1 rgb 0.2] } scale 0.3 turbulence "
      "0.4 "
      "}" MAP "scale 1.3 rotate 20"),
    P("pigment_pattern { checker rgb 0.2 rgb 0.7 } color_map { [0 rgb x] [1 rgb z] } scale 0.5"),
    {"", "pigment { rgb 0.8 } normal { pigment_pattern { marble turbulence 0.5 scale 0.5 }, 0.5 }"},
    P("object { sphere { 0, 1.3 scale <1.3,1,1> } rgb x, rgb z } rotate 10"),
    P("object { difference { box { -1.6, 1.6 } cylinder { -3*z, 3*z, 0.9 } } pigment { bozo scale "
      "0.2 } "
      "pigment { granite } } turbulence 0.3"),
    {"", "pigment { rgb 0.8 } normal { object { sphere { 0, 1.5 } normal { bumps 0.5 scale 0.2 } "
         "normal "
         "{ quilted 0.6 scale 0.3 } } }"},
    {"",
     "texture { object { torus { 1.4, 0.6 rotate 90*x } texture { pigment { rgb 1 } } texture { "
     "pigment { granite } finish { reflection 0.2 } } } }"},
    P("density_file df3 \"spiral.df3\"" MAP "translate -0.5 scale <7,6,5>"),
    P("density_file df3 \"spiral.df3\" interpolate 1" MAP "translate -0.5 scale <7,6,5>"),
    P("density_file df3 \"spiral.df3\" interpolate 2" MAP "translate -0.5 scale <7,6,5>"),
    P("mandel 50 scale 1.5"),
    P("mandel 30" MAP "exponent 3 interior 1, 1 exterior 6, 0.3"),
    P("mandel 25" MAP "exponent 4 exterior 7, 5"),
    P("mandel 20" MAP "exponent 7 exterior 8, 4 interior 6, 0.5"),
    P("julia <0.353, 0.288>, 30 interior 1, 1" MAP "scale 1.3"),
    P("julia <-0.4, 0.6>, 40" MAP "exponent 3 exterior 2, 0.2"),
    P("julia <0.2, 0.5>, 20" MAP "exponent 5 exterior 4, 0.1 interior 3, 0.7"),
    P("magnet 1 mandel 30" MAP "interior 1, 0.5 scale 0.8"),
    P("magnet 2 mandel 30" MAP "exterior 3, 0.01"),
    P("magnet 1 julia <0.3, 0.4>, 30" MAP "scale 0.7"),
    P("magnet 2 julia <1.2, 0.4>, 30" MAP "exterior 5, 0.001 interior 2, 1"),
};

#define N(text)                                                                                    \
    { "", "pigment { rgb <0.9,0.8,0.6> } finish { phong 0.5 specular 0.3 } normal { " text " }" }

static const TextureRow NORMALS[] = {
    N("bumps 0.6 scale 0.3"),
    N("bumps scale <0.2,0.5,0.1> rotate 20 turbulence 0.4 bump_size 0.8"),
    N("dents 0.9 scale 0.2 noise_generator 3"),
    N("wrinkles 0.6 scale 0.7"),
    N("ripples 0.5 frequency 3 phase 0.2 scale 0.6"),
    N("waves 0.4 frequency 4 scale 0.7 translate 0.3"),
    N("quilted 0.7 control0 0.3 control1 0.8 scale 0.5"),
    N("facets size 0.4"),
    N("facets coords 0.6 scale 0.3 rotate 30"),
    N("facets coords 0.5 metric 1 scale 0.4"),
    N("facets size 0.3 metric 3"),
    N("granite 0.3 scale 2"),
    N("granite 0.4 accuracy 0.005 turbulence 0.3"),
    N("bozo 0.8 scale 0.4"),
    N("spotted 0.8 scale 0.4 noise_generator 1"),
    N("gradient x, 0.6 scale 0.5 triangle_wave"),
    N("leopard 0.7 scale 0.1"),
    N("marble 0.5 turbulence 0.6 scale 0.5"),
    N("wood 0.5 scale 0.3 turbulence 0.1 rotate 80*x"),
    N("crackle 0.8 scale 0.5"),
    N("agate 0.4 scale 0.6"),
    N("brick 0.5 scale 0.15"),
    N("checker 0.4 scale 0.5"),
    N("hexagon 0.4 scale 0.5 rotate 90*x"),
    N("radial 0.6 frequency 8 rotate 90*x"),
    N("spiral1 4, 0.6"),
    N("onion 0.8 scale 0.5 sine_wave"),
    N("gradient y, 0.7 slope_map { [0 <0,1>] [0.3 <1,1>] [0.3 <1,-1>] [0.7 <0.2,0>] [1 <0,0>] } "
      "scale 0.6"),
    N("bozo 0.5 slope_map { [0.2 <0,0.5>] [0.8 <1,-0.5>] } scale 0.3 turbulence 0.2"),
    N("gradient x normal_map { [0.2 bumps 0.7 scale 0.2] [0.6 granite 0.4 scale 0.6] [0.9 ripples "
      "0.4 frequency 3 scale 0.4] } scale 1.2 rotate 30"),
    N("checker normal { bumps 0.6 scale 0.2 } normal { quilted 0.8 scale 0.3 } scale 0.8 rotate "
      "10"),
    N("hexagon normal { bumps 0.6 scale 0.2 } normal { granite 0.3 } normal { wood } rotate 90*x"),
    N("average normal_map { [1 bumps 0.8 scale 0.3] [2 waves 0.5 frequency 3] [0.5 facets size "
      "0.2] "
      "} scale <1,0.6,1>"),
    N("bumps 0.5 scale 0.2 no_bump_scale"),
    N("granite 0.2 scale <0.3,1,0.5> rotate 40 no_bump_scale"),
    N("gradient x normal_map { [0 bumps 1 scale 0.1] [1 wrinkles 1] } scale 2 no_bump_scale"),
    N("uv_mapping bumps 0.6 scale 0.05"),
    N("uv_mapping gradient x, 0.4 scale 0.2 sine_wave"),
    N("bumps 0.6 scale 0.4 warp { repeat x flip x } warp { turbulence 0.3 }"),
    {"", "texture { pigment { rgb 0.7 } normal { bumps 0.5 } scale 0.2 rotate 30 } "
         "texture { pigment { bozo color_map { [0.4 rgbt 1] [0.6 rgb x] } scale 0.4 } normal { "
         "gradient y, 0.5 scale 0.4 } }"},
    {"", "texture { pigment { rgb 0.7 } normal { bumps 0.5 } scale 0.2 no_bump_scale }"},
    {"", "pigment { rgb 0.2 } finish { reflection { 0.3, 0.8 } specular 0.4 } normal { bumps 0.3 "
         "scale 0.5 }"},
    {"", "pigment { rgbf <0.9,1,0.9,0.8> } finish { reflection 0.1 } interior { ior 1.3 } normal { "
         "bumps 0.3 scale 0.5 } } plane { z, 4 pigment { checker rgb 1 rgb x }"},
};

static const TextureRow TEXTURES[] = {
    {"", "texture { gradient y texture_map { [0.2 pigment { rgb x } finish { phong 1 } ] [0.7 "
         "pigment { checker scale 0.2 } normal { bumps 0.6 scale 0.2 }] } scale 1.3 rotate 20 }"},
    {"", "texture { checker texture { pigment { rgb x } } texture { pigment { bozo } normal { "
         "ripples 0.5 scale 0.3 } } scale 0.6 }"},
    {"", "texture { brick texture { pigment { rgb 0.8 } } texture { pigment { granite } normal { "
         "dents 0.7 scale 0.2 } } scale 0.2 }"},
    {"", "texture { hexagon texture { pigment { rgb x } } texture { pigment { rgb z } } rotate "
         "90*x scale 0.5 }"},
    {"", "texture { tiles { texture { pigment { rgb x } } tile2 texture { pigment { rgb y } } } "
         "scale 0.5 }"},
    {"",
     "texture { average texture_map { [1 pigment { rgb x } finish { reflection 0.3 }] [2 pigment "
     "{ bozo scale 0.3 } normal { bumps scale 0.2 }] } scale 0.8 rotate 40 }"},
    {"", "texture { bozo texture_map { [0.3 pigment { rgb x } normal { bumps 0.4 scale 0.3 }] [0.6 "
         "gradient x texture_map { [0 pigment { rgb y } normal { granite 0.2 }] [1 pigment { rgb z "
         "} normal { bumps 0.9 scale 0.2 }] } rotate 30 scale <0.3,0.7,1>] } scale 0.6 turbulence "
         "0.3 }"},
    {"", "texture { gradient x texture_map { [0.3 wood texture_map { [0 pigment { rgb y } normal { "
         "bumps 0.6 scale 0.3 }] [1 pigment { rgb 1 }] } rotate 50 scale 0.4] [0.8 pigment { rgb x "
         "} normal { wrinkles 0.6 scale 0.5 }] } scale <2,1,0.4> rotate 25 }"},
    {"", "texture { uv_mapping pigment { checker scale 0.1 } normal { bumps 0.5 scale 0.05 } }"},
    {"", "texture { uv_mapping gradient x texture_map { [0.3 pigment { rgb x }] [0.7 pigment { rgb "
         "y } normal { bumps 0.6 scale 0.1 }] } scale 0.3 rotate 20 } rotate 10*z"},
    {"",
     "texture { gradient x texture_map { [0.3 uv_mapping pigment { checker scale 0.1 } normal { "
     "bumps scale 0.1 }] [0.7 pigment { rgb y } normal { bumps 0.6 scale 0.1 }] } scale 2 }"},
    {"",
     "texture { #declare A = texture { pigment { rgb x } } texture { pigment { bozo color_map { "
     "[0.4 rgbt 1] [0.5 rgb z] } scale 0.3 } finish { reflection 0.2 } } spherical texture_map "
     "{ [0.2 A] [0.5 A pigment { rgb y }] } scale 3 no_bump_scale }"},
    // Here the shadow was too bright: caustics of a finish are not 45 times what is written.
    {"",
     "pigment { rgbf <0.3,0.8,0.5,0.8> } finish { ior 1.3 caustics 1.5 } } plane { z, 3 pigment { "
     "checker rgb 1 rgb 0.6 }"},
    {"",
     "texture { pigment { rgbt <0.8,0.9,1,0.7> } normal { bumps 0.4 } } interior { caustics 0.6 "
     "ior 1.2 } } plane { z, 3 pigment { checker rgb 1 rgb 0.6 }"},
    {"",
     "texture { checker texture { pigment { rgbt <0.8,0.9,1,0.9> } } texture { pigment { rgb x } "
     "} scale 0.4 } } plane { z, 3 pigment { checker rgb 1 rgb 0.6 }"},
    {"", "pigment { rgb x } interior_texture { gradient y texture_map { [0 pigment { rgb y }] [1 "
         "pigment { rgb z } normal { bumps 0.6 scale 0.2 }] } } rotate 180*y"},
};

#define T(file, name, more)                                                                        \
    { file, "texture { " name " " more " }" }

// Those with crand get their grain from a generator that POV-Ray steps on from pixel to pixel.
static const TextureRow INCLUDES[] = {
    T("textures.inc", "Jade", "scale 0.7"),
    T("textures.inc", "White_Marble", "scale 0.5"),
    T("textures.inc", "Blood_Marble", ""),
    T("textures.inc", "Blue_Agate", ""),
    T("textures.inc", "Pink_Granite", ""),
    T("textures.inc", "Cherry_Wood", "scale 0.5 rotate 80*y"),
    T("textures.inc", "DMFWood4", "scale 0.6 rotate <3,70,0>"),
    T("textures.inc", "Cork", ""),
    {"textures.inc", "pigment { Blue_Sky scale 0.7 } finish { ambient 0.6 }"},
    T("woods.inc", "T_Wood1", "scale 0.7 rotate 85*y"),
    T("woods.inc", "T_Wood14", "scale 0.4"),
    T("woods.inc", "T_Wood35", "scale 0.4"),
    T("stones1.inc", "T_Stone1", ""),
    T("stones1.inc", "T_Stone10", ""),
    T("stones1.inc", "T_Grnt1", ""),
    T("stones1.inc", "T_Grnt20", "finish { crand 0 }"),
    T("stones1.inc", "T_Crack2", "scale 0.5"),
    T("stones2.inc", "T_Stone28", ""),
    T("stones2.inc", "T_Stone42", "finish { crand 0 }"),
    T("skies.inc", "T_Cloud2", "scale 0.5"),
    {"skies.inc", "pigment { P_Cloud3 scale 0.3 }"},
};

// Clear sheets in front of the patch, one behind the other. The first and the last of them belong
// to one union, the glass in between does not: a ray that meets the last one leaves the air of that
// union, if it is one air, and is not bent; it is bent if it enters another.
#define SHEET(z, more)                                                                             \
    "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 "                                       \
    "<-3,-3,0>, <-1,-3,0.3>, <1,-3,-0.2>, <3,-3,0>, <-3,-1,0.1>, <-1,-1,-0.6>, <1,-1,0.7>, "       \
    "<3,-1,0>, <-3,1,0>, <-1,1,0.4>, <1,1,-0.5>, <3,1,0>, <-3,3,0>, <-1,3,0.3>, <1,3,0>, "         \
    "<3,3,0.2> rotate <20,25,0> translate " #z "*z " more " }\n"
#define CLEAR "pigment { rgbt <0.9,1,0.9,0.95> } finish { diffuse 0.3 } "
#define FRONT SHEET(-2.5, CLEAR)
#define BACK SHEET(-1.5, CLEAR)
#define SCENE(text)                                                                                \
    {                                                                                              \
        "", "pigment { checker rgb x rgb 1 scale 0.4 } }\n"                                        \
            "object { " SHEET(-2, CLEAR "interior { ior 1.4 }") "}\n" text                         \
    }

static const TextureRow INTERIORS[] = {
    SCENE("union { " FRONT BACK),
    SCENE("union { union { " FRONT SHEET(-2.4, CLEAR) "}" BACK),
    SCENE(FRONT "object { " BACK),
    SCENE("union { " FRONT SHEET(-2.2, CLEAR "interior { ior 1.2 }") BACK),
    SCENE("union { " FRONT BACK "interior { ior 1.3 }"),
};

static void patterns(void **state) {
    (void)state;
    texture_rows_check(PATTERNS, sizeof PATTERNS / sizeof *PATTERNS);
}

static void warps_and_maps(void **state) {
    (void)state;
    texture_rows_check(WARPS, sizeof WARPS / sizeof *WARPS);
}

static void standard_textures(void **state) {
    (void)state;
    texture_rows_check(INCLUDES, sizeof INCLUDES / sizeof *INCLUDES);
}

static void other_patterns(void **state) {
    (void)state;
    texture_rows_check(OTHER_PATTERNS, sizeof OTHER_PATTERNS / sizeof *OTHER_PATTERNS);
}

static void normals(void **state) {
    (void)state;
    texture_rows_check(NORMALS, sizeof NORMALS / sizeof *NORMALS);
}

static void patterned_textures(void **state) {
    (void)state;
    texture_rows_check(TEXTURES, sizeof TEXTURES / sizeof *TEXTURES);
}

static void interiors(void **state) {
    (void)state;
    texture_rows_check(INTERIORS, sizeof INTERIORS / sizeof *INTERIORS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns),           cmocka_unit_test(warps_and_maps),
        cmocka_unit_test(standard_textures),  cmocka_unit_test(interiors),
        cmocka_unit_test(other_patterns),     cmocka_unit_test(normals),
        cmocka_unit_test(patterned_textures),
    };
    return cmocka_run_group_tests_name("texture_scenes", tests, NULL, NULL);
}
