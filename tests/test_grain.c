// SPDX-License-Identifier: MIT
// Grain: crand, and the jitter of area lights. POV-Ray draws it from one sequence for each thread,
// so that a pixel depends on all that its thread has traced before: on the size of the tiles, on
// how many threads there are. Ours is drawn for each ray, from the ray. So the pictures cannot be
// equal; what must be is the distribution.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "pictures.h"
#include "povray_pictures.h"
#include "reference.h"
#include "shade_fixture.h"

#include <math.h>
#include <stdio.h>

enum { WIDTH = 64, HEIGHT = 48, PIXELS = WIDTH * HEIGHT };

#define VIEW "camera { orthographic location <0, 5, 0> look_at 0 sky z right 0.0133*x up 0.01*z }\n"

// All under the same light, so that the grain is all there is to see.
static const char CRAND[] =
    VIEW "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 crand 0.5 } }\n"
         "light_source { 100*y, rgb 0.9 parallel point_at 0 }\n";
// All at the same share of the same light: the edge that throws the shadow is far off.
static const char JITTER[] =
    VIEW "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n"
         "box { <-900, 50, -900>, <7, 51, 900> no_image pigment { rgb 1 } }\n"
         "light_source { 100*y, rgb 0.9 area_light 60*x, 60*z, 4, 4 jitter }\n";

typedef struct {
    double mean, variance, kurtosis, along; // along: the correlation of neighbours in a row
} Moments;

static Moments moments(const double v[PIXELS]) {
    Moments m = {0};
    double fourth = 0.0;
    for (int i = 0; i < PIXELS; i++)
        m.mean += v[i] / PIXELS;
    for (int i = 0; i < PIXELS; i++) {
        double d = v[i] - m.mean;
        m.variance += d * d / PIXELS;
        fourth += d * d * d * d / PIXELS;
        if (i > 0)
            m.along += d * (v[i - 1] - m.mean) / PIXELS;
    }
    m.kurtosis = fourth / (m.variance * m.variance);
    m.along /= m.variance;
    return m;
}

static Moments ours(const char *text) {
    static double v[PIXELS];
    Fixture *f = fixture_read(WIDTH, HEIGHT, text);
    const Color *pixels = fixture_picture(f, 9);
    for (int i = 0; i < PIXELS; i++)
        v[i] = pixels[i].g;
    fixture_destroy(f);
    return moments(v);
}

static void write_scene(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "#version 3.7; global_settings { assumed_gamma 1 }\n%s", text);
    assert_int_equal(fclose(file), 0);
}

static Moments theirs(const char *text) {
    static double v[PIXELS];
    PovrayPictures *pictures = povray_create(WIDTH, HEIGHT);
    char path[128];
    snprintf(path, sizeof path, "%s/job0.pov", pictures->directory);
    write_scene(path, text);
    assert_true(povray_render(pictures, 1));
    const uint16_t *pixels = povray_read(pictures, 0);
    assert_non_null(pixels);
    for (int i = 0; i < PIXELS; i++)
        v[i] = pixels[3 * i + 1] / 65535.0;
    povray_destroy(pictures);
    return moments(v);
}

// Both are samples of the distribution, of PIXELS values: means differ by sqrt(2 variance /
// PIXELS), variances by variance sqrt(2 (kurtosis - 1) / PIXELS), and neighbours that have nothing
// to do with each other correlate by 1 / sqrt(PIXELS); five times that has a chance of one in a
// million.
static void assert_same_distribution(const char *text) {
    Moments a = ours(text), b = theirs(text);
    assert_true(a.variance > 1e-4);
    assert_true(fabs(a.mean - b.mean) < 5.0 * sqrt(2.0 * b.variance / PIXELS));
    assert_true(fabs(a.variance - b.variance) <
                5.0 * b.variance * sqrt(2.0 * (b.kurtosis - 1.0) / PIXELS));
    assert_true(fabs(a.along) < 5.0 / sqrt(PIXELS));
}

static void crand_has_the_distribution(void **state) {
    (void)state;
    if (!reference_available())
        skip();
    assert_same_distribution(CRAND);
}

static void jitter_has_the_distribution(void **state) {
    (void)state;
    if (!reference_available())
        skip();
    assert_same_distribution(JITTER);
}

// POV-Ray's picture with one thread is another when the tiles are of another size. Ours is not, nor
// with more threads.
static void only_povray_remembers(void **state) {
    (void)state;
    if (!reference_available())
        skip();
    static const char *const texts[] = {CRAND, JITTER};
    for (int i = 0; i < 2; i++) {
        char scene[512];
        snprintf(scene, sizeof scene, "%s/grain%d.pov", scratch_folder(), i);
        write_scene(scene, texts[i]);
        assert_true(percent_over(render_with_povray("p32", scene, "+W64 +H48 -A +WT1 +BS32"),
                                 render_with_povray("p8", scene, "+W64 +H48 -A +WT1 +BS8"),
                                 0.0041) > 50.0);
        assert_true(percent_over(render_with_qirender("q32", scene, "+W64 +H48 -A +WT1 +BS32"),
                                 render_with_qirender("q8", scene, "+W64 +H48 -A +WT2 +BS8"),
                                 0.0) == 0.0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crand_has_the_distribution),
        cmocka_unit_test(jitter_has_the_distribution),
        cmocka_unit_test(only_povray_remembers),
    };
    return cmocka_run_group_tests_name("grain", tests, NULL, NULL);
}
