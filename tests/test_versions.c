// SPDX-License-Identifier: MIT
// What #version changes in a picture, against POV-Ray's: the words of textures before 3.0, the
// order of a camera's words before 3.5, noise, layers, heights, gamma, skies, alpha. What it
// changes in the language is in tests/sdl/versions.pov.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "image/image.h"
#include "reference.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define VIEW "camera { location <0 1 -3> look_at <0 0 0> } light_source { <5 9 -7> rgb 1 } "
#define BALL VIEW "sphere { <0 0 0> 1 texture { "
#define SIZE "+W24 +H18 "

typedef struct {
    const char *text, *switches;
} Row;

// Each is the picture of both programs, to the last bit.
static void equal_pictures(const Row *rows, size_t count) {
    enum { MOST = 40 };
    if (!reference_available() || access("build/test/qirender", X_OK) != 0) {
        print_message("skipped: povray or qirender is missing\n");
        skip();
    }
    assert_true(count <= MOST);
    Arena *arena = arena_create();
    Reference *theirs[MOST];
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++)
        theirs[i] = reference_begin(arena, rows[i].text,
                                    arena_printf(arena, SIZE "+FN16 %s", rows[i].switches));
    for (size_t i = 0; i < count; i++) {
        FILE *out = fopen("build/test/version.pov", "w");
        assert_true(out && fputs(rows[i].text, out) >= 0 && fclose(out) == 0);
        const char *command = arena_printf(
            arena, "build/test/qirender build/test/version.pov " SIZE "+FN16 -GA %s 2>/dev/null",
            rows[i].switches);
        if (system(command) != 0)
            fail_msg("row %zu is refused: %s", i, rows[i].text);
        char where[160];
        Image *ours = image_read(arena, "build/test/version.png");
        size_t off = reference_mismatches(reference_end(theirs[i]), ours, where, sizeof where);
        if (off)
            print_message("%s: %zu values differ, first %s\n", rows[i].text, off, where);
        wrong += off;
    }
    arena_destroy(arena);
    assert_int_equal(wrong, 0);
}

#define EQUAL_PICTURES(rows) equal_pictures(rows, sizeof rows / sizeof *rows)

static void old_textures(void **state) {
    (void)state;
    static const Row rows[] = {
        {"#version 1.0 " BALL "color red 1 phong 1 ambient 0.3 } }", ""},
        {"#version 1.0 " BALL "marble turbulence 0.5 "
         "color_map { [0 1 color red 1 color blue 1] } } }",
         ""},
        {"#version 2.0 " BALL "wood turbulence 0.1 octaves 3 omega 0.4 lambda 3 } }", ""},
        {"#version 2.0 " BALL "gradient <0 1 0> color_map { [0 rgb 0] [1 rgb 1] } bumps 0.3 "
         "scale 2 } }",
         ""},
        {"#version 2.0 " BALL "checker color red 1 color blue 1 scale 0.5 reflection 0.2 } }", ""},
        {"#version 2.0 " BALL "pigment { color green 1 } finish { phong 1 } ripples 0.4 "
         "frequency 3 phase 0.2 } }",
         ""},
        {"#version 2.0 " BALL "hexagon color red 1 color green 1 color blue 1 rotate <90 0 0> "
         "specular 0.5 roughness 0.01 metallic } }",
         ""},
        {"#version 1.0 " BALL "phong 1 } }", ""},
        {"#version 1.0 " BALL "bozo turbulence 1 color_map { [0 0.5 color red 1 color blue 1] "
         "[0.5 1 color blue 1 color green 1] } translate <1 2 3> } color red 1 }",
         ""},
        {"#version 1.0 " BALL "granite } color red 1 }", "+Q1"},
        {"#version 2.0 " BALL "granite } color red 1 }", "+Q1"},
        {"#version 2.0 " BALL "agate color_map { [0 rgb 0] [1 rgb 1] } } }", ""},
        {"#version 2.0 " BALL "onion waves 0.3 wrinkles 0.2 } }", ""},
        {"#version 2.0 " BALL "spotted dents 0.3 brilliance 2 diffuse 0.8 phong_size 10 } }", ""},
        {"#version 2.0 " BALL "color red 1 alpha 0.5 ior 1.4 refraction 1 } }", ""},
        {"#version 2.0 " BALL "leopard } texture { color red 1 filter 0.5 } }", ""},
        {"#version 2.0 " BALL "color red 1 onion } }", ""},
        {"#version 2.0 #declare T = texture { color red 1 } " BALL
         "T phong 1 translate <1 0 0> } }",
         ""},
        {"#version 2.0 " BALL "tiles { texture { color red 1 } tile2 texture { color green 1 } } "
         "scale 0.5 } }",
         ""},
        {"#version 2.0 #default { texture { ambient 0.5 color green 1 } } " VIEW
         "sphere { <0 0 0> 1 }",
         ""},
    };
    EQUAL_PICTURES(rows);
}

static void rules(void **state) {
    (void)state;
    static const Row rows[] = {
        // water_level counts from 0 to 256 before 2.0.
        {"#version 1.9 " VIEW "height_field { function 8 8 { x * (1 - y) } water_level 100 "
         "pigment { rgb 1 } translate <-0.5, -0.5, -0.5> scale <2, 2, 2> }",
         ""},
        {"#version 2.0 " VIEW "height_field { function 8 8 { x * (1 - y) } water_level 0.4 "
         "pigment { rgb 1 } translate <-0.5, -0.5, -0.5> scale <2, 2, 2> }",
         ""},
        // Noise of the first kind before 3.5.
        {"#version 3.1; " VIEW "sphere { 0, 1 pigment { bozo scale 0.2 } }", ""},
        {"#version 3.5; " VIEW "sphere { 0, 1 pigment { bozo scale 0.2 } }", ""},
        {VIEW "sphere { 0, 1 pigment { bozo scale 0.2 } }", "+MV3.1"},
        // In layers the filter of what lies above becomes transmit up to 3.1.
        {"#version 3.1; " VIEW "sphere { 0, 1 texture { pigment { rgb <1, 0.5, 0.2> } } "
         "texture { pigment { rgbf <1, 1, 0, 0.6> } } }",
         ""},
        {"#version 3.2; " VIEW "sphere { 0, 1 texture { pigment { rgb <1, 0.5, 0.2> } } "
         "texture { pigment { rgbf <1, 1, 0, 0.6> } } }",
         ""},
        // Words of a camera count in their order before 3.5, and cameras add up.
        {"#version 3.1; camera { look_at <0, -1, 3> location <0, 1, -3> angle 40 } "
         "light_source { <5, 9, -7> rgb 1 } sphere { 0, 1 pigment { rgb 1 } }",
         ""},
        {"#version 3.1; camera { location <0, 1, -3> } camera { look_at 0 } "
         "light_source { <5, 9, -7> rgb 1 } sphere { 0, 1 pigment { rgb 1 } }",
         ""},
        {"#version 3.1; #declare C = camera { location <0, 1, -3> look_at 0 } "
         "camera { C angle 30 } light_source { <5, 9, -7> rgb 1 } "
         "sphere { 0, 1 pigment { rgb 1 } }",
         ""},
        // Gamma, layers, skies and alpha before 3.7, and where no #version is.
        {"#version 3.6; " VIEW "sphere { 0, 1 pigment { rgb 0.7 } }", ""},
        {"#version 3.7; " VIEW "sphere { 0, 1 pigment { rgb 0.7 } }", ""},
        {VIEW "sphere { 0, 1 pigment { rgb 0.7 } }", ""},
        {"#version 3.6; global_settings { assumed_gamma 2.2 } " VIEW
         "sphere { 0, 1 pigment { rgb 0.7 } }",
         ""},
        {"#version 3.6; " VIEW
         "background { rgb <0.2, 0.4, 0.6> } plane { y, -1 pigment { rgb 1 } } "
         "sphere { 0, 1 texture { pigment { rgbf <1, 0.5, 0.5, 0.5> } } "
         "texture { pigment { rgbft <0.5, 1, 0.5, 0.3, 0.3> } } }",
         "+UA"},
        {"#version 3.7; " VIEW "background { rgbt <0.2, 0.4, 0.6, 0.5> } "
         "sphere { 0, 1 texture { pigment { rgbf <1, 0.5, 0.5, 0.5> } } "
         "texture { pigment { rgbft <0.5, 1, 0.5, 0.3, 0.3> } } }",
         "+UA"},
        {"#version 3.6; " VIEW "background { rgbt <0.2, 0.4, 0.6, 0.5> } "
         "sphere { 0, 0.5 pigment { rgbt 0.5 } }",
         ""},
        {"#version 3.6; " VIEW "sky_sphere { pigment { rgb <0.3, 0.6, 0.9> } "
         "pigment { gradient y color_map { [0 rgbf <1, 0.5, 0.5, 0.7>] [1 rgbt 1] } } } "
         "sphere { 0, 0.5 pigment { rgb 1 } }",
         ""},
        {"#version 3.7; " VIEW "sky_sphere { pigment { rgb <0.3, 0.6, 0.9> } "
         "pigment { gradient y color_map { [0 rgbf <1, 0.5, 0.5, 0.7>] [1 rgbt 1] } } } "
         "sphere { 0, 0.5 pigment { rgb 1 } }",
         ""},
    };
    EQUAL_PICTURES(rows);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(old_textures), cmocka_unit_test(rules)};
    return cmocka_run_group_tests_name("versions", tests, NULL, NULL);
}
