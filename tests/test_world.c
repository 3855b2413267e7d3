// SPDX-License-Identifier: MIT
// The World against a brute force that walks the scene's trees for every ray, and against POV-Ray's
// pictures of merges.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/array.h"
#include "base/progress.h"
#include "base/rng.h"
#include "render/world.h"
#include "shape/shape.h"
#include "tests/povray_pictures.h"

#include <stdio.h>
#include <string.h>

// ---- scenes built by hand -------------------------------------------------------------------

typedef struct {
    Arena *arena;
    ARRAY(Object) objects;
    ARRAY(uint32_t) roots;
    Scene scene;
    Shape *shapes; // of every leaf, prepared here for the brute force
    PatchSet **patches;
    World *world;
} Stage;

static uint32_t put(Stage *stage, const Object *object) {
    array_push(&stage->objects, *object);
    return (uint32_t)stage->objects.count - 1;
}

static uint32_t put_group(Stage *stage, ObjectType type, const uint32_t *items, uint32_t count) {
    Object object = {.type = type};
    object.shape.children.items = arena_copy(stage->arena, items, count * sizeof *items);
    object.shape.children.count = count;
    return put(stage, &object);
}

static void put_root(Stage *stage, uint32_t index) { array_push(&stage->roots, index); }

static const PatchSetOptions FACETS = {.method = METHOD_FACETS, .tolerance = 1e-9};

static PatchDef def_of(const Object *object, uint32_t id) {
    const PatchShape *patch = &object->shape.patch;
    return (PatchDef){.degree_u = patch->degree_u,
                      .degree_v = patch->degree_v,
                      .points = patch->points,
                      .id = id,
                      .mask = RAY_ALL,
                      .flatness = patch->flatness,
                      .u_steps = patch->u_steps,
                      .v_steps = patch->v_steps};
}

static Stage stage_begin(void) { return (Stage){.arena = arena_create()}; }

// Makes the world; brute says whether the brute force is wanted too.
static void stage_ready(Stage *stage, bool brute) {
    stage->scene = (Scene){.objects = stage->objects.items,
                           .object_count = (uint32_t)stage->objects.count,
                           .roots = stage->roots.items,
                           .root_count = (uint32_t)stage->roots.count};
    stage->world = world_create(&stage->scene, &FACETS);
    if (!brute)
        return;
    size_t n = stage->objects.count;
    stage->shapes = ARENA_ARRAY(stage->arena, Shape, n);
    stage->patches = ARENA_ARRAY(stage->arena, PatchSet *, n);
    for (uint32_t i = 0; i < n; i++) {
        stage->shapes[i] = shape_prepare(&stage->objects.items[i], stage->arena);
        if (stage->objects.items[i].type != OBJECT_PATCH)
            continue;
        PatchDef def = def_of(&stage->objects.items[i], i);
        stage->patches[i] = patchset_create(&FACETS);
        patchset_add(stage->patches[i], &def);
        patchset_commit(stage->patches[i]);
    }
}

static void stage_end(Stage *stage) {
    world_destroy(stage->world);
    for (size_t i = 0; stage->patches && i < stage->objects.count; i++)
        if (stage->patches[i])
            patchset_destroy(stage->patches[i]);
    array_free(&stage->objects);
    array_free(&stage->roots);
    arena_destroy(stage->arena);
}

// ---- the brute force ------------------------------------------------------------------------

static bool is_group(const Object *object) {
    return object->type == OBJECT_UNION || object->type == OBJECT_MERGE;
}

static bool brute_inside(const Stage *stage, uint32_t index, Vec3 p) {
    const Object *object = &stage->objects.items[index];
    if (!is_group(object))
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
    if (!is_group(object)) {
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
    case OBJECT_UNION:
    case OBJECT_MERGE:
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

static void compare_rays(const Stage *stage, Rng *rng, int count, int *hits) {
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
        *hits += hit;
        if (!hit)
            continue;
        assert_true(fabs(vec_length(got.normal) - 1.0) < 1e-12);
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
            put_root(&stage, put(&stage, &object));
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
        return put(stage, &object);
    }
    uint32_t items[4], count = 1 + (uint32_t)(rng_next(rng) % 4);
    for (uint32_t i = 0; i < count; i++)
        items[i] = random_tree(stage, rng, depth - 1);
    return put_group(stage, rng_next(rng) % 3 ? OBJECT_MERGE : OBJECT_UNION, items, count);
}

static void test_merge_is_membership(void **state) {
    (void)state;
    int hits = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        Rng rng = {seed * 1000};
        Stage stage = stage_begin();
        for (uint64_t i = 0; i < 1 + seed % 3; i++)
            put_root(&stage, random_tree(&stage, &rng, 3));
        stage_ready(&stage, true);
        compare_rays(&stage, &rng, 120, &hits);
        for (int i = 0; i < 200; i++) {
            Vec3 p = random_vec(&rng, 3);
            uint32_t found[64], want[64], want_count = 0;
            uint32_t found_count = world_containing(stage.world, p, found, 64);
            for (uint32_t o = 0; o < stage.objects.count; o++) {
                bool inside = brute_inside(&stage, o, p);
                assert_int_equal(world_inside(stage.world, o, p), inside);
                if (inside && !is_group(&stage.objects.items[o]))
                    want[want_count++] = o;
            }
            // Leaves are put before their groups here, in the order of the source.
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

static Object sphere_at(Vec3 center, double radius) {
    Object object = {.type = OBJECT_SPHERE};
    object.shape.sphere = (SphereShape){center, radius};
    return object;
}

static Object box_between(Vec3 low, Vec3 high) {
    Object object = {.type = OBJECT_BOX};
    object.shape.box = (BoxShape){low, high};
    return object;
}

static void test_empty_and_one(void **state) {
    (void)state;
    Ray ray = {{0, 0, -5}, {0, 0, 1}};
    WorldHit hit;
    RayStats stats = {0};
    uint32_t found[1];
    Stage stage = stage_begin();
    stage_ready(&stage, false);
    assert_false(world_intersect(stage.world, &ray, 0, INFINITY, RAY_CAMERA, &stats, &hit));
    assert_false(world_occluded(stage.world, &ray, 0, INFINITY, &stats));
    assert_int_equal(world_containing(stage.world, vec3(0, 0, 0), found, 1), 0);
    stage_end(&stage);

    stage = stage_begin();
    Object sphere = sphere_at(vec3(0, 0, 0), 2);
    put_root(&stage, put(&stage, &sphere));
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
        put_root(&stage, put(&stage, &object));
    }
    // Nothing to hit, and no harm: no radius, no length, no area, no thickness.
    Object nothing[] = {
        sphere_at(vec3(0, 0, 0), 0),
        box_between(vec3(1, 1, 1), vec3(1, 1, 1)),
        box_between(vec3(-1, 0, -1), vec3(1, 0, 1)),
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
        put_root(&stage, put(&stage, &nothing[i]));
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
            Object a = sphere_at(vec3(0, 0, 0), 1), b = sphere_at(vec3(3, 0, 0), 1);
            a.no_image = flag == 0;
            a.no_reflection = flag == 1;
            a.no_shadow = flag == 2;
            uint32_t items[2] = {put(&stage, &a), put(&stage, &b)};
            ObjectType inner =
                way == IN_MERGE || way == IN_MERGE_IN_UNION ? OBJECT_MERGE : OBJECT_UNION;
            if (way == ALONE) {
                put_root(&stage, items[0]);
                put_root(&stage, items[1]);
            } else {
                uint32_t root = put_group(&stage, inner, items, 2);
                if (way == IN_UNION_IN_MERGE || way == IN_MERGE_IN_UNION)
                    root = put_group(&stage, way == IN_UNION_IN_MERGE ? OBJECT_MERGE : OBJECT_UNION,
                                     &root, 1);
                put_root(&stage, root);
            }
            stage_ready(&stage, false);
            for (int kind = 0; kind < 3; kind++) {
                assert_int_equal(sees(&stage, 0, kinds[kind]), kind != flag || !hides[way][flag]);
                assert_true(sees(&stage, 3, kinds[kind]));
            }
            stage_end(&stage);
        }
}

static void test_flags_of_the_merge(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object a = sphere_at(vec3(0, 0, 0), 1);
    uint32_t item = put(&stage, &a);
    uint32_t merge = put_group(&stage, OBJECT_MERGE, &item, 1);
    stage.objects.items[merge].no_shadow = true;
    put_root(&stage, merge);
    stage_ready(&stage, false);
    assert_false(sees(&stage, 0, RAY_SHADOW));
    assert_true(sees(&stage, 0, RAY_CAMERA));
    stage_end(&stage);
}

// A flat patch over the unit square at the given z, corners at (0,0), (1,0), (1,1), (0,1).
static Object flat_patch(Stage *stage, double z) {
    Object object = {.type = OBJECT_PATCH};
    PatchShape *patch = &object.shape.patch;
    *patch = (PatchShape){.degree_u = 3, .degree_v = 3, .u_steps = 1, .v_steps = 1};
    patch->points = ARENA_ARRAY(stage->arena, Vec3, 16);
    for (int i = 0; i < 16; i++)
        patch->points[i] = vec3(i / 4 / 3.0, i % 4 / 3.0, z);
    patch->uv[1] = (Vec2){1, 0}, patch->uv[2] = (Vec2){1, 1}, patch->uv[3] = (Vec2){0, 1};
    return object;
}

static void test_patch_uv(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object patch = flat_patch(&stage, 0), other = flat_patch(&stage, 1);
    // uv_vectors: at u = 0: (v 0) <2,5>, (v 1) <4,5>; at u = 1: (v 1) <4,8>, (v 0) <2,8>.
    other.shape.patch.uv[0] = (Vec2){2, 5}, other.shape.patch.uv[1] = (Vec2){4, 5};
    other.shape.patch.uv[2] = (Vec2){4, 8}, other.shape.patch.uv[3] = (Vec2){2, 8};
    put_root(&stage, put(&stage, &patch));
    put_root(&stage, put(&stage, &other));
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
    Object patch = flat_patch(&stage, 0), sphere = sphere_at(vec3(0.5, 0.5, 0), 0.25);
    uint32_t items[2] = {put(&stage, &patch), put(&stage, &sphere)};
    put_root(&stage, put_group(&stage, OBJECT_MERGE, items, 2));
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
            Object box = box_between(vec3(0, 0, 0), vec3(1, 1, 1)), patch = flat_patch(&stage, 0);
            Object plane = {.type = OBJECT_PLANE, .shape.plane = {{0, 0, -1}, 0}};
            Object pair[2] = {more ? box : patch, more ? plane : box};
            put_root(&stage, put(&stage, &pair[first]));
            put_root(&stage, put(&stage, &pair[1 - first]));
            stage_ready(&stage, false);
            assert_true(world_intersect(stage.world, &ray, 1e-4, 10, RAY_CAMERA, NULL, &hit));
            assert_int_equal(hit.object, 0);
            stage_end(&stage);
        }
    Stage stage = stage_begin();
    Object box = box_between(vec3(0, 0, 0), vec3(1, 1, 1)), far = sphere_at(vec3(9, 9, 9), 1);
    Object plane = {.type = OBJECT_PLANE, .shape.plane = {{0, 0, -1}, 0}};
    put_root(&stage, put(&stage, &box));
    put_root(&stage, put(&stage, &far));
    put_root(&stage, put(&stage, &plane));
    stage_ready(&stage, false);
    assert_true(world_intersect(stage.world, &ray, 1e-4, 10, RAY_CAMERA, NULL, &hit));
    assert_int_equal(hit.object, 2);
    stage_end(&stage);
}

static void test_many_spheres(void **state) {
    (void)state;
    enum { COUNT = 20000 }; // under the sanitizers; a release build takes 100,000 in 0.1 s
    Stage stage = stage_begin();
    Rng rng = {11};
    for (uint32_t i = 0; i < COUNT; i++) {
        // A tenth of them in one place: boxes that no cut can part.
        Object object = i % 10 ? sphere_at(random_vec(&rng, 50), rng_range(&rng, 0.1, 0.5))
                               : sphere_at(vec3(1, 2, 3), 0.5);
        put_root(&stage, put(&stage, &object));
    }
    double start = progress_seconds();
    stage_ready(&stage, true);
    print_message("%d spheres: %.2f s, %.1f MB\n", (int)COUNT, progress_seconds() - start,
                  (double)world_memory(stage.world) / 1e6);
    int hits = 0;
    compare_rays(&stage, &rng, 100, &hits);
    assert_true(hits > 10);
    stage_end(&stage);
}

// ---- merges in POV-Ray's pictures -----------------------------------------------------------

enum { WIDTH = 64, HEIGHT = 48, COLORS = 6 };

static const char *const COLOR[COLORS] = {"<1,0,0>", "<0,1,0>", "<0,0,1>",
                                          "<1,1,0>", "<0,1,1>", "<1,0,1>"};
static const uint16_t COLOR_BITS[COLORS] = {1, 2, 4, 3, 6, 5};

typedef struct {
    const char *text; // $n stands for the texture of leaf n
    void (*build)(Stage *stage);
} MergeCase;

static void build_simple(Stage *stage) {
    Object a = sphere_at(vec3(-0.4, 0, 0), 1),
           b = box_between(vec3(0, -0.6, -0.7), vec3(1.6, 0.6, 0.5));
    Object c = {.type = OBJECT_TORUS, .shape.torus = {0.9, 0.4}};
    uint32_t items[3] = {put(stage, &a), put(stage, &b), put(stage, &c)};
    put_root(stage, put_group(stage, OBJECT_MERGE, items, 3));
}

static void build_nested(Stage *stage) {
    Object a = sphere_at(vec3(-0.4, 0, 0), 1), b = sphere_at(vec3(0.4, 0.3, 0), 0.9);
    Object c = box_between(vec3(-0.2, -1.2, -1.3), vec3(0.6, 0.4, 0.5));
    Object d = {.type = OBJECT_CYLINDER, .shape.cone = {{-2, 0, 0}, {2, 0, 0}, 0.4, 0.4, true}};
    Object e = {.type = OBJECT_DISC, .shape.disc = {{0, 0, 0.2}, {0, 0, 1}, 2, 0}};
    uint32_t u[2] = {put(stage, &a), put(stage, &b)};
    uint32_t m[2] = {put_group(stage, OBJECT_UNION, u, 2), put(stage, &c)};
    uint32_t r[3] = {put_group(stage, OBJECT_MERGE, m, 2), put(stage, &d), put(stage, &e)};
    put_root(stage, put_group(stage, OBJECT_MERGE, r, 3));
}

static void build_patch(Stage *stage) {
    Object a = sphere_at(vec3(0.5, 0.5, 0.1), 0.4), b = flat_patch(stage, 0);
    for (int i = 0; i < 16; i++)
        b.shape.patch.points[i] = vec3(i / 4 - 1.5, i % 4 - 1.2, (i % 3) * 0.4);
    Object c = {.type = OBJECT_PLANE, .shape.plane = {{0, 1, 0}, -0.5}};
    uint32_t items[3] = {put(stage, &a), put(stage, &b), put(stage, &c)};
    put_root(stage, put_group(stage, OBJECT_MERGE, items, 3));
}

static const MergeCase MERGES[] = {
    {"merge { sphere { <-0.4,0,0>, 1 $0 } box { <0,-0.6,-0.7>, <1.6,0.6,0.5> $1 }"
     " torus { 0.9, 0.4 $2 } }",
     build_simple},
    {"merge { merge { union { sphere { <-0.4,0,0>, 1 $0 } sphere { <0.4,0.3,0>, 0.9 $1 } }"
     " box { <-0.2,-1.2,-1.3>, <0.6,0.4,0.5> $2 } }"
     " cylinder { -2*x, 2*x, 0.4 open $3 } disc { <0,0,0.2>, z, 2 $4 } }",
     build_nested},
    {"merge { sphere { <0.5,0.5,0.1>, 0.4 $0 } bicubic_patch { type 1 flatness 0 u_steps 1 v_steps "
     "1 "
     "<-1.5,-1.2,0>, <-1.5,-0.2,0.4>, <-1.5,0.8,0.8>, <-1.5,1.8,0>,"
     "<-0.5,-1.2,0.4>, <-0.5,-0.2,0.8>, <-0.5,0.8,0>, <-0.5,1.8,0.4>,"
     "<0.5,-1.2,0.8>, <0.5,-0.2,0>, <0.5,0.8,0.4>, <0.5,1.8,0.8>,"
     "<1.5,-1.2,0>, <1.5,-0.2,0.4>, <1.5,0.8,0.8>, <1.5,1.8,0> $1 } plane { y, -0.5 $2 } }",
     build_patch},
};

// In front, and within, where only the outer walls may be seen.
static const Vec3 EYES[] = {{0.1, 0.4, -4}, {0.05, 0.1, 0.02}, {0.3, 1.5, 1.2}};
enum { MERGE_COUNT = sizeof MERGES / sizeof *MERGES, EYE_COUNT = sizeof EYES / sizeof *EYES };

static void write_merge(const PovrayPictures *pictures, size_t number, const MergeCase *merge,
                        Vec3 eye) {
    char path[128];
    snprintf(path, sizeof path, "%s/job%zu.pov", pictures->directory, number);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(
        file,
        "#version 3.7; global_settings { assumed_gamma 1 ambient_light 1 }\n"
        "camera { location <%.17g,%.17g,%.17g> direction <-0.1,-0.2,1> right 1.6*x up 1.2*y }\n",
        eye.x, eye.y, eye.z);
    for (const char *c = merge->text; *c; c++)
        if (*c == '$')
            fprintf(file, "pigment { rgb %s } finish { ambient 1 diffuse 0 }", COLOR[*++c - '0']);
        else
            putc(*c, file);
    fclose(file);
}

static void test_merge_as_povray(void **state) {
    (void)state;
    PovrayPictures *pictures = povray_create(WIDTH, HEIGHT);
    for (size_t i = 0; i < MERGE_COUNT * EYE_COUNT; i++)
        write_merge(pictures, i, &MERGES[i / EYE_COUNT], EYES[i % EYE_COUNT]);
    if (!povray_render(pictures, MERGE_COUNT * EYE_COUNT)) {
        povray_destroy(pictures);
        print_message("povray is not installed: nothing to compare with\n");
        skip();
    }
    size_t differ = 0, hits = 0;
    for (size_t i = 0; i < MERGE_COUNT * EYE_COUNT; i++) {
        const uint16_t *pixels = povray_read(pictures, i);
        if (!pixels)
            fail_msg("povray refused %s/job%zu.pov", pictures->directory, i);
        Stage stage = stage_begin();
        MERGES[i / EYE_COUNT].build(&stage);
        stage_ready(&stage, false);
        // The number of a leaf's texture is its place among the leaves.
        uint32_t number[16] = {0}, leaves = 0;
        for (uint32_t o = 0; o < stage.objects.count; o++)
            number[o] = is_group(&stage.objects.items[o]) ? 0 : leaves++;
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            double a = (k % WIDTH + 0.5) / WIDTH - 0.5;
            double b = ((HEIGHT - 1) - (k / WIDTH - 0.5)) / HEIGHT - 0.5;
            Ray ray = {EYES[i % EYE_COUNT], vec_normalize(vec3(-0.1 + 1.6 * a, -0.2 + 1.2 * b, 1))};
            WorldHit hit;
            bool met = world_intersect(stage.world, &ray, 1e-4, INFINITY, RAY_CAMERA, NULL, &hit);
            int want = met ? COLOR_BITS[number[hit.object]] : 0, seen = 0;
            for (int c = 0; c < 3; c++)
                seen |= pixels[k * 3 + c] > 32768 ? 1 << c : 0;
            hits += met;
            differ += want != seen;
            if (want != seen)
                print_message("merge %zu eye %zu pixel %d,%d: %d, POV-Ray %d\n", i / EYE_COUNT,
                              i % EYE_COUNT, k % WIDTH, k / WIDTH, want, seen);
        }
        stage_end(&stage);
    }
    povray_destroy(pictures);
    print_message("merges: %zu of %zu pixels differ\n", differ, hits);
    assert_true(hits > 5000);
    assert_int_equal(differ, 0);
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
        cmocka_unit_test(test_merge_as_povray),
    };
    return cmocka_run_group_tests_name("world", tests, NULL, NULL);
}
