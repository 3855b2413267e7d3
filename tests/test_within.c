// SPDX-License-Identifier: MIT
// How far infinite shapes reach into a box: no point of the inside or of the surface may be lost,
// however they are turned; and what should be finite is.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "shape_fixture.h"

static const Box everywhere = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};

static Shape plane(Vec3 normal, double distance) {
    return prepare((Object){.type = OBJECT_PLANE, .shape.plane = {normal, distance}});
}

static Shape hyperboloid(const Transform *transform) { // x^2 - y^2 + z^2 = 1
    Object object = {.type = OBJECT_QUADRIC,
                     .shape.quadric = {.square = {1, -1, 1}, .constant = -1}};
    if (transform) {
        object.has_transform = true;
        object.transform = *transform;
    }
    return prepare(object);
}

static int below(Rng *rng, int count) { return (int)(rng_unit(rng) * count); }

static double pick(Rng *rng, const double *values, int count) { return values[below(rng, count)]; }

static Shape random_shape(Rng *rng) {
    static const double few[] = {-2, -1, -0.25, 0, 0, 0.25, 1, 2};
    Object object = {.type = OBJECT_QUADRIC};
    QuadricShape *q = &object.shape.quadric;
    if (below(rng, 4) == 0) {
        Vec3 normals[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {0, 1e-12, 1}};
        return plane(normals[below(rng, 5)], pick(rng, few, 8));
    }
    q->square = vec3(pick(rng, few, 8), pick(rng, few, 8), pick(rng, few, 8));
    q->linear = vec3(pick(rng, few, 8), pick(rng, few, 8), pick(rng, few, 8));
    if (below(rng, 8) == 0)
        q->mixed = vec3(pick(rng, few, 8), 0, pick(rng, few, 8));
    q->constant = pick(rng, few, 8);
    object.inverse = below(rng, 8) == 0;
    Transform t = transform_scale(vec3(pick(rng, few, 2), pick(rng, few + 5, 3), 0.5));
    if (below(rng, 2)) {
        Transform turn = transform_rotate(vec3(0, 90.0 * below(rng, 5), 0));
        t = transform_compose(&t, &turn);
    }
    if (below(rng, 4) == 0) {
        Transform turn = transform_rotate(vec3(10, 20, 30));
        t = transform_compose(&t, &turn);
    }
    Transform move = transform_translate(vec3(pick(rng, few, 8), 1.5, pick(rng, few, 8)));
    object.transform = transform_compose(&t, &move);
    object.has_transform = true;
    return prepare(object);
}

static double random_side(Rng *rng, double side) {
    return below(rng, 3) == 0 ? copysign(INFINITY, side) : side * rng_unit(rng) * 4.0;
}

static bool has(const Box *box, Vec3 p) {
    return p.x >= box->low.x && p.x <= box->high.x && p.y >= box->low.y && p.y <= box->high.y &&
           p.z >= box->low.z && p.z <= box->high.z;
}

static void test_keeps_all_points(void **state) {
    (void)state;
    Rng rng = {11};
    int inside = 0, narrowed = 0;
    for (int i = 0; i < 20000; i++) {
        Shape shape = random_shape(&rng);
        Box around = {{random_side(&rng, -1), random_side(&rng, -1), random_side(&rng, -1)},
                      {random_side(&rng, 1), random_side(&rng, 1), random_side(&rng, 1)}};
        Box within = shape_within(&shape, around);
        narrowed += within.low.x > around.low.x || within.high.y < around.high.y;
        for (int k = 0; k < 20; k++) {
            Vec3 p = vec3(8 * rng_unit(&rng) - 4, 8 * rng_unit(&rng) - 4, 8 * rng_unit(&rng) - 4);
            if (!has(&around, p) || !shape_inside(&shape, p))
                continue;
            inside++;
            assert_true(has(&within, p));
        }
    }
    assert_true(inside > 20000);
    assert_true(narrowed > 2000);
}

static void test_plane_along_an_axis_cuts(void **state) {
    (void)state;
    Shape below = plane(vec3(0, 1, 0), 3), beyond = plane(vec3(0, 0, -1), 2);
    Box box = shape_within(&below, everywhere);
    assert_true(box.high.y >= 3.0 && box.high.y < 3.001 && isinf(box.low.y) && isinf(box.high.x));
    box = shape_within(&beyond, everywhere);
    assert_true(box.low.z <= -2.0 && box.low.z > -2.001 && isinf(box.high.z));
}

// A chessman's foot; half a turn about the axis leaves 1e-16 of x in z.
static void test_hyperboloid_between_planes_is_finite(void **state) {
    (void)state;
    Transform turn = transform_rotate(vec3(0, 180, 0));
    Shape shapes[] = {hyperboloid(NULL), hyperboloid(&turn)};
    const Box slab = {{-INFINITY, -3, -INFINITY}, {INFINITY, 2, INFINITY}};
    for (int i = 0; i < 2; i++) {
        Box box = shape_within(&shapes[i], slab);
        double reach = sqrt(10.0); // at y = -3
        assert_true(box.high.x >= reach && box.high.x < reach + 1e-3);
        assert_true(box.low.z <= -reach && box.low.z > -reach - 1e-3);
        assert_true(box.low.y == -3 && box.high.y == 2);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_keeps_all_points),
        cmocka_unit_test(test_plane_along_an_axis_cuts),
        cmocka_unit_test(test_hyperboloid_between_planes_is_finite),
    };
    return cmocka_run_group_tests_name("within", tests, create_arena, destroy_arena);
}
