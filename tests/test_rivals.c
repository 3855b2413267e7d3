// SPDX-License-Identifier: MIT
// METHOD_CLIPPING, METHOD_NEWTON and METHOD_TESSELLATION: hits, bounds and completeness against the
// oracle, and what they do where there is no good answer.
#include "patch_oracle.h"
#include "ray_oracle.h"

#include "base/rng.h"
#include "patch/embree.h"
#include "patch/patch.h"
#include "patch/tessellation.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const PatchMethod rivals[] = {METHOD_CLIPPING, METHOD_NEWTON};
enum { RIVALS = 2 };

static PatchDef def_of(const Bezier *patch) {
    return (PatchDef){.degree_u = (uint32_t)patch->du,
                      .degree_v = (uint32_t)patch->dv,
                      .points = patch->p,
                      .id = 7,
                      .mask = 2};
}

static PatchSet *set_of(PatchMethod method, const Bezier *patches, int count, double tolerance) {
    PatchSetOptions options = {.method = method, .tolerance = tolerance};
    PatchSet *set = patchset_create(&options);
    for (int i = 0; i < count; i++) {
        PatchDef def = def_of(&patches[i]);
        patchset_add(set, &def);
    }
    patchset_commit(set);
    return set;
}

// A sheet over [0,1]^2 with noise.
static void sheet(Rng *rng, double wild, Bezier *out) {
    int du = 1 + (int)(rng_next(rng) % 5), dv = 1 + (int)(rng_next(rng) % 5);
    if (rng_next(rng) % 2)
        du = dv = 3;
    random_patch(rng, du, dv, wild, out);
}

static Ray ray_through(Rng *rng, const Bezier *patch) {
    Vec3 to = oracle_point(patch, rng_range(rng, -0.2, 1.2), rng_range(rng, -0.2, 1.2));
    Vec3 dir = vec_scale(random_direction(rng), ldexp(1.0, (int)(rng_next(rng) % 20) - 10));
    return (Ray){vec_madd(to, -rng_range(rng, 0.5, 5) / vec_length(dir), dir), dir};
}

typedef struct {
    int count;
    PatchHit hit[64];
} Hits;

static void collect(void *context, const PatchHit *hit) {
    Hits *hits = context;
    assert_true(hits->count < 64);
    hits->hit[hits->count++] = *hit;
}

static void check_hit(const PatchDef *def, const Ray *ray, const PatchHit *hit, double most) {
    assert_int_equal(hit->id, 7);
    assert_true(hit->u >= 0 && hit->u <= 1 && hit->v >= 0 && hit->v <= 1);
    double off = ray_oracle_residual(def, ray, hit->t, hit->u, hit->v);
    if (!(off <= hit->bound && hit->bound <= most))
        fail_msg("off by %g, bound %g, allowed %g", off, hit->bound, most);
    Vec3 jet[3];
    ray_oracle_jet(def, hit->u, hit->v, jet);
    Vec3 n = vec_normalize(vec_cross(vec_normalize(jet[1]), vec_normalize(jet[2])));
    assert_true(vec_length(vec_sub(n, hit->normal)) < 1e-6);
}

// Nearest, any and all hits of one ray on one patch, where the oracle has no doubt.
static bool as_the_oracle(const PatchSet *set, const Bezier *patch, const Ray *ray, double least,
                          double tolerance) {
    PatchDef def = def_of(patch);
    RayOracle oracle = {0};
    ray_oracle(&oracle, &def, ray, 0.0, INFINITY);
    if (oracle.doubtful)
        return false;
    double nearest = INFINITY, sine = 1.0;
    for (int k = 0; k < oracle.count; k++) {
        nearest = fmin(nearest, oracle.root[k].t);
        sine = fmin(sine, oracle.root[k].sine);
    }
    if (sine < least)
        return false;
    double length = vec_length(ray->dir), diameter = bezier_diameter(patch);
    PatchHit hit;
    bool found = patchset_intersect(set, ray, 0.0, INFINITY, 2, NULL, &hit);
    assert_int_equal(found, oracle.count > 0);
    assert_int_equal(patchset_occluded(set, ray, 0.0, INFINITY, 3, NULL), oracle.count > 0);
    assert_false(patchset_occluded(set, ray, 0.0, INFINITY, 5, NULL));
    if (!found)
        return false;
    check_hit(&def, ray, &hit, 1.01 * tolerance * diameter);
    double reach = 4.0 * tolerance * diameter / sine;
    if (fabs(hit.t - nearest) * length > reach)
        fail_msg("t %.17g, nearest %.17g, sine %g, %d roots", hit.t, nearest, sine, oracle.count);
    assert_false(patchset_intersect(set, ray, 0.0, nearest - reach / length, 2, NULL, &hit));

    Hits hits = {0};
    patchset_all(set, ray, 0.0, INFINITY, 2, NULL, collect, &hits);
    if (hits.count != oracle.count)
        fail_msg("%d hits instead of %d", hits.count, oracle.count);
    for (int k = 0; k < hits.count; k++)
        check_hit(&def, ray, &hits.hit[k], 1.01 * tolerance * diameter);
    return true;
}

// Gentle sheets for all, wild ones (several roots in one sub-patch) for clipping, which must find
// them too.
static void random_patches(void **state) {
    (void)state;
    static const double tolerances[] = {1e-4, 1e-9, 1e-12};
    for (int m = 0; m < RIVALS; m++) {
        for (int wild = 0; wild < (rivals[m] == METHOD_CLIPPING ? 2 : 1); wild++) {
            int hits = 0;
            for (int n = 0; n < 60; n++) {
                Rng rng = {(uint64_t)n + 1000 * (uint64_t)wild};
                Bezier patch;
                sheet(&rng, wild ? 0.4 : 0.04, &patch);
                double tolerance = tolerances[n % 3];
                PatchSet *set = set_of(rivals[m], &patch, 1, tolerance);
                for (int i = 0; i < 12; i++) {
                    Ray ray = ray_through(&rng, &patch);
                    // Newton finds one root a sub-patch; near a silhouette there may be two.
                    bool steep = tolerance > 1e-6 || rivals[m] == METHOD_NEWTON;
                    hits += as_the_oracle(set, &patch, &ray, steep ? 0.3 : 0.03, tolerance);
                }
                patchset_destroy(set);
            }
            if (hits < 100)
                fail_msg("%s: only %d hits", patch_method_name(rivals[m]), hits);
        }
    }
}

// The same patch at any size and place: the same answers.
static void scales(void **state) {
    (void)state;
    // 1e120: the normal was not a number, its length being a square of products.
    static const double scale[] = {1e-120, 1e-9, 1e-4, 1.0, 1e4, 1e9, 1e120}, place[] = {0, 1e3};
    for (int m = 0; m < RIVALS; m++) {
        for (int k = 0; k < 14; k++) {
            Bezier patch;
            teapot_body(&patch);
            double by = scale[k / 2], away = place[k % 2] * by;
            for (int i = 0; i < bezier_count(&patch); i++)
                patch.p[i] = vec_scale(vec_add(patch.p[i], vec3(away / by, 0, 0)), by);
            PatchSet *set = set_of(rivals[m], &patch, 1, 1e-9);
            int hits = 0;
            for (int n = 0; n < 40; n++) {
                Rng rng = {(uint64_t)n};
                double u = rng_range(&rng, 0.05, 0.95), v = rng_range(&rng, 0.05, 0.95);
                Ray ray = ray_to(&patch, u, v, random_direction(&rng), 10 * by);
                PatchHit hit;
                if (patchset_intersect(set, &ray, 0, INFINITY, 2, NULL, &hit)) {
                    hits++;
                    PatchDef def = def_of(&patch);
                    check_hit(&def, &ray, &hit, 1.01e-9 * bezier_diameter(&patch));
                }
            }
            if (hits != 40)
                fail_msg("%s at scale %g: %d of 40", patch_method_name(rivals[m]), by, hits);
            patchset_destroy(set);
        }
    }
}

// A pole, a point, a segment, a ray in a flat patch and on its edge: an answer, within the bound,
// after bounded work. A direction that is no number, an empty set: no hit.
static void nothing_hangs(void **state) {
    (void)state;
    for (int m = 0; m < RIVALS; m++) {
        Bezier patches[4];
        teapot_lid(&patches[0]);
        for (int k = 1; k < 4; k++) {
            patches[k].du = patches[k].dv = 3;
            for (int i = 0; i < 16; i++)
                patches[k].p[i] = vec3(k == 2 ? i : 0, 0, 0);
        }
        for (int i = 0; i < 16; i++)
            patches[3].p[i] = vec3(i / 4, i % 4, 0);
        Vec3 pole = patches[0].p[0];
        const Ray rays[] = {{vec_add(pole, vec3(0, 0, 5)), vec3(0, 0, -1)},
                            {vec3(0, 0, 5), vec3(0, 0, -1)},
                            {vec3(0.5, 0, 5), vec3(0, 0, -1)},
                            {vec3(-1, 1.5, 0), vec3(1, 0, 0)},
                            {vec3(-1, 0, 0), vec3(1, 0, 0)}};
        const int patch_of[] = {0, 1, 2, 3, 3};
        for (int k = 0; k < 5; k++) {
            PatchSet *set = set_of(rivals[m], &patches[patch_of[k]], 1, 1e-9);
            PatchHit hit;
            PatchStats stats = {0};
            if (patchset_intersect(set, &rays[k], 0, INFINITY, 2, &stats, &hit)) {
                assert_true(hit.bound < 1e-7);
                assert_true(fabs(vec_length(hit.normal) - 1.0) < 1e-9);
            }
            Hits hits = {0};
            patchset_all(set, &rays[k], 0, INFINITY, 2, NULL, collect, &hits);
            assert_true(stats.steps < 200000);
            patchset_destroy(set);
        }
        PatchSet *empty = set_of(rivals[m], NULL, 0, 1e-9);
        PatchHit hit;
        Ray odd = {vec3(0, 0, 1), vec3(0, 0, NAN)};
        assert_false(patchset_intersect(empty, &rays[0], 0, INFINITY, 2, NULL, &hit));
        assert_false(patchset_intersect(empty, &odd, 0, INFINITY, 2, NULL, &hit));
        patchset_destroy(empty);
    }
}

// Both quarters of the lid that share an edge: rays at that edge meet one of them.
static void shared_edges(void **state) {
    (void)state;
    for (int m = 0; m < RIVALS; m++) {
        Bezier patches[2];
        teapot_body(&patches[0]);
        // Turned by a quarter about z: x, y become -y, x; the edges coincide.
        for (int i = 0; i < 16; i++)
            patches[1].p[i] = vec3(-patches[0].p[i].y, patches[0].p[i].x, patches[0].p[i].z);
        patches[1].du = patches[1].dv = 3;
        PatchSet *set = set_of(rivals[m], patches, 2, 1e-9);
        int leaks = 0, sides = 0;
        for (int side = 0; side < 4; side++) {
            for (int n = 0; n < 300; n++) {
                Rng rng = {(uint64_t)n};
                double s = rng_unit(&rng);
                double u = side == 0 ? 0 : side == 1 ? 1 : s, v = side == 2 ? 0 : side == 3 ? 1 : s;
                Vec3 p = oracle_point(&patches[0], u, v);
                Vec3 q = oracle_point(&patches[1], side < 2 ? 1 - u : u, side < 2 ? v : 1 - v);
                if (vec_length(vec_sub(p, q)) > 1e-12)
                    continue;
                sides++;
                Vec3 from = vec3(p.x * 0.1, p.y * 0.1, p.z); // inside the pot
                Ray ray = {from, vec_sub(p, from)};
                leaks += !patchset_occluded(set, &ray, 0.0, INFINITY, 2, NULL);
            }
        }
        assert_true(sides > 200);
        assert_int_equal(leaks, 0);
        patchset_destroy(set);
    }
}

// Triangles: every hit within the tolerance of the patch, as the bound says; the nearest ones where
// the oracle has them; all of them; masks and ranges.
static void triangles(void **state) {
    (void)state;
    if (embree_missing()) {
        printf("skipped: %s\n", embree_missing());
        skip();
    }
    int hits = 0;
    for (int n = 0; n < 20; n++) {
        Rng rng = {(uint64_t)n};
        Bezier patch;
        sheet(&rng, 0.04, &patch);
        PatchSet *set = set_of(METHOD_TESSELLATION, &patch, 1, 1e-4);
        for (int i = 0; i < 12; i++) {
            Ray ray = ray_through(&rng, &patch);
            hits += as_the_oracle(set, &patch, &ray, 0.3, 1e-4);
        }
        patchset_destroy(set);
    }
    assert_true(hits > 60);
    PatchSet *empty = set_of(METHOD_TESSELLATION, NULL, 0, 1e-4);
    Ray ray = {vec3(0, 0, 0), vec3(0, 0, 1)};
    assert_false(patchset_occluded(empty, &ray, 0, INFINITY, 2, NULL));
    patchset_destroy(empty);
}

// Enough cuts bring the triangles to the distance asked, and not ten times nearer.
static void cuts_from_the_distance(void **state) {
    (void)state;
    for (int n = 0; n < 20; n++) {
        Rng rng = {(uint64_t)n};
        Bezier patch;
        sheet(&rng, 0.3, &patch);
        PatchDef def = def_of(&patch);
        uint32_t cuts = tessellation_cuts(&def, 1e-3);
        double most = 0.0;
        for (int i = 0; i < 2000; i++) {
            double a = rng_unit(&rng), b = rng_unit(&rng) * (1.0 - a);
            double u0 = floor(rng_unit(&rng) * cuts) / cuts,
                   v0 = floor(rng_unit(&rng) * cuts) / cuts;
            double h = 1.0 / cuts;
            Vec3 p = oracle_point(&patch, u0, v0), q = oracle_point(&patch, fmin(u0 + h, 1), v0),
                 r = oracle_point(&patch, u0, fmin(v0 + h, 1));
            Vec3 flat =
                vec_add(vec_add(vec_scale(p, 1.0 - a - b), vec_scale(q, a)), vec_scale(r, b));
            Vec3 s = oracle_point(&patch, fmin(u0 + a * h, 1), fmin(v0 + b * h, 1));
            most = fmax(most, vec_length(vec_sub(flat, s)));
        }
        assert_true(most <= 1e-3 && most >= 2e-5);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_patches), cmocka_unit_test(scales),
        cmocka_unit_test(nothing_hangs),  cmocka_unit_test(shared_edges),
        cmocka_unit_test(triangles),      cmocka_unit_test(cuts_from_the_distance),
    };
    return cmocka_run_group_tests_name("rivals", tests, NULL, NULL);
}
