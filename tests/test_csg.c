// SPDX-License-Identifier: MIT
// Trees of unions, merges, intersections and clips against the membership function: along random
// rays the hits are where, and only where, membership changes. Primitives are tested by formulas of
// their own here. Patches, which have no inside, show where membership of their surroundings holds.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "tests/world_stage.h"

#include <math.h>

// ---- membership by mathematics --------------------------------------------------------------

static bool in_cone(const ConeShape *cone, Vec3 p) {
    Vec3 axis = vec_sub(cone->apex, cone->base);
    double length2 = vec_dot(axis, axis), h = vec_dot(vec_sub(p, cone->base), axis) / length2;
    double r = cone->base_radius + h * (cone->apex_radius - cone->base_radius);
    Vec3 off = vec_sub(p, vec_madd(cone->base, h, axis));
    return h >= 0 && h <= 1 && vec_dot(off, off) <= r * r;
}

static bool in_leaf(const Object *object, Vec3 p) {
    Vec3 q = object->has_transform ? transform_inv_point(&object->transform, p) : p;
    switch (object->type) {
    case OBJECT_PLANE:
        return vec_dot(object->shape.plane.normal, p) <= object->shape.plane.distance;
    case OBJECT_SPHERE: {
        Vec3 d = vec_sub(q, object->shape.sphere.center);
        return vec_dot(d, d) <= object->shape.sphere.radius * object->shape.sphere.radius;
    }
    case OBJECT_BOX: {
        const BoxShape *box = &object->shape.box;
        return q.x >= box->low.x && q.x <= box->high.x && q.y >= box->low.y && q.y <= box->high.y &&
               q.z >= box->low.z && q.z <= box->high.z;
    }
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        return in_cone(&object->shape.cone, q);
    case OBJECT_TORUS: {
        double ring = sqrt(q.x * q.x + q.z * q.z) - object->shape.torus.major;
        return ring * ring + q.y * q.y <= object->shape.torus.minor * object->shape.torus.minor;
    }
    default:
        return false;
    }
}

static bool member(const Stage *stage, uint32_t index, Vec3 p) {
    const Object *object = &stage->objects.items[index];
    for (uint32_t i = 0; i < object->clips.count; i++)
        if (!member(stage, object->clips.items[i], p))
            return false;
    if (!object_is_tree(object))
        return object->type != OBJECT_PATCH && in_leaf(object, p) != object->inverse;
    bool all = object->type == OBJECT_INTERSECTION;
    for (uint32_t i = 0; i < object->shape.children.count; i++)
        if (member(stage, object->shape.children.items[i], p) != all)
            return !all;
    return all;
}

// ---- random trees ---------------------------------------------------------------------------

static Vec3 random_vec(Rng *rng, double range) {
    double x = rng_range(rng, -range, range), y = rng_range(rng, -range, range);
    return vec3(x, y, rng_range(rng, -range, range));
}

static uint32_t random_leaf(Stage *stage, Rng *rng) {
    Object object = object_default((ObjectType)(OBJECT_PLANE + rng_next(rng) % 6));
    Vec3 a = random_vec(rng, 1);
    double r = rng_range(rng, 0.4, 1.3);
    switch (object.type) {
    case OBJECT_PLANE:
        object.shape.plane = (PlaneShape){vec_normalize(a), rng_range(rng, -0.3, 0.8)};
        return stage_put(stage, &object);
    case OBJECT_SPHERE:
        object.shape.sphere = (SphereShape){a, r};
        break;
    case OBJECT_BOX:
        object.shape.box = (BoxShape){vec_sub(a, vec3(r, r, r)), vec_add(a, vec3(r, r / 2, r))};
        break;
    case OBJECT_CYLINDER:
        object.shape.cone = (ConeShape){a, vec_add(a, vec3(0, 0.5 + r, a.x)), r / 2, r / 2, false};
        break;
    case OBJECT_CONE:
        object.shape.cone = (ConeShape){a, vec_add(a, vec3(0, 0.5 + r, a.x)), r, r / 3, false};
        break;
    default:
        object.shape.torus = (TorusShape){r, 0.3 * r};
        break;
    }
    object.inverse = rng_next(rng) % 3 == 0;
    object.has_transform = rng_next(rng) % 2;
    if (object.has_transform) {
        Transform turn = transform_rotate(random_vec(rng, 180));
        Transform move = transform_translate(random_vec(rng, 0.5));
        object.transform = transform_compose(&turn, &move);
    }
    return stage_put(stage, &object);
}

static uint32_t random_tree(Stage *stage, Rng *rng, int depth, bool clips) {
    if (depth == 0 || rng_next(rng) % 5 == 0)
        return random_leaf(stage, rng);
    uint32_t items[3], count = 2 + (uint32_t)(rng_next(rng) % 2);
    for (uint32_t i = 0; i < count; i++)
        items[i] = random_tree(stage, rng, depth - 1, clips);
    ObjectType type = rng_next(rng) % 3 ? OBJECT_INTERSECTION : OBJECT_MERGE;
    uint32_t tree = stage_put_group(stage, type, items, count);
    if (clips && rng_next(rng) % 4 == 0) {
        uint32_t clip = random_tree(stage, rng, depth - 1, false);
        Object *object = &stage->objects.items[tree];
        object->clips = (ObjectList){arena_copy(stage->arena, &clip, sizeof clip), 1};
    }
    return tree;
}

// ---- the tests ------------------------------------------------------------------------------

// Hits one behind the other; `min` is POV-Ray's own least depth and more: 1e-4.
static int all_hits(const World *world, const Ray *ray, double *t, int max) {
    WorldHit hit;
    int count = 0;
    double from = 1e-4;
    while (count < max && world_intersect(world, ray, from, INFINITY, RAY_CAMERA, NULL, &hit)) {
        t[count++] = hit.t;
        from = nextafter(hit.t, INFINITY);
    }
    return count;
}

// Far above the rounding of a hit (the torus: 1e-7) and below what random surfaces leave between
// them, but for a few rays.
static const double GAP = 1e-5;

// Without clips each hit is a change and each change a hit; two hits closer than GAP say nothing.
static void test_hits_are_changes(void **state) {
    (void)state;
    int hits = 0, gaps = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        Rng rng = {seed * 77};
        Stage stage = stage_begin();
        uint32_t root = random_tree(&stage, &rng, 1 + (int)(seed % 4), false);
        stage_put_root(&stage, root);
        stage_ready(&stage, false);
        for (int i = 0; i < 60; i++) {
            Ray ray = {random_vec(&rng, 4), {0, 0, 0}};
            ray.dir = vec_normalize(vec_sub(random_vec(&rng, 1), ray.org));
            double t[256];
            int count = all_hits(stage.world, &ray, t + 1, 250);
            assert_true(count < 250);
            t[0] = 1e-3, t[count + 1] = count > 0 ? t[count] + 20 : 20;
            for (int k = 0; k <= count; k++) {
                if (t[k + 1] - t[k] < 4 * GAP)
                    continue;
                // Between two hits membership is one and the same, on both sides of a hit not.
                bool here = member(&stage, root, vec_madd(ray.org, t[k] + GAP, ray.dir));
                for (int s = 1; s <= 20; s++) {
                    double at = t[k] + GAP + (t[k + 1] - t[k] - 2 * GAP) * s / 20.0;
                    if (member(&stage, root, vec_madd(ray.org, at, ray.dir)) != here)
                        fail_msg("seed %llu ray %d: membership changes without a hit before %.17g",
                                 (unsigned long long)seed, i, at);
                }
                gaps++;
                if (k == 0 || t[k] - t[k - 1] < 4 * GAP)
                    continue;
                if (member(&stage, root, vec_madd(ray.org, t[k] - GAP, ray.dir)) == here)
                    fail_msg("seed %llu ray %d: a hit at %.17g, but no change",
                             (unsigned long long)seed, i, t[k]);
                hits++;
            }
        }
        stage_end(&stage);
    }
    print_message("%d hits, %d gaps\n", hits, gaps);
    assert_true(hits > 5000 && gaps > 20000);
}

// A clip opens the walls: each hit then lies on the surface without its clips, and inside them.
// world_inside is membership with them.
static void test_clips_and_inside(void **state) {
    (void)state;
    int inside = 0;
    for (uint64_t seed = 1; seed <= 150; seed++) {
        Rng rng = {seed * 991};
        Stage stage = stage_begin();
        uint32_t root = random_tree(&stage, &rng, 1 + (int)(seed % 4), true);
        stage_put_root(&stage, root);
        stage_ready(&stage, false);
        for (int i = 0; i < 300; i++) {
            Vec3 p = random_vec(&rng, 1.5);
            bool want = member(&stage, root, p);
            assert_int_equal(world_inside(stage.world, root, p), want);
            inside += want;
            // A leaf fills p as far as the whole does.
            WorldPlace found[64];
            uint32_t count = world_containing(stage.world, p, found, 64);
            if (!want)
                assert_int_equal(count, 0);
            for (uint32_t k = 0; k < count; k++)
                assert_true(member(&stage, found[k].object, p));
        }
        stage_end(&stage);
    }
    print_message("%d points inside\n", inside);
    assert_true(inside > 4000);
}

// Clips, and patches in trees: a hit counts where all that surrounds the surface holds.
static void test_surfaces_in_trees(void **state) {
    (void)state;
    int seen = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= 120; seed++) {
        Rng rng = {seed * 4241};
        Stage stage = stage_begin();
        Object patch = stage_flat_patch(&stage, 0.1);
        for (int i = 0; i < 16; i++)
            patch.shape.patch.points[i] =
                vec3(i / 4 - 1.5, i % 4 - 1.5, rng_range(&rng, -0.6, 0.6));
        uint32_t alone = stage_put(&stage, &patch);
        uint32_t other = random_tree(&stage, &rng, 2, true);
        bool clip = seed % 3 == 0, merge = seed % 3 == 1;
        uint32_t items[2] = {alone, other}, root;
        if (clip) {
            root = stage_put_group(&stage, OBJECT_UNION, items, 1);
            stage.objects.items[root].clips =
                (ObjectList){arena_copy(stage.arena, &other, sizeof other), 1};
        } else {
            root = stage_put_group(&stage, merge ? OBJECT_MERGE : OBJECT_INTERSECTION, items, 2);
        }
        stage_put_root(&stage, root);
        stage_ready(&stage, true);
        for (int i = 0; i < 100; i++) {
            Ray ray = {random_vec(&rng, 4), {0, 0, 0}};
            ray.dir = vec_normalize(vec_sub(random_vec(&rng, 1), ray.org));
            PatchHit single;
            if (!patchset_intersect(stage.patches[alone], &ray, 1e-4, INFINITY, RAY_ALL, NULL,
                                    &single))
                continue;
            bool there = member(&stage, other, vec_madd(ray.org, single.t, ray.dir)) != merge;
            WorldHit hit;
            bool found = world_intersect(stage.world, &ray, single.t, nextafter(single.t, INFINITY),
                                         RAY_CAMERA, NULL, &hit);
            assert_int_equal(found, there);
            if (found)
                assert_int_equal(hit.object, alone);
            seen += there, hidden += !there;
        }
        stage_end(&stage);
    }
    print_message("%d seen, %d hidden\n", seen, hidden);
    assert_true(seen > 1000 && hidden > 1000);
}

// A clipped ball shows its far wall through the opening: the same hits as without, but inside.
static void test_clips_open(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object half = {.type = OBJECT_PLANE, .shape.plane = {{0, 0, -1}, 0}}; // z > 0
    uint32_t plane = stage_put(&stage, &half);
    Object ball = stage_sphere(vec3(0, 0, 0), 1);
    ball.clips = (ObjectList){&plane, 1};
    stage_put_root(&stage, stage_put(&stage, &ball));
    stage_ready(&stage, false);
    Ray ray = {{0.1, 0.2, -5}, {0, 0, 1}};
    WorldHit hit;
    assert_true(world_intersect(stage.world, &ray, 0, INFINITY, RAY_CAMERA, NULL, &hit));
    assert_true(hit.p.z > 0.9);
    assert_true(world_occluded(stage.world, &ray, 0, INFINITY, NULL));
    assert_false(world_occluded(stage.world, &ray, 0, 5, NULL));
    assert_true(world_inside(stage.world, 1, vec3(0, 0, 0.5)));
    assert_false(world_inside(stage.world, 1, vec3(0, 0, -0.5)));
    stage_end(&stage);
}

// Many children, of which a point meets few: merges of small bodies, walls with small holes, in
// each other; and bodies without a box among them. Also hit by hit.
static uint32_t wide_tree(Stage *stage, Rng *rng, bool holes) {
    enum { CHILDREN = 60 };
    uint32_t items[CHILDREN];
    for (int i = 0; i < CHILDREN; i++) {
        items[i] = random_leaf(stage, rng);
        Object *object = &stage->objects.items[items[i]];
        if (i % 20 == 3 || object->type == OBJECT_PLANE) {
            *object = stage_box(vec3(-1.5, -1.5, -1.5), vec3(1.5, 1.5, 1.5));
            if (!holes)
                object->shape.box.low.y = 1.2;
            continue;
        }
        Transform small = transform_scale(vec3(0.3, 0.3, 0.3));
        Transform move = transform_translate(random_vec(rng, 1.3));
        if (object->has_transform)
            small = transform_compose(&object->transform, &small);
        object->has_transform = true;
        object->transform = transform_compose(&small, &move);
        object->inverse = holes;
    }
    return stage_put_group(stage, holes ? OBJECT_INTERSECTION : OBJECT_MERGE, items, CHILDREN);
}

static void test_wide(void **state) {
    (void)state;
    int inside = 0, outside = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        Rng rng = {seed * 5};
        Stage stage = stage_begin();
        uint32_t a = wide_tree(&stage, &rng, seed % 2), b = wide_tree(&stage, &rng, seed % 3 == 0);
        uint32_t items[2] = {a, b};
        uint32_t root =
            stage_put_group(&stage, seed % 4 < 2 ? OBJECT_MERGE : OBJECT_INTERSECTION, items, 2);
        stage_put_root(&stage, root);
        stage_ready(&stage, false);
        for (int i = 0; i < 400; i++) {
            Vec3 p = random_vec(&rng, 1.6);
            bool want = member(&stage, root, p);
            assert_int_equal(world_inside(stage.world, root, p), want);
            inside += want, outside += !want;
            // Every hit is where the whole begins or ends.
            Ray ray = {p, vec_normalize(random_vec(&rng, 1))};
            double t[16];
            int count = all_hits(stage.world, &ray, t, 16);
            for (int k = 0; k < count; k++) {
                bool before = member(&stage, root, vec_madd(p, t[k] - 1e-7, ray.dir));
                bool after = member(&stage, root, vec_madd(p, t[k] + 1e-7, ray.dir));
                assert_true(before != after);
            }
        }
        stage_end(&stage);
    }
    print_message("%d points inside, %d outside\n", inside, outside);
    assert_true(inside > 500 && outside > 500);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_wide),
        cmocka_unit_test(test_hits_are_changes),
        cmocka_unit_test(test_clips_and_inside),
        cmocka_unit_test(test_surfaces_in_trees),
        cmocka_unit_test(test_clips_open),
    };
    return cmocka_run_group_tests_name("csg", tests, NULL, NULL);
}
