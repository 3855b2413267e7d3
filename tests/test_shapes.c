// SPDX-License-Identifier: MIT
// Primitives against mathematics: hits known by hand (from outside, within, tangent, on edges, at
// tips and caps), then random shapes under random transforms, where every hit must satisfy the
// surface's equation, alternate between in and out, and lie in the box; normals against
// differences. The roots of quartics against quartics made of known roots.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "shape/quartic.h"
#include "shape/roots.h"
#include "shape_fixture.h"

#include <string.h>

static Shape sphere(Vec3 center, double radius) {
    return prepare((Object){.type = OBJECT_SPHERE, .shape.sphere = {center, radius}});
}

static Shape box(Vec3 low, Vec3 high) {
    return prepare((Object){.type = OBJECT_BOX, .shape.box = {low, high}});
}

static Shape cone(Vec3 base, double base_radius, Vec3 apex, double apex_radius, bool open) {
    return prepare(
        (Object){.type = OBJECT_CONE, .shape.cone = {base, apex, base_radius, apex_radius, open}});
}

static Shape torus(double major, double minor) {
    return prepare((Object){.type = OBJECT_TORUS, .shape.torus = {major, minor}});
}

static Shape disc(Vec3 center, Vec3 normal, double radius, double hole) {
    return prepare((Object){.type = OBJECT_DISC, .shape.disc = {center, normal, radius, hole}});
}

static Shape triangle(Vec3 a, Vec3 b, Vec3 c) {
    return prepare((Object){.type = OBJECT_TRIANGLE, .shape.triangle = {{a, b, c}}});
}

static Shape plane(Vec3 normal, double distance, bool inverse) {
    return prepare(
        (Object){.type = OBJECT_PLANE, .inverse = inverse, .shape.plane = {normal, distance}});
}

static int compare_hits(const void *a, const void *b) {
    const ShapeHit *x = a, *y = b;
    return (x->t > y->t) - (x->t < y->t);
}

// Hits in ascending order.
static int hits_of(const Shape *shape, Vec3 org, Vec3 dir, ShapeHit hits[SHAPE_MAX_HITS]) {
    Ray ray = {org, vec_normalize(dir)};
    int count = shape_hits(shape, &ray, hits);
    assert_true(count >= 0 && count <= SHAPE_MAX_HITS);
    for (int i = 0; i < count; i++)
        assert_true(isfinite(hits[i].t));
    qsort(hits, (size_t)count, sizeof *hits, compare_hits);
    return count;
}

// The ray must meet the shape at exactly these depths (within rounding), with these normals.
static void expect(const Shape *shape, Vec3 org, Vec3 dir, int count, const double *depths,
                   const Vec3 *normals) {
    ShapeHit hits[SHAPE_MAX_HITS];
    assert_int_equal(hits_of(shape, org, dir, hits), count);
    dir = vec_normalize(dir);
    for (int i = 0; i < count; i++) {
        assert_true(fabs(hits[i].t - depths[i]) < 1e-13 * (1 + fabs(depths[i])));
        Vec3 n = shape_normal(shape, vec_madd(org, hits[i].t, dir), &hits[i]);
        assert_true(vec_length(vec_sub(n, normals[i])) < 1e-12);
    }
}

#define EXPECT(shape, org, dir, ...)                                                               \
    do {                                                                                           \
        const struct {                                                                             \
            double t;                                                                              \
            Vec3 n;                                                                                \
        } wanted[] = {__VA_ARGS__};                                                                \
        enum { WANTED = sizeof wanted / sizeof *wanted };                                          \
        double depths[WANTED];                                                                     \
        Vec3 normals[WANTED];                                                                      \
        for (int w = 0; w < WANTED; w++)                                                           \
            depths[w] = wanted[w].t, normals[w] = wanted[w].n;                                     \
        expect(shape, org, dir, WANTED, depths, normals);                                          \
    } while (0)

static void expect_miss(const Shape *shape, Vec3 org, Vec3 dir) {
    expect(shape, org, dir, 0, NULL, NULL);
}

static const Vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};

// ---- by hand --------------------------------------------------------------------------------

static void test_plane(void **state) {
    (void)state;
    Shape s = plane(Y, 2, false), inverse = plane(Y, 2, true);
    EXPECT(&s, vec3(5, 6, 7), vec3(0, -1, 0), {4, Y});
    EXPECT(&s, vec3(5, -2, 7), vec3(3, 4, 0), {5, Y});
    EXPECT(&inverse, vec3(5, 6, 7), vec3(0, -1, 0), {4, vec_neg(Y)});
    expect_miss(&s, vec3(0, 6, 0), Y);
    expect_miss(&s, vec3(0, 2, 0), X);                    // within it
    expect_miss(&s, vec3(0, 2 + 1e7 + 1, 0), vec_neg(Y)); // farther than hits go
    expect_miss(&s, vec3(0, 2 + 9e-7, 0), vec_neg(Y));    // nearer than they come
    assert_true(shape_inside(&s, vec3(9, 1.9, 9)) && !shape_inside(&s, vec3(9, 2.1, 9)));
    assert_true(shape_inside(&s, vec3(9, 2, 9)));
    assert_true(shape_inside(&inverse, vec3(9, 2.1, 9)) && !shape_inside(&inverse, vec3(9, 1, 9)));
    Vec2 uv = shape_uv(&s, vec3(3, 2, 4), &(ShapeHit){0});
    assert_true(uv.u == 3 && uv.v == 2);
}

static void test_sphere(void **state) {
    (void)state;
    Shape s = sphere(vec3(1, 2, 3), 2);
    EXPECT(&s, vec3(1, 2, -5), Z, {6, vec_neg(Z)}, {10, Z});
    EXPECT(&s, vec3(1, 2, 3), X, {2, X});
    expect_miss(&s, vec3(1, 2, 6), Z);
    expect_miss(&s, vec3(3, 2, -5), Z); // tangent
    // POV-Ray wants half the chord's square above 1e-10: 2 r h with h from the rim.
    ShapeHit hits[SHAPE_MAX_HITS];
    assert_int_equal(hits_of(&s, vec3(3 - 2e-11, 2, -5), Z, hits), 0);
    assert_int_equal(hits_of(&s, vec3(3 - 3e-11, 2, -5), Z, hits), 2);
    assert_true(shape_inside(&s, vec3(1, 3.9, 3)) && !shape_inside(&s, vec3(1, 4, 3)));
    // A negative radius turns the normal.
    Shape negative = sphere(vec3(0, 0, 0), -1);
    EXPECT(&negative, vec3(0, 0, -5), Z, {4, Z}, {6, vec_neg(Z)});
    Shape none = sphere(vec3(0, 0, 0), 0);
    expect_miss(&none, vec3(0, 0, -5), Z);
}

static void test_box(void **state) {
    (void)state;
    Shape s = box(vec3(3, 2, 1), vec3(-1, -2, -3)); // corners in any order
    EXPECT(&s, vec3(0, 0, -5), Z, {2, vec_neg(Z)}, {6, Z});
    EXPECT(&s, vec3(0, 5, 0), vec3(0, -1, 0), {3, Y}, {7, vec_neg(Y)});
    EXPECT(&s, vec3(0, 0, 0), X, {3, X});
    // Along a face and along an edge: both belong to the box.
    EXPECT(&s, vec3(3, 0, -5), Z, {2, vec_neg(Z)}, {6, Z});
    EXPECT(&s, vec3(3, 2, -5), Z, {2, vec_neg(Z)}, {6, Z});
    expect_miss(&s, vec3(3.0000001, 0, -5), Z);
    // Into an edge: the side that faces the ray more.
    EXPECT(&s, vec3(3 + 2, 0, 1 + 1), vec3(-2, 0, -1), {sqrt(5), X}, {3 * sqrt(5), vec_neg(X)});
    // Through two corners.
    Shape cube = box(vec3(-1, -1, -1), vec3(1, 1, 1));
    ShapeHit hits[SHAPE_MAX_HITS];
    assert_int_equal(hits_of(&cube, vec3(-2, -2, -2), vec3(1, 1, 1), hits), 2);
    assert_true(fabs(hits[1].t - hits[0].t - 2 * sqrt(3)) < 1e-14);
    assert_int_equal(hits_of(&cube, vec3(-2, 0, 0), vec3(1, 1, 0), hits), 2); // touches an edge
    assert_true(hits[0].t == hits[1].t);
    Shape flat = box(vec3(-1, 0, -1), vec3(1, 0, 1));
    assert_int_equal(hits_of(&flat, vec3(0, 3, 0), vec3(0, -1, 0), hits), 2);
    assert_true(hits[0].t == 3 && hits[1].t == 3);
    assert_true(shape_inside(&s, vec3(3, 2, 1)) && !shape_inside(&s, vec3(3, 2.1, 1)));
}

static void test_cylinder(void **state) {
    (void)state;
    Shape s = cone(vec3(0, -1, 0), 2, vec3(0, 3, 0), 2, false);
    Shape open = cone(vec3(0, -1, 0), 2, vec3(0, 3, 0), 2, true);
    assert_int_equal(s.kind, SHAPE_CYLINDER);
    EXPECT(&s, vec3(0, 0, -5), Z, {3, vec_neg(Z)}, {7, Z});
    EXPECT(&s, vec3(1, 9, 1), vec3(0, -1, 0), {6, Y}, {10, vec_neg(Y)});
    EXPECT(&s, vec3(0, 1, 0), vec3(3, 4, 0), {2.5, Y}); // from within through a cap
    EXPECT(&open, vec3(0, 0, -5), Z, {3, vec_neg(Z)}, {7, Z});
    expect_miss(&open, vec3(1, 9, 1), vec3(0, -1, 0)); // along the axis there is nothing
    // In by the end, out by the side.
    EXPECT(&open, vec3(-2.5, 4, 0), vec3(1, -1, 0), {4.5 * sqrt(2), X});
    expect_miss(&s, vec3(0, 3.001, -5), Z);
    assert_true(shape_inside(&s, vec3(1.4, 2.9, 1.4)) && !shape_inside(&s, vec3(1.5, 2.9, 1.5)));
    assert_false(shape_inside(&s, vec3(0, 3, 0)));
    assert_true(shape_inside(&open, vec3(0, 3, 0))); // POV-Ray's slack has the other sign
    Shape none = cone(vec3(0, 0, 0), 1, vec3(0, 0, 0), 1, false);
    expect_miss(&none, vec3(0, 0, -5), Z);
    none = cone(vec3(0, 0, 0), 0, vec3(0, 1, 0), 0, false);
    expect_miss(&none, vec3(0, 0, -5), Z);
}

static void test_cone(void **state) {
    (void)state;
    // Radius 2 at y = 0, tip at y = 2: the side leans by 45 degrees.
    const double h = sqrt(0.5);
    for (int turned = 0; turned < 2; turned++) {
        Shape s = turned ? cone(vec3(0, 2, 0), 0, vec3(0, 0, 0), 2, false)
                         : cone(vec3(0, 0, 0), 2, vec3(0, 2, 0), 0, false);
        EXPECT(&s, vec3(0, 1, -5), Z, {4, vec3(0, h, -h)}, {6, vec3(0, h, h)});
        EXPECT(&s, vec3(1, 9, 0), vec3(0, -1, 0), {8, vec3(h, h, 0)}, {9, vec_neg(Y)});
        EXPECT(&s, vec3(0, 1, 0), vec3(0, -1, 0), {1, vec_neg(Y)});
        EXPECT(&s, vec3(0, 0.5, 0), X, {1.5, vec3(h, h, 0)});
        expect_miss(&s, vec3(0, 2.001, -5), Z); // no second nappe
        expect_miss(&s, vec3(0, 3, -1), Z);
        // Parallel to the side: one root is at infinity.
        EXPECT(&s, vec3(-2, -1, 0), vec3(1, 1, 0), {sqrt(2), vec_neg(Y)},
               {2.5 * sqrt(2), vec3(h, h, 0)});
        // Through the tip, straight down the axis: the tip looks along it.
        ShapeHit hits[SHAPE_MAX_HITS];
        int count = hits_of(&s, vec3(0, 5, 0), vec3(0, -1, 0), hits);
        assert_true(count >= 2 && fabs(hits[0].t - 3) < 1e-12 && hits[count - 1].t == 5);
        Vec3 tip = shape_normal(&s, vec3(0, 2, 0), &hits[0]);
        assert_true(fabs(tip.y - 1) < 1e-9);
        assert_true(shape_inside(&s, vec3(0.9, 1, 0)) && !shape_inside(&s, vec3(1.1, 1, 0)));
        assert_false(shape_inside(&s, vec3(0, -0.1, 0)));
    }
    Shape cut = cone(vec3(0, 0, 0), 2, vec3(0, 1, 0), 1, false);
    EXPECT(&cut, vec3(0.5, 9, 0), vec3(0, -1, 0), {8, Y}, {9, vec_neg(Y)});
    Shape open = cone(vec3(0, 0, 0), 2, vec3(0, 1, 0), 1, true);
    expect_miss(&open, vec3(0.5, 9, 0), vec3(0, -1, 0));
    // Radii that hardly differ: nearly a cylinder, without noise in the depth.
    Shape near = cone(vec3(0, 0, 0), 1, vec3(0, 1, 0), 1 + 1e-7, false);
    ShapeHit hits[SHAPE_MAX_HITS];
    assert_int_equal(hits_of(&near, vec3(0, 0.5, -5), Z, hits), 2);
    assert_true(fabs(hits[0].t - 4 + 0.5e-7) < 1e-8);
}

static void test_torus(void **state) {
    (void)state;
    Shape s = torus(2, 0.5);
    EXPECT(&s, vec3(-5, 0, 0), X, {2.5, vec_neg(X)}, {3.5, X}, {6.5, vec_neg(X)}, {7.5, X});
    EXPECT(&s, vec3(2, 3, 0), vec3(0, -1, 0), {2.5, Y}, {3.5, vec_neg(Y)});
    EXPECT(&s, vec3(0, 0, 2), Z, {0.5, Z});
    expect_miss(&s, vec3(0, 3, 0), vec3(0, -1, 0)); // through the hole
    expect_miss(&s, vec3(-5, 0.5001, 0), X);
    // From far away nothing is lost: roots are taken about the point nearest to the centre.
    ShapeHit hits[SHAPE_MAX_HITS];
    assert_int_equal(hits_of(&s, vec3(-1e6, 0.25, 0), X, hits), 4);
    assert_true(fabs(hits[0].t - (1e6 - 2 - sqrt(0.1875))) < 1e-9);
    assert_true(shape_inside(&s, vec3(1.5, 0, 0)) && !shape_inside(&s, vec3(1.4, 0, 0)));
    Shape thin = torus(1, 0);
    expect_miss(&thin, vec3(-5, 0, 0), X);
    // No hole at all: a sphere.
    Shape ball = torus(0, 1);
    assert_true(hits_of(&ball, vec3(-5, 0.1, 0), X, hits) % 2 == 0);
}

static void test_disc(void **state) {
    (void)state;
    Shape s = disc(vec3(0, 1, 0), Y, 2, 1);
    EXPECT(&s, vec3(1.5, 4, 0), vec3(0, -1, 0), {3, Y});
    EXPECT(&s, vec3(1.5, -4, 0), Y, {5, Y});
    EXPECT(&s, vec3(2, 4, 0), vec3(0, -1, 0), {3, Y}); // both rims belong to it
    EXPECT(&s, vec3(0, 4, 1), vec3(0, -1, 0), {3, Y});
    expect_miss(&s, vec3(2.0000001, 4, 0), vec3(0, -1, 0));
    expect_miss(&s, vec3(0.9999999, 4, 0), vec3(0, -1, 0));
    expect_miss(&s, vec3(-9, 1, 0), X); // within its plane
    assert_true(shape_inside(&s, vec3(99, 0.9, 0)) && !shape_inside(&s, vec3(0, 1.1, 0)));
}

static void test_triangle(void **state) {
    (void)state;
    Shape s = triangle(vec3(-1, -1, 0), vec3(1, -1, 0), vec3(0, 1, 0));
    EXPECT(&s, vec3(0, 0, -5), Z, {5, vec_neg(Z)}); // seen from -z it shows its outside
    EXPECT(&s, vec3(0, 0, 5), vec3(0, 0, -1), {5, vec_neg(Z)});
    EXPECT(&s, vec3(1, -1, -5), Z, {5, vec_neg(Z)});  // a corner
    EXPECT(&s, vec3(0.5, 0, -5), Z, {5, vec_neg(Z)}); // an edge
    expect_miss(&s, vec3(0.5000001, 0, -5), Z);
    expect_miss(&s, vec3(-3, 0, 0), X);
    assert_false(shape_inside(&s, vec3(0, 0, 0)) || shape_has_inside(&s));
    // Neighbours leave no gap along the common edge, whichever axis dominates.
    for (int axis = 0; axis < 3; axis++) {
        Vec3 a = vec3(0, 0, 0), b = vec3(1, 0.5, 0.25), c = vec3(1, 0, 1), d = vec3(0, 1, 0.125);
        if (axis == 0)
            c = vec3(0, 1, 1), d = vec3(0, 1, -1), b = vec3(0, 2, 0);
        Shape left = triangle(a, b, c), right = triangle(a, d, b);
        for (int i = 1; i < 8; i++) {
            Vec3 on = vec_scale(b, i / 8.0), dir = axis == 0 ? X : axis == 1 ? Y : Z;
            ShapeHit hits[SHAPE_MAX_HITS];
            Vec3 org = vec_madd(on, -4, dir);
            assert_true(hits_of(&left, org, dir, hits) + hits_of(&right, org, dir, hits) > 0);
        }
    }
    Shape line = triangle(vec3(0, 0, 0), vec3(1, 1, 1), vec3(2, 2, 2));
    assert_int_equal(line.kind, SHAPE_NONE);
}

// The maps as measured with POV-Ray.
static void test_uv(void **state) {
    (void)state;
    Shape ball = sphere(vec3(0, 0, 0), 2);
    const double s = sqrt(2);
    struct {
        Vec3 p;
        double u, v;
    } on_sphere[] = {{{2, 0, 0}, 0, 0.5},     {{0, 0, 2}, 0.25, 0.5}, {{-2, 0, 0}, 0.5, 0.5},
                     {{0, 0, -2}, 0.75, 0.5}, {{0, 2, 0}, 0, 1},      {{s, s, 0}, 0, 0.75},
                     {{0, -2, 0}, 0, 0}},
      on_torus[] = {{{2.5, 0, 0}, 0.5, 0.5},
                    {{2, 0.5, 0}, 0.5, 0.75},
                    {{1.5, 0, 0}, 0.5, 0},
                    {{0, -0.5, 2}, 0.25, 0.25},
                    {{0, 0.5, -2}, 0.75, 0.75}};
    for (size_t i = 0; i < sizeof on_sphere / sizeof *on_sphere; i++) {
        Vec2 uv = shape_uv(&ball, on_sphere[i].p, &(ShapeHit){0});
        assert_true(fabs(uv.u - on_sphere[i].u) < 1e-15 && fabs(uv.v - on_sphere[i].v) < 1e-15);
    }
    Shape ring = torus(2, 0.5);
    for (size_t i = 0; i < sizeof on_torus / sizeof *on_torus; i++) {
        Vec2 uv = shape_uv(&ring, on_torus[i].p, &(ShapeHit){0});
        assert_true(fabs(uv.u - on_torus[i].u) < 1e-15 && fabs(uv.v - on_torus[i].v) < 1e-15);
    }
    // Each side of the box has a cell of its own.
    Shape b = box(vec3(-1, -1, -1), vec3(1, 1, 1));
    struct {
        Vec3 from;
        double u, v;
    } sides[] = {{{-5, 0, 0}, 0.125, 0.5},     {{5, 0, 0}, 0.625, 0.5},
                 {{0, -5, 0}, 0.375, 1.0 / 6}, {{0, 5, 0}, 0.375, 5.0 / 6},
                 {{0, 0, -5}, 0.875, 0.5},     {{0, 0, 5}, 0.375, 0.5}};
    for (size_t i = 0; i < 6; i++) {
        ShapeHit hits[SHAPE_MAX_HITS];
        assert_int_equal(hits_of(&b, sides[i].from, vec_neg(sides[i].from), hits), 2);
        Vec2 uv = shape_uv(&b, vec_scale(sides[i].from, 0.2), &hits[0]);
        assert_true(fabs(uv.u - sides[i].u) < 1e-15 && fabs(uv.v - sides[i].v) < 1e-15);
    }
}

// How near and how far hits may be, as measured with POV-Ray: the front of the object is at z = 0
// after a scale in all directions, the ray starts `distance` before it. Some limits hold for the
// local depth, some for the world's.
static void test_depth_limits(void **state) {
    (void)state;
    const Object front_sphere = {.type = OBJECT_SPHERE, .shape.sphere = {{0, 0, 1}, 1}};
    const Object front_box = {.type = OBJECT_BOX, .shape.box = {{-1, -1, 0}, {1, 1, 2}}};
    const Object front_cylinder = {.type = OBJECT_CYLINDER,
                                   .shape.cone = {{0, -1, 1}, {0, 1, 1}, 1, 1, false}};
    const Object front_torus = {.type = OBJECT_TORUS, .shape.torus = {1, 0.5}};
    const Object front_disc = {.type = OBJECT_DISC, .shape.disc = {{0, 0, 0}, {0, 0, -1}, 3, 0}};
    const struct {
        const Object *object;
        double scale, distance;
        bool met;
    } cases[] = {
        {&front_sphere, 1000, 2e-4, false},   {&front_sphere, 1000, 5e-3, true},
        {&front_sphere, 30000, 2e-2, false},  {&front_sphere, 30000, 2e-1, true},
        {&front_box, 1000, 2e-4, true},       {&front_disc, 1000, 2e-4, true},
        {&front_cylinder, 30000, 2e-4, true}, {&front_cylinder, 1e6, 2e-4, false},
        {&front_cylinder, 1e6, 5e-3, true},   {&front_torus, 1000, 2e-2, false},
        {&front_torus, 1000, 2e-1, true},     {&front_torus, 30000, 2, false},
        {&front_torus, 30000, 20, true},      {&front_sphere, 1, 1.1e7, false},
        {&front_sphere, 1, 9.9e6, true},      {&front_sphere, 1000, 2e7, true},
        {&front_cylinder, 1, 1.1e7, false},   {&front_cylinder, 1000, 2e7, true},
        {&front_torus, 1, 1.1e7, false},      {&front_torus, 1000, 1.1e7, false},
        {&front_torus, 1000, 9.9e6, true},    {&front_disc, 1000, 1.1e7, false},
        {&front_disc, 1000, 9.9e6, true},     {&front_box, 1, 9.9e9, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Object object = *cases[i].object;
        double s = cases[i].scale;
        bool is_torus = object.type == OBJECT_TORUS;
        Transform lift = transform_translate(vec3(0, 0, is_torus ? 0.5 : 0));
        Transform turn = transform_rotate(vec3(is_torus ? 90 : 0, 0, 0));
        Transform size = transform_scale(vec3(s, s, s));
        object.has_transform = true;
        object.transform = transform_compose(&turn, &lift);
        object.transform = transform_compose(&object.transform, &size);
        Shape shape = shape_prepare(NULL, &object, NULL, arena);
        ShapeHit hits[SHAPE_MAX_HITS];
        Vec3 org = vec3(is_torus ? s : 0, 0, -cases[i].distance);
        int count = hits_of(&shape, org, Z, hits);
        bool met = count > 0 && hits[0].t < cases[i].distance * 1.5;
        if (met != cases[i].met)
            fail_msg("case %zu: scale %g, distance %g", i, s, cases[i].distance);
    }
}

// ---- quartics -------------------------------------------------------------------------------

static void test_quartic_roots(void **state) {
    (void)state;
    Rng rng = {3};
    for (int i = 0; i < 20000; i++) {
        // Four roots whose sum is 0, some close together, some far.
        double size = pow(10, rng_range(&rng, -3, 3)), want[4], roots[4];
        for (int k = 0; k < 3; k++)
            want[k] = size * rng_range(&rng, -1, 1);
        if (rng_next(&rng) % 2)
            want[1] = want[0] + size * pow(10, rng_range(&rng, -5, 0));
        want[3] = -want[0] - want[1] - want[2];
        for (int a = 0; a < 4; a++)
            for (int b = a + 1; b < 4; b++)
                if (want[b] < want[a]) {
                    double t = want[a];
                    want[a] = want[b], want[b] = t;
                }
        double p = 0, q = 0, r = want[0] * want[1] * want[2] * want[3], gap = INFINITY;
        for (int a = 0; a < 4; a++)
            for (int b = a + 1; b < 4; b++) {
                p += want[a] * want[b];
                for (int c = b + 1; c < 4; c++)
                    q -= want[a] * want[b] * want[c];
                gap = fmin(gap, want[b] - want[a]);
            }
        int count = quartic_roots(p, q, r, 8 * size, roots);
        // The coefficients carry rounding of 2^-50 size^4; a pair of roots `gap` apart rises to
        // (gap/2)^2 size^2 at most between them, and may vanish below that.
        if (gap < 1e-6 * size)
            continue;
        assert_int_equal(count, 4);
        for (int k = 0; k < 4; k++)
            assert_true(fabs(roots[k] - want[k]) < 1e-13 * size * (size / gap) * (size / gap));
    }
    double roots[4];
    assert_int_equal(quartic_roots(0, 0, 1, 10, roots), 0);
    assert_int_equal(quartic_roots(0, 0, -1, 10, roots), 2);
    assert_int_equal(quartic_roots(0, 0, -1, 0.5, roots), 0); // outside the interval
    assert_int_equal(quartic_roots(0, 0, 0, 10, roots), 0);   // touches, does not cross
    assert_int_equal(quartic_roots(NAN, 0, 0, 10, roots), 0);
    assert_int_equal(quartic_roots(0, INFINITY, 0, 10, roots), 0);
    assert_int_equal(quartic_roots(0, 0, -1, INFINITY, roots), 0);
}

// ---- random shapes --------------------------------------------------------------------------

static Vec3 random_vec(Rng *rng, double range) {
    double x = rng_range(rng, -range, range), y = rng_range(rng, -range, range);
    return vec3(x, y, rng_range(rng, -range, range));
}

static Transform random_transform(Rng *rng) {
    Transform s = transform_scale(vec3(rng_range(rng, 0.2, 3),
                                       rng_range(rng, 0.2, 3) * (rng_next(rng) % 2 ? 1 : -1),
                                       rng_range(rng, 0.2, 3)));
    Transform r = transform_rotate(random_vec(rng, 180)),
              m = transform_translate(random_vec(rng, 9));
    double rows[4][3] = {{1, rng_range(rng, -1, 1), 0}, {0, 1, 0}, {rng_range(rng, -1, 1), 0, 1}};
    Transform shear;
    assert_true(transform_matrix(rows, &shear));
    s = transform_compose(&s, &r);
    s = transform_compose(&s, &shear);
    return transform_compose(&s, &m);
}

// Solids in local space; zero on the surface, of first order there, negative within.
static double equation(const Object *object, Vec3 p) {
    switch (object->type) {
    case OBJECT_SPHERE:
        return vec_length(vec_sub(p, object->shape.sphere.center)) - object->shape.sphere.radius;
    case OBJECT_BOX: {
        const BoxShape *b = &object->shape.box;
        Vec3 low = vec_sub(b->low, p), high = vec_sub(p, b->high);
        return fmax(fmax(fmax(low.x, low.y), low.z), fmax(fmax(high.x, high.y), high.z));
    }
    case OBJECT_TORUS: {
        double out = hypot(p.x, p.z) - object->shape.torus.major;
        return hypot(out, p.y) - object->shape.torus.minor;
    }
    default: {
        const ConeShape *c = &object->shape.cone;
        Vec3 axis = vec_sub(c->apex, c->base);
        double length = vec_length(axis);
        double z = vec_dot(vec_sub(p, c->base), axis) / length;
        Vec3 on = vec_madd(c->base, z / length, axis);
        double radius = c->base_radius + (c->apex_radius - c->base_radius) * z / length;
        return fmax(vec_length(vec_sub(p, on)) - radius, fmax(-z, z - length));
    }
    }
}

static Object random_solid(Rng *rng) {
    static const ObjectType types[] = {OBJECT_SPHERE, OBJECT_BOX, OBJECT_CYLINDER, OBJECT_CONE,
                                       OBJECT_TORUS};
    Object object = {.type = types[rng_next(rng) % 5],
                     .inverse = rng_next(rng) % 2,
                     .has_transform = rng_next(rng) % 4 != 0};
    if (object.has_transform)
        object.transform = random_transform(rng);
    Vec3 a = random_vec(rng, 1), b = random_vec(rng, 1);
    switch (object.type) {
    case OBJECT_SPHERE:
        object.shape.sphere = (SphereShape){a, rng_range(rng, 0.1, 2)};
        break;
    case OBJECT_BOX:
        object.shape.box = (BoxShape){vec_min(a, b), vec_max(a, b)};
        break;
    case OBJECT_TORUS: {
        double minor = rng_range(rng, 0.05, 0.8);
        object.shape.torus = (TorusShape){minor + rng_range(rng, 0.1, 1), minor};
        break;
    }
    default: {
        double r = rng_range(rng, 0.1, 1);
        object.shape.cone =
            (ConeShape){a, b, r, object.type == OBJECT_CONE ? rng_range(rng, 0, 1) : r, false};
        break;
    }
    }
    return object;
}

static Vec3 to_local(const Object *object, Vec3 p) {
    return object->has_transform ? transform_inv_point(&object->transform, p) : p;
}

// The gradient of the equation, seen from the world, by central differences.
static Vec3 gradient(const Object *object, Vec3 p) {
    const double h = 1e-6;
    double g[3];
    for (int axis = 0; axis < 3; axis++) {
        Vec3 e = vec3(axis == 0 ? h : 0, axis == 1 ? h : 0, axis == 2 ? h : 0);
        g[axis] = equation(object, to_local(object, vec_add(p, e))) -
                  equation(object, to_local(object, vec_sub(p, e)));
    }
    return vec_normalize(vec3(g[0], g[1], g[2]));
}

// A sphere's normal is the way from its middle over the radius, as POV-Ray's: as long as the hit is
// exact. That comes from r^2 - (c^2 - b^2), c the way from the ray's start to the middle: some
// roundings of c^2 there are as many of (c / r)^2 / 2 in the normal's length.
static double length_error(const Object *object, Vec3 org) {
    if (object->type != OBJECT_SPHERE || object->has_transform)
        return 1e-14;
    double ratio =
        vec_length(vec_sub(object->shape.sphere.center, org)) / object->shape.sphere.radius;
    return 1e-14 + 8.0 * 0x1p-53 * ratio * ratio;
}

static void test_random_solids(void **state) {
    (void)state;
    Rng rng = {5};
    int hit_count = 0, normal_count = 0;
    for (int i = 0; i < 3000; i++) {
        Object object = random_solid(&rng);
        Shape shape = shape_prepare(NULL, &object, NULL, arena);
        Box bounds = shape_bounds(&shape);
        Vec3 size = vec_sub(bounds.high, bounds.low);
        for (int k = 0; k < 20; k++) {
            // From somewhere around to somewhere in the box.
            Vec3 to = vec_add(bounds.low, vec3(size.x * rng_unit(&rng), size.y * rng_unit(&rng),
                                               size.z * rng_unit(&rng)));
            Vec3 org = vec_add(to, random_vec(&rng, 10)), dir = vec_sub(to, org);
            ShapeHit hits[SHAPE_MAX_HITS];
            int count = hits_of(&shape, org, dir, hits);
            dir = vec_normalize(dir);
            bool in = equation(&object, to_local(&object, org)) < 0.0;
            for (int h = 0; h < count; h++) {
                Vec3 p = vec_madd(org, hits[h].t, dir), q = to_local(&object, p);
                assert_true(fabs(equation(&object, q)) < 1e-9);
                for (int axis = 0; axis < 3; axis++)
                    assert_true(vec_get(p, axis) > vec_get(bounds.low, axis) - 1e-9 &&
                                vec_get(p, axis) < vec_get(bounds.high, axis) + 1e-9);
                Vec3 n = shape_normal(&shape, p, &hits[h]), g = gradient(&object, p);
                assert_true(fabs(vec_length(n) - 1.0) < length_error(&object, org));
                n = object.inverse ? vec_neg(n) : n;
                // Differences across an edge or near the tip say nothing.
                Vec3 behind = gradient(&object, vec_madd(p, -1e-5, g));
                if (vec_dot(behind, g) > 1 - 1e-6) {
                    assert_true(vec_length(vec_sub(n, g)) < 1e-3);
                    normal_count++;
                }
                hit_count++;
            }
            // Between hits the ray is in or out by turns, and the inside test agrees.
            for (int h = 0; h <= count; h++) {
                double a = h == 0 ? 0.0 : hits[h - 1].t, b = h == count ? a + 5.0 : hits[h].t;
                Vec3 p = vec_madd(org, 0.5 * (a + b), dir);
                if (b - a > 1e-3) {
                    assert_int_equal(equation(&object, to_local(&object, p)) < 0.0, in);
                    assert_int_equal(shape_inside(&shape, p), in != object.inverse);
                }
                in = !in;
            }
        }
    }
    assert_true(hit_count > 40000 && normal_count > hit_count * 9 / 10);
}

// Boxes must hold what is hit, and not be much larger: sample the surface by rays from within.
static void test_bounds_are_tight(void **state) {
    (void)state;
    Rng rng = {9};
    for (int i = 0; i < 60; i++) {
        Object object = random_solid(&rng);
        if (object.type == OBJECT_TORUS || object.type == OBJECT_BOX)
            continue;
        object.inverse = false;
        Shape shape = shape_prepare(NULL, &object, NULL, arena);
        Box bounds = shape_bounds(&shape), seen = box_empty();
        Vec3 center = object.type == OBJECT_SPHERE
                          ? object.shape.sphere.center
                          : vec_scale(vec_add(object.shape.cone.base, object.shape.cone.apex), 0.5);
        if (object.has_transform)
            center = transform_point(&object.transform, center);
        for (int k = 0; k < 20000; k++) {
            Vec3 dir = vec_normalize(random_vec(&rng, 1));
            ShapeHit hits[SHAPE_MAX_HITS];
            if (hits_of(&shape, center, dir, hits) > 0)
                seen = box_extend(seen, vec_madd(center, hits[0].t, dir));
        }
        Vec3 size = vec_sub(bounds.high, bounds.low), found = vec_sub(seen.high, seen.low);
        for (int axis = 0; axis < 3; axis++)
            assert_true(vec_get(found, axis) > 0.8 * vec_get(size, axis));
    }
}

// Polynomials with known roots, in intervals of any place: each root that lies inside is found, and
// no other.
static void test_roots(void **state) {
    (void)state;
    Rng rng = {11};
    for (int i = 0; i < 20000; i++) {
        int n = 1 + (int)(rng_next(&rng) % 6), inside = 0, at = 0;
        double want[6], c[7] = {rng_range(&rng, 0.5, 2.0)}, roots[6];
        double low = rng_range(&rng, -3, 3), high = low + rng_range(&rng, 0.01, 4);
        if (i % 4 == 0)
            low = 0.0, high = 1.0;
        for (int k = 0; k < n; k++) {
            want[k] = (k > 0 ? want[k - 1] : rng_range(&rng, -4, 0)) + rng_range(&rng, 0.3, 2);
            for (int j = k + 1; j >= 0; j--)
                c[j] = (j > 0 ? c[j - 1] : 0.0) - want[k] * (j <= k ? c[j] : 0.0);
            if (fabs(want[k] - low) < 1e-6 || fabs(want[k] - high) < 1e-6)
                want[k] = INFINITY; // on the border
        }
        int count = roots_find(c, n, low, high, roots);
        bool border = false;
        for (int k = 0; k < n; k++)
            border |= isinf(want[k]);
        if (border)
            continue;
        for (int k = 0; k < n; k++)
            inside += want[k] > low && want[k] < high;
        assert_int_equal(count, inside);
        for (int k = 0; k < n; k++)
            if (want[k] > low && want[k] < high)
                assert_true(fabs(roots[at++] - want[k]) < 1e-7);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_roots),         cmocka_unit_test(test_plane),
        cmocka_unit_test(test_sphere),        cmocka_unit_test(test_box),
        cmocka_unit_test(test_cylinder),      cmocka_unit_test(test_cone),
        cmocka_unit_test(test_torus),         cmocka_unit_test(test_disc),
        cmocka_unit_test(test_triangle),      cmocka_unit_test(test_uv),
        cmocka_unit_test(test_depth_limits),  cmocka_unit_test(test_quartic_roots),
        cmocka_unit_test(test_random_solids), cmocka_unit_test(test_bounds_are_tight),
    };
    return cmocka_run_group_tests_name("shapes", tests, create_arena, destroy_arena);
}
