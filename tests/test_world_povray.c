// SPDX-License-Identifier: MIT
// Merges against POV-Ray's pictures: every leaf has a colour of its own, seen from in front and
// from within, where only the outer walls may be left.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/povray_pictures.h"
#include "tests/world_stage.h"

#include <stdio.h>

enum { WIDTH = 64, HEIGHT = 48, COLORS = 6 };

static const char *const COLOR[COLORS] = {"<1,0,0>", "<0,1,0>", "<0,0,1>",
                                          "<1,1,0>", "<0,1,1>", "<1,0,1>"};
static const uint16_t COLOR_BITS[COLORS] = {1, 2, 4, 3, 6, 5};

typedef struct {
    const char *text; // $n stands for the texture of leaf n
    void (*build)(Stage *stage);
} MergeCase;

static void build_simple(Stage *stage) {
    Object a = stage_sphere(vec3(-0.4, 0, 0), 1),
           b = stage_box(vec3(0, -0.6, -0.7), vec3(1.6, 0.6, 0.5));
    Object c = {.type = OBJECT_TORUS, .shape.torus = {0.9, 0.4}};
    uint32_t items[3] = {stage_put(stage, &a), stage_put(stage, &b), stage_put(stage, &c)};
    stage_put_root(stage, stage_put_group(stage, OBJECT_MERGE, items, 3));
}

static void build_nested(Stage *stage) {
    Object a = stage_sphere(vec3(-0.4, 0, 0), 1), b = stage_sphere(vec3(0.4, 0.3, 0), 0.9);
    Object c = stage_box(vec3(-0.2, -1.2, -1.3), vec3(0.6, 0.4, 0.5));
    Object d = {.type = OBJECT_CYLINDER, .shape.cone = {{-2, 0, 0}, {2, 0, 0}, 0.4, 0.4, true}};
    Object e = {.type = OBJECT_DISC, .shape.disc = {{0, 0, 0.2}, {0, 0, 1}, 2, 0}};
    uint32_t u[2] = {stage_put(stage, &a), stage_put(stage, &b)};
    uint32_t m[2] = {stage_put_group(stage, OBJECT_UNION, u, 2), stage_put(stage, &c)};
    uint32_t r[3] = {stage_put_group(stage, OBJECT_MERGE, m, 2), stage_put(stage, &d),
                     stage_put(stage, &e)};
    stage_put_root(stage, stage_put_group(stage, OBJECT_MERGE, r, 3));
}

static void build_patch(Stage *stage) {
    Object a = stage_sphere(vec3(0.5, 0.5, 0.1), 0.4), b = stage_flat_patch(stage, 0);
    for (int i = 0; i < 16; i++)
        b.shape.patch.points[i] = vec3(i / 4 - 1.5, i % 4 - 1.2, (i % 3) * 0.4);
    Object c = {.type = OBJECT_PLANE, .shape.plane = {{0, 1, 0}, -0.5}};
    uint32_t items[3] = {stage_put(stage, &a), stage_put(stage, &b), stage_put(stage, &c)};
    stage_put_root(stage, stage_put_group(stage, OBJECT_MERGE, items, 3));
}

static const MergeCase MERGES[] = {
    {"merge { sphere { <-0.4,0,0>, 1 $0 } box { <0,-0.6,-0.7>, <1.6,0.6,0.5> $1 }"
     " torus { 0.9, 0.4 $2 } }",
     build_simple},
    {"merge { merge { union { sphere { <-0.4,0,0>, 1 $0 } sphere { <0.4,0.3,0>, 0.9 $1 } }"
     " box { <-0.2,-1.2,-1.3>, <0.6,0.4,0.5> $2 } }"
     " cylinder { -2*x, 2*x, 0.4 open $3 } disc { <0,0,0.2>, z, 2 $4 } }",
     build_nested},
    {"merge { sphere { <0.5,0.5,0.1>, 0.4 $0 } bicubic_patch { type 1 flatness 0 u_steps 1 v_steps "
     "1 "
     "<-1.5,-1.2,0>, <-1.5,-0.2,0.4>, <-1.5,0.8,0.8>, <-1.5,1.8,0>,"
     "<-0.5,-1.2,0.4>, <-0.5,-0.2,0.8>, <-0.5,0.8,0>, <-0.5,1.8,0.4>,"
     "<0.5,-1.2,0.8>, <0.5,-0.2,0>, <0.5,0.8,0.4>, <0.5,1.8,0.8>,"
     "<1.5,-1.2,0>, <1.5,-0.2,0.4>, <1.5,0.8,0.8>, <1.5,1.8,0> $1 } plane { y, -0.5 $2 } }",
     build_patch},
};

// In front, and within, where only the outer walls may be seen.
static const Vec3 EYES[] = {{0.1, 0.4, -4}, {0.05, 0.1, 0.02}, {0.3, 1.5, 1.2}};
enum { MERGE_COUNT = sizeof MERGES / sizeof *MERGES, EYE_COUNT = sizeof EYES / sizeof *EYES };

static void write_merge(const PovrayPictures *pictures, size_t number, const MergeCase *merge,
                        Vec3 eye) {
    char path[128];
    snprintf(path, sizeof path, "%s/job%zu.pov", pictures->directory, number);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(
        file,
        "#version 3.7; global_settings { assumed_gamma 1 ambient_light 1 }\n"
        "camera { location <%.17g,%.17g,%.17g> direction <-0.1,-0.2,1> right 1.6*x up 1.2*y }\n",
        eye.x, eye.y, eye.z);
    for (const char *c = merge->text; *c; c++)
        if (*c == '$')
            fprintf(file, "pigment { rgb %s } finish { ambient 1 diffuse 0 }", COLOR[*++c - '0']);
        else
            putc(*c, file);
    fclose(file);
}

static void test_merge_as_povray(void **state) {
    (void)state;
    PovrayPictures *pictures = povray_create(WIDTH, HEIGHT);
    for (size_t i = 0; i < MERGE_COUNT * EYE_COUNT; i++)
        write_merge(pictures, i, &MERGES[i / EYE_COUNT], EYES[i % EYE_COUNT]);
    if (!povray_render(pictures, MERGE_COUNT * EYE_COUNT)) {
        povray_destroy(pictures);
        print_message("povray is not installed: nothing to compare with\n");
        skip();
    }
    size_t differ = 0, hits = 0;
    for (size_t i = 0; i < MERGE_COUNT * EYE_COUNT; i++) {
        const uint16_t *pixels = povray_read(pictures, i);
        if (!pixels)
            fail_msg("povray refused %s/job%zu.pov", pictures->directory, i);
        Stage stage = stage_begin();
        MERGES[i / EYE_COUNT].build(&stage);
        stage_ready(&stage, false);
        // The number of a leaf's texture is its place among the leaves.
        uint32_t number[16] = {0}, leaves = 0;
        for (uint32_t o = 0; o < stage.objects.count; o++)
            number[o] = stage_is_group(&stage.objects.items[o]) ? 0 : leaves++;
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            double a = (k % WIDTH + 0.5) / WIDTH - 0.5;
            double b = ((HEIGHT - 1) - (k / WIDTH - 0.5)) / HEIGHT - 0.5;
            Ray ray = {EYES[i % EYE_COUNT], vec_normalize(vec3(-0.1 + 1.6 * a, -0.2 + 1.2 * b, 1))};
            WorldHit hit;
            bool met = world_intersect(stage.world, &ray, 1e-4, INFINITY, RAY_CAMERA, NULL, &hit);
            int want = met ? COLOR_BITS[number[hit.object]] : 0, seen = 0;
            for (int c = 0; c < 3; c++)
                seen |= pixels[k * 3 + c] > 32768 ? 1 << c : 0;
            hits += met;
            differ += want != seen;
            if (want != seen)
                print_message("merge %zu eye %zu pixel %d,%d: %d, POV-Ray %d\n", i / EYE_COUNT,
                              i % EYE_COUNT, k % WIDTH, k / WIDTH, want, seen);
        }
        stage_end(&stage);
    }
    povray_destroy(pictures);
    print_message("merges: %zu of %zu pixels differ\n", differ, hits);
    assert_true(hits > 5000);
    assert_int_equal(differ, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_merge_as_povray),
    };
    return cmocka_run_group_tests_name("world_povray", tests, NULL, NULL);
}
