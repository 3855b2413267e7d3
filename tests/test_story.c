// SPDX-License-Identifier: MIT
// The story of a pixel (--pixel) tells what the renderer does: its last line is the picture's value
// there, and in its table of nets the ray is never farther from the net than the bound allows.
#include "pictures.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define QIRENDER "build/test/qirender +Lscenes/teapot -V +W64 +H48 -A "

static const char *const scenes[] = {
    "scenes/teapot-chrome/teapot-chrome.pov",
    "scenes/teapot-glass/teapot-glass.pov",
    "scenes/folds/folds.pov",
};

static const struct { int x, y; } pixels[] = {{32, 24}, {20, 30}, {40, 20}, {1, 1}, {60, 44}};

// Every row of every table; returns how many there are.
static int check_nets(const char *story) {
    int rows = 0;
    for (const char *at = story; (at = strstr(at, "QI nets")) != NULL;) {
        at = strchr(strchr(at, '\n') + 1, '\n') + 1; // past the heading
        double last = INFINITY;
        for (int step = 0;; step++) {
            int number;
            double u0, u1, v0, v1, epsilon, distance;
            if (sscanf(at, " %d [%lf , %lf ] [%lf , %lf ] %lf %lf", &number, &u0, &u1, &v0, &v1,
                       &epsilon, &distance) != 7)
                break;
            assert_int_equal(number, step);
            // Four digits are printed; below 1e-12 rounding is part of both.
            assert_true(distance <= epsilon * 1.001 + 1e-12);
            assert_true(epsilon < last);
            last = epsilon;
            rows++;
            at = strchr(at, '\n') + 1;
        }
    }
    return rows;
}

static void ends_with_the_picture(void **state) {
    (void)state;
    int rows = 0, lights = 0;
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        char path[4400];
        snprintf(path, sizeof path, "%s/story.png", scratch_folder());
        assert_int_equal(run_command(NULL, QIRENDER "+I%s '+O%s'", scenes[s], path), 0);
        Arena *arena = arena_create();
        const Image *picture = image_read(arena, path);
        for (size_t i = 0; i < sizeof pixels / sizeof *pixels; i++) {
            const char *log;
            int x = pixels[i].x, y = pixels[i].y;
            assert_int_equal(
                run_command(&log, QIRENDER "+I%s --pixel %d,%d 2>/dev/null", scenes[s], x, y), 0);
            const char *last = strstr(log, "in the file, without anti-aliasing:");
            assert_non_null(last);
            double rgb[3];
            assert_int_equal(sscanf(strchr(last, ':') + 1, "%lf %lf %lf", rgb, rgb + 1, rgb + 2),
                             3);
            for (int c = 0; c < 3; c++)
                assert_int_equal(
                    lround(rgb[c]),
                    lround(255.0 * (double)picture->pixels[(y * 64 + x) * picture->channels + c]));
            rows += check_nets(log);
            lights += strstr(log, "light 0") != NULL;
        }
        arena_destroy(arena);
    }
    assert_true(rows > 50);
    assert_true(lights > 5);
}

static void refuses(void **state) {
    (void)state;
    const char *log;
    assert_int_equal(run_command(&log, QIRENDER "+I%s --pixel 64,0", scenes[0]), 1);
    assert_non_null(strstr(log, "outside the picture"));
    assert_int_equal(run_command(&log, QIRENDER "+I%s --pixel 3", scenes[0]), 2);
    assert_non_null(strstr(log, "column,row"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_with_the_picture),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
