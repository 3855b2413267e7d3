// SPDX-License-Identifier: MIT
// Every instruction set that this machine has gives the same bits: hits of scattered and grazing
// rays, of rays at shared edges and poles, nearest, any and all, on the same patches.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "patch_oracle.h"

#include "base/rng.h"
#include "patch/patch.h"

#include <stdio.h>
#include <string.h>

enum { PATCHES = 8, RAYS = 1500, HITS = 16 };

typedef struct {
    bool found, any;
    PatchHit nearest, all[HITS];
    int count;
} Answer;

static void keep_hit(void *context, const PatchHit *hit) {
    Answer *a = context;
    if (a->count < HITS)
        a->all[a->count++] = *hit;
}

static const char *const names[] = {"scalar", "avx2", "avx512"};

static Ray ray_of(const Bezier *patches, Rng *rng, int i) {
    const Bezier *patch = &patches[rng_next(rng) % PATCHES];
    double u = rng_unit(rng), v = rng_unit(rng);
    if (i % 5 == 0)
        u = (double)(rng_next(rng) % 5) / 4.0; // borders of patches and of pieces
    Vec3 dir = random_direction(rng);
    if (i % 7 == 0) { // along a tangent, or nearly
        Vec3 su, sv;
        oracle_tangents(patch, u, v, &su, &sv);
        dir = vec_add(vec_add(su, vec_scale(sv, rng_range(rng, -1, 1))), vec_scale(dir, 1e-6));
    }
    if (!(vec_length(dir) > 0.0))
        dir = vec3(0, 0, 1);
    double away = i % 11 == 0 ? 1e9 : i % 3 == 0 ? 0.0 : 5.0;
    return ray_to(patch, u, v, dir, away);
}

static void fill(Bezier *patches, double wild) {
    Rng rng = {3};
    teapot_lid(&patches[0]);
    teapot_bottom(&patches[1]);
    teapot_body(&patches[2]);
    for (int i = 3; i < PATCHES; i++)
        random_patch(&rng, i == 3 ? 2 : 3, i == 4 ? 5 : 3, wild, &patches[i]);
}

static PatchSet *make_set(const Bezier *patches, PatchPrepare prepare) {
    PatchSetOptions options = patchset_options_default();
    options.prepare = prepare;
    PatchSet *set = patchset_create(&options);
    for (int i = 0; i < PATCHES; i++) {
        PatchDef def = {.degree_u = (uint32_t)patches[i].du,
                        .degree_v = (uint32_t)patches[i].dv,
                        .points = patches[i].p,
                        .id = (uint32_t)i,
                        .mask = 1,
                        .u_steps = 4,
                        .v_steps = 4};
        patchset_add(set, &def);
    }
    patchset_commit(set);
    return set;
}

// However few pieces are prepared, the hits are the same within their bounds.
static void prepared_less(void **state) {
    (void)state;
    static Bezier patches[PATCHES];
    fill(patches, 0.2);
    PatchSet *sets[PREPARE_COUNT];
    for (int k = 0; k < PREPARE_COUNT; k++) {
        sets[k] = make_set(patches, (PatchPrepare)k);
        if (k > 0)
            assert_true(patchset_memory(sets[k]) < patchset_memory(sets[k - 1]));
        PatchPrepare parsed;
        assert_true(patch_prepare_parse(patch_prepare_name((PatchPrepare)k), &parsed));
        assert_int_equal(parsed, k);
    }
    Rng rng = {78};
    int hits = 0, apart = 0;
    for (int i = 0; i < 500; i++) {
        const Bezier *patch = &patches[i % PATCHES];
        Ray ray = ray_to(patch, rng_unit(&rng), rng_unit(&rng), random_direction(&rng), 3.0);
        PatchHit hit[PREPARE_COUNT];
        for (int k = 0; k < PREPARE_COUNT; k++) {
            assert_true(patchset_intersect(sets[k], &ray, 0.0, INFINITY, 1, NULL, &hit[k]));
            hits++;
            // At a grazing ray depths differ by more than bounds do across the ray.
            if (k > 0 && fabs(hit[k].t - hit[0].t) > 1e-7)
                apart++;
        }
    }
    assert_int_equal(hits, 500 * PREPARE_COUNT);
    assert_true(apart <= 2);
    for (int k = 0; k < PREPARE_COUNT; k++)
        patchset_destroy(sets[k]);
}

static void same_bits(void **state) {
    (void)state;
    static Bezier patches[PATCHES];
    static Answer answers[RAYS];
    fill(patches, 0.3);
    PatchSet *set = make_set(patches, PREPARE_FULL);
    int compared = 0, hits = 0;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        PatchIsa done = patch_isa_choose(names[k]);
        assert_int_not_equal(done, PATCH_ISA_UNKNOWN);
        if (done == PATCH_ISA_UNUSABLE) {
            printf("%s: not on this machine\n", names[k]);
            continue;
        }
        assert_string_equal(patch_isa_name(), names[k]);
        Rng rng = {77};
        for (int i = 0; i < RAYS; i++) {
            Ray ray = ray_of(patches, &rng, i);
            Answer now;
            memset(&now, 0, sizeof now);
            now.found = patchset_intersect(set, &ray, 0.0, INFINITY, 1, NULL, &now.nearest);
            now.any = patchset_occluded(set, &ray, 0.0, INFINITY, 1, NULL);
            patchset_all(set, &ray, 0.0, INFINITY, 1, NULL, keep_hit, &now);
            assert_int_equal(now.found, now.any);
            hits += now.found;
            if (k == 0)
                answers[i] = now;
            else if (memcmp(&answers[i], &now, sizeof now) != 0)
                fail_msg("ray %d differs between %s and scalar: t %.17g and %.17g", i, names[k],
                         now.nearest.t, answers[i].nearest.t);
            compared += k > 0;
        }
    }
    assert_true(hits > RAYS / 2);
    printf("%d rays compared, %d hits\n", compared, hits);
    patchset_destroy(set);
    assert_int_equal(patch_isa_choose(NULL), PATCH_ISA_CHOSEN);
}

static void names_are_checked(void **state) {
    (void)state;
    assert_int_equal(patch_isa_choose("sse9"), PATCH_ISA_UNKNOWN);
    assert_int_equal(patch_isa_choose(""), PATCH_ISA_UNKNOWN);
    assert_int_equal(patch_isa_choose("scalar"), PATCH_ISA_CHOSEN);
    assert_int_equal(patch_isa_choose(NULL), PATCH_ISA_CHOSEN);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits),
        cmocka_unit_test(prepared_less),
        cmocka_unit_test(names_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
