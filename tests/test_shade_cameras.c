// SPDX-License-Identifier: MIT
// Cameras against POV-Ray: each row looks at the same stage, from the text through the converter to
// the picture, and every value of 16 bits is compared.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "shade_fixture.h"

#include <stdio.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

static const char STAGE[] =
    "light_source { <3, 6, -5>, rgb <1, 0.9, 0.8> }\n"
    "plane { y, -0.5 pigment { checker rgb <0.9, 0.8, 0.7> rgb 0.3 } }\n"
    "sphere { <0, 0.7, 0>, 0.8 pigment { rgb <0.5, 0.7, 0.9> } finish { reflection 0.3 } }\n"
    "sphere { <-1.3, 0.4, -1>, 0.5 pigment { rgbf <0.9, 0.5, 0.3, 0.6> } }\n"
    "sky_sphere { pigment { checker rgb <0.2, 0.3, 0.5> rgb <0.5, 0.3, 0.4> scale 0.3 } }\n";

static void check_cameras(const char *const *rows, size_t count, int width, int height) {
    for (size_t i = 0; i < count; i++) {
        char text[1024];
        snprintf(text, sizeof text, "camera { %s look_at <0, 0.8, 0> }\n%s", rows[i], STAGE);
        fixture_compare_later(fixture_read(width, height, text), 9, false);
    }
    fixture_compare_now();
}

#define NEAR "location <0.3, 1.5, -3> "

static void projections(void **state) {
    (void)state;
    static const char *const rows[] = {
        "fisheye right x up y " NEAR,
        "fisheye angle 200 " NEAR,
        "ultra_wide_angle angle 140 " NEAR,
        "omnimax " NEAR,
        "omnimax right 1.2*x " NEAR,
        "omnimax right 0.9*x " NEAR,
        "panoramic " NEAR,
        "panoramic angle 100 right 2*x up 0.8*y " NEAR,
        "cylinder 1 angle 160 " NEAR,
        "cylinder 2 angle 120 " NEAR,
        "cylinder 3 angle 170 up 3*y " NEAR,
        "cylinder 4 angle 100 right 4*x " NEAR,
        "spherical " NEAR,
        "spherical angle 200 rotate 10*z " NEAR,
        "spherical angle 200, 60 right -x " NEAR,
        "orthographic " NEAR,
        "orthographic angle 40 " NEAR,
        "orthographic angle right 2*x up 2*y " NEAR,
    };
    check_cameras(rows, COUNT(rows), 32, 24);
}

// The point at which the normal's pattern is asked depends on the camera's type.
static void normals(void **state) {
    (void)state;
    static const char *const rows[] = {
        NEAR "normal { bumps 0.3 scale 0.1 }",
        NEAR "normal { ripples 0.2 frequency 20 phase 0.3 translate 0.1 } angle 70",
        "fisheye angle 120 normal { waves 0.3 scale 0.5 } " NEAR,
        "cylinder 1 angle 160 normal { wrinkles 0.4 scale 0.3 } " NEAR,
        "spherical normal { gradient x 0.3 slope_map { [0 <0, 1>] [1 <1, 0>] } scale 0.2 } " NEAR,
        NEAR "normal { dents 0.5 scale 0.2 } aperture 0.1 blur_samples 7 focal_point 0",
    };
    check_cameras(rows, COUNT(rows), 32, 24);
}

#define LENS "location <0.3, 1.5, -6> aperture 0.4 focal_point <0, 0.8, 0> "

// Of each kind of lens grid, and with fewer and more samples than it has. Most of the pixels end
// by the test of the variance: POV-Ray's has an error for odd numbers of samples, without which 8
// of 4800 pixels of the last row but four differed.
static void focal_blur(void **state) {
    (void)state;
    static const char *const rows[] = {
        LENS "blur_samples 1",
        LENS "blur_samples 2",
        LENS "blur_samples 6",
        LENS "blur_samples 7",
        "location <0.3, 1.5, -6> aperture 0.4 blur_samples 10",
        LENS "blur_samples 19 angle 40",
        LENS "blur_samples 10, 25 confidence 0.95 variance 1/1000",
        LENS "blur_samples 37 variance 0",
        LENS "blur_samples 60 confidence 0.999",
        "orthographic " LENS "blur_samples 10",
        "fisheye angle 100 " LENS "blur_samples 10",
    };
    check_cameras(rows, COUNT(rows), 32, 24);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projections),
        cmocka_unit_test(normals),
        cmocka_unit_test(focal_blur),
    };
    return cmocka_run_group_tests_name("shade_cameras", tests, NULL, NULL);
}
