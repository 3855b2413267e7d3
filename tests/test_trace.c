// SPDX-License-Identifier: MIT
// qibench trace: its file read to the last bit, its answers against the oracle, rays that start on
// a surface, and what it says of wrong input.
#include "pictures.h"
#include "ray_oracle.h"

#include "base/diag.h"
#include "base/rng.h"
#include "bench/ray_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *path_of(const char *name) {
    static char path[4400];
    snprintf(path, sizeof path, "%s/%s", scratch_folder(), name);
    return path;
}

static void write_file(const char *name, const char *text) {
    FILE *out = fopen(path_of(name), "w");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, strlen(text), out), strlen(text));
    fclose(out);
}

// ---- The file

// Numbers in every form, through the reader, have strtod's bits.
static void numbers_are_exact(void **state) {
    (void)state;
    enum { RAYS = 4000 };
    static const char *const odd[] = {"-0",     "+1.5",  "1e22",    "1e-22", "9007199254740993",
                                      "1e23",   ".5",    "5.",      "inf",   "-nan",
                                      "0x1p-3", "1e999", "4.9e-324"};
    Rng rng = {1};
    char *text = calloc(RAYS, 6 * 32);
    double *want = calloc(RAYS * 6, sizeof *want);
    assert_non_null(text);
    assert_non_null(want);
    size_t at = (size_t)sprintf(text, "patches 0\n\nrays %d\n", RAYS);
    for (int i = 0; i < RAYS * 6; i++) {
        char word[64];
        double x = ldexp(rng_range(&rng, -1, 1), (int)(rng_next(&rng) % 120) - 60);
        int form = (int)(rng_next(&rng) % 6);
        if (form == 0)
            snprintf(word, sizeof word, "%s", odd[rng_next(&rng) % (sizeof odd / sizeof odd[0])]);
        else if (form > 2)
            snprintf(word, sizeof word, "%.*g", (int)(rng_next(&rng) % 17) + 1, x);
        else if (form == 1)
            snprintf(word, sizeof word, "%.17g", x);
        else if (form == 2)
            snprintf(word, sizeof word, "%.6e", x);
        want[i] = strtod(word, NULL);
        at += (size_t)sprintf(text + at, "%s%s", word, i % 6 == 5 ? "\r\n" : "\t ");
    }
    write_file("numbers", text);
    Arena *arena = arena_create();
    RayFile *file = ray_file_open(arena, path_of("numbers"));
    assert_int_equal(ray_file_ray_count(file), RAYS);
    Ray *rays = ARENA_ARRAY(arena, Ray, RAYS);
    size_t count = 0, got;
    while ((got = ray_file_next(file, rays + count, 777 < RAYS - count ? 777 : RAYS - count)) > 0)
        count += got;
    assert_int_equal(count, RAYS);
    for (int i = 0; i < RAYS * 6; i++) {
        double have = ((const double *)rays)[i];
        if (memcmp(&have, &want[i], sizeof have) != 0)
            fail_msg("number %d of ray %d: %.17g instead of %.17g", i % 6, i / 6, have, want[i]);
    }
    ray_file_close(file);
    arena_destroy(arena);
    free(want);
    free(text);
}

static void wrong_files_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", ":1:1: error: expected 'patches' and their number, found the end of the file"},
        {"\n patch 1\n", ":2:2: error: expected 'patches' and their number, found 'patch'"},
        {"patches\n", ":1:8: error: expected the number of patches, found the end of the line"},
        {"patches -1\n", ":1:9: error: expected the number of patches, found '-1'"},
        {"patches 2x\n", ":1:9: error: expected the number of patches, found '2x'"},
        {"patches 4000000000\n", ":1:9: error: 4000000000 patches: the file is too short for them"},
        {"patches 0\nrays 1e3\n", ":2:6: error: expected the number of rays, found '1e3'"},
        {"patches 0 rays 0\n", ":1:11: error: expected the end of the line, found 'rays'"},
        {"patches 1\n1 2\n",
         ":2:4: error: expected x, y and z of a patch's point, found the end of the line"},
        {"patches 1\n1 2 3 4\n", ":2:7: error: expected the end of the line, found '4'"},
        {"patches 1\n1 2 3\n1 nan 2\n", ":3:1: error: point 1 of patch 0 is not finite"},
        {"patches 1\n1 2 1e999\n", ":2:1: error: point 0 of patch 0 is not finite"},
        {"patches 0\nrays 1\n1 2 3 4 5 6,\n",
         ":3:11: error: expected ox oy oz dx dy dz of a ray, found '6,'"},
        {"patches 0\nrays 1\n1 2 3 4 5 1.2.3\n",
         ":3:11: error: expected ox oy oz dx dy dz of a ray, found '1.2.3'"},
        {"patches 0\nrays 2\n1 2 3 4 5 6\n",
         ":4:1: error: expected ox oy oz dx dy dz of a ray, found the end of the file"},
        {"patches 0\nrays 1\n1 2 3 4 5 6\n7\n",
         ":4:1: error: expected the end of the file after the last ray, found '7'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_file("wrong", cases[i].text);
        const char *log;
        int status = run_command(&log, "build/test/qibench trace '%s'", path_of("wrong"));
        if (status != 1 || !strstr(log, cases[i].message))
            fail_msg("case %zu: status %d, expected '%s', got\n%s", i, status, cases[i].message,
                     log);
    }
}

static void wrong_usage_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *words, *message;
    } cases[] = {
        {"", "the first word says what to do"},
        {"guess", "the first word says what to do"},
        {"trace", "no file given"},
        {"trace a b", "what is 'b'?"},
        {"trace --method", "a value must follow"},
        {"trace --method=best a", "the methods are qi, qi-paper"},
        {"trace --tolerance 2 a", "a share of the patch's diameter"},
        {"trace --tolerance 1px a", "without a camera there are no pixels"},
        {"trace --threads -1 a", "a whole number from 0 to 512"},
        {"trace --isa mmx a", "the instruction sets are scalar, avx2, avx512"},
        {"trace --prepare all a", "the ways are full, light, none"},
        {"trace --quick a", "'--quick'"},
        {"trace --rounds 3 a", "'--rounds'"},
        {"speed --threads 2", "'--threads'"},
        {"speed --rounds 4", "an odd number"},
        {"speed --share 0", "a number from 0.0001 to 1"},
        {"speed --view top", "the views are full, zoom, scattered"},
        {"speed fast", "the tables are methods, picture, lattices and threads"},
        {"sweep", "no scene given"},
        {"sweep --size 4x4 a.pov", "8x8 to 8192x8192"},
        {"sweep --povray maybe a.pov", "on or off"},
        {"sweep +W640 a.pov", "'+W640'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *log;
        int status = run_command(&log, "build/test/qibench %s", cases[i].words);
        if (status != 2 || !strstr(log, cases[i].message))
            fail_msg("qibench %s: status %d, %s", cases[i].words, status, log);
    }
}

// ---- Answers

typedef struct {
    double t, u, v, bound;
    int patch; // -1: miss
} Answer;

static int read_answers(const char *text, Answer *answers, int capacity) {
    int count = 0;
    for (const char *line = text; *line && count < capacity; count++) {
        Answer *a = &answers[count];
        if (strncmp(line, "miss\n", 5) == 0)
            a->patch = -1;
        else if (sscanf(line, "%lf %lf %lf %d %lf", &a->t, &a->u, &a->v, &a->patch, &a->bound) != 5)
            fail_msg("line %d: '%.60s'", count + 1, line);
        line = strchr(line, '\n') + 1;
    }
    return count;
}

// A bowl over [0,1]^2 with its middle at z = height.
static void write_bowl(FILE *out, double height, double depth) {
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            double edge = i % 3 == 0 || j % 3 == 0;
            fprintf(out, "%.17g %.17g %.17g\n", i / 3.0, j / 3.0, height + edge * depth);
        }
    }
}

static void bowl_points(double height, double depth, Vec3 points[16]) {
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            points[4 * i + j] =
                vec3(i / 3.0, j / 3.0, height + (double)(i % 3 == 0 || j % 3 == 0) * depth);
}

// Three bowls above each other, random rays: nearest hits as the oracle has them, bounds true, any
// length of direction, the same text for 1 and 3 threads and whatever instructions.
static void answers_as_the_oracle(void **state) {
    (void)state;
    enum { BOWLS = 3, RAYS = 600 };
    PatchDef defs[BOWLS];
    Vec3 points[BOWLS][16];
    static Ray rays[RAYS];
    FILE *out = fopen(path_of("rays"), "w");
    fprintf(out, "patches %d\n", BOWLS);
    for (int k = 0; k < BOWLS; k++) {
        bowl_points(k, 0.7 - 0.3 * k, points[k]);
        write_bowl(out, k, 0.7 - 0.3 * k);
        defs[k] = (PatchDef){.degree_u = 3, .degree_v = 3, .points = points[k], .mask = 1};
    }
    fprintf(out, "rays %d\n", RAYS);
    Rng rng = {7};
    for (int i = 0; i < RAYS; i++) {
        double scale = ldexp(1.0, (int)(rng_next(&rng) % 40) - 20);
        Vec3 org = vec3(rng_range(&rng, -1, 2), rng_range(&rng, -1, 2), rng_range(&rng, -3, 5));
        Vec3 to = vec3(rng_unit(&rng), rng_unit(&rng), rng_range(&rng, 0, 2.5));
        rays[i] = (Ray){org, vec_scale(vec_sub(to, org), scale)};
        fprintf(out, "%.17g %.17g %.17g %.17g %.17g %.17g\n", org.x, org.y, org.z, rays[i].dir.x,
                rays[i].dir.y, rays[i].dir.z);
    }
    fclose(out);
    const char *log;
    assert_int_equal(
        run_command(&log,
                    "build/test/qibench trace '%s' --threads=1 >'%s.1' && "
                    "build/test/qibench trace --threads 3 --isa scalar '%s' >'%s.3' && "
                    "cmp '%s.1' '%s.3' && cat '%s.1'",
                    path_of("rays"), path_of("rays"), path_of("rays"), path_of("rays"),
                    path_of("rays"), path_of("rays"), path_of("rays")),
        0);
    static Answer answers[RAYS];
    assert_int_equal(read_answers(log, answers, RAYS), RAYS);
    int hits = 0;
    for (int i = 0; i < RAYS; i++) {
        const Answer *a = &answers[i];
        double nearest = INFINITY;
        bool doubtful = false;
        for (int k = 0; k < BOWLS; k++) {
            RayOracle o = {0};
            ray_oracle(&o, &defs[k], &rays[i], 0.0, INFINITY);
            doubtful |= o.doubtful;
            for (int r = 0; r < o.count; r++)
                nearest = fmin(nearest, o.root[r].t);
        }
        if (doubtful)
            continue;
        if (a->patch < 0) {
            assert_true(nearest == INFINITY);
            continue;
        }
        hits++;
        double length = vec_length(rays[i].dir);
        assert_true(fabs(a->t - nearest) * length < 1e-6);
        double off = ray_oracle_residual(&defs[a->patch], &rays[i], a->t, a->u, a->v);
        if (!(off <= a->bound && a->bound < 3e-9))
            fail_msg("ray %d: off by %g, bound %g", i, off, a->bound);
    }
    assert_true(hits > RAYS / 4);
}

// Rays that start on a bowl: never that place again, always what comes next, however near: the
// sheet 1e-8 above, or the other side of the same bowl.
static void rays_leave_their_surface(void **state) {
    (void)state;
    enum { RAYS = 200 };
    Vec3 points[16];
    bowl_points(0.0, 0.5, points);
    PatchDef bowl = {.degree_u = 3, .degree_v = 3, .points = points, .mask = 1};
    FILE *out = fopen(path_of("leave"), "w");
    fprintf(out, "patches 2\n");
    write_bowl(out, 0.0, 0.5);
    write_bowl(out, 1e-8, 0.5);
    fprintf(out, "rays %d\n", 4 * RAYS);
    Rng rng = {11};
    for (int i = 0; i < RAYS; i++) {
        Vec3 jet[3];
        double u = rng_range(&rng, 0.05, 0.95), v = rng_range(&rng, 0.05, 0.95);
        ray_oracle_jet(&bowl, u, v, jet);
        Vec3 n = vec_normalize(vec_cross(jet[1], jet[2]));
        Vec3 o = jet[0], side = vec_normalize(vec3(0.5 - o.x, 0.5 - o.y, 0.3));
        fprintf(out, "%.17g %.17g %.17g 0 0 1\n", o.x, o.y, o.z);            // the sheet above
        fprintf(out, "%.17g %.17g %.17g 0 0 -1\n", o.x, o.y, o.z);           // nothing below
        fprintf(out, "%.17g %.17g %.17g 0 0 -3\n", o.x, o.y, o.z + 1e-8);    // from above, back
        fprintf(out, "%.17g %.17g %.17g %.17g %.17g %.17g\n", o.x, o.y, o.z, // out of the bowl,
                1e3 * (side.x + n.x), 1e3 * (side.y + n.y), 1e3 * (side.z + n.z)); // long direction
    }
    fclose(out);
    const char *log;
    assert_int_equal(run_command(&log, "build/test/qibench trace '%s'", path_of("leave")), 0);
    static Answer answers[4 * RAYS];
    assert_int_equal(read_answers(log, answers, 4 * RAYS), 4 * RAYS);
    for (int i = 0; i < RAYS; i++) {
        const Answer *a = &answers[4 * i];
        if (a[0].patch != 1 || fabs(a[0].t - 1e-8) > 1e-14)
            fail_msg("ray %d up: patch %d at %g", i, a[0].patch, a[0].t);
        assert_int_equal(a[1].patch, -1);
        if (a[2].patch != 0 || fabs(a[2].t - 1e-8 / 3.0) > 1e-14)
            fail_msg("ray %d down: patch %d at %g", i, a[2].patch, a[2].t);
        assert_true(a[3].patch < 0 || a[3].t > 1e-13);
    }
}

// What cannot meet anything is a miss, not an error.
static void odd_rays_miss(void **state) {
    (void)state;
    FILE *out = fopen(path_of("odd"), "w");
    fprintf(out, "patches 1\n");
    write_bowl(out, 0.0, 0.5);
    fprintf(out, "rays 5\n0.5 0.5 2 0 0 0\n0.5 0.5 nan 0 0 -1\n0.5 0.5 2 0 0 -inf\n"
                 "0.5 0.5 2 0 -0 1\n0.5 0.5 2 -0 0 -1e-300\n");
    fclose(out);
    const char *log;
    assert_int_equal(run_command(&log, "build/test/qibench trace '%s'", path_of("odd")), 0);
    assert_true(strncmp(log, "miss\nmiss\nmiss\nmiss\n1.", 22) == 0);
}

// The tables have a row for each method and tolerance, with numbers in them.
static void speed_prints_tables(void **state) {
    (void)state;
    FILE *teapot = fopen(EXAMPLES "advanced/teapot/teapot.inc", "r");
    if (!teapot) {
        printf("skipped: no teapot.inc (package povray-examples)\n");
        skip();
    }
    fclose(teapot);
    const char *log;
    int status = run_command(&log, "build/qibench speed methods --rounds 1 --share 1e-3");
    assert_int_equal(status, 0);
    static const char *const rows[] = {"qi | 0.001", "qi | 1e-12", "clipping | 1e-06",
                                       "newton | 1e-09", "qi-paper | 0.001"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *at = strstr(log, rows[i]);
        if (!at || strtod(at + strlen(rows[i]) + 3, NULL) <= 0.0)
            fail_msg("no row '%s' with a number in\n%s", rows[i], log);
    }
    // How far it is shows on a terminal only.
    assert_null(strstr(log, "s left"));
    assert_int_equal(run_command(&log,
                                 "script -qec 'build/qibench speed methods --rounds 1 --share "
                                 "1e-3' /dev/null"),
                     0);
    assert_non_null(strstr(log, "s left"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_exact),        cmocka_unit_test(wrong_files_are_refused),
        cmocka_unit_test(wrong_usage_is_refused),   cmocka_unit_test(answers_as_the_oracle),
        cmocka_unit_test(rays_leave_their_surface), cmocka_unit_test(odd_rays_miss),
        cmocka_unit_test(speed_prints_tables),
    };
    return cmocka_run_group_tests_name("trace", tests, NULL, NULL);
}
