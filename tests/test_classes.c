// SPDX-License-Identifier: MIT
// Patches of very different size in one set: what a ray asks of the small ones must not grow
// because a huge one lies beside them, nor may hits change.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "patch/classes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 4, SMALL = SIDE * SIDE * SIDE, RAYS = 1000 };

static Vec3 points[SMALL + 1][16];

static PatchDef def_of(int i) {
    return (PatchDef){
        .degree_u = 3, .degree_v = 3, .points = points[i], .id = (uint32_t)i, .mask = 1};
}

// Patches of size 1 in a lattice of steps of 2 about 0, and last one `huge` wide that goes through
// their middle, z being across it.
static void make_points(double huge) {
    Rng rng = {5};
    for (int i = 0; i <= SMALL; i++) {
        Vec3 at = vec3(2 * (i % SIDE) - SIDE, 2 * (i / SIDE % SIDE) - SIDE,
                       2 * (double)(i / SIDE / SIDE) - SIDE);
        for (int k = 0; k < 16; k++) {
            Vec3 p = vec3(k / 4 / 3.0, k % 4 / 3.0, rng_range(&rng, -0.4, 0.4));
            if (i < SMALL)
                points[i][k] = vec_add(p, at);
            else
                points[i][k] = vec3(huge * (p.x - 0.4), huge * (p.y - 0.3), 0.9);
        }
    }
}

static PatchSet *set_of(int count) {
    PatchSetOptions options = patchset_options_default();
    PatchSet *set = patchset_create(&options);
    for (int i = 0; i < count; i++) {
        PatchDef def = def_of(i);
        patchset_add(set, &def);
    }
    patchset_commit(set);
    return set;
}

static Vec3 anywhere(Rng *rng, double reach) {
    return vec3(rng_range(rng, -reach, reach), rng_range(rng, -reach, reach),
                rng_range(rng, -reach, reach));
}

static uint64_t work(const PatchStats *stats) {
    return stats->patch_tests + stats->steps + stats->newton;
}

// Beside a patch of 1e30 a ray asked each of the small ones for all its pieces: 5 ms where there
// were 2,160.
static void huge_ones_beside(void **state) {
    (void)state;
    static const double sizes[] = {1e7, 1e15, 1e30};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        make_points(sizes[s]);
        PatchSet *alone = set_of(SMALL), *beside = set_of(SMALL + 1);
        PatchStats few = {0}, more = {0};
        Rng rng = {6};
        int hits = 0, on_huge = 0;
        for (int i = 0; i < RAYS; i++) {
            Vec3 org = anywhere(&rng, 2 * SIDE);
            Ray ray = {org, vec_sub(points[i % SMALL][5], org)};
            PatchHit a, b;
            bool found = patchset_intersect(alone, &ray, 0, INFINITY, 1, &few, &a);
            bool found_b = patchset_intersect(beside, &ray, 0, INFINITY, 1, &more, &b);
            assert_true(found_b || !found);
            if (found_b && b.id == SMALL) {
                assert_true(!found || b.t <= a.t);
                on_huge++;
            } else if (found) {
                assert_int_equal(a.id, b.id);
                assert_true(a.t == b.t && a.u == b.u && a.v == b.v && a.bound == b.bound);
                hits++;
            }
        }
        printf("beside %g: %d hits, %d of the huge one, work a ray %.1f, without %.1f\n", sizes[s],
               hits, on_huge, (double)work(&more) / RAYS, (double)work(&few) / RAYS);
        assert_true(hits > RAYS / 5 && on_huge > RAYS / 20);
        // The huge one's own pieces, 16 at most in a leaf or two, and steps in it.
        assert_true((double)work(&more) < (double)work(&few) + 40.0 * RAYS);
        patchset_destroy(alone);
        patchset_destroy(beside);
    }
}

// Rays that leave the huge patch far away and pass by the small ones: to their tree they start too
// far away, and all their pieces were searched. Those that do meet one are still found.
static void from_far_away(void **state) {
    (void)state;
    make_points(1e30);
    PatchSet *set = set_of(SMALL + 1);
    PatchStats beside = {0}, stats = {0};
    Rng rng = {7};
    for (int i = 0; i < RAYS; i++) {
        // What double has no room for at the origin is the way that such rays pass by.
        Vec3 target = anywhere(&rng, SIDE), org = vec_scale(anywhere(&rng, 1), 1e29);
        Ray ray = {org, vec_sub(target, org)};
        patchset_occluded(set, &ray, 1e-9, 1.0, 1, &beside);
    }
    printf("by from 1e29: work a ray %.1f\n", (double)work(&beside) / RAYS);
    assert_true(work(&beside) < (uint64_t)40 * RAYS);
    int found = 0;
    for (int i = 0; i < 100; i++) {
        // Straight along z through a small patch, from 2^50 to 2^90 away.
        Ray ray = {{2 * (i % SIDE) - SIDE + 0.5, 2 * (i / SIDE % SIDE) - SIDE + 0.5,
                    -ldexp(1.0, 50 + 10 * (i % 5))},
                   {0, 0, 1}};
        PatchHit hit;
        found += patchset_intersect(set, &ray, 0, INFINITY, 1, &stats, &hit);
    }
    assert_int_equal(found, 100);
    patchset_destroy(set);
}

// The point beside the patches against the line in the digits of __float128.
static void lines_are_kept(void **state) {
    (void)state;
    make_points(1e12);
    PatchDef defs[SMALL + 1];
    for (int i = 0; i <= SMALL; i++)
        defs[i] = def_of(i);
    Arena *arena = arena_create();
    const Accel *large = classes_build(arena, defs, SMALL + 1, PREPARE_LIGHT);
    assert_non_null(large->next);
    assert_null(large->next->next);
    const Accel *small = large->next;
    assert_int_equal(small->patch_count, SMALL);
    assert_false(classes_build(arena, defs, SMALL, PREPARE_LIGHT)->is_class);
    Rng rng = {8};
    int known = 0, near_by = 0;
    for (int i = 0; i < 20000; i++) {
        // From 2^20 to 2^79 away; every other one begins where nothing is rounded.
        double far = ldexp(1.0, 20 + i % 60);
        Vec3 p = anywhere(&rng, 2 * SIDE), d = anywhere(&rng, 1);
        if (i % 2)
            p = vec3(0, 0, 0);
        Ray ray = {vec_madd(p, -far, d), d}, near;
        if (!classes_near(small, &ray, &near))
            continue;
        known++;
        __float128 w[3] = {(__float128)near.org.x - ray.org.x, (__float128)near.org.y - ray.org.y,
                           (__float128)near.org.z - ray.org.z};
        __float128 n[3] = {w[1] * d.z - w[2] * d.y, w[2] * d.x - w[0] * d.z,
                           w[0] * d.y - w[1] * d.x};
        double off = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])) / vec_length(d);
        // 2^-112 of products of 2^80 a time.
        assert_true(off * small->tree.scale <= 0.25 * (double)TREE_PAD);
        near_by += vec_length(near.org) < 40.0;
    }
    printf("%d rays known, %d begin beside the patches\n", known, near_by);
    assert_true(known == 20000 && near_by > 12000);
    // Not where numbers end.
    Ray odd = {{1e308, 1e308, 0}, {1e300, -1e300, 1}}, near;
    assert_false(classes_near(small, &odd, &near));
    arena_destroy(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(huge_ones_beside),
        cmocka_unit_test(from_far_away),
        cmocka_unit_test(lines_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
