// SPDX-License-Identifier: MIT
// Noise against values that POV-Ray printed with all digits, and against POV-Ray itself.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "digits.h"
#include "noise/noise.h"

#include <math.h>
#include <stdio.h>

// To the last of 15 printed decimals.
static void near15(double have, double want) {
    if (!(fabs(have - want) < 0.6e-15))
        fail_msg("%.17g, not %.15f", have, want);
}

static void printed_values(void **state) {
    (void)state;
    const Vec3 p = vec3(0.5, 0.25, 0.75), q = vec3(-1.3, 2.7, 10.1), r = vec3(100.5, -200.25, 0.0);
    static const double want[3][3] = {
        {0.229814690539551, 0.383182215766698, 0.606314745812513},
        {0.471436834245888, 0.501542229102123, 0.486435865783491},
        {0.267273156250000, 0.401531463203232, 0.515069043998550},
    };
    const Vec3 points[3] = {p, q, r};
    for (int i = 0; i < 3; i++)
        for (int g = 1; g <= 3; g++)
            near15(noise_value(points[i], g), want[i][g - 1]);
    Vec3 v = noise_vector(p);
    near15(v.x, -0.270185309460449);
    near15(v.y, -0.497926325378418);
    near15(v.z, 0.332525255480957);
    const NoiseOctaves octaves = {6, 2.0f, 0.5f};
    near15(noise_turbulence(p, &octaves, 1), 0.682622484289551);
    near15(noise_turbulence(p, &octaves, 2), 0.749909917416515);
    v = noise_turbulence_vector(p, &octaves);
    near15(v.x, -0.301752515710449);
    near15(v.y, -0.643241031628418);
    near15(v.z, 0.579396924230957);
    // The well-known first numbers of MT19937, and of the shuffle.
    assert_true(fabs(noise_random(0) - 0.814723691903) < 1e-12);
    assert_true(fabs(noise_random(3) - 0.835008589784) < 1e-12);
}

// Coordinates beyond what an int holds: no undefined step, and still within the range.
static void far_away(void **state) {
    (void)state;
    static const double far[] = {2147483647.5, 2147483648.0, -2147483649.0, 1e17, -1e17};
    for (int i = 0; i < 5; i++)
        for (int g = 1; g <= 3; g++) {
            double n = noise_value(vec3(far[i], 1.5, far[4 - i]), g);
            assert_true(n >= 0.0 && n <= 1.0);
        }
}

static void generators(void **state) {
    (void)state;
    Digits *digits = digits_create("#include \"functions.inc\"\n");
    for (int g = 1; g <= 3; g++) {
        char text[64];
        snprintf(text, sizeof text, "function { f_noise_generator(x, y, z, %d) }", g);
        digits_function(digits, text, "");
    }
    const double *want = digits_run(digits);
    for (int g = 1; g <= 3; g++)
        for (int i = 0; i < DIGITS_POINTS; i++)
            digits_equal(digits, noise_value(digits_point(i), g), *want++, "generator", i);
    digits_finish(digits);
}

static int prepare(void **state) {
    (void)state;
    noise_prepare();
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(printed_values),
        cmocka_unit_test(far_away),
        cmocka_unit_test(generators),
    };
    return cmocka_run_group_tests_name("noise", tests, prepare, NULL);
}
