// SPDX-License-Identifier: MIT
// facets.c against POV-Ray itself: the same patch is rendered by the installed povray with pigments
// that carry the hit's parameters, depth and normal in 16-bit colours, and every pixel must be
// equal to one step.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "patch/patch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { SIZE = 48 };

typedef struct {
    const char *name;
    int type, u_steps, v_steps;
    double flatness;
    Vec3 points[16];
    double scale; // of the points and of the view
    bool orthographic;
} Case;

// Two pictures: parameters and depth, normal.
static void write_scene(const char *path, const Case *c, bool normals) {
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f, "#version 3.7; global_settings { assumed_gamma 1.0 }\n");
    fprintf(f, "camera { %s location <0,0,-4> right x*%.17g up y*%.17g direction z*4 }\n",
            c->orthographic ? "orthographic" : "perspective", 2 * c->scale, 2 * c->scale);
    static const char *const ramp[2][3] = {
        {"uv_mapping gradient x", "uv_mapping gradient y", "gradient z translate 0.5*z scale 4"},
        {"slope x", "slope y", "slope z"}};
    fprintf(f, "#declare Probe = texture { pigment { average pigment_map {\n");
    for (int i = 0; i < 3; i++) {
        const char *what = ramp[normals][i];
        const char *move = strstr(what, " translate");
        fprintf(f, "[1 %.*s color_map { [0 rgb 0] [1 rgb <%d,%d,%d>] } %s]\n",
                move ? (int)(move - what) : (int)strlen(what), what, i == 0 ? 3 : 0, i == 1 ? 3 : 0,
                i == 2 ? 3 : 0, move ? move : "");
    }
    fprintf(f, "} } finish { ambient 1 diffuse 0 } }\n");
    fprintf(f, "bicubic_patch { type %d flatness %.17g u_steps %d v_steps %d\n", c->type,
            c->flatness, c->u_steps, c->v_steps);
    for (int i = 0; i < 16; i++)
        fprintf(f, "%s<%.17g,%.17g,%.17g>", i ? ",\n" : "", c->points[i].x, c->points[i].y,
                c->points[i].z);
    fprintf(f, "\ntexture { Probe } }\n");
    fclose(f);
}

// 16-bit PPM; comments start with #.
static void read_ppm(const char *path, uint16_t *out) {
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    assert_int_equal(fgetc(f), 'P');
    assert_int_equal(fgetc(f), '6');
    int header[3];
    for (int i = 0; i < 3; i++) {
        int ch = fgetc(f);
        while (ch == '#' || ch == ' ' || ch == '\n') {
            if (ch == '#') {
                while (ch != '\n')
                    ch = fgetc(f);
            }
            ch = fgetc(f);
        }
        ungetc(ch, f);
        assert_int_equal(fscanf(f, "%d", &header[i]), 1);
    }
    assert_int_equal(header[0], SIZE);
    assert_int_equal(header[1], SIZE);
    assert_int_equal(header[2], 65535);
    fgetc(f);
    for (int i = 0; i < SIZE * SIZE * 3; i++) {
        int high = fgetc(f);
        out[i] = (uint16_t)(high * 256 + fgetc(f));
    }
    fclose(f);
}

// Both pictures, by two runs side by side (povray sleeps most of its half second).
static void render(const Case *c, uint16_t truth[2][SIZE * SIZE * 3]) {
    char folder[] = "/tmp/test_facets_XXXXXX", path[64], command[512];
    assert_non_null(mkdtemp(folder));
    for (int normals = 0; normals < 2; normals++) {
        snprintf(path, sizeof path, "%s/%d.pov", folder, normals);
        write_scene(path, c, normals);
    }
    snprintf(command, sizeof command,
             "cd %s; for i in 0 1; do povray +I$i.pov +O$i.ppm +FP16 +W%d +H%d -D -A +WT1 "
             "File_Gamma=1.0 >log$i 2>&1 & done; wait",
             folder, SIZE, SIZE);
    assert_int_equal(system(command), 0);
    for (int normals = 0; normals < 2; normals++) {
        snprintf(path, sizeof path, "%s/%d.ppm", folder, normals);
        read_ppm(path, truth[normals]);
    }
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

static Ray pixel_ray(const Case *c, int x, int y) {
    double dx = ((x + 0.5) / SIZE - 0.5) * 2 * c->scale,
           dy = (0.5 - (y + 0.5) / SIZE) * 2 * c->scale;
    if (c->orthographic)
        return (Ray){vec3(dx, dy, -4), vec3(0, 0, 1)};
    return (Ray){vec3(0, 0, -4), vec_normalize(vec3(dx, dy, 4))};
}

static double slope(double cosine) { return (asin(cosine) * 2 / 3.14159265358979323846 + 1) / 2; }

static int compare(const Case *c) {
    PatchSetOptions options = patchset_options_default();
    options.method = METHOD_FACETS;
    PatchSet *set = patchset_create(&options);
    patchset_add(set, &(PatchDef){.degree_u = 3,
                                  .degree_v = 3,
                                  .points = c->points,
                                  .id = 7,
                                  .mask = 1,
                                  .flatness = c->flatness,
                                  .u_steps = c->u_steps,
                                  .v_steps = c->v_steps});
    patchset_commit(set);
    static uint16_t truth[2][SIZE * SIZE * 3];
    render(c, truth);
    int wrong = 0, hits = 0;
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            Ray ray = pixel_ray(c, x, y);
            PatchHit hit;
            double got[6] = {0};
            // POV-Ray's own nearest depth for any object.
            if (patchset_intersect(set, &ray, 1e-4, 1e7, 1, NULL, &hit)) {
                hits++;
                assert_int_equal(hit.id, 7);
                Vec3 n = hit.normal, p = vec_madd(ray.org, hit.t, ray.dir);
                if (vec_dot(n, ray.dir) > 0)
                    n = vec_neg(n);
                double values[6] = {hit.v,      hit.u,      p.z / 4 - 0.5 + 1.0,
                                    slope(n.x), slope(n.y), slope(n.z)};
                memcpy(got, values, sizeof got);
            }
            bool same = true;
            for (int i = 0; i < 6; i++) {
                int seen = truth[i / 3][(y * SIZE + x) * 3 + i % 3];
                double value = got[i] - floor(got[i]);
                same &= fabs(value * 65535.0 - seen) <= 1.0;
            }
            if (!same && wrong++ < 3)
                printf(
                    "%s: pixel %d,%d: %.0f %.0f %.0f %.0f %.0f %.0f instead of %d %d %d %d %d %d\n",
                    c->name, x, y, got[0] * 65535, got[1] * 65535, got[2] * 65535, got[3] * 65535,
                    got[4] * 65535, got[5] * 65535, truth[0][(y * SIZE + x) * 3],
                    truth[0][(y * SIZE + x) * 3 + 1], truth[0][(y * SIZE + x) * 3 + 2],
                    truth[1][(y * SIZE + x) * 3], truth[1][(y * SIZE + x) * 3 + 1],
                    truth[1][(y * SIZE + x) * 3 + 2]);
        }
    }
    printf("%s: %d pixels hit, %d differ\n", c->name, hits, wrong);
    patchset_destroy(set);
    return wrong;
}

// A bumpy sheet, rows along x, that covers most of the view.
static void sheet(Case *c, uint64_t seed, double noise) {
    Rng rng = {seed};
    for (int i = 0; i < 16; i++) {
        double x = (i / 4 - 1.5) * 0.6, y = (i % 4 - 1.5) * 0.6;
        c->points[i] = vec3(c->scale * (x + rng_range(&rng, -noise, noise)),
                            c->scale * (y + rng_range(&rng, -noise, noise)),
                            c->scale * rng_range(&rng, -2 * noise, 2 * noise));
    }
}

static bool have_povray(void) { return system("povray --version >/dev/null 2>&1") == 0; }

#define NEED_POVRAY()                                                                              \
    do {                                                                                           \
        if (!have_povray()) {                                                                      \
            printf("skipped: povray is not installed\n");                                          \
            skip();                                                                                \
        }                                                                                          \
    } while (0)

static void equal_for_all_settings(void **state) {
    (void)state;
    NEED_POVRAY();
    Case cases[] = {
        {.name = "no steps", .type = 1, .orthographic = true},
        {.name = "2 x 2", .type = 1, .u_steps = 2, .v_steps = 2},
        {.name = "3 x 1, type 0", .u_steps = 3, .v_steps = 1, .orthographic = true},
        {.name = "0 x 4", .type = 1, .v_steps = 4},
        {.name = "flatness 0.05", .type = 1, .u_steps = 5, .v_steps = 5, .flatness = 0.05},
        {.name = "flatness 0.01", .u_steps = 6, .v_steps = 4, .flatness = 0.01},
    };
    int wrong = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cases[i].scale = 1.0;
        sheet(&cases[i], 100 + i, i % 2 ? 0.2 : 0.5);
        wrong += compare(&cases[i]);
    }
    assert_int_equal(wrong, 0);
}

static void equal_when_collapsed(void **state) {
    (void)state;
    NEED_POVRAY();
    Case c = {.name = "row and column", .type = 1, .u_steps = 3, .v_steps = 3, .scale = 1.0};
    int wrong = 0;
    sheet(&c, 7, 0.2);
    for (int i = 0; i < 4; i++)
        c.points[i] = c.points[1]; // u = 0
    for (int i = 0; i < 4; i++)
        c.points[4 * i + 3] = c.points[15]; // v = 1
    wrong += compare(&c);
    c.name = "edge, flatness";
    sheet(&c, 8, 0.2);
    for (int i = 0; i < 4; i++)
        c.points[12 + i] = c.points[12]; // u = 1
    c.flatness = 0.03;
    c.u_steps = c.v_steps = 5;
    wrong += compare(&c);
    c.name = "one corner, flatness";
    sheet(&c, 9, 0.2);
    c.points[12] = c.points[0];
    wrong += compare(&c);
    assert_int_equal(wrong, 0);
}

// A flat patch of side 1.8 at 8 x 8 cells: the triangles vanish when twice their area falls below
// 1e-10, that is at a scale below 8 sqrt(1e-10) / 1.8 = 4.4e-5.
static void equal_when_tiny(void **state) {
    (void)state;
    NEED_POVRAY();
    int wrong = 0;
    for (int i = 0; i < 2; i++) {
        Case c = {.name = i ? "vanishing" : "tiny",
                  .type = 1,
                  .u_steps = 3,
                  .v_steps = 3,
                  .scale = i ? 4.6e-5 : 8e-5};
        sheet(&c, 3, 0.1);
        wrong += compare(&c);
    }
    assert_int_equal(wrong, 0);
}

typedef struct {
    int count;
    double t[64];
} List;

static void collect(void *context, const PatchHit *hit) {
    List *list = context;
    if (list->count < 64)
        list->t[list->count++] = hit->t;
}

// All hits, nearest and any tell the same story, within the limits.
static void forms_agree(void **state) {
    (void)state;
    PatchSetOptions options = patchset_options_default();
    options.method = METHOD_FACETS;
    PatchSet *set = patchset_create(&options);
    for (uint64_t k = 0; k < 3; k++) {
        Case c = {.scale = 1.0};
        sheet(&c, 20 + k, 0.5);
        patchset_add(set, &(PatchDef){.degree_u = 3,
                                      .degree_v = 3,
                                      .points = c.points,
                                      .id = (uint32_t)k,
                                      .mask = 1u << k,
                                      .u_steps = 3,
                                      .v_steps = 3});
    }
    patchset_commit(set);
    Rng rng = {1};
    int seen = 0;
    for (int i = 0; i < 2000; i++) {
        Ray ray = {vec3(rng_range(&rng, -3, 3), rng_range(&rng, -3, 3), -4), {0, 0, 0}};
        ray.dir = vec_sub(vec3(rng_range(&rng, -1, 1), rng_range(&rng, -1, 1), 0), ray.org);
        uint32_t mask = 1 + (uint32_t)(rng_next(&rng) % 7);
        double t_min = rng_range(&rng, 0.5, 1.0), t_max = rng_range(&rng, 1.0, 1.5);
        List list = {0};
        PatchStats stats = {0};
        PatchHit hit;
        patchset_all(set, &ray, t_min, t_max, mask, &stats, collect, &list);
        assert_int_equal(stats.hits, list.count);
        double nearest = INFINITY;
        for (int k = 0; k < list.count; k++) {
            assert_true(list.t[k] >= t_min && list.t[k] < t_max);
            nearest = fmin(nearest, list.t[k]);
        }
        bool found = patchset_intersect(set, &ray, t_min, t_max, mask, NULL, &hit);
        assert_int_equal(found, list.count > 0);
        assert_int_equal(patchset_occluded(set, &ray, t_min, t_max, mask, NULL), found);
        if (found) {
            assert_true(hit.t == nearest);
            assert_true(mask >> hit.id & 1);
            // The limits count exactly.
            assert_true(patchset_occluded(set, &ray, hit.t, t_max, mask, NULL));
            assert_false(patchset_occluded(set, &ray, t_min, hit.t, mask, NULL));
            seen++;
        }
    }
    assert_true(seen > 200);
    patchset_destroy(set);
}

// 100 patches at 8 steps are 13 million triangles: prepared within the bound, and still found.
static void many_steps_stay_small(void **state) {
    (void)state;
    PatchSetOptions options = patchset_options_default();
    options.method = METHOD_FACETS;
    PatchSet *set = patchset_create(&options);
    Case c = {.scale = 1.0};
    sheet(&c, 5, 0.2);
    for (uint32_t i = 0; i < 100; i++) {
        patchset_add(set, &(PatchDef){.degree_u = 3,
                                      .degree_v = 3,
                                      .points = c.points,
                                      .id = i,
                                      .mask = 1,
                                      .u_steps = 8,
                                      .v_steps = 8});
    }
    patchset_commit(set);
    assert_true(patchset_memory(set) < 700u << 20);
    Ray ray = {vec3(0.1, 0.2, -4), vec3(0.003, 0.001, 1)};
    PatchHit hit;
    PatchStats stats = {0};
    assert_true(patchset_intersect(set, &ray, 0, 100, 1, &stats, &hit));
    assert_int_equal(hit.id, 0); // the first of equals
    patchset_destroy(set);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_for_all_settings), cmocka_unit_test(equal_when_collapsed),
        cmocka_unit_test(equal_when_tiny),        cmocka_unit_test(forms_agree),
        cmocka_unit_test(many_steps_stay_small),
    };
    return cmocka_run_group_tests_name("facets", tests, NULL, NULL);
}
