// SPDX-License-Identifier: MIT
// Fog, rainbows and skies against POV-Ray: each row is the air of the same stage, from the text
// through the converter to the picture, and every value of 16 bits is compared.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "shade_fixture.h"

#include <stdio.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

// One sphere is hollow, so that fog goes on in it; the other is filled with clear air.
static const char STAGE[] =
    "camera { location <0.3, 1.5, -7> right x up y look_at <0, 0.8, 0> }\n"
    "light_source { <3, 6, -5>, rgb <1, 0.9, 0.8> }\n"
    "plane { y, -0.5 pigment { checker rgb <0.9, 0.8, 0.7> rgb 0.3 } }\n"
    "sphere { <0, 0.7, 0>, 0.8 pigment { rgb <0.5, 0.7, 0.9> } finish { reflection 0.3 } }\n"
    "sphere { <-1.3, 0.4, -1>, 0.5 pigment { rgbf <0.9, 0.5, 0.3, 0.6> } }\n"
    "sphere { <1.3, 0.4, -1>, 0.5 hollow pigment { rgbf <0.9, 0.5, 0.3, 0.6> }\n"
    "  interior { ior 1.2 } }\n";

static void check_air(const char *const *rows, size_t count) {
    for (size_t i = 0; i < count; i++) {
        char text[2048];
        snprintf(text, sizeof text, "%s%s\n", STAGE, rows[i]);
        fixture_compare_later(fixture_read(40, 30, text), 9, false);
    }
    fixture_compare_now();
}

static void fogs(void **state) {
    (void)state;
    static const char *const rows[] = {
        "fog { distance 10 rgb <0.6, 0.7, 0.8> }",
        "fog { 10 rgbft <0.6, 0.7, 0.8, 0.3, 0.2> } background { rgb <0.2, 0.3, 0.5> }",
        "fog { fog_type 2 distance 5 fog_offset 0.2 fog_alt 0.4 rgb 0.7 up <0.2, 2, 0.1> }",
        "fog { fog_type 2 distance 5 fog_offset 0.2 fog_alt 0.4 rgbt <0.6, 0.7, 0.8, 0.2>\n"
        "  turbulence <0.3, 0.5, 0.2> turb_depth 0.8 octaves 4 omega 0.6 lambda 2.5 rotate 10*z }",
        "fog { distance 10 rgb <0.6, 0.7, 0.8> turbulence 0.7 }\n"
        "fog { fog_type 2 distance 3 fog_alt 0.3 rgb <1, 0.5, 0.5> turbulence 1 }",
        "#declare F = fog { distance 10 rgb <0.6, 0.7, 0.8> } fog { F rgb x } fog { F distance 3 }",
        // The camera in a body: fog begins behind it, or, where it is hollow, at once.
        "fog { distance 10 rgb 0.7 } sphere { <0.3, 1.5, -7>, 0.5 pigment { rgbt 0.8 } }",
        "fog { distance 10 rgb 0.7 }\n"
        "sphere { <0.3, 1.5, -7>, 0.5 pigment { rgbt 0.8 } hollow interior { ior 1.3 } }",
    };
    check_air(rows, COUNT(rows));
}

#define BOW "color_map { [0 rgbft <1, 0, 0, 0.2, 0.1>] [0.5 rgbt <0, 1, 0, 0.3>] [1 rgbf 0.5] } "

static void rainbows(void **state) {
    (void)state;
    static const char *const rows[] = {
        "rainbow { angle 30 width 20 distance 5 direction z arc_angle 120 falloff_angle 60 " BOW
        "}",
        "rainbow { angle 30 width 20 direction <0.1, -0.1, 1> up <0.3, 1, 0> falloff_angle 100\n"
        "  distance 20 color_map { [0 rgb x] [0.5 rgb y] [1 rgb z] } }\n"
        "rainbow { angle 20 width 10 direction z distance 10 " BOW "} fog { distance 30 rgb 1 }",
        "rainbow { angle 20 width 10 direction z distance 10 } background { rgb 0.2 }",
    };
    check_air(rows, COUNT(rows));
}

static void skies(void **state) {
    (void)state;
    static const char *const rows[] = {
        "sky_sphere {\n"
        "  pigment { gradient y color_map { [0 rgb x] [1 rgb z] } scale 2 translate -1 }\n"
        "  pigment { bozo turbulence 0.6 color_map { [0 rgbt 1] [0.5 rgbft <1, 1, 0.8, 0.3, 0.2>]\n"
        "    [0.8 rgbt <1, 0, 1, 0.5>] } scale 0.2 }\n"
        "  pigment { checker rgbf 0.8 rgbt <1, 0.5, 0.5, 0.8> scale 0.3 }\n"
        "  scale <1, 0.5, 2> rotate <20, 30, 40> translate <0.1, 0.2, 0>\n"
        "  emission <0.8, 0.9, 1.2> } background { rgb <0.3, 0.4, 0.5> }",
        "sky_sphere { pigment { wood color_map { [0 rgbft <1, 0.8, 0.6, 0.5, 0.5>] [1 rgbt 0.6] }\n"
        "  scale 0.1 matrix <1, 0.2, 0, 0, 1, 0, 0.1, 0, 1, 0, 0.3, 0> } }\n"
        "background { rgbft <0.3, 0.4, 0.5, 0.2, 0.4> }",
    };
    check_air(rows, COUNT(rows));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fogs),
        cmocka_unit_test(rainbows),
        cmocka_unit_test(skies),
    };
    return cmocka_run_group_tests_name("shade_air", tests, NULL, NULL);
}
