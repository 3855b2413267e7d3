// SPDX-License-Identifier: MIT
// Copies held once: a definition seen through instances is what its objects are when each is moved
// itself, for rays of all kinds and points.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/rng.h"
#include "tests/world_stage.h"

#include <math.h>

enum { PARTS = 12, COPIES = 9 };

static Vec3 random_vec(Rng *rng, double size) {
    double x = rng_range(rng, -size, size), y = rng_range(rng, -size, size);
    return vec3(x, y, rng_range(rng, -size, size));
}

static Transform random_move(Rng *rng, bool mirrored, bool even, double away) {
    Transform t = transform_rotate(random_vec(rng, 180));
    double s = rng_range(rng, 0.4, 1.6), z = even ? s : rng_range(rng, 0.4, 1.6);
    Transform scale = transform_scale(vec3(mirrored ? -s : s, s, z));
    Transform move = transform_translate(random_vec(rng, away));
    t = transform_compose(&t, &scale);
    return transform_compose(&t, &move);
}

static PatchShape random_patch(Rng *rng, Arena *arena) {
    PatchShape patch = {.degree_u = 3, .degree_v = 3, .u_steps = 2, .v_steps = 2};
    Vec3 corner = random_vec(rng, 1);
    patch.points = ARENA_ARRAY(arena, Vec3, 16);
    for (int i = 0; i < 16; i++) {
        Vec3 at = vec3(0.4 * (i / 4), 0.4 * (i % 4), 0);
        patch.points[i] = vec_add(corner, vec_add(at, random_vec(rng, 0.3)));
    }
    return patch;
}

static PatchShape moved_patch(const PatchShape *patch, const Transform *t, Arena *arena) {
    PatchShape moved = *patch;
    moved.points = ARENA_ARRAY(arena, Vec3, 16);
    for (int i = 0; i < 16; i++)
        moved.points[i] = transform_point(t, patch->points[i]);
    return moved;
}

static Object random_part(Rng *rng, Arena *arena, bool patches) {
    static const ObjectType types[] = {OBJECT_SPHERE,   OBJECT_BOX,  OBJECT_TORUS,
                                       OBJECT_CYLINDER, OBJECT_DISC, OBJECT_PATCH};
    Object object = object_default(types[rng_next(rng) % (patches ? 6 : 5)]);
    Vec3 a = random_vec(rng, 1);
    double r = rng_range(rng, 0.1, 0.4);
    switch (object.type) {
    case OBJECT_SPHERE:
        object.shape.sphere = (SphereShape){a, r};
        break;
    case OBJECT_BOX:
        object.shape.box = (BoxShape){a, vec_add(a, vec3(r, 2 * r, r))};
        break;
    case OBJECT_TORUS:
        object.shape.torus = (TorusShape){3 * r, 0.5 * r};
        break;
    case OBJECT_CYLINDER:
        object.shape.cone = (ConeShape){a, vec_add(a, random_vec(rng, 1)), r, r, false};
        break;
    case OBJECT_PATCH:
        object.shape.patch = random_patch(rng, arena);
        object.no_reflection = rng_next(rng) % 4 == 0;
        return object;
    default:
        object.shape.disc = (DiscShape){a, vec_normalize(random_vec(rng, 1)), 2 * r, 0.5 * r};
        break;
    }
    object.has_transform = true;
    object.transform = random_move(rng, false, false, 0.5);
    object.no_image = rng_next(rng) % 4 == 0;
    return object;
}

// The same objects twice: copies of one definition, and each part moved by itself.
typedef struct {
    Stage shared, apart;
    uint32_t first_apart[COPIES]; // first part of each copy
} Pair;

// A scene stays where its world was made. Patches are only moved as a whole: normals between the
// corners of triangles are not those of a stretched patch.
static void make_pair(Pair *pair, Rng *rng, ObjectType tree, bool mirrored, bool patches) {
    *pair = (Pair){.shared = stage_begin(), .apart = stage_begin()};
    Object parts[PARTS];
    uint32_t items[PARTS];
    for (uint32_t i = 0; i < PARTS; i++) {
        parts[i] = random_part(rng, pair->shared.arena, patches);
        items[i] = stage_put(&pair->shared, &parts[i]);
    }
    array_push(&pair->shared.definitions, stage_put_group(&pair->shared, tree, items, PARTS));
    for (uint32_t c = 0; c < COPIES; c++) {
        Transform t = random_move(rng, mirrored && c % 2, patches, 4);
        Object instance = object_default(OBJECT_INSTANCE);
        instance.has_transform = true;
        instance.transform = t;
        stage_put_root(&pair->shared, stage_put(&pair->shared, &instance));
        for (uint32_t i = 0; i < PARTS; i++) {
            Object part = parts[i];
            if (part.type == OBJECT_PATCH)
                part.shape.patch = moved_patch(&part.shape.patch, &t, pair->apart.arena);
            else
                part.transform = transform_compose(&part.transform, &t);
            items[i] = stage_put(&pair->apart, &part);
        }
        pair->first_apart[c] = items[0];
        stage_put_root(&pair->apart, stage_put_group(&pair->apart, tree, items, PARTS));
    }
    stage_ready(&pair->shared, false);
    stage_ready(&pair->apart, false);
}

// The object of the second stage that shows what the place of the first does.
static uint32_t same_apart(const Pair *pair, uint32_t object, uint32_t instance) {
    // Definition first, then the instances one by one; parts in their order.
    uint32_t copy = instance - (PARTS + 1);
    return pair->first_apart[copy] + object;
}

static int compare_rays(Pair *pair, Rng *rng, int count) {
    int met = 0;
    for (int i = 0; i < count; i++) {
        Ray ray = {random_vec(rng, 8), {0, 0, 0}};
        ray.dir = vec_sub(random_vec(rng, 4), ray.org);
        double far = i % 3 ? INFINITY : rng_range(rng, 0.1, 2);
        RayKind kind = i % 2 ? RAY_CAMERA : RAY_REFLECTION;
        WorldHit a, b;
        RayStats stats = {0};
        bool one = world_intersect(pair->shared.world, &ray, 1e-4, far, kind, &stats, &a);
        bool two = world_intersect(pair->apart.world, &ray, 1e-4, far, kind, &stats, &b);
        assert_int_equal(one, two);
        assert_int_equal(world_occluded(pair->shared.world, &ray, 1e-4, far, &stats),
                         world_occluded(pair->apart.world, &ray, 1e-4, far, &stats));
        if (!one)
            continue;
        met++;
        assert_int_equal(same_apart(pair, a.object, a.instance), b.object);
        assert_int_equal(b.instance, NO_INDEX);
        assert_true(fabs(a.t - b.t) <= 1e-9 * (1 + b.t));
        assert_true(vec_length(vec_sub(a.p, b.p)) <= 1e-9 * (1 + b.t));
        // The outside of a patch does not turn with it under a mirror, that of a copy does.
        const Object *object = &pair->shared.objects.items[a.object];
        bool turned = object->type == OBJECT_PATCH && vec_dot(a.normal, b.normal) < 0;
        Vec3 normal = turned ? vec_neg(a.normal) : a.normal;
        assert_true(vec_length(vec_sub(normal, b.normal)) <= 1e-6);
    }
    return met;
}

static int compare_points(Pair *pair, Rng *rng, int count) {
    int inside = 0;
    for (int i = 0; i < count; i++) {
        Vec3 p = random_vec(rng, 7);
        WorldPlace a[64], b[64];
        uint32_t one = world_containing(pair->shared.world, p, a, 64);
        uint32_t two = world_containing(pair->apart.world, p, b, 64);
        assert_int_equal(one, two);
        for (uint32_t k = 0; k < one; k++)
            assert_int_equal(same_apart(pair, a[k].object, a[k].instance), b[k].object);
        inside += one > 0;
        if (one > 1)
            assert_int_equal(world_containing(pair->shared.world, p, a, 1), 1);
    }
    return inside;
}

static void test_copies(void **state) {
    (void)state;
    static const ObjectType trees[] = {OBJECT_UNION, OBJECT_MERGE, OBJECT_INTERSECTION};
    int met = 0, inside = 0;
    for (uint64_t seed = 1; seed <= 24; seed++) {
        Rng rng = {seed * 77};
        Pair pair;
        make_pair(&pair, &rng, trees[seed % 3], seed % 2, seed % 4 < 2);
        met += compare_rays(&pair, &rng, 300);
        inside += compare_points(&pair, &rng, 300);
        stage_end(&pair.shared);
        stage_end(&pair.apart);
    }
    print_message("%d rays met, %d points inside\n", met, inside);
    assert_true(met > 1000 && inside > 500);
}

// Where copies touch, and where one lies on what is no copy, the order of the source decides, to
// the last bit: without that the picture of a tiled floor is speckled.
static void test_same_place(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object box = stage_box(vec3(-0.5, -1, -0.5), vec3(0.5, 0, 0.5));
    array_push(&stage.definitions, stage_put(&stage, &box));
    uint32_t first = 0;
    for (int k = 0; k < 8; k++) {
        // All in the same place, turned by quarters.
        Object instance = object_default(OBJECT_INSTANCE);
        Transform turn = transform_rotate(vec3(0, 90 * k, 0));
        Transform move = transform_translate(vec3(0.3, 0.7, 0.1));
        instance.has_transform = true;
        instance.transform = transform_compose(&turn, &move);
        uint32_t index = stage_put(&stage, &instance);
        first = k == 0 ? index : first;
        stage_put_root(&stage, index);
    }
    Object later = stage_box(vec3(-0.2, -0.3, -0.4), vec3(0.8, 0.7, 0.6));
    stage_put_root(&stage, stage_put(&stage, &later));
    stage_ready(&stage, false);
    Rng rng = {5};
    for (int i = 0; i < 3000; i++) {
        Vec3 org = vec_add(random_vec(&rng, 3), vec3(0, 5, 0));
        Vec3 to = vec3(rng_range(&rng, -0.15, 0.75), 0.7, rng_range(&rng, -0.35, 0.55));
        Ray ray = {org, vec_normalize(vec_sub(to, org))};
        WorldHit hit;
        RayStats stats = {0};
        assert_true(world_intersect(stage.world, &ray, 0, INFINITY, RAY_CAMERA, &stats, &hit));
        assert_int_equal(hit.instance, first);
    }
    stage_end(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_copies),
        cmocka_unit_test(test_same_place),
    };
    return cmocka_run_group_tests_name("instances", tests, NULL, NULL);
}
