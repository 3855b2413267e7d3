// SPDX-License-Identifier: MIT
// Copies of declared trees that the scene holds once: the picture is the one of each copy with
// parts of its own, and POV-Ray's.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/convert_help.h"
#include "tests/pictures.h"

#include <stdio.h>
#include <string.h>

// Textures that move with the copies or come from around them, glass, cuts, flags, mirrors. Copies
// of one declared thing, or things that are made again each time.
static const char STAGE[] =
    "#version 3.7; global_settings { assumed_gamma 1 max_trace_level 8 }\n"
    "camera { location <0, 9, -16> right 4/3*x look_at <0, 0, 3> angle 50 }\n"
    "light_source { <-200, 300, -150> 1 } light_source { <100, 200, -150> 0.4 shadowless }\n"
    "plane { y, 0 pigment { checker rgb 0.6 rgb 0.4 } finish { reflection 0.2 } }\n"
    "sky_sphere { pigment { gradient y color_map { [0 rgb 0.8] [1 rgb <0.2,0.3,0.8>] } } }\n"
    "#declare S = seed(3);\n"
    "#macro Make() union {\n"
    "  difference { box { <-0.5, 0, -0.5>, <0.5, 0.9, 0.5> } cylinder { <0, 0.3, -1>, <0, 0.3, 1>,"
    "    0.25 pigment { marble turbulence 0.4 scale 0.3 } } }\n"
    "  #for (I, 0, 27) sphere { <0.45*cos(I*0.224), 1.0, 0.45*sin(I*0.224)>, 0.08 pigment { bozo"
    "    color_map { [0 rgb <1,0.2,0.1>] [1 rgb <0.2,0.2,1>] } scale 0.1 } } #end\n"
    "  torus { 0.4, 0.05 translate 1.2*y pigment { granite scale 0.3 }"
    "    normal { bumps 0.5 scale 0.05 } }\n"
    "  merge { sphere { <0, 1.5, 0>, 0.25 } sphere { <0.2, 1.6, 0>, 0.2 }"
    "    pigment { rgbt <0.9,1,0.9,0.8> } finish { reflection 0.1 }"
    "    interior { ior 1.4 fade_distance 0.5 fade_power 1 } }\n"
    "  cone { <0, 1.7, 0>, 0.1, <0, 2.2, 0>, 0 pigment { wood scale 0.05 } no_shadow }\n"
    "  superellipsoid { <0.3, 0.4> scale 0.15 translate <0.6, 0.2, 0> }\n"
    "  mesh { triangle { <-0.6,0,0.6>,<0.6,0,0.6>,<0,1.6,0.6> } pigment { rgb <0.3,0.7,0.9> } }\n"
    "  blob { threshold 0.5 sphere { <0.7,0.6,0>,0.3,1 } sphere { <0.7,0.8,0.1>,0.3,1"
    "    pigment { rgb x } } pigment { rgb y } }\n"
    "} #end\n"
    "#macro Copies()\n"
    "  #for (J, 0, 59) object { Thing()\n"
    "    #switch (mod(J, 6))\n"
    "      #case (0) pigment { rgb <0.8,0.6,0.3> } #break\n"
    "      #case (1) texture { pigment { agate scale 0.5 } finish { specular 0.5 } } #break\n"
    "      #case (2) pigment { rgbf <0.6,0.9,0.3,0.8> } hollow #break\n"
    "      #case (3) pigment { leopard scale 0.1 } no_reflection #break\n"
    "      #case (5) pigment { rgbf <0.9,0.7,0.8,0.6> } interior { ior 1.2 } #break\n"
    "    #end\n"
    "    rotate y*360*rand(S) scale <0.7+0.6*rand(S), 0.7+0.6*rand(S),"
    "      (mod(J,3)=1 ? -1 : 1)*(0.7+0.6*rand(S))>\n"
    "    rotate 20*z*rand(S) translate <16*(rand(S)-0.5), 0, 16*rand(S)-5> } #end\n"
    "  union { #for (J, 0, 5) object { Thing() translate <J*1.5-4, 0, -6> scale 0.9 } #end\n"
    "    pigment { onion scale 0.2 } interior { ior 1.1 } rotate 3*y }\n"
    "#end\n";
static const char SHARED[] = "#declare One = Make() #macro Thing() One #end Copies()\n";
static const char APART[] = "#macro Thing() Make() #end Copies()\n";

static const char *write_scene(const char *name, const char *stage, const char *rest) {
    static char path[256];
    snprintf(path, sizeof path, "%s/%s.pov", scratch_folder(), name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%s%s", stage, rest);
    fclose(file);
    return path;
}

static uint32_t count_type(const Scene *scene, ObjectType type) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        count += scene->objects[i].type == type;
    return count;
}

static Scene *convert_with(const char *stage, const char *rest) {
    static char text[2 * sizeof STAGE];
    snprintf(text, sizeof text, "%s%s", stage, rest);
    Converted converted = convert_raw(text);
    assert_non_null(converted.scene);
    return converted.scene;
}

static void test_shared(void **state) {
    (void)state;
    const Scene *scene = convert_with(STAGE, SHARED);
    assert_int_equal(count_type(scene, OBJECT_INSTANCE), 66);
    // Hollow, without reflection, and the others.
    assert_int_equal(scene->definition_count, 3);
    assert_int_equal(count_type(scene, OBJECT_SPHERE), 3 * 30);
    scene = convert_with(STAGE, APART);
    assert_int_equal(count_type(scene, OBJECT_INSTANCE), 0);
    assert_int_equal(count_type(scene, OBJECT_SPHERE), 66 * 30);
}

#define PATCH(flatness)                                                                            \
    "bicubic_patch { type 1 flatness " flatness " u_steps 1 v_steps 1 " PATCH_POINTS "}"

// A scene of few parts keeps each in its place, and what cannot be shared is not: lights, bounds,
// triangles that are mirrored, patches that are stretched.
static void test_not_shared(void **state) {
    (void)state;
    static const struct {
        const char *part, *copy;
        int copies, shared;
    } cases[] = {
        {"sphere { I*x, 0.1 }", "translate J*y", 20, 0},
        {"sphere { I*x, 0.1 }", "translate J*y", 200, 200},
        {"sphere { I*x, 0.1 }", "", 200, 0}, // all in the same place: nothing to move
        {"sphere { I*x, 0.1 } light_source { I*y, 1 }", "translate J*y", 200, 0},
        {"sphere { I*x, 0.1 }", "translate J*y bounded_by { sphere { 0, 9 } }", 200, 0},
        {"plane { x, I }", "translate J*y", 200, 0},
        {"triangle { I*x, I*x+y, I*x+z }", "translate J*y", 200, 200},
        {"triangle { I*x, I*x+y, I*x+z }", "scale <-1, 1, 1> translate J*y", 200, 0},
        {"sphere { I*x, 0.1 }", "scale 0.001 translate J*y", 200, 0},
        {"sphere { I*x, 0.1 pigment { uv_mapping checker } }", "translate J*y", 200, 0},
        {"box { I*x, I*x+0.1 pigment { uv_mapping checker } }", "translate J*y", 200, 200},
        {PATCH("0"), "rotate J*y scale 0.7 translate J*y", 200, 200},
        {PATCH("0.1"), "translate J*y", 200, 0},
        {PATCH("0"), "scale <1, 1, 2> translate J*y", 200, 0},
        {PATCH("0"), "scale <1, 1, -1> translate J*y", 200, 0},
        {"isosurface { function { x } }", "translate J*y", 200, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2048];
        snprintf(text, sizeof text,
                 "#declare Thing = union { #for (I, 0, 19) %s #end pigment { rgb 1 } }\n"
                 "#for (J, 1, %d) object { Thing %s } #end",
                 cases[i].part, cases[i].copies, cases[i].copy);
        const Scene *scene = scene_of(text);
        if (count_type(scene, OBJECT_INSTANCE) != (uint32_t)cases[i].shared)
            fail_msg("%s, %s: %u instances", cases[i].part, cases[i].copy,
                     count_type(scene, OBJECT_INSTANCE));
    }
}

// Bowls of patches and a knob: as POV-Ray's triangles beside POV-Ray, and as patches.
static const char BOWLS[] =
    "#version 3.7; global_settings { assumed_gamma 1 }\n"
    "camera { location <0, 9, -16> right 4/3*x look_at <0, 0, 3> angle 50 }\n"
    "light_source { <-200, 300, -150> 1 }\n"
    "plane { y, 0 pigment { checker rgb 0.6 rgb 0.4 } }\n"
    "#declare S = seed(4);\n"
    "#macro Make() union {\n"
    "  #for (I, 0, 19) bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3\n"
    "    #for (U, 0, 3) #for (V, 0, 3) vrotate(<0.3 + 0.3*V - 0.1*U, 0.4*V + 0.1*mod(U*V, 3), 0>,"
    "      (I + U/3)*18*y) #end #end rotate 0 } #end\n"
    "  sphere { 0.4*y, 0.3 pigment { rgb <0.9, 0.7, 0.2> } finish { reflection 0.3 } }\n"
    "  pigment { marble turbulence 0.3 scale 0.4 } finish { phong 0.4 } } #end\n"
    "#macro Copies() #for (J, 0, 119) object { Thing() rotate y*360*rand(S)\n"
    "  scale 0.5 + 0.4*rand(S) rotate 20*x*rand(S)\n"
    "  translate <16*(rand(S)-0.5), 0.3, 16*rand(S)-5> } #end #end\n";

// Fog, which is in what is hollow only: every other copy is, and clear.
static const char FOG[] =
    "#version 3.7; global_settings { assumed_gamma 1 }\n"
    "camera { location <0, 9, -16> right 4/3*x look_at <0, 0, 3> angle 50 }\n"
    "light_source { <-200, 300, -150> 1 }\n"
    "plane { y, 0 pigment { checker rgb 0.6 rgb 0.4 } } fog { distance 12 rgb 0.7 }\n"
    "#declare S = seed(3);\n"
    "#macro Make() union { box { <-0.05, 0.1, -0.4>, <0.05, 1.9, 0.4> }\n"
    "  #for (I, 0, 30) sphere { <0.02*I, 2.2, 0>, 0.1 pigment { rgb x } } #end } #end\n"
    "#macro Copies() #for (J, 0, 149) object { Thing() pigment { rgbf <0.6,0.9,0.3,0.8> }\n"
    "  #if (mod(J, 2)) hollow #end translate <16*(rand(S)-0.5), 0, 16*rand(S)-5> } #end #end\n";

// The same with all copies held once and with parts of their own. povray: beside POV-Ray's, too.
static void check_pictures(const char *name, const char *stage, const char *switches, bool povray) {
    char ours[256], file[256], apart[64];
    const char *path = write_scene(name, stage, SHARED);
    snprintf(ours, sizeof ours, "%s", render_with_qirender(name, path, switches));
    if (povray)
        assert_true(percent_over(ours, render_with_povray("povray", path, switches), 0.0041) <=
                    0.1);
    // By way of the scene file.
    snprintf(file, sizeof file, "%s/%s.qi.json", scratch_folder(), name);
    assert_int_equal(run_command(NULL, "build/test/pov2qi %s -o %s", path, file), 0);
    assert_true(percent_over(ours, render_with_qirender("file", file, switches), 0) == 0);
    snprintf(apart, sizeof apart, "%s-apart", name);
    path = write_scene(apart, stage, APART);
    double off = percent_over(ours, render_with_qirender(apart, path, switches), 0.0041);
    print_message("%s: %.3f %% off\n", name, off);
    assert_true(off <= 0.01); // one pixel
}

static void test_pictures(void **state) {
    (void)state;
    check_pictures("solids", STAGE, "+W160 +H120 -D -A", true);
    check_pictures("fog", FOG, "+W160 +H120 -D -A", true);
    check_pictures("patches", BOWLS, "+W120 +H90 -D -A", false);
    check_pictures("triangles", BOWLS, "+W120 +H90 -D -A --method facets", false);
    assert_int_equal(count_type(convert_with(BOWLS, SHARED), OBJECT_PATCH), 20);
}

static void test_like_povray(void **state) {
    (void)state;
    const char *path = write_scene("bowls", BOWLS, SHARED);
    const char *ours = render_with_qirender("bowls", path, "+W120 +H90 -D -A --method facets");
    char kept[256];
    snprintf(kept, sizeof kept, "%s", ours);
    const char *theirs = render_with_povray("povray", path, "+W120 +H90 -D -A");
    assert_true(percent_over(kept, theirs, 0.0041) <= 0.1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared),
        cmocka_unit_test(test_not_shared),
        cmocka_unit_test(test_pictures),
        cmocka_unit_test(test_like_povray),
    };
    return cmocka_run_group_tests_name("instance_pictures", tests, NULL, NULL);
}
