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

// A cylinder and two planes across it, turned together: no plane lies along an axis of the world.
static void test_turned_cylinder_between_planes_is_finite(void **state) {
    (void)state;
    Transform turn = transform_rotate(vec3(-30, 20, 40));
    Object object = {.type = OBJECT_QUADRIC,
                     .shape.quadric = {.square = {1, 1, 0}, .constant = -4},
                     .has_transform = true,
                     .transform = turn};
    Shape cylinder = prepare(object);
    Vec3 along = transform_dir(&turn, vec3(0, 0, 1));
    const PlaneShape planes[2] = {{along, 3}, {vec_neg(along), 1}};
    Box box = shape_within_planes(&cylinder, planes, 2, everywhere);
    Box open = shape_within_planes(&cylinder, planes, 1, everywhere);
    assert_true(vec_length(vec_sub(open.high, open.low)) > 1e300);
    Box want = box_empty();
    for (int end = 0; end < 2; end++)
        for (int i = 0; i < 360; i++) {
            double angle = i * M_PI / 180.0;
            Vec3 rim = vec3(2 * cos(angle), 2 * sin(angle), end ? 3 : -1);
            want = box_extend(want, transform_point(&turn, rim));
        }
    assert_true(box.low.x <= want.low.x && box.low.y <= want.low.y && box.low.z <= want.low.z);
    assert_true(box.high.x >= want.high.x && box.high.y >= want.high.y &&
                box.high.z >= want.high.z);
    // The box of a box that is turned: at most twice as long.
    assert_true(vec_length(vec_sub(box.high, box.low)) <
                2.0 * vec_length(vec_sub(want.high, want.low)));
}

static bool holds(const Box *box, Vec3 p) {
    return p.x >= box->low.x && p.x <= box->high.x && p.y >= box->low.y && p.y <= box->high.y &&
           p.z >= box->low.z && p.z <= box->high.z;
}

static Vec3 random_direction(Rng *rng) {
    for (;;) {
        Vec3 v = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        double length = vec_length(v);
        if (length > 0.1 && length < 1.0)
            return vec_scale(v, 1.0 / length);
    }
}

// The plane that a ray from within all comes to first; INFINITY: none.
static double first_plane(const PlaneShape *planes, uint32_t count, Vec3 org, Vec3 dir,
                          uint32_t *own) {
    double nearest = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double slope = vec_dot(planes[i].normal, dir);
        double t = (planes[i].distance - vec_dot(planes[i].normal, org)) / slope;
        if (slope > 0.0 && t < nearest)
            nearest = t, *own = i;
    }
    return nearest;
}

// Rays at random from within bodies of 4 to 14 planes: where they leave is in the boxes.
static void test_boxes_of_planes_hold_their_faces(void **state) {
    (void)state;
    Rng rng = {.state = 77};
    int bodies = 0, open = 0, tight = 0;
    for (int round = 0; round < 200; round++) {
        PlaneShape planes[14];
        uint32_t count = 4 + (uint32_t)(rng_unit(&rng) * 11.0), own;
        double scale = pow(10.0, rng_range(&rng, -3, 3));
        Vec3 middle = vec_scale(random_direction(&rng), 3.0 * scale);
        for (uint32_t i = 0; i < count; i++) {
            Vec3 n = random_direction(&rng);
            planes[i] = (PlaneShape){n, vec_dot(n, middle) + scale * rng_range(&rng, 0.2, 1)};
        }
        Box all, faces[SHAPE_MOST_PLANES], seen = box_empty();
        bool closed = shape_planes_box(planes, count, &all, faces);
        bodies += closed, open += !closed;
        bool leaks = false;
        for (int r = 0; r < 2000; r++) {
            Vec3 dir = random_direction(&rng);
            double t = first_plane(planes, count, middle, dir, &own);
            leaks = leaks || !isfinite(t);
            if (!closed || leaks)
                continue;
            Vec3 p = vec_madd(middle, t, dir);
            assert_true(holds(&all, p) && holds(&faces[own], p));
            seen = box_extend(seen, p);
        }
        assert_false(closed && leaks);
        // Not much wider than what was seen, but for needles.
        tight += closed && vec_length(vec_sub(all.high, all.low)) <
                               1.5 * vec_length(vec_sub(seen.high, seen.low));
    }
    print_message("%d bodies, %d of them tight; %d open\n", bodies, tight, open);
    assert_true(bodies > 50 && open > 20 && 4 * tight > 3 * bodies);
}

static void test_box_of_a_turned_cube_is_its_own(void **state) {
    (void)state;
    const double k = sqrt(0.5);
    PlaneShape planes[7] = {{{k, k, 0}, k}, {{-k, -k, 0}, k}, {{k, -k, 0}, k}, {{-k, k, 0}, k},
                            {{0, 0, 1}, 2}, {{0, 0, -1}, 3},  {{1, 0, 0}, 5}};
    Box all, faces[SHAPE_MOST_PLANES];
    assert_true(shape_planes_box(planes, 6, &all, faces));
    assert_true(fabs(all.high.x - 1) < 1e-5 && fabs(all.low.y + 1) < 1e-5);
    assert_true(fabs(all.high.z - 2) < 1e-5 && fabs(all.low.z + 3) < 1e-5);
    assert_true(fabs(faces[0].low.x) < 1e-5 && fabs(faces[0].high.x - 1) < 1e-5);
    assert_true(fabs(faces[4].low.z - 2) < 1e-5);
    assert_true(shape_planes_box(planes, 7, &all, faces));
    assert_true(faces[6].low.x > faces[6].high.x); // beyond the body
    assert_false(shape_planes_box(planes, 5, &all, faces));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_keeps_all_points),
        cmocka_unit_test(test_plane_along_an_axis_cuts),
        cmocka_unit_test(test_hyperboloid_between_planes_is_finite),
        cmocka_unit_test(test_turned_cylinder_between_planes_is_finite),
        cmocka_unit_test(test_boxes_of_planes_hold_their_faces),
        cmocka_unit_test(test_box_of_a_turned_cube_is_its_own),
    };
    return cmocka_run_group_tests_name("within", tests, create_arena, destroy_arena);
}
