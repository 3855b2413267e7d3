// SPDX-License-Identifier: MIT
// Whole pictures against POV-Ray's: with its own triangles (--method facets) they must be the same,
// so everything around the patch is right. Limit: at most 1 pixel in 10,000 off by more than one
// step of 8 bits (0.0041 of full range is just above 1/255), since a ray on the very edge of a
// triangle or a tie between two surfaces may be decided by the last bit.
#include "pictures.h"

#include "base/file.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define ONE_STEP 0.0041
#define AT_MOST_PERCENT 0.01

// Scenes by strangers are held to all of them, our own to the last, which samples most.
static const char *const SWITCHES[] = {"-A", "+A0.3 +AM2 +R3", "+A0.3"};

typedef struct {
    const char *name, *scene;
    size_t first;        // of SWITCHES: those before are left out
    double percent_more; // over AT_MOST_PERCENT, for a reason given at the row
} Row;

static const Row ROWS[] = {
    {"bezier", EXAMPLES "objects/bezier.pov", 0, 0},
    {"teapot", EXAMPLES "advanced/teapot/teapot.pov", 0, 0},
    {"cephalopov", CORPUS "cephalopov/bicubicpatch_basic.pov", 0, 0},
    {"dealii", CORPUS "dealii/cont243bic.pov", 0, 0},
    {"postit", CORPUS "postit/postit.pov", 0, 0},
    {"eaglemode", CORPUS "eaglemode/Splitter.pov", 0, 0},
    {"teapot-matte", "scenes/teapot-matte/teapot-matte.pov", 2, 0},
    {"teapot-chrome", "scenes/teapot-chrome/teapot-chrome.pov", 2, 0},
    {"teapot-glass", "scenes/teapot-glass/teapot-glass.pov", 2, 0},
    {"folds", "scenes/folds/folds.pov", 2, 0},
    // All petals meet in one place, nearer to each other than a thousandth. There POV-Ray's shadows
    // depend on which object it met last (its shadow cache takes hits down to 1e-4 of an object
    // that it knows, 1e-3 of others); ours never depend on the past. 19 of 76,800 pixels.
    {"macros", "scenes/macros/macros.pov", 2, 0.02},
    {"mirror", "scenes/mirror/mirror.pov", 2, 0},
    {"shells", "scenes/shells/shells.pov", 2, 0},
    {"uv", "scenes/uv/uv.pov", 2, 0},
};

static void facets_equal_povray(void **state) {
    const Row *row = *state;
    if (!file_exists(row->scene)) {
        print_message("skipped: %s is not here\n", row->scene);
        skip();
    }
    int bad = 0;
    for (size_t i = row->first; i < sizeof SWITCHES / sizeof *SWITCHES; i++) {
        char switches[256];
        snprintf(switches, sizeof switches, "+W320 +H240 +L../teapot %s", SWITCHES[i]);
        const char *theirs = render_with_povray("theirs", row->scene, switches);
        strcat(switches, " --method facets");
        const char *ours = render_with_qirender("ours", row->scene, switches);
        double percent = percent_over(theirs, ours, ONE_STEP);
        print_message("%-14s %-16s %.4f %% of the pixels differ\n", row->name, SWITCHES[i],
                      percent);
        bad += !(percent <= AT_MOST_PERCENT + row->percent_more);
    }
    assert_int_equal(bad, 0);
}

static void bytes_do_not_depend_on_threads(void **state) {
    (void)state;
    const char *scene = EXAMPLES "advanced/teapot/teapot.pov";
    const char *first = NULL;
    for (int i = 0; i < 4; i++) {
        char name[32], switches[64];
        snprintf(name, sizeof name, "threads%d", i);
        snprintf(switches, sizeof switches, "+W320 +H240 +A0.3 +WT%d", 1 + i % 2);
        const char *picture = render_with_qirender(name, scene, switches);
        if (first)
            assert_int_equal(run_command(NULL, "cmp '%s' '%s'", first, picture), 0);
        else
            first = picture;
    }
}

// A row of this picture lay in the shadow of its own patch: 32 where the rows above and below have
// 58 and 52. The button is smooth there, so that each row is the mean of its neighbours.
static void no_patch_shades_itself(void **state) {
    (void)state;
    if (!file_exists(CORPUS "eaglemode/Splitter.pov")) {
        print_message("skipped: the scene is not here\n");
        skip();
    }
    const char *picture =
        render_with_qirender("smooth", CORPUS "eaglemode/Splitter.pov", "+W320 +H240");
    Arena *arena = arena_create();
    const Image *image = image_read(arena, picture);
    size_t row = (size_t)image->width * (size_t)image->channels;
    for (int y = 205; y < 219; y++)
        for (int x = 105; x < 210; x++) {
            size_t at = (size_t)y * row + (size_t)x * (size_t)image->channels;
            float mean = 0.5f * (image->pixels[at - row] + image->pixels[at + row]);
            assert_true(fabsf(image->pixels[at] - mean) < 3.0f / 255.0f);
        }
    arena_destroy(arena);
}

int main(void) {
    enum { COUNT = sizeof ROWS / sizeof *ROWS };
    struct CMUnitTest tests[COUNT + 2];
    for (int i = 0; i < COUNT; i++)
        tests[i] = (struct CMUnitTest){ROWS[i].name, facets_equal_povray, NULL, NULL,
                                       (void *)(uintptr_t)&ROWS[i]};
    tests[COUNT] = (struct CMUnitTest)cmocka_unit_test(bytes_do_not_depend_on_threads);
    tests[COUNT + 1] = (struct CMUnitTest)cmocka_unit_test(no_patch_shades_itself);
    return cmocka_run_group_tests_name("pictures", tests, NULL, NULL);
}
