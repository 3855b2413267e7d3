// SPDX-License-Identifier: MIT
// Named accuracies and tolerances in pixels: what they promise of a picture and of a hit.
#include "pictures.h"

#include "render/footprint.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const scenes[] = {
    "scenes/teapot-matte/teapot-matte.pov",
    "scenes/teapot-chrome/teapot-chrome.pov",
    "scenes/teapot-glass/teapot-glass.pov",
    "scenes/folds/folds.pov",
    "scenes/macros/macros.pov",
    "scenes/mirror/mirror.pov",
    "scenes/uv/uv.pov",
};

static const char *render(const char *scene, const char *accuracy) {
    static char path[2][4400];
    static int turn;
    char *out = path[turn ^= 1];
    snprintf(out, sizeof path[0], "%s/%s.png", scratch_folder(), accuracy);
    const char *log;
    if (run_command(&log,
                    "build/qirender +I%s +Lscenes/teapot +W160 +H120 +A0.3 -V --accuracy %s '+O%s'",
                    scene, accuracy, out) != 0)
        fail_msg("%s", log);
    return out;
}

// `pixel`, and the default, which is `fine`, show what `exact` shows: no pixel is off by more than
// one step of 8 bits, reflections and refractions included. The limit is what an eye could see.
static void pixel_is_exact_to_the_eye(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        static const char *const named[] = {"pixel", "fine"};
        for (int k = 0; k < 2; k++) {
            const char *exact = render(scenes[i], "exact"), *other = render(scenes[i], named[k]);
            double off = percent_over(exact, other, 1.0 / 255.0 * (1.0 + 1e-4));
            if (off > 0.0)
                fail_msg("%s: %s differs from exact in %g %% of the pixels", scenes[i], named[k],
                         off);
        }
    }
}

static double number_after(const char *text, const char *words) {
    const char *at = strstr(text, words);
    if (!at)
        fail_msg("no '%s' in\n%s", words, text);
    return strtod(at + strlen(words), NULL);
}

// What --explain measures keeps what the tolerances promise: bounds are below them, hits move by
// no more than both allow, and what is not there is said.
static void explained(void **state) {
    (void)state;
    const char *log;
    const char *run = "build/qirender +Iscenes/teapot-matte/teapot-matte.pov +Lscenes/teapot +W160 "
                      "+H120 -V --accuracy %s --explain '+O%s/explained.png'";
    char command[4600];
    snprintf(command, sizeof command, run, "pixel", scratch_folder());
    assert_int_equal(run_command(&log, "%s", command), 0);
    assert_true(number_after(log, "(pixel), from a sample of ") == 160 * 120);
    assert_true(number_after(log, "within its bound: ") <= 1e-6);
    assert_true(number_after(log, "a camera ray ") > 0.0);
    assert_non_null(strstr(log, "The next coarser, 0.1px (draft)"));
    assert_non_null(strstr(log, "The next finer, 1e-09 of a patch's diameter (fine)"));
    const char *finer = strstr(log, "The next finer");
    assert_true(number_after(finer, "by up to ") <= 1e-5);
    assert_true(number_after(finer, "pixels; ") <= 1.0);

    snprintf(command, sizeof command, run, "exact", scratch_folder());
    assert_int_equal(run_command(&log, "%s", command), 0);
    assert_null(strstr(log, "The next finer"));
    assert_non_null(strstr(log, "The next coarser, 1e-09"));

    assert_int_equal(run_command(&log,
                                 "echo 'sphere { 0, 1 } background { rgb 1 }' >'%s/a.pov' && "
                                 "build/qirender '%s/a.pov' +W8 +H8 -V --explain",
                                 scratch_folder(), scratch_folder()),
                     0);
    assert_non_null(strstr(log, "no patches"));
}

// The pixel of a perspective camera grows with the distance; that of an orthographic one does not.
static void footprints(void **state) {
    (void)state;
    Camera camera = {.type = CAMERA_PERSPECTIVE,
                     .direction = {0, 0, 1},
                     .right = {4.0 / 3.0, 0, 0},
                     .up = {0, 1, 0}};
    CameraView view = camera_view(&camera, NULL, 400, 300);
    Footprint f = footprint_create(&view, 0.5);
    for (double z = 10; z < 1e6; z *= 10) {
        Box box = {{-z, -z, z}, {z, z, 3 * z}};
        // Half of 1/300 a unit of distance in the middle; less at the corners, by cos^2 of 40
        // degrees at most, and for the slant.
        double t = footprint_tolerance(&f, box) / z;
        assert_true(t <= 0.5 / 300.0 * (1 + 1e-9) && t >= 0.5 * 0.5 / 300.0);
    }
    // Never more than a thousandth of a small patch; nothing where the camera is inside.
    Box small = {{0, 0, 1000}, {0.001, 0.001, 1000.001}}, around = {{-1, -1, -1}, {1, 1, 1}};
    assert_true(fabs(footprint_tolerance(&f, small) - 1e-6 * sqrt(3)) < 1e-12);
    assert_true(footprint_tolerance(&f, around) == 0.0);

    camera.type = CAMERA_ORTHOGRAPHIC;
    view = camera_view(&camera, NULL, 400, 300);
    f = footprint_create(&view, 0.5);
    Box near = {{-9, -9, 1}, {9, 9, 2}}, far = {{-9, -9, 1e6}, {9, 9, 1e6 + 1}};
    assert_true(fabs(footprint_tolerance(&f, near) - 0.5 / 300.0) < 1e-9);
    assert_true(fabs(footprint_tolerance(&f, far) - 0.5 / 300.0) < 1e-9);
}

// Rays moved by a whole pixel give the picture moved by one, to the last bit.
static void nudged_rays_move_the_picture(void **state) {
    (void)state;
    const char *log;
    const char *run = "build/qirender +Iscenes/teapot-matte/teapot-matte.pov +Lscenes/teapot +W64 "
                      "+H48 -A -V %s '+O%s/%s.png'";
    char command[4600], path[4400];
    Arena *arena = arena_create();
    const Image *cut[2];
    for (int k = 0; k < 2; k++) {
        const char *name = k ? "moved" : "plain";
        snprintf(command, sizeof command, run, k ? "--nudge 1,-1" : "", scratch_folder(), name);
        if (run_command(&log, "%s", command) != 0)
            fail_msg("%s", log);
        snprintf(path, sizeof path, "%s/%s.png", scratch_folder(), name);
        cut[k] = image_cut(arena, image_read(arena, path), k ? 0 : 1, k ? 1 : 0, 63, 47);
    }
    assert_true(image_compare(cut[0], cut[1], 0, 0).max == 0);
    arena_destroy(arena);
    assert_int_equal(run_command(&log, "build/qirender a.pov --nudge 2,0"), 2);
    assert_non_null(strstr(log, "right,down"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixel_is_exact_to_the_eye),
        cmocka_unit_test(footprints),
        cmocka_unit_test(nudged_rays_move_the_picture),
        cmocka_unit_test(explained),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
