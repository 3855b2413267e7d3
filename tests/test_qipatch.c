// SPDX-License-Identifier: MIT
// libqipatch: its answers, what it refuses, and README's example, compiled and run as it stands.
#include "pictures.h"

#include "patch/qipatch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// A sheet z = height over [0,1]^2, linear in both directions.
static const double (*sheet(double height))[3] {
    static double points[4][3];
    for (int i = 0; i < 4; i++) {
        points[i][0] = i / 2;
        points[i][1] = i % 2;
        points[i][2] = height;
    }
    return (const double(*)[3])points;
}

static QipatchRay down(double x, double y) {
    return (QipatchRay){.org = {x, y, 5}, .dir = {0, 0, -2}, .tfar = INFINITY, .mask = UINT32_MAX};
}

static void answers(void **state) {
    (void)state;
    QipatchScene *scene = qipatch_new_scene(0);
    assert_non_null(scene);
    for (int i = 0; i < 3; i++) {
        QipatchPatch patch = {1, 1, sheet(i), NULL, i == 2 ? 4u : 0u};
        uint32_t id = 99;
        assert_int_equal(qipatch_attach_patch(scene, &patch, &id), QIPATCH_OK);
        assert_int_equal(id, i);
    }
    double low[3], high[3];
    assert_true(qipatch_scene_bounds(scene, low, high));
    assert_true(low[2] == 0 && high[0] == 1 && high[2] == 2);

    QipatchRay ray = down(0.25, 0.75);
    QipatchHit hit;
    assert_false(qipatch_intersect1(scene, &ray, &hit)); // not committed yet
    assert_int_equal(qipatch_commit_scene(scene), QIPATCH_OK);
    assert_true(qipatch_scene_memory(scene) > 100);
    assert_true(qipatch_intersect1(scene, &ray, &hit));
    assert_int_equal(hit.patchID, 2);
    assert_true(fabs(hit.t - 1.5) < 1e-9 && fabs(hit.u - 0.25) < 1e-9 && fabs(hit.v - 0.75) < 1e-9);
    assert_true(fabs(fabs(hit.Ng[2]) - 1) < 1e-12 && hit.bound < 2e-9);

    ray.mask = 3; // not the third
    assert_true(qipatch_intersect1(scene, &ray, &hit) && hit.patchID == 1);
    ray.tnear = 2.25;
    assert_true(qipatch_intersect1(scene, &ray, &hit) && hit.patchID == 0);
    assert_true(qipatch_occluded1(scene, &ray));
    ray.tfar = 2.25;
    assert_false(qipatch_occluded1(scene, &ray));
    ray = down(1.5, 0.5);
    assert_false(qipatch_intersect1(scene, &ray, &hit));
    assert_int_equal(hit.patchID, QIPATCH_INVALID_ID);

    ray = down(0.5, 0.5); // from the second sheet on
    ray.org[2] = 1;
    assert_true(qipatch_intersect1(scene, &ray, &hit) && hit.patchID == 1);
    ray.flags = QIPATCH_RAY_LEAVES;
    assert_true(qipatch_intersect1(scene, &ray, &hit) && hit.patchID == 0);
    assert_true(qipatch_occluded1(scene, &ray));
    ray.dir[2] = NAN;
    assert_false(qipatch_intersect1(scene, &ray, &hit));
    qipatch_release_scene(scene);
    qipatch_release_scene(NULL);
}

// One by one and all at once: the same bits, whoever is left out.
static void many_at_once(void **state) {
    (void)state;
    enum { N = 37 };
    QipatchScene *scene = qipatch_new_scene(0);
    QipatchRay rays[N];
    QipatchHit hits[N];
    bool occluded[N];
    int valid[N], found = 0;
    for (int i = 0; i < N; i++) {
        rays[i] = down(0.04 * i - 0.1, 0.5);
        rays[i].dir[0] = i % 5 == 0 ? 0.3 : -0.01;
        rays[i].tnear = i % 7 == 0 ? 2.2 : 0;
        rays[i].mask = i % 6 == 0 ? 3 : UINT32_MAX;
        if (i % 4 == 1) { // leaves the second sheet
            rays[i].org[2] = 1;
            rays[i].tnear = 0;
            rays[i].flags = QIPATCH_RAY_LEAVES;
        }
        valid[i] = i % 9 != 8 ? -1 : 0;
    }
    rays[8].org[0] = NAN; // and is left out
    rays[10].dir[1] = INFINITY;
    qipatch_intersectN(valid, scene, rays, N, hits);
    qipatch_occludedN(valid, scene, rays, N, occluded);
    for (int i = 0; i < N; i++) // before the commit
        assert_true(hits[i].patchID == QIPATCH_INVALID_ID && !occluded[i]);
    for (int i = 0; i < 3; i++) {
        QipatchPatch patch = {1, 1, sheet(i), NULL, i == 2 ? 4u : 0u};
        assert_int_equal(qipatch_attach_patch(scene, &patch, NULL), QIPATCH_OK);
    }
    assert_int_equal(qipatch_commit_scene(scene), QIPATCH_OK);
    for (int all = 0; all < 2; all++) {
        qipatch_intersectN(all ? NULL : valid, scene, rays, N, hits);
        qipatch_occludedN(all ? NULL : valid, scene, rays, N, occluded);
        for (int i = 0; i < N; i++) {
            QipatchHit one = {.patchID = QIPATCH_INVALID_ID};
            bool any = (all || valid[i]) && qipatch_intersect1(scene, &rays[i], &one);
            assert_int_equal(one.patchID, hits[i].patchID);
            assert_int_equal(any, occluded[i]);
            assert_true(!any || memcmp(&one, &hits[i], offsetof(QipatchHit, patchID)) == 0);
            found += any;
        }
    }
    assert_true(found > N);
    qipatch_release_scene(scene);
}

static void errors_are_returned(void **state) {
    (void)state;
    assert_null(qipatch_new_scene(2));
    assert_null(qipatch_new_scene(NAN));
    QipatchScene *scene = qipatch_new_scene(1e-6);
    assert_string_equal(qipatch_error_text(scene), "");
    double points[4][3] = {{0, 0, 0}, {0, 1, 0}, {1, INFINITY, 0}, {1, 1, 0}};
    double weights[4] = {1, 1, 1, 0}, apart[4] = {1, 1, 1, 1.1e12};
    const struct {
        QipatchPatch patch;
        const char *text;
    } cases[] = {
        {{1, 1, NULL, NULL, 0}, "no points"},
        {{0, 1, sheet(0), NULL, 0}, "degrees"},
        {{1, 17, sheet(0), NULL, 0}, "degrees"},
        {{1, 1, (const double(*)[3])points, NULL, 0}, "point 2 is not finite"},
        {{1, 1, sheet(0), weights, 0}, "weight 3 is not a finite number above 0"},
        {{1, 1, sheet(0), apart, 0}, "the weights differ by more than 1e+12"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(qipatch_attach_patch(scene, &cases[i].patch, NULL),
                         QIPATCH_INVALID_ARGUMENT);
        assert_non_null(strstr(qipatch_error_text(scene), cases[i].text));
    }
    assert_int_equal(qipatch_attach_patch(scene, NULL, NULL), QIPATCH_INVALID_ARGUMENT);
    assert_int_equal(qipatch_attach_patch(NULL, NULL, NULL), QIPATCH_INVALID_ARGUMENT);
    assert_int_equal(qipatch_commit_scene(scene), QIPATCH_OK); // empty
    assert_int_equal(qipatch_commit_scene(scene), QIPATCH_INVALID_OPERATION);
    QipatchPatch good = {1, 1, sheet(0), NULL, 0};
    assert_int_equal(qipatch_attach_patch(scene, &good, NULL), QIPATCH_INVALID_OPERATION);
    QipatchRay ray = down(0.5, 0.5);
    assert_false(qipatch_occluded1(scene, &ray));
    qipatch_release_scene(scene);
}

// The C text between the first ```c and ``` after the mark that holds the command.
static void readme_example_runs(void **state) {
    (void)state;
    static const char mark[] = "<!-- example: ";
    char line[1024], command[1024] = "", source[4200], program[4200];
    snprintf(source, sizeof source, "%s/example.c", scratch_folder());
    snprintf(program, sizeof program, "%s/example", scratch_folder());
    FILE *in = fopen("README.md", "r"), *out = fopen(source, "w");
    assert_non_null(in);
    assert_non_null(out);
    int lines = 0;
    bool inside = false;
    while (fgets(line, sizeof line, in)) {
        if (strncmp(line, mark, sizeof mark - 1) == 0)
            snprintf(command, sizeof command, "%.*s", (int)(strstr(line, " -->") - line) - 14,
                     line + sizeof mark - 1);
        if (inside && strncmp(line, "```", 3) == 0)
            break;
        if (inside) {
            fputs(line, out);
            lines++;
        }
        inside |= command[0] && strncmp(line, "```c", 4) == 0;
    }
    fclose(in);
    fclose(out);
    assert_true(lines >= 30 && lines <= 50);
    char *name = strstr(command, "example.c");
    assert_non_null(name);
    const char *log;
    int status = run_command(&log, "%.*s -Wall -Wextra -Werror -o '%s' '%s'%s && '%s'",
                             (int)(name - command), command, program, source, name + 9, program);
    if (status != 0)
        fail_msg("README's example: status %d\n%s", status, log);
    // Twelve lines; blank beside the bowl; flat and so bright in its middle, steep at its rim.
    assert_true(strlen(log) == 12 * 25 && log[0] == ' ' && log[6 * 25 + 12] == '@');
    assert_true(log[6 * 25 + 3] != '@' && log[6 * 25 + 3] != ' ');
}

// Nothing else of ours can clash with a program's own names (the locks of named critical sections
// are gcc's, and meant to be shared).
static void only_public_names(void **state) {
    (void)state;
    const char *log;
    int status = run_command(&log, "nm -g --defined-only build/libqipatch.a | grep ' [A-Z] ' | "
                                   "grep -v -e ' qipatch_' -e ' [.]gomp_' ; nm -g --defined-only "
                                   "build/libqipatch.a | grep -c ' T qipatch_'");
    assert_int_equal(status, 0);
    assert_string_equal(log, "11\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers),
        cmocka_unit_test(many_at_once),
        cmocka_unit_test(errors_are_returned),
        cmocka_unit_test(readme_example_runs),
        cmocka_unit_test(only_public_names),
    };
    return cmocka_run_group_tests_name("qipatch", tests, NULL, NULL);
}
