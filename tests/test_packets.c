// SPDX-License-Identifier: MIT
// Rays asked many at a time get the bits that they get one by one: packets that go one way and
// others that do not, with all kinds of ranges and masks, rays that are not finite or come from far
// away, on every instruction set that this machine has.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "patch_oracle.h"

#include "base/rng.h"
#include "patch/patch.h"

#include <stdio.h>
#include <string.h>

enum { PATCHES = 9, MOST = 61 }; // not a whole number of packets

static const char *const names[] = {"scalar", "avx2", "avx512"};

static void fill(Bezier *patches) {
    Rng rng = {5};
    teapot_lid(&patches[0]);
    teapot_bottom(&patches[1]);
    teapot_body(&patches[2]);
    for (int i = 3; i < PATCHES; i++)
        random_patch(&rng, i == 3 ? 2 : 3, i == 4 ? 5 : 3, 0.3, &patches[i]);
}

static PatchSet *make_set(const Bezier *patches, int count, PatchSetOptions options, double scale,
                          const double *weights) {
    PatchSet *set = patchset_create(&options);
    for (int i = 0; i < count; i++) {
        Vec3 points[BEZIER_MAX_POINTS];
        for (int k = 0; k < bezier_count(&patches[i]); k++)
            points[k] = vec_scale(patches[i].p[k], scale);
        PatchDef def = {.degree_u = (uint32_t)patches[i].du,
                        .degree_v = (uint32_t)patches[i].dv,
                        .points = points,
                        .weights = i == 2 ? weights : NULL,
                        .id = 100 + (uint32_t)i,
                        .mask = 1u << (i % 3),
                        .u_steps = 3,
                        .v_steps = 3};
        patchset_add(set, &def);
    }
    patchset_commit(set);
    return set;
}

typedef struct {
    Ray rays[MOST];
    PatchRange ranges[MOST];
    size_t count;
    bool ranged;
} Case;

// A bundle about one ray: spread 0 for all alike, 1 for all directions.
static void aim(const Bezier *patches, int count, Rng *rng, double spread, double scale, Case *c) {
    const Bezier *patch = &patches[rng_next(rng) % (uint64_t)count];
    double u = rng_unit(rng), v = rng_unit(rng);
    if (rng_next(rng) % 4 == 0)
        u = (double)(rng_next(rng) % 3) / 2.0; // borders
    Vec3 dir = random_direction(rng);
    if (rng_next(rng) % 3 == 0) { // along a tangent, or nearly
        Vec3 su, sv;
        oracle_tangents(patch, u, v, &su, &sv);
        dir = vec_add(su, vec_scale(sv, rng_range(rng, -1, 1)));
    }
    if (!(vec_length(dir) > 0.0))
        dir = vec3(0, 0, 1);
    Ray ray = ray_to(patch, u, v, dir, rng_next(rng) % 5 == 0 ? 0.0 : 4.0);
    for (size_t i = 0; i < c->count; i++) {
        Vec3 turn = vec_scale(random_direction(rng), spread * vec_length(ray.dir));
        Vec3 move = vec_scale(random_direction(rng), spread);
        Ray *out = &c->rays[i];
        *out = (Ray){vec_scale(vec_add(ray.org, move), scale), vec_add(ray.dir, turn)};
        if (rng_next(rng) % 16 == 0)
            out->dir.x = rng_next(rng) % 2 ? 0.0 : -0.0;
    }
}

static void spoil(Rng *rng, Case *c) {
    static const double odd[] = {NAN, INFINITY, 0.0, 1e200, 1e-200, 1e-310, 1e12, 1e300};
    for (size_t i = 0; i < c->count; i++) {
        if (rng_next(rng) % 8)
            continue;
        double x = odd[rng_next(rng) % 8];
        Vec3 *to = rng_next(rng) % 2 ? &c->rays[i].org : &c->rays[i].dir;
        if (x == 0.0)
            c->rays[i].dir = vec3(0, 0, 0);
        else if (x < 1.0 || rng_next(rng) % 2)
            *to = vec_scale(*to, x);
        else
            to->y = x;
    }
}

// Ranges that begin or end at the nearest hit, or near it.
static void limit(const PatchSet *set, Rng *rng, Case *c) {
    for (size_t i = 0; i < c->count; i++) {
        PatchRange *r = &c->ranges[i];
        *r = (PatchRange){0.0, INFINITY, (uint32_t)(rng_next(rng) % 8)};
        PatchHit hit;
        if (!patchset_intersect(set, &c->rays[i], 0.0, INFINITY, 7, NULL, &hit))
            continue;
        switch (rng_next(rng) % 6) {
        case 0:
            r->t_min = hit.t;
            break;
        case 1:
            r->t_max = hit.t;
            break;
        case 2:
            r->t_min = nextafter(hit.t, INFINITY);
            break;
        case 3:
            r->t_max = nextafter(hit.t, INFINITY);
            break;
        case 4:
            r->t_min = -10.0;
            break;
        default:
            r->t_max = hit.t * rng_range(rng, 0.5, 2.0);
            break;
        }
    }
}

static long compare(const PatchSet *set, const Case *c, const char *what) {
    bool found[MOST], any[MOST];
    PatchHit hits[MOST];
    PatchStats stats = {0}, alone = {0};
    const PatchRange *ranges = c->ranged ? c->ranges : NULL;
    long count = 0;
    patchset_intersect_many(set, c->rays, ranges, c->count, &stats, found, hits);
    patchset_occluded_many(set, c->rays, ranges, c->count, NULL, any);
    for (size_t i = 0; i < c->count; i++) {
        PatchRange r = ranges ? ranges[i] : (PatchRange){0.0, INFINITY, UINT32_MAX};
        PatchHit hit;
        bool one = patchset_intersect(set, &c->rays[i], r.t_min, r.t_max, r.mask, &alone, &hit);
        bool one_any = patchset_occluded(set, &c->rays[i], r.t_min, r.t_max, r.mask, NULL);
        if (one != found[i] || one_any != any[i] ||
            (one && memcmp(&hit, &hits[i], offsetof(PatchHit, id) + sizeof hit.id) != 0))
            fail_msg("%s, ray %zu of %zu: alone %d %d t %.17g, in a packet %d %d t %.17g", what, i,
                     c->count, one, one_any, one ? hit.t : 0.0, found[i], any[i],
                     found[i] ? hits[i].t : 0.0);
        count += one;
    }
    assert_true(stats.hits == alone.hits);
    return count;
}

// Many bundles of all kinds at one set.
static long sweep(const PatchSet *set, const Bezier *patches, int count, double scale, int rounds,
                  const char *what) {
    static const double spreads[] = {0.0, 1e-9, 1e-4, 1e-3, 1e-2, 0.1, 1.0};
    Rng rng = {31};
    long hits = 0;
    for (int i = 0; i < rounds; i++) {
        Case c = {.count = i % 3 == 0 ? 1 + rng_next(&rng) % MOST : 16, .ranged = i % 4 == 1};
        aim(patches, count, &rng, spreads[i % 7], scale, &c);
        if (i % 5 == 4)
            spoil(&rng, &c);
        if (c.ranged)
            limit(set, &rng, &c);
        hits += compare(set, &c, what);
    }
    return hits;
}

static void on_every_isa(const PatchSet *set, const Bezier *patches, int count, double scale,
                         int rounds) {
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        if (patch_isa_choose(names[k]) == PATCH_ISA_CHOSEN)
            assert_true(sweep(set, patches, count, scale, rounds, names[k]) > 4 * rounds);
    }
    patch_isa_choose(NULL);
}

static void same_bits(void **state) {
    (void)state;
    static Bezier patches[PATCHES];
    fill(patches);
    PatchSet *set = make_set(patches, PATCHES, patchset_options_default(), 1.0, NULL);
    on_every_isa(set, patches, PATCHES, 1.0, 250);
    patchset_destroy(set);
}

// Where hits may be far from the surface, and patches lie across each other, many count as hit at
// nearly the same depth.
static void same_bits_at_loose_tolerance(void **state) {
    (void)state;
    enum { CLOUD = 64 };
    static Bezier patches[CLOUD];
    Rng rng = {8};
    for (int i = 0; i < CLOUD; i++) {
        random_patch(&rng, 3, 3, 0.1, &patches[i]);
        Vec3 place = vec_scale(random_direction(&rng), 0.4);
        for (int k = 0; k < bezier_count(&patches[i]); k++)
            patches[i].p[k] = vec_madd(place, 0.5, patches[i].p[k]);
    }
    PatchSetOptions options = patchset_options_default();
    options.tolerance = 0.2;
    options.prepare = PREPARE_NONE;
    PatchSet *set = make_set(patches, CLOUD, options, 1.0, NULL);
    on_every_isa(set, patches, CLOUD, 1.0, 250);
    patchset_destroy(set);
}

// A tree that is one leaf, one of whole patches, no tree, and sets that packets are not made for.
static void other_sets(void **state) {
    (void)state;
    static Bezier patches[PATCHES];
    fill(patches);
    PatchSetOptions options = patchset_options_default();
    options.prepare = PREPARE_NONE;
    PatchSet *set = make_set(patches, 4, options, 1.0, NULL);
    on_every_isa(set, patches, 4, 1.0, 20);
    patchset_destroy(set);
    set = make_set(patches, PATCHES, options, 1.0, NULL);
    on_every_isa(set, patches, PATCHES, 1.0, 20);
    patchset_destroy(set);

    options.prepare = PREPARE_LIGHT;
    static double weights[BEZIER_MAX_POINTS];
    for (int i = 0; i < BEZIER_MAX_POINTS; i++)
        weights[i] = 1.0 + i % 3;
    set = make_set(patches, PATCHES, options, 1.0, weights);
    assert_true(sweep(set, patches, PATCHES, 1.0, 20, "rational") > 0);
    patchset_destroy(set);
    set = make_set(patches, PATCHES, options, 0x1p-600, NULL);
    assert_true(sweep(set, patches, PATCHES, 0x1p-600, 20, "tiny") > 0);
    patchset_destroy(set);
    set = make_set(patches, 0, options, 1.0, NULL);
    assert_int_equal(sweep(set, patches, PATCHES, 1.0, 20, "empty"), 0);
    patchset_destroy(set);
    options.method = METHOD_FACETS;
    set = make_set(patches, PATCHES, options, 1.0, NULL);
    assert_true(sweep(set, patches, PATCHES, 1.0, 20, "facets") > 0);
    patchset_destroy(set);
}

// A ray that passes a border by far less than the tolerance, and by far more than rounding, passes
// it; just inside of it, it hits. Before, patches were wider than they are by their tolerance, so
// that a picture at 1e-9 of the diameter showed three pixels of a far scene's outlines otherwise
// than one at 1e-14.
static void borders_are_as_wide_as_they_are(void **state) {
    (void)state;
    Bezier bowl;
    Vec3 points[16];
    for (int i = 0; i < 16; i++)
        points[i] = vec3((i >> 2) / 3.0, (i & 3) / 3.0, i == 5 || i == 10 ? -0.4 : 0.1 * (i & 3));
    bezier_init(&bowl, 3, 3, points);
    for (int k = 0; k < 9; k++) {
        if (patch_isa_choose(names[k / 3]) != PATCH_ISA_CHOSEN)
            continue;
        PatchSetOptions options = patchset_options_default();
        options.tolerance = 1e-3;
        options.prepare = (PatchPrepare)(k % 3);
        PatchSet *set = make_set(&bowl, 1, options, 1.0, NULL);
        for (double beside = 1e-4; beside > 3e-13; beside *= 0.1) {
            Case c = {.count = 48};
            for (size_t i = 0; i < c.count; i++) {
                // Past each of the four sides, and the other way.
                double at = 0.01 + 0.02 * (double)i, off = i & 8 ? -beside : beside;
                double x = i & 1 ? at : i & 2 ? 1.0 + off : -off;
                double y = i & 1 ? (i & 2 ? 1.0 + off : -off) : at;
                c.rays[i] = (Ray){vec3(x, y, i & 4 ? -5.0 : 5.0), vec3(0, 0, i & 4 ? 2 : -2)};
            }
            assert_int_equal(compare(set, &c, names[k / 3]), c.count / 2);
            for (size_t i = 0; i < c.count; i++) {
                PatchHit hit;
                bool met =
                    patchset_intersect(set, &c.rays[i], 0.0, INFINITY, UINT32_MAX, NULL, &hit);
                assert_int_equal(met, i & 8 ? 1 : 0);
            }
        }
        patchset_destroy(set);
    }
    patch_isa_choose(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits),
        cmocka_unit_test(same_bits_at_loose_tolerance),
        cmocka_unit_test(other_sets),
        cmocka_unit_test(borders_are_as_wide_as_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
