// SPDX-License-Identifier: MIT
// The World against a brute force that walks the scene's trees for every ray.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/usage.h"
#include "base/rng.h"
#include "render/world.h"
#include "shape/shape.h"
#include "tests/world_stage.h"

#include <stdio.h>

// ---- the brute force ------------------------------------------------------------------------

static bool brute_inside(const Stage *stage, uint32_t index, Vec3 p) {
    const Object *object = &stage->objects.items[index];
    if (!stage_is_group(object))
        return shape_inside(&stage->shapes[index], p);
    for (uint32_t i = 0; i < object->shape.children.count; i++)
        if (brute_inside(stage, object->shape.children.items[i], p))
            return true;
    return false;
}

typedef struct {
    double t;
    uint32_t object;
} BruteHit;

typedef ARRAY(BruteHit) BruteHits;

typedef struct {
    BruteHits *hits;
    uint32_t object;
} PatchCollector;

static void collect_patch(void *context, const PatchHit *hit) {
    PatchCollector *collector = context;
    array_push(collector->hits, ((BruteHit){hit->t, collector->object}));
}

// Every hit that a merge around does not drop, the object's flags aside.
static void brute_hits(const Stage *stage, uint32_t index, const Ray *ray, BruteHits *hits) {
    const Object *object = &stage->objects.items[index];
    if (object->type == OBJECT_PATCH) {
        PatchCollector collector = {hits, index};
        patchset_all(stage->patches[index], ray, 1e-5, INFINITY, RAY_ALL, NULL, collect_patch,
                     &collector);
        return;
    }
    if (!stage_is_group(object)) {
        ShapeHit found[SHAPE_MAX_HITS];
        int count = shape_hits(&stage->shapes[index], ray, found);
        for (int i = 0; i < count; i++)
            array_push(hits, ((BruteHit){found[i].t, index}));
        return;
    }
    for (uint32_t i = 0; i < object->shape.children.count; i++) {
        size_t kept = hits->count;
        brute_hits(stage, object->shape.children.items[i], ray, hits);
        size_t end = hits->count;
        for (size_t h = kept; h < end; h++) {
            Vec3 p = vec_madd(ray->org, hits->items[h].t, ray->dir);
            bool dropped = false;
            for (uint32_t j = 0; j < object->shape.children.count && !dropped; j++)
                dropped = object->type == OBJECT_MERGE && j != i &&
                          brute_inside(stage, object->shape.children.items[j], p);
            if (!dropped)
                hits->items[kept++] = hits->items[h];
        }
        hits->count = kept;
    }
}

static BruteHit brute_nearest(const Stage *stage, const Ray *ray, double t_min, double t_max) {
    BruteHits hits = {0};
    BruteHit best = {t_max, NO_INDEX};
    for (size_t i = 0; i < stage->roots.count; i++)
        brute_hits(stage, stage->roots.items[i], ray, &hits);
    for (size_t i = 0; i < hits.count; i++)
        if (hits.items[i].t >= t_min && hits.items[i].t < best.t)
            best = hits.items[i];
    array_free(&hits);
    return best;
}

// ---- random things --------------------------------------------------------------------------

static Vec3 random_vec(Rng *rng, double range) {
    double x = rng_range(rng, -range, range), y = rng_range(rng, -range, range);
    return vec3(x, y, rng_range(rng, -range, range));
}

static Transform random_transform(Rng *rng) {
    Transform t = transform_identity();
    if (rng_next(rng) % 3) {
        Transform s = transform_scale(
            vec3(rng_range(rng, 0.3, 2), rng_range(rng, -2, -0.3), rng_range(rng, 0.3, 2)));
        Transform r = transform_rotate(random_vec(rng, 180));
        t = transform_compose(&s, &r);
    }
    Transform m = transform_translate(random_vec(rng, 4));
    return transform_compose(&t, &m);
}

static Object random_object(Stage *stage, Rng *rng, ObjectType type) {
    Object object = {.type = type,
                     .inverse = rng_next(rng) % 8 == 0,
                     .has_transform = true,
                     .transform = random_transform(rng)};
    switch (type) {
    case OBJECT_PLANE:
        object.shape.plane = (PlaneShape){vec_normalize(random_vec(rng, 1)), rng_range(rng, 5, 9)};
        break;
    case OBJECT_SPHERE:
        object.shape.sphere = (SphereShape){random_vec(rng, 0.5), rng_range(rng, 0.2, 1.2)};
        break;
    case OBJECT_BOX:
        object.shape.box = (BoxShape){random_vec(rng, 1), random_vec(rng, 1)};
        break;
    case OBJECT_CYLINDER:
    case OBJECT_CONE: {
        double r = rng_range(rng, 0.2, 0.9);
        object.shape.cone =
            (ConeShape){random_vec(rng, 1), random_vec(rng, 1), r,
                        type == OBJECT_CONE ? rng_range(rng, 0, 1) : r, rng_next(rng) % 2};
        break;
    }
    case OBJECT_TORUS:
        object.shape.torus = (TorusShape){rng_range(rng, 0.4, 1), rng_range(rng, 0.1, 0.5)};
        break;
    case OBJECT_DISC:
        object.shape.disc = (DiscShape){random_vec(rng, 0.5), vec_normalize(random_vec(rng, 1)),
                                        rng_range(rng, 0.5, 1.2), rng_range(rng, 0, 0.4)};
        break;
    case OBJECT_TRIANGLE:
        for (int i = 0; i < 3; i++)
            object.shape.triangle.p[i] = random_vec(rng, 3);
        break;
    case OBJECT_PATCH: {
        PatchShape *patch = &object.shape.patch;
        *patch = (PatchShape){.degree_u = 3, .degree_v = 3, .type = 1, .u_steps = 2, .v_steps = 2};
        patch->points = ARENA_ARRAY(stage->arena, Vec3, 16);
        Vec3 center = random_vec(rng, 3);
        for (int i = 0; i < 16; i++)
            patch->points[i] =
                vec_add(vec_add(center, random_vec(rng, 0.4)), vec3(i / 4 - 1.5, i % 4 - 1.5, 0));
        patch->uv[1] = (Vec2){1, 0}, patch->uv[2] = (Vec2){1, 1}, patch->uv[3] = (Vec2){0, 1};
        break;
    }
    default:
        break;
    }
    return object;
}

// Directions include axis-parallel ones, zeros and negative zeros.
static Ray random_ray(Rng *rng) {
    Ray ray = {random_vec(rng, 6), random_vec(rng, 1)};
    uint64_t kind = rng_next(rng) % 8;
    if (kind == 0)
        ray.dir = vec3(0, -0.0, rng_next(rng) % 2 ? 1 : -1);
    if (kind == 1)
        ray.dir = vec3(-0.0, rng_next(rng) % 2 ? 1 : -1, 0);
    if (kind == 2)
        ray.dir.x = 0;
    if (kind == 3)
        ray.org = vec3(floor(ray.org.x), floor(ray.org.y), floor(ray.org.z)), ray.dir.y = -0.0;
    ray.dir = vec_normalize(ray.dir);
    return ray;
}

// A sphere's normal is the way from its centre over the radius, as POV-Ray's: as long as the hit is
// exact. That comes from r^2 - (c^2 - b^2) with c the way to the centre: some roundings of c^2
// there are as many of (c / r)^2 / 2 in the normal's length.
static double length_error(const Stage *stage, const Ray *ray, const WorldHit *hit) {
    const Object *object = &stage->objects.items[hit->object];
    if (object->type != OBJECT_SPHERE || object->has_transform)
        return 1e-12;
    double far = vec_length(vec_sub(object->shape.sphere.center, ray->org));
    double ratio = far / object->shape.sphere.radius;
    return 1e-12 + 8.0 * 0x1p-53 * ratio * ratio;
}

static void compare_rays(const Stage *stage, Rng *rng, int count, int *hits) {
    uint32_t last = WORLD_NO_BLOCKER;
    for (int i = 0; i < count; i++) {
        uint64_t seed = rng->state;
        Ray ray = random_ray(rng);
        double t_max = rng_next(rng) % 4 ? INFINITY : rng_range(rng, 0, 8);
        BruteHit want = brute_nearest(stage, &ray, 1e-4, t_max);
        WorldHit got;
        RayStats stats = {0};
        bool hit = world_intersect(stage->world, &ray, 1e-4, t_max, RAY_CAMERA, &stats, &got);
        if (hit != (want.object != NO_INDEX) || (hit && got.t != want.t))
            fail_msg("seed %llu: %s t %.17g object %u, brute force t %.17g object %u",
                     (unsigned long long)seed, hit ? "hit" : "miss", hit ? got.t : 0.0,
                     hit ? got.object : 0, want.t, want.object);
        assert_int_equal(world_occluded(stage->world, &ray, 1e-4, t_max, &stats), hit);
        // Whatever blocked the rays before.
        WorldNear near = {1e-4, 1e-4};
        assert_int_equal(world_blocked(stage->world, &ray, near, t_max, &last, NULL), hit);
        *hits += hit;
        if (!hit)
            continue;
        assert_true(fabs(vec_length(got.normal) - 1.0) < length_error(stage, &ray, &got));
        assert_true(isfinite(got.u) && isfinite(got.v) && vec_is_finite(got.p));
    }
}

// ---- tests ----------------------------------------------------------------------------------

static void test_nearest_is_brute_force(void **state) {
    (void)state;
    int hits = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        Rng rng = {seed};
        Stage stage = stage_begin();
        uint32_t count = (uint32_t)(seed * seed);
        for (uint32_t i = 0; i < count; i++) {
            ObjectType type = OBJECT_PATCH + (ObjectType)(rng_next(&rng) % 9);
            if (type == OBJECT_PLANE && rng_next(&rng) % 8)
                type = OBJECT_SPHERE;
            Object object = random_object(&stage, &rng, type);
            stage_put_root(&stage, stage_put(&stage, &object));
        }
        stage_ready(&stage, true);
        compare_rays(&stage, &rng, 400, &hits);
        stage_end(&stage);
    }
    print_message("%d hits\n", hits);
    assert_true(hits > 1500);
}

// A random tree of unions and merges; returns its root.
static uint32_t random_tree(Stage *stage, Rng *rng, int depth) {
    if (depth == 0 || rng_next(rng) % 4 == 0) {
        Object object = random_object(stage, rng, OBJECT_PATCH + (ObjectType)(rng_next(rng) % 9));
        // Bring them together, so that they overlap.
        if (object.type != OBJECT_PATCH)
            for (int i = 0; i < 3; i++)
                object.transform.m[3][i] *= 0.25;
        Transform t = object.transform;
        double rows[4][3];
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 3; j++)
                rows[i][j] = t.m[i][j];
        assert_true(transform_matrix(rows, &object.transform));
        object.inverse = object.inverse && depth == 0;
        return stage_put(stage, &object);
    }
    uint32_t items[4], count = 1 + (uint32_t)(rng_next(rng) % 4);
    for (uint32_t i = 0; i < count; i++)
        items[i] = random_tree(stage, rng, depth - 1);
    return stage_put_group(stage, rng_next(rng) % 3 ? OBJECT_MERGE : OBJECT_UNION, items, count);
}

static void test_merge_is_membership(void **state) {
    (void)state;
    int hits = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        Rng rng = {seed * 1000};
        Stage stage = stage_begin();
        for (uint64_t i = 0; i < 1 + seed % 3; i++)
            stage_put_root(&stage, random_tree(&stage, &rng, 3));
        stage_ready(&stage, true);
        compare_rays(&stage, &rng, 120, &hits);
        for (int i = 0; i < 200; i++) {
            Vec3 p = random_vec(&rng, 3);
            WorldPlace found[64], want[64];
            uint32_t want_count = 0;
            uint32_t found_count = world_containing(stage.world, p, found, 64);
            for (uint32_t o = 0; o < stage.objects.count; o++) {
                bool inside = brute_inside(&stage, o, p);
                assert_int_equal(world_inside(stage.world, o, p), inside);
                if (inside && !stage_is_group(&stage.objects.items[o]))
                    want[want_count++] = (WorldPlace){o, NO_INDEX};
            }
            // Leaves are stage_put before their groups here, in the order of the source.
            assert_int_equal(found_count, want_count);
            assert_memory_equal(found, want, want_count * sizeof *want);
            uint32_t two = world_containing(stage.world, p, found, 2);
            assert_int_equal(two, want_count < 2 ? want_count : 2);
            assert_memory_equal(found, want, two * sizeof *want);
        }
        stage_end(&stage);
    }
    assert_true(hits > 1500);
}

static void test_empty_and_one(void **state) {
    (void)state;
    Ray ray = {{0, 0, -5}, {0, 0, 1}};
    WorldHit hit;
    RayStats stats = {0};
    WorldPlace found[1];
    Stage stage = stage_begin();
    stage_ready(&stage, false);
    assert_false(world_intersect(stage.world, &ray, 0, INFINITY, RAY_CAMERA, &stats, &hit));
    assert_false(world_occluded(stage.world, &ray, 0, INFINITY, &stats));
    assert_int_equal(world_containing(stage.world, vec3(0, 0, 0), found, 1), 0);
    stage_end(&stage);

    stage = stage_begin();
    Object sphere = stage_sphere(vec3(0, 0, 0), 2);
    stage_put_root(&stage, stage_put(&stage, &sphere));
    stage_ready(&stage, false);
    assert_true(world_intersect(stage.world, &ray, 0, INFINITY, RAY_CAMERA, &stats, &hit));
    assert_true(hit.t == 3 && hit.object == 0 && hit.p.z == -2 && hit.normal.z == -1);
    // t counts in lengths of the direction.
    ray.dir.z = 0.5;
    assert_true(world_intersect(stage.world, &ray, 0, INFINITY, RAY_CAMERA, &stats, &hit));
    assert_true(hit.t == 6 && hit.p.z == -2);
    // The range is [t_min, t_max).
    assert_true(world_intersect(stage.world, &ray, 6, 6.5, RAY_CAMERA, &stats, &hit));
    assert_true(hit.t == 6);
    assert_false(world_intersect(stage.world, &ray, 1, 6, RAY_CAMERA, &stats, &hit));
    assert_true(world_intersect(stage.world, &ray, 6.5, 100, RAY_CAMERA, &stats, &hit));
    assert_true(hit.t == 14);
    assert_true(stats.shape_tests > 0 && stats.shape_hits > 0);
    assert_true(world_memory(stage.world) > 0);
    stage_end(&stage);
}

static void test_hostile_rays(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Rng rng = {7};
    for (uint32_t i = 0; i < 60; i++) {
        Object object = random_object(&stage, &rng, OBJECT_PATCH + (ObjectType)(i % 9));
        stage_put_root(&stage, stage_put(&stage, &object));
    }
    // Nothing to hit, and no harm: no radius, no length, no area, no thickness.
    Object nothing[] = {
        stage_sphere(vec3(0, 0, 0), 0),
        stage_box(vec3(1, 1, 1), vec3(1, 1, 1)),
        stage_box(vec3(-1, 0, -1), vec3(1, 0, 1)),
        {.type = OBJECT_CYLINDER},
        {.type = OBJECT_CONE, .shape.cone = {{0, 0, 0}, {0, 1, 0}, 0, 0, false}},
        {.type = OBJECT_TORUS},
        {.type = OBJECT_TORUS, .shape.torus = {1, 0}},
        {.type = OBJECT_TORUS, .shape.torus = {0, 1}},
        {.type = OBJECT_DISC},
        {.type = OBJECT_TRIANGLE},
        {.type = OBJECT_TRIANGLE, .shape.triangle = {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}},
        {.type = OBJECT_PLANE},
    };
    for (size_t i = 0; i < sizeof nothing / sizeof *nothing; i++)
        stage_put_root(&stage, stage_put(&stage, &nothing[i]));
    stage_ready(&stage, false);
    const double values[] = {0.0, -0.0, 1, -1, 1e-320, 1e-160, 1e300, INFINITY, -INFINITY, NAN};
    enum { COUNT = sizeof values / sizeof *values };
    WorldHit hit;
    for (int i = 0; i < 20000; i++) {
        double v[6];
        for (int k = 0; k < 6; k++)
            v[k] = rng_next(&rng) % 3 ? rng_range(&rng, -5, 5) : values[rng_next(&rng) % COUNT];
        Ray ray = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
        if (!world_intersect(stage.world, &ray, 1e-4, INFINITY, RAY_ALL, NULL, &hit))
            continue;
        assert_true(isfinite(hit.t) && vec_is_finite(hit.p) && vec_is_finite(hit.normal));
        assert_true(isfinite(hit.u) && isfinite(hit.v));
        assert_true(world_occluded(stage.world, &ray, 1e-4, INFINITY, NULL));
    }
    stage_end(&stage);
}

static bool sees(const Stage *stage, double x, RayKind kind) {
    Ray ray = {{x, 0, -5}, {0, 0, 1}};
    WorldHit hit;
    RayStats stats = {0};
    if (kind == RAY_SHADOW)
        return world_occluded(stage->world, &ray, 1e-4, INFINITY, &stats);
    return world_intersect(stage->world, &ray, 1e-4, INFINITY, kind, &stats, &hit);
}

// The flags as measured with POV-Ray: rows are no_image, no_reflection, no_shadow on one child.
static void test_flags(void **state) {
    (void)state;
    static const RayKind kinds[3] = {RAY_CAMERA, RAY_REFLECTION, RAY_SHADOW};
    enum { ALONE, IN_UNION, IN_MERGE, IN_UNION_IN_MERGE, IN_MERGE_IN_UNION, WAYS };
    static const bool hides[WAYS][3] = {
        {true, true, true},   {true, true, true},  {true, true, false},
        {false, true, false}, {true, true, false},
    };
    for (int way = 0; way < WAYS; way++)
        for (int flag = 0; flag < 3; flag++) {
            Stage stage = stage_begin();
            Object a = stage_sphere(vec3(0, 0, 0), 1), b = stage_sphere(vec3(3, 0, 0), 1);
            a.no_image = flag == 0;
            a.no_reflection = flag == 1;
            a.no_shadow = flag == 2;
            uint32_t items[2] = {stage_put(&stage, &a), stage_put(&stage, &b)};
            ObjectType inner =
                way == IN_MERGE || way == IN_MERGE_IN_UNION ? OBJECT_MERGE : OBJECT_UNION;
            if (way == ALONE) {
                stage_put_root(&stage, items[0]);
                stage_put_root(&stage, items[1]);
            } else {
                uint32_t root = stage_put_group(&stage, inner, items, 2);
                if (way == IN_UNION_IN_MERGE || way == IN_MERGE_IN_UNION)
                    root = stage_put_group(
                        &stage, way == IN_UNION_IN_MERGE ? OBJECT_MERGE : OBJECT_UNION, &root, 1);
                stage_put_root(&stage, root);
            }
            stage_ready(&stage, false);
            for (int kind = 0; kind < 3; kind++) {
                assert_int_equal(sees(&stage, 0, kinds[kind]), kind != flag || !hides[way][flag]);
                assert_true(sees(&stage, 3, kinds[kind]));
            }
            assert_int_equal(sees(&stage, 0, RAY_REFRACTED), flag != 0);
            stage_end(&stage);
        }
}

static void test_flags_of_the_merge(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object a = stage_sphere(vec3(0, 0, 0), 1);
    uint32_t item = stage_put(&stage, &a);
    uint32_t merge = stage_put_group(&stage, OBJECT_MERGE, &item, 1);
    stage.objects.items[merge].no_shadow = true;
    stage_put_root(&stage, merge);
    stage_ready(&stage, false);
    assert_false(sees(&stage, 0, RAY_SHADOW));
    assert_true(sees(&stage, 0, RAY_CAMERA));
    stage_end(&stage);
}

static void test_patch_uv(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object patch = stage_flat_patch(&stage, 0), other = stage_flat_patch(&stage, 1);
    // uv_vectors: at u = 0: (v 0) <2,5>, (v 1) <4,5>; at u = 1: (v 1) <4,8>, (v 0) <2,8>.
    other.shape.patch.uv[0] = (Vec2){2, 5}, other.shape.patch.uv[1] = (Vec2){4, 5};
    other.shape.patch.uv[2] = (Vec2){4, 8}, other.shape.patch.uv[3] = (Vec2){2, 8};
    stage_put_root(&stage, stage_put(&stage, &patch));
    stage_put_root(&stage, stage_put(&stage, &other));
    stage_ready(&stage, false);
    WorldHit hit;
    Ray ray = {{0.3, 0.9, -2}, {0, 0, 1}}, back = {{0.3, 0.9, 4}, {0, 0, -1}};
    // u runs along x, v along y; without uv_vectors U is v and V is u.
    assert_true(world_intersect(stage.world, &ray, 1e-4, 10, RAY_CAMERA, NULL, &hit));
    assert_true(hit.object == 0 && fabs(hit.u - 0.9) < 1e-9 && fabs(hit.v - 0.3) < 1e-9);
    assert_true(fabs(hit.normal.z - 1) < 1e-12 && fabs(hit.t - 2) < 1e-9);
    assert_true(world_intersect(stage.world, &back, 1e-4, 10, RAY_CAMERA, NULL, &hit));
    assert_true(hit.object == 1 && fabs(hit.u - 3.8) < 1e-9 && fabs(hit.v - 5.9) < 1e-9);
    // A patch is not met nearer than 1e-5, whatever the caller allows.
    Ray close = {{0.3, 0.9, 1 - 5e-6}, {0, 0, 1}};
    assert_false(world_intersect(stage.world, &close, 0, 10, RAY_CAMERA, NULL, &hit));
    assert_false(world_occluded(stage.world, &close, 0, 10, NULL));
    stage_end(&stage);
}

// In a merge a sphere punches its inside out of the patch, and the patch nothing out of the sphere.
static void test_patch_in_merge(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object patch = stage_flat_patch(&stage, 0), sphere = stage_sphere(vec3(0.5, 0.5, 0), 0.25);
    uint32_t items[2] = {stage_put(&stage, &patch), stage_put(&stage, &sphere)};
    stage_put_root(&stage, stage_put_group(&stage, OBJECT_MERGE, items, 2));
    stage_ready(&stage, true);
    WorldHit hit;
    Ray beside = {{0.1, 0.9, -2}, {0, 0, 1}}, within = {{0.5, 0.5, -0.1}, {0, 0, 1}};
    assert_true(world_intersect(stage.world, &beside, 1e-4, 10, RAY_CAMERA, NULL, &hit));
    assert_int_equal(hit.object, 0);
    assert_true(world_intersect(stage.world, &within, 1e-4, 10, RAY_CAMERA, NULL, &hit));
    assert_int_equal(hit.object, 1);
    assert_false(world_occluded(stage.world, &within, 1e-4, 0.2, NULL));
    assert_true(world_occluded(stage.world, &beside, 1e-4, 10, NULL));
    stage_end(&stage);
}

// Two surfaces in one place: the first in the source, unless one is infinite and there are three.
static void test_equal_depth(void **state) {
    (void)state;
    Ray ray = {{0.5, 0.5, -2}, {0, 0, 1}};
    WorldHit hit;
    for (int first = 0; first < 2; first++)
        for (int more = 0; more < 2; more++) {
            Stage stage = stage_begin();
            Object box = stage_box(vec3(0, 0, 0), vec3(1, 1, 1)),
                   patch = stage_flat_patch(&stage, 0);
            Object plane = {.type = OBJECT_PLANE, .shape.plane = {{0, 0, -1}, 0}};
            Object pair[2] = {more ? box : patch, more ? plane : box};
            stage_put_root(&stage, stage_put(&stage, &pair[first]));
            stage_put_root(&stage, stage_put(&stage, &pair[1 - first]));
            stage_ready(&stage, false);
            assert_true(world_intersect(stage.world, &ray, 1e-4, 10, RAY_CAMERA, NULL, &hit));
            assert_int_equal(hit.object, 0);
            stage_end(&stage);
        }
    Stage stage = stage_begin();
    Object box = stage_box(vec3(0, 0, 0), vec3(1, 1, 1)), far = stage_sphere(vec3(9, 9, 9), 1);
    Object plane = {.type = OBJECT_PLANE, .shape.plane = {{0, 0, -1}, 0}};
    stage_put_root(&stage, stage_put(&stage, &box));
    stage_put_root(&stage, stage_put(&stage, &far));
    stage_put_root(&stage, stage_put(&stage, &plane));
    stage_ready(&stage, false);
    assert_true(world_intersect(stage.world, &ray, 1e-4, 10, RAY_CAMERA, NULL, &hit));
    assert_int_equal(hit.object, 2);
    stage_end(&stage);
}

static void test_many_spheres(void **state) {
    (void)state;
    enum { COUNT = 20000 }; // under the sanitizers; a release build takes 100,000 in 0.25 s
    Stage stage = stage_begin();
    Rng rng = {11};
    for (uint32_t i = 0; i < COUNT; i++) {
        // A tenth of them in one place: boxes that no cut can part.
        Object object = i % 10 ? stage_sphere(random_vec(&rng, 50), rng_range(&rng, 0.1, 0.5))
                               : stage_sphere(vec3(1, 2, 3), 0.5);
        stage_put_root(&stage, stage_put(&stage, &object));
    }
    double start = usage_clock();
    stage_ready(&stage, true);
    print_message("%d spheres: %.2f s, %.1f MB\n", (int)COUNT, usage_clock() - start,
                  (double)world_memory(stage.world) / 1e6);
    int hits = 0;
    compare_rays(&stage, &rng, 100, &hits);
    assert_true(hits > 10);
    stage_end(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty_and_one),
        cmocka_unit_test(test_nearest_is_brute_force),
        cmocka_unit_test(test_merge_is_membership),
        cmocka_unit_test(test_hostile_rays),
        cmocka_unit_test(test_flags),
        cmocka_unit_test(test_flags_of_the_merge),
        cmocka_unit_test(test_patch_uv),
        cmocka_unit_test(test_patch_in_merge),
        cmocka_unit_test(test_equal_depth),
        cmocka_unit_test(test_many_spheres),
    };
    return cmocka_run_group_tests_name("world", tests, NULL, NULL);
}
