// SPDX-License-Identifier: MIT
// Solids where their equations lose digits: thin and fat tori from outside and inside, rays that
// touch a sphere, tips of cones, boxes without thickness, triangles without area, lathes with
// vertical and level pieces. Points are chosen on the surface, so that each ray's hit is known;
// every hit of every ray must be on the surface, with a finite unit normal, and from outside a
// closed surface is crossed an even number of times.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "shape_fixture.h"

static Vec3 random_unit(Rng *rng) {
    for (;;) {
        Vec3 v = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        double l = vec_length(v);
        if (l > 0.1 && l < 1)
            return vec_scale(v, 1 / l);
    }
}

enum { MOST = 16 };

typedef struct {
    const Shape *shape;
    Ray ray;
    double t[MOST];
    int count;
} Hits;

static double keep_hit(void *context, const ShapeHit *hit) {
    Hits *hits = context;
    assert_true(isfinite(hit->t) && hits->count < MOST);
    Vec3 n = shape_normal(hits->shape, vec_madd(hits->ray.org, hit->t, hits->ray.dir), hit);
    assert_true(vec_is_finite(n) && fabs(vec_length(n) - 1) < 1e-9);
    hits->t[hits->count++] = hit->t;
    return INFINITY;
}

static Hits hits_of(const Shape *shape, Vec3 org, Vec3 dir) {
    Hits hits = {.shape = shape, .ray = {org, dir}};
    shape_visit(shape, &hits.ray, 0, INFINITY, keep_hit, &hits);
    return hits;
}

// Is there a hit within `by` of depth t?
static bool has(const Hits *hits, double t, double by) {
    for (int i = 0; i < hits->count; i++)
        if (fabs(hits->t[i] - t) <= by)
            return true;
    return false;
}

// ---- torus ----------------------------------------------------------------------------------

// The tube reaches over the axis when it is thicker than its ring.
static double off_torus(double major, double minor, Vec3 p) {
    double r = sqrt(p.x * p.x + p.z * p.z), here = r - major, across = r + major;
    return fmin(fabs(sqrt(here * here + p.y * p.y) - minor),
                fabs(sqrt(across * across + p.y * p.y) - minor));
}

// The point of the tube at these angles; *n: its normal.
static Vec3 on_torus(double major, double minor, double around, double tube, Vec3 *n) {
    Vec3 ring = vec3(cos(around), 0, sin(around));
    *n = vec_madd(vec_scale(ring, cos(tube)), sin(tube), vec3(0, 1, 0));
    return vec_madd(vec_scale(ring, major), minor, *n);
}

// Rays at known points of the tube, no flatter to it than a cosine of `least`; `by`: the error.
static void check_torus(double major, double minor, bool within, double least, double by) {
    Shape s = prepare((Object){.type = OBJECT_TORUS, .shape.torus = {major, minor}});
    Rng rng = {7};
    for (int i = 0; i < 20000; i++) {
        Vec3 n;
        double around = rng_range(&rng, -M_PI, M_PI), tube = rng_range(&rng, -M_PI, M_PI);
        Vec3 p = on_torus(major, minor, around, tube, &n);
        Vec3 dir = random_unit(&rng), org;
        if (within) {
            // From a point inside the tube, half as far from its middle.
            org = on_torus(major, 0.5 * minor, rng_range(&rng, -M_PI, M_PI),
                           rng_range(&rng, -M_PI, M_PI), &dir);
            dir = vec_normalize(vec_sub(p, org));
        } else {
            org = vec_madd(p, -5 * (major + minor), dir);
        }
        // Where sheets cross on the axis they are R times as far apart as the axis is away; closer
        // than 1e-8, the root of a rounding, they are none.
        bool crossing = minor > major && major * sqrt(p.x * p.x + p.z * p.z) < 2e-8;
        if (fabs(vec_dot(dir, n)) < least || crossing)
            continue;
        Hits hits = hits_of(&s, org, dir);
        double wanted = vec_dot(vec_sub(p, org), dir);
        // POV-Ray's least depth of a torus, which a thin one is nearer to its inside than.
        if (wanted > 1.01e-4)
            assert_true(has(&hits, wanted, by));
        if (!within || minor > 1e-2)
            assert_int_equal(hits.count % 2, within);
        for (int k = 0; k < hits.count; k++)
            assert_true(off_torus(major, minor, vec_madd(org, hits.t[k], dir)) <= by);
    }
}

static void test_torus(void **state) {
    (void)state;
    // (r / R)^2 of the quartic's terms is what the tube leaves of them: 1e-16 / 1e-8 of r at 1e-4.
    check_torus(1, 1e-4, false, 1e-2, 1e-9);
    check_torus(1, 1e-4, true, 1e-2, 1e-9);
    check_torus(1, 0.3, false, 1e-3, 1e-10);
    check_torus(1, 0.3, true, 1e-3, 1e-10);
    check_torus(1e-4, 1, false, 1e-2, 1e-9); // all but a sphere, which crosses itself on the axis
}

// ---- sphere and cone ------------------------------------------------------------------------

// Rays that pass at nearly the radius: there is a chord when they are nearer, by more than
// POV-Ray's least (half of it, squared, is above 1e-10), and none when they are farther.
static void test_tangents(void **state) {
    (void)state;
    Shape s = prepare((Object){.type = OBJECT_SPHERE, .shape.sphere = {{0.25, -0.5, 1}, 2}});
    Rng rng = {11};
    for (int i = 0; i < 20000; i++) {
        Vec3 n = random_unit(&rng), dir = vec_normalize(vec_cross(n, random_unit(&rng)));
        double off = pow(10, rng_range(&rng, -16, -1)) * (i % 2 ? -1 : 1);
        Vec3 near = vec_madd(vec3(0.25, -0.5, 1), 2 + off, n);
        Hits hits = hits_of(&s, vec_madd(near, -7, dir), dir);
        double half2 = -off * (4 + off);
        if (half2 > 1.01e-10) {
            assert_int_equal(hits.count, 2);
            // 1e-13: a few roundings of squares of about 50, whose root is taken.
            double by = 1e-13 / sqrt(half2) + 1e-12;
            assert_true(has(&hits, 7 - sqrt(half2), by) && has(&hits, 7 + sqrt(half2), by));
        } else if (half2 < 0.99e-10) {
            assert_int_equal(hits.count, 0);
        }
    }
}

// At the tip, and around it nearer than a picture could show.
static void test_tip(void **state) {
    (void)state;
    const Vec3 tip = {0.1, 2, -0.3};
    Shape s =
        prepare((Object){.type = OBJECT_CONE, .shape.cone = {{0, -1, 0.2}, tip, 1, 0, false}});
    Rng rng = {13};
    for (int i = 0; i < 20000; i++) {
        Vec3 dir = random_unit(&rng);
        double off = i % 3 ? pow(10, rng_range(&rng, -18, -3)) : 0.0;
        Vec3 at = vec_madd(tip, off, random_unit(&rng));
        Hits hits = hits_of(&s, vec_madd(at, -4, dir), dir);
        // A ray through the tip itself may count it once or twice; one beside it goes in and out.
        // The roots at the tip are those of a square: 1e-16 there is 1e-8 of the height.
        if (off > 1e-7)
            assert_int_equal(hits.count % 2, 0);
        for (int k = 0; k < hits.count; k++)
            assert_true(hits.t[k] > 0 && hits.t[k] < 8);
    }
}

// ---- flat things ----------------------------------------------------------------------------

static void test_flat_box(void **state) {
    (void)state;
    Rng rng = {17};
    for (int i = 0; i < 20000; i++) {
        int axis = i % 3;
        double level = rng_range(&rng, -1, 1);
        double low[3] = {-1, -2, -3}, high[3] = {2, 1, 3}, at[3];
        low[axis] = high[axis] = level;
        Shape s =
            prepare((Object){.type = OBJECT_BOX,
                             .shape.box = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}});
        for (int k = 0; k < 3; k++)
            at[k] = k == axis ? level : rng_range(&rng, low[k] * 1.5, high[k] * 1.5);
        bool on = true;
        for (int k = 0; k < 3; k++)
            on = on && at[k] >= low[k] && at[k] <= high[k];
        Vec3 p = vec3(at[0], at[1], at[2]), dir = random_unit(&rng);
        if (fabs(vec_get(dir, axis)) < 1e-3)
            continue;
        Hits hits = hits_of(&s, vec_madd(p, -6, dir), dir);
        // In and out at the same depth, or rounding apart.
        assert_int_equal(hits.count, on ? 2 : 0);
        for (int k = 0; k < hits.count; k++)
            assert_true(fabs(hits.t[k] - 6) < 1e-11);
    }
}

// Of no area, or too little for a double to say where it is: nothing, or a hit that is near it.
static void test_no_triangle(void **state) {
    (void)state;
    Rng rng = {19};
    for (int i = 0; i < 20000; i++) {
        Vec3 a = random_unit(&rng), along = random_unit(&rng);
        double thin = i % 2 ? pow(10, rng_range(&rng, -300, -6)) : 0.0;
        Vec3 b = vec_madd(a, i % 5 ? 1.0 : 0.0, along);
        Vec3 c = vec_madd(vec_madd(a, 0.5, along), thin, random_unit(&rng));
        if (i % 7 == 0)
            c = b;
        Shape s = prepare((Object){.type = OBJECT_TRIANGLE, .shape.triangle = {{a, b, c}}});
        Vec3 dir = random_unit(&rng);
        Hits hits = hits_of(&s, vec_madd(vec_madd(a, 0.3, along), -4, dir), dir);
        assert_true(hits.count <= 1);
    }
}

// ---- lathe ----------------------------------------------------------------------------------

// A can, of vertical and level pieces: what a cylinder is.
static void test_can(void **state) {
    (void)state;
    Vec2 points[] = {{0, -1}, {0.7, -1}, {0.7, 0.2}, {0.7, 1}, {0, 1}};
    Shape lathe = prepare((Object){.type = OBJECT_LATHE,
                                   .shape.lathe = {.outline = OUTLINE_LINEAR,
                                                   .points = points,
                                                   .count = sizeof points / sizeof *points}});
    Rng rng = {23};
    for (int i = 0; i < 20000; i++) {
        double a = rng_range(&rng, -M_PI, M_PI), y = rng_range(&rng, -1, 1);
        Vec3 p = vec3(0.7 * cos(a), y, 0.7 * sin(a)), n = vec3(cos(a), 0, sin(a));
        if (i % 2) {
            double r = 0.7 * sqrt(rng_unit(&rng));
            p = vec3(r * cos(a), i % 4 == 1 ? 1 : -1, r * sin(a)), n = vec3(0, 1, 0);
        }
        Vec3 dir = random_unit(&rng);
        if (i % 3 == 0) // level, as cameras look
            dir = vec_normalize(vec3(dir.x, i % 9 == 0 ? 0.0 : 1e-7 * dir.y, dir.z));
        if (fabs(vec_dot(n, dir)) < 1e-2)
            continue;
        Hits hits = hits_of(&lathe, vec_madd(p, -5, dir), dir);
        assert_true(has(&hits, 5, 1e-8));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_torus),       cmocka_unit_test(test_tangents),
        cmocka_unit_test(test_tip),         cmocka_unit_test(test_flat_box),
        cmocka_unit_test(test_no_triangle), cmocka_unit_test(test_can),
    };
    return cmocka_run_group_tests_name("solid_extremes", tests, create_arena, destroy_arena);
}
