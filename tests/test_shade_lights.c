// SPDX-License-Identifier: MIT
// Lights that are more than a point, against POV-Ray: each row is one light over the same stage,
// from the text through the converter to the picture, and every value of 16 bits is compared.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "shade_fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

static const char STAGE[] =
    "camera { location <0.3, 3, -7> right x up y look_at <0, 0.4, 0> }\n"
    "plane { y, -0.5 pigment { rgb <0.9, 0.8, 0.7> } finish { specular 0.3 } }\n"
    "sphere { <0, 0.7, 0>, 0.8 pigment { rgb <0.5, 0.7, 0.9> } finish { phong 0.5 } }\n"
    "sphere { <-1.3, 0.4, -1>, 0.5 pigment { rgbf <0.9, 0.5, 0.3, 0.6> } }\n";

static void check_lights(const char *const *rows, size_t count) {
    for (size_t i = 0; i < count; i++) {
        char text[1024];
        snprintf(text, sizeof text, "%slight_source { <2, 5, -3> rgb <1, 0.8, 0.6> %s }\n", STAGE,
                 rows[i]);
        fixture_compare_later(fixture_read(36, 30, text), 9, false);
    }
    fixture_compare_now();
}

#define NARROW "radius 12 falloff 25 tightness 10 "

static void beams(void **state) {
    (void)state;
    static const char *const rows[] = {
        "spotlight point_at <0, 0.3, 0>",
        "spotlight point_at <0, 0.3, 0> " NARROW "fade_distance 4 fade_power 2",
        "spotlight point_at <0, 0.3, 0> radius 20 falloff 15", // wider than where it ends
        "spotlight point_at <0, 0.3, 0> radius 95 falloff 100",
        "spotlight parallel point_at <0, 0.3, 0> " NARROW,
        "spotlight parallel point_at <2, 5, -2> " NARROW, // lights only what is before it
        "cylinder point_at <0, 0.3, 0>",
        "cylinder point_at <0, 0.3, 0> radius 1 falloff 2.5 tightness 2 fade_distance 4 "
        "fade_power 1",
        "cylinder parallel radius 3 falloff 2.5 tightness 2 scale 0.9 rotate 5 point_at 0",
        "cylinder point_at <0, 5, -2> radius 2 falloff 4",
    };
    check_lights(rows, COUNT(rows));
}

static void areas(void **state) {
    (void)state;
    static const char *const rows[] = {
        "area_light 2*x, 2*z, 5, 6",
        "area_light 2*x, 2*z, 9, 7 adaptive 1",
        "area_light <2, 1, 0>, 2*z, 9, 7 adaptive 0 circular",
        "area_light <2, 1, 0>, 2*z, 9, 7 adaptive 2 orient circular",
        "area_light <2, 1, 0>, 2*z, 3, 4 orient",
        "area_light <2, 1, 0>, 2*z, 1, 5 rotate 10 scale <1, 1.1, 0.8>",
        "area_light <2, 1, 0>, 2*z, 5, 5 spotlight point_at 0 " NARROW,
        "area_light <2, 1, 0>, 2*z, 5, 5 parallel point_at 0",
        "area_light <2, 1, 0>, 2*z, 5, 5 cylinder radius 1 falloff 3 point_at 0",
    };
    check_lights(rows, COUNT(rows));
}

static void area_illumination(void **state) {
    (void)state;
    static const char *const rows[] = {
        "area_light <2, 1, 0>, 2*z, 4, 5 area_illumination",
        "area_light <2, 1, 0>, 2*z, 4, 5 circular orient area_illumination adaptive 1",
        "area_light <2, 1, 0>, 2*z, 3, 5 shadowless area_illumination",
        "area_light <2, 1, 0>, 2*z, 5, 5 spotlight point_at 0 " NARROW
        "fade_distance 4 fade_power 1 area_illumination",
        "area_light <2, 1, 0>, 2*z, 5, 5 parallel point_at 0 area_illumination",
        "area_light <2, 1, 0>, 2*z, 5, 5 parallel spotlight point_at 0 area_illumination " NARROW,
        "area_light <2, 1, 0>, 2*z, 5, 5 cylinder radius 1 falloff 3 point_at 0 "
        "area_illumination",
    };
    check_lights(rows, COUNT(rows));
}

// The mean over the floor of a hard shadow's soft edge does not depend on where the jitter puts the
// points; only with jitter do neighbours along the edge differ by more than the slant of the light
// does (below 1e-3). Each of the 30 x 20 pixels averages 16 of them: the mean of a share of light p
// in 0..1 varies by at most 0.5 / sqrt(30 x 20 x 16) = 0.005, jitter by cells less; 4 times that is
// allowed.
static void jitter_keeps_the_mean(void **state) {
    (void)state;
    double mean[2] = {0};
    for (int jitter = 0; jitter < 2; jitter++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "camera { orthographic location <0, 5, 0> look_at 0 sky z right 1.5*x up z }\n"
                 "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n"
                 "box { <-9, 1, -9>, <0, 1.1, 9> no_image pigment { rgb 1 } }\n"
                 "light_source { 100*y, rgb 1 area_light 100*x, 100*z, 4, 4 %s }\n",
                 jitter ? "jitter" : "");
        Fixture *f = fixture_read(30, 20, text);
        const Color *pixels = fixture_picture(f, 9);
        int different = 0;
        for (int i = 0; i < 30 * 20; i++) {
            mean[jitter] += pixels[i].g / (30 * 20);
            different += fabsf(pixels[i].g - pixels[(i + 30) % (30 * 20)].g) > 0.01f;
        }
        assert_true(jitter ? different > 100 : different == 0);
        fixture_destroy(f);
    }
    assert_true(mean[0] > 0.2 && mean[0] < 0.8);
    assert_true(fabs(mean[1] - mean[0]) < 0.02);
}

static const char PARTS[] =
    "camera { location <0.3, 3, -7> right x up y look_at <0, 0.4, 0> }\n"
    "plane { y, -0.5 pigment { rgb <0.9, 0.8, 0.7> } finish { specular 0.3 } }\n"
    "#declare S = sphere { <0, 0.7, 0>, 0.8 pigment { rgb <0.5, 0.7, 0.9> }\n"
    "  finish { phong 0.5 reflection 0.2 } }\n"
    "#declare T = sphere { <-1.3, 0.4, -1>, 0.5 pigment { rgbf <0.9, 0.5, 0.3, 0.6> } }\n"
    "#declare L = light_source { <2, 5, -3> rgb <1, 0.8, 0.6> }\n"
    "#declare M = light_source { <-4, 3, -5> rgb <0.3, 0.8, 0.6> }\n";

static void check_scenes(const char *const *rows, size_t count) {
    for (size_t i = 0; i < count; i++) {
        char text[2048];
        snprintf(text, sizeof text, "%s%s\n", PARTS, rows[i]);
        fixture_compare_later(fixture_read(36, 30, text), 9, false);
    }
    fixture_compare_now();
}

// What an outer group says of global lights reaches all objects inside; its lights only those that
// are in no inner group of their own.
static void groups(void **state) {
    (void)state;
    static const char *const rows[] = {
        "light_group { S L } T M",
        "light_group { S L global_lights on } T M",
        "light_group { S light_group { T M global_lights on } L } light_source { 9, 0.5 }",
        "light_group { S light_group { T global_lights on } L global_lights }\n"
        "light_source { 9, 0.5 }",
        "light_group { light_group { S M } L } T light_source { 9, 0.5 }",
        "light_group { M } S T L",
        "light_group { S T global_lights off } L",
        "light_group { S light_source { <-1, 1, -3> rgb 0.6\n"
        "  looks_like { sphere { 0, 0.3 pigment { rgb 1 } } } } } T light_source { 9, 0.5 }",
        "#declare G = light_group { S L } object { G translate -x } T M\n"
        "object { G translate 1.5*x }",
    };
    check_scenes(rows, COUNT(rows));
}

#define LIGHT "S T light_source { <2, 5, -3> rgb <1, 0.8, 0.6> "
#define SLIT "difference { box { -1, 1 } cylinder { -2*y, 2*y, 0.6 } } scale <1, 0.2, 0.5> "

static void projections(void **state) {
    (void)state;
    static const char *const rows[] = {
        LIGHT "projected_through { box { <-1, 2, -1.5>, <1, 2.1, 0.5> } } }",
        LIGHT
        "projected_through { disc { <1, 2.5, -1.5>, y, 1, 0.3 } } }\n"
        "sphere { <1.2, 1.7, -1.2>, 0.3 pigment { rgbt 0.5 } } sphere { <1.7, 4, -2.5>, 0.3 }",
        LIGHT "shadowless projected_through { disc { <1, 2.5, -1.5>, y, 1, 0.3 } } }",
        LIGHT "projected_through { " SLIT "translate <1, 2.5, -1.5> } spotlight parallel }",
        "S T light_source { <-1, 1.5, -3> rgb 1 fade_distance 2 fade_power 2 looks_like {\n"
        "  sphere { 0, 0.3 pigment { rgbt <1, 1, 1, 0.5> } finish { ambient 1 } } } }\n"
        "light_source { <2, 4, -3>, 0.5 }",
        "S T light_source { <2, 3, -3> color_map { [0.2 rgb x] [0.5 rgb <0, 1, 1>] [1 rgb 0.3] } }",
    };
    check_scenes(rows, COUNT(rows));
}

#define BRIGHT "light_source { <2, 5, -3> rgb <5, 4, 3> media_attenuation "

static void fog_before_lights(void **state) {
    (void)state;
    static const char *const rows[] = {
        "S T " BRIGHT "} fog { distance 10 rgbft <0.5, 0.6, 0.7, 0.3, 0.2> }",
        "S T " BRIGHT "} fog { fog_type 2 fog_alt 0.5 distance 3 rgb 0.6 turbulence 1 }",
        "S T " BRIGHT "media_interaction off } fog { distance 10 rgb 0.6 }",
        "S object { T hollow } " BRIGHT "} fog { distance 10 rgb 0.6 }",
        "S T " BRIGHT "area_light 2*x, 2*z, 3, 3 } fog { distance 10 rgb 0.6 }",
        "S T " BRIGHT "area_light 2*x, 2*z, 4, 5 adaptive 1 } fog { distance 10 rgb 0.6 }",
    };
    check_scenes(rows, COUNT(rows));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beams),
        cmocka_unit_test(areas),
        cmocka_unit_test(area_illumination),
        cmocka_unit_test(jitter_keeps_the_mean),
        cmocka_unit_test(groups),
        cmocka_unit_test(projections),
        cmocka_unit_test(fog_before_lights),
    };
    return cmocka_run_group_tests_name("shade_lights", tests, NULL, NULL);
}
