// SPDX-License-Identifier: MIT
// Camera rays that ask the patches ahead, in rows of pixels, against rays one by one.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "render/sample.h"
#include "render/world.h"
#include "tests/world_stage.h"

#include <string.h>

enum { PATCHES = 12, MOST = 160 };

// Bent patches in depth, a ball before and one behind some of them.
static Stage bent_patches(void) {
    Stage stage = stage_begin();
    Rng rng = {7};
    for (int i = 0; i < PATCHES; i++) {
        Object patch = stage_flat_patch(&stage, 0.3 * i);
        for (int k = 0; k < 16; k++) {
            Vec3 *p = (Vec3 *)&patch.shape.patch.points[k];
            *p = vec_add(*p, vec3(rng_range(&rng, -0.4, 0.4), rng_range(&rng, -0.4, 0.4),
                                  rng_range(&rng, -0.4, 0.4)));
        }
        stage_put_root(&stage, stage_put(&stage, &patch));
    }
    Object near = stage_sphere(vec3(0.2, 0.3, -0.5), 0.2), far = stage_sphere(vec3(1, 1, 3), 1);
    stage_put_root(&stage, stage_put(&stage, &near));
    stage_put_root(&stage, stage_put(&stage, &far));
    stage_ready(&stage, false);
    return stage;
}

static void look(Ray *rays, size_t across, size_t down, double wide) {
    for (size_t y = 0; y < down; y++)
        for (size_t x = 0; x < across; x++) {
            Vec3 at = vec3(-0.3 + wide * ((double)x + 0.5) / (double)across,
                           -0.3 + wide * ((double)y + 0.5) / (double)down, 0);
            Vec3 eye = vec3(0.5, 0.4, -4);
            rays[y * across + x] = (Ray){eye, vec_normalize(vec_sub(at, eye))};
        }
}

static void assert_same_hit(const WorldHit *a, const WorldHit *b) {
    assert_int_equal(a->object, b->object);
    assert_memory_equal(&a->t, &b->t, sizeof a->t);
    assert_memory_equal(&a->p, &b->p, sizeof a->p);
    assert_memory_equal(&a->normal, &b->normal, sizeof a->normal);
    assert_true(a->u == b->u && a->v == b->v && a->bound == b->bound && a->reach == b->reach);
}

static int compare_grid(const World *world, size_t across, size_t down, double wide) {
    Ray rays[MOST];
    WorldForeseen foreseen[MOST];
    RayStats stats = {0};
    assert_true(across * down <= MOST);
    look(rays, across, down, wide);
    WorldNear near = world_near(world, NULL, vec3(0, 0, 0), 1e-4);
    assert_true(world_foresee(world, rays, across, down, near, RAY_CAMERA, &stats, foreseen));
    int hits = 0;
    for (size_t i = 0; i < across * down; i++) {
        WorldHit one, ahead;
        bool met = world_nearest(world, &rays[i], near, INFINITY, RAY_CAMERA, NULL, &one);
        assert_int_equal(met, world_nearest_foreseen(world, &rays[i], near, INFINITY, RAY_CAMERA,
                                                     &foreseen[i], NULL, &ahead));
        if (met)
            assert_same_hit(&one, &ahead);
        hits += met;
    }
    return hits;
}

static void rows_meet_what_rays_meet(void **state) {
    (void)state;
    Stage stage = bent_patches();
    PatchSetOptions qi = patchset_options_default();
    World *world = world_create(&stage.scene, &qi);
    static const size_t grids[][2] = {{1, 1}, {7, 3}, {33, 4}, {5, 2}, {16, 1}, {40, 4}, {3, 7}};
    int hits = 0;
    for (size_t g = 0; g < sizeof grids / sizeof grids[0]; g++)
        hits += compare_grid(world, grids[g][0], grids[g][1], 1.6) +
                compare_grid(world, grids[g][0], grids[g][1], 5.0);
    assert_true(hits > 200);
    world_destroy(world);
    stage_end(&stage);
}

// Where nothing is to be gained, or rays would become others, all is left to the single rays.
static void some_rays_are_left(void **state) {
    (void)state;
    Stage stage = bent_patches();
    PatchSetOptions qi = patchset_options_default();
    World *world = world_create(&stage.scene, &qi);
    Ray rays[2] = {{{0, 0, -4}, {0, 0, 1}}, {{0, 0, -4}, {0, 0, 2}}};
    WorldForeseen foreseen[2];
    RayStats stats = {0};
    WorldNear near = {1e-4, 0};
    assert_true(world_foresee(world, rays, 1, 1, near, RAY_CAMERA, &stats, foreseen));
    assert_false(world_foresee(world, rays, 2, 1, near, RAY_CAMERA, &stats, foreseen));
    rays[1].dir = vec3(NAN, 0, 1);
    assert_false(world_foresee(world, rays, 2, 1, near, RAY_CAMERA, &stats, foreseen));
    // These are POV-Ray's triangles.
    assert_false(world_foresee(stage.world, rays, 1, 1, near, RAY_CAMERA, &stats, foreseen));
    world_destroy(world);
    stage_end(&stage);
}

// ---- the sampler's side ---------------------------------------------------------------------

typedef struct {
    const Ray *rays;
    size_t count, next;
    int foreseen, traced, others;
} Watch;

static void watch_ahead(void *context, const Ray *rays, size_t across, size_t down) {
    Watch *watch = context;
    assert_int_equal(watch->next, watch->count); // all that were foreseen have been traced
    watch->rays = rays;
    watch->count = across * down;
    watch->next = 0;
    watch->foreseen += (int)watch->count;
}

// A chessboard, so that many pixels are supersampled in between.
static Color watch_ray(void *context, const Ray *ray) {
    Watch *watch = context;
    watch->traced++;
    if (watch->next < watch->count && memcmp(&watch->rays[watch->next], ray, sizeof *ray) == 0)
        watch->next++;
    else
        watch->others++;
    float white = (float)(((int)floor(40 * ray->dir.x) + (int)floor(40 * ray->dir.y)) & 1);
    return (Color){white, white, white, 0, 0};
}

static void rays_are_traced_as_foreseen(void **state) {
    (void)state;
    Camera camera = {
        .type = CAMERA_PERSPECTIVE, .direction = {0, 0, 1}, .right = {1.33, 0, 0}, .up = {0, 1, 0}};
    for (int method = 0; method <= 2; method++) {
        for (int high = 1; high <= 9; high += 2) {
            SampleOptions options = {.method = method, .depth = 2, .threshold = 0.3, .jitter = 1};
            Sampler *sampler = sampler_create(&options, &camera, 11, high, 32);
            sampler_foresee(sampler, watch_ahead);
            Color picture[99];
            Watch watch = {0};
            sampler_tile(sampler, (PixelRect){0, 0, 11, high}, watch_ray, &watch, picture);
            assert_int_equal(watch.next, watch.count);
            assert_int_equal(watch.foreseen, method == 0   ? 11 * high
                                             : method == 1 ? 12 * high + 11
                                                           : 12 * (high + 1));
            assert_int_equal(watch.traced - watch.foreseen, watch.others);
            assert_true(method == 0 ? watch.others == 0 : high == 1 || watch.others > 0);
            sampler_destroy(sampler);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_meet_what_rays_meet),
        cmocka_unit_test(some_rays_are_left),
        cmocka_unit_test(rays_are_traced_as_foreseen),
    };
    return cmocka_run_group_tests_name("foresee", tests, NULL, NULL);
}
