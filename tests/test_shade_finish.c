// SPDX-License-Identifier: MIT
// Finishes and interiors against POV-Ray, from the text through the converter to the picture; every
// value of 16 bits is compared.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "shade_fixture.h"

#include <stdio.h>

static const char STAGE[] =
    "camera { location <0.3, 3, -7> right x up y look_at <0, 0.4, 0> }\n"
    "light_source { <3, 6, -5>, rgb <1, 0.9, 0.8> }\n"
    "light_source { <-3, 6, -5>, rgb 0.4 spotlight point_at 0 }\n"
    "plane { y, -0.5 pigment { checker rgb <0.9, 0.8, 0.7> rgb 0.3 quick_color rgb y }\n"
    "  normal { bumps 0.5 scale 0.3 } }\n"
    "#declare Map = pigment { gradient x color_map { [0 rgbf <0.9, 0.5, 0.3, 0.6>] [1 rgbt 0.5] } "
    "}\n";

// All that quality can leave out is in the scene.
static void qualities(void **state) {
    (void)state;
    char text[2048];
    snprintf(text, sizeof text,
             "%s fog { distance 20 rgb 0.5 } global_settings { ambient_light rgb <1, 0.9, 1.5> }\n"
             "sphere { <0, 0.7, 0>, 0.8 pigment { rgb <0.5, 0.7, 0.9> } finish { phong 0.5\n"
             "  reflection 0.2 } }\n"
             "sphere { <1.3, 0.4, -1>, 0.5 pigment { Map } finish { specular 0.4\n"
             "  irid { 0.3 thickness 0.5 } } interior { ior 1.2 fade_distance 0.5 fade_power 1\n"
             "  fade_color <0.2, 0.4, 0.6> caustics 0.5 } }\n",
             STAGE);
    for (int quality = 0; quality <= 9; quality++)
        fixture_compare_later(fixture_read(36, 30, text), quality, false);
    fixture_compare_now();
}

// In a finish the number is the exponent itself; in an interior it is times 45. The first was also
// times 45 here before, and the light behind glass was half of POV-Ray's.
static void caustics(void **state) {
    (void)state;
    static const char *const rows[] = {
        "sphere { 0.3*y, 1 pigment { rgbf <0.1, 0.6, 0.3, 0.75> } finish { ior 1.5 caustics 1 } }",
        "sphere { 0.3*y, 1 pigment { rgbf <0.1, 0.6, 0.3, 0.75> } finish { caustics 2 }\n"
        "  interior { ior 1.5 caustics 1 } }",
        "sphere { 0.3*y, 1 pigment { rgbf <0.1, 0.6, 0.3, 0.75> } normal { bumps 0.5 scale 0.2 }\n"
        "  interior { ior 1.5 caustics 0.1 } }",
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[2048];
        snprintf(text, sizeof text, "%s%s\n", STAGE, rows[i]);
        fixture_compare_later(fixture_read(36, 30, text), 9, false);
    }
    fixture_compare_now();
}

// Into air, into and out of a body inside, with other samples; overlapping bodies; totally
// reflected in some colours only; without an ior there is none; the second body along the way bends
// rays that are of one colour already.
static void dispersion(void **state) {
    (void)state;
    static const char *const rows[] = {
        "sphere { 0.3*y, 1 pigment { rgbf <0.9, 0.8, 0.7, 0.9> }\n"
        "  interior { ior 1.5 dispersion 1.3 dispersion_samples 12 } }",
        "sphere { 0.3*y, 1 pigment { rgbt 0.8 } finish { reflection { 0, 1 fresnel } "
        "conserve_energy }\n"
        "  normal { bumps 0.3 scale 0.4 } interior { ior 0.9 dispersion 0.8 } }",
        "sphere { 0.3*y, 1 pigment { rgbt 0.8 } interior { dispersion 0.8 } }",
        "sphere { 0.3*y, 1.2 pigment { rgbf 0.9 } interior { ior 1.6 dispersion 1.1\n"
        "  dispersion_samples 3 } } sphere { 0.2*y, 0.7 pigment { rgbf 0.9 } interior { ior 1.1\n"
        "  dispersion 1.5 dispersion_samples 5 } } sphere { <0.9, 0.3, -0.5>, 0.5 pigment { rgbf "
        "0.8 }\n"
        "  interior { ior 1.2 } }",
        "sphere { 0.3*y, 1 pigment { rgbf 0.9 } finish { ior 1.2 } interior { ior 1.5 dispersion "
        "1.3\n"
        "  } } sphere { <1.5, 0.3, 0>, 0.7 pigment { rgbf 0.9 } interior { ior 0 dispersion 2 } }",
        "box { -1, 1 rotate <20, 30, 0> pigment { rgbf 0.95 } interior { ior 1.4 dispersion 1.08\n"
        "  fade_distance 2 fade_power 1 } }",
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[2048];
        snprintf(text, sizeof text, "%s%s\n", STAGE, rows[i]);
        fixture_compare_later(fixture_read(36, 30, text), 9, false);
    }
    fixture_compare_now();
}

// The factor of old scenes: that of a plain texture's finish replaces the interior's.
static void refraction_dims(void **state) {
    (void)state;
    static const char *const rows[] = {
        "sphere { 0.3*y, 1 pigment { rgbf <0.9, 0.5, 0.3, 0.6> } finish { refraction 0.5 ior 1.3 "
        "}\n"
        "  interior { refraction 0.2 } }",
        "sphere { 0.3*y, 1 pigment { rgbt 0.8 } interior { ior 1.2 refraction 0.8 } }",
        "sphere { 0.3*y, 1 texture { checker texture { pigment { rgbf <0.9, 0.5, 0.3, 0.6> } }\n"
        "  texture { pigment { rgbt 0.9 } } scale 0.1 } interior { ior 1.2 refraction 0.8 } }",
        "union { sphere { 0, 0.6 } sphere { <1.1, 0, 0>, 0.7 } pigment { rgbt 0.7 }\n"
        "  finish { refraction 0.4 } }",
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[2048];
        snprintf(text, sizeof text, "%s%s\n", STAGE, rows[i]);
        fixture_compare_later(fixture_read(36, 30, text), 9, false);
    }
    fixture_compare_now();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(qualities),
        cmocka_unit_test(caustics),
        cmocka_unit_test(dispersion),
        cmocka_unit_test(refraction_dims),
    };
    return cmocka_run_group_tests_name("shade_finish", tests, NULL, NULL);
}
