// SPDX-License-Identifier: MIT
// The work of a ray grows as the logarithm of the number of solids, that of building no faster than
// a little more than their number; copies of one tree take no room for its parts. make scaling
// measures seconds.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/rng.h"
#include "tests/world_stage.h"

#include <math.h>
#include <time.h>

static Vec3 random_vec(Rng *rng, double size) {
    double x = rng_range(rng, -size, size), y = rng_range(rng, -size, size);
    return vec3(x, y, rng_range(rng, -size, size));
}

typedef struct {
    double tests; // of solids, a ray
    double hits;  // share of the rays
    double build; // processor seconds
} Work;

// Half spheres, half triangles, in a cube of which they fill the same share for all counts.
static void put_solids(Stage *stage, Rng *rng, uint32_t count) {
    double size = 0.5 / cbrt(0.5 * count);
    for (uint32_t i = 0; i < count; i++) {
        Vec3 p = random_vec(rng, 1);
        Object object = stage_sphere(p, size);
        if (i % 2) {
            Vec3 a = vec_madd(p, 2 * size, random_vec(rng, 1));
            Vec3 b = vec_madd(p, 2 * size, random_vec(rng, 1));
            object = (Object){.type = OBJECT_TRIANGLE, .shape.triangle = {{p, a, b}}};
        }
        stage_put_root(stage, stage_put(stage, &object));
    }
}

static Work measure(uint32_t count) {
    enum { RAYS = 4000 };
    Rng rng = {count};
    Stage stage = stage_begin();
    put_solids(&stage, &rng, count);
    clock_t start = clock();
    stage_ready(&stage, false);
    Work work = {.build = (double)(clock() - start) / CLOCKS_PER_SEC};
    RayStats stats = {0};
    int hits = 0;
    for (int i = 0; i < RAYS; i++) {
        Vec3 org = vec3(0, 0, -4), to = random_vec(&rng, 0.9);
        Ray ray = {org, vec_normalize(vec_sub(to, org))};
        WorldHit hit;
        hits += world_intersect(stage.world, &ray, 0, INFINITY, RAY_CAMERA, &stats, &hit);
    }
    stage_end(&stage);
    work.tests = (double)stats.shape_tests / RAYS;
    work.hits = (double)hits / RAYS;
    return work;
}

static void test_rays_and_building(void **state) {
    (void)state;
    Work few = measure(1000), more = measure(10000), most = measure(100000);
    print_message("tests a ray %.1f, %.1f, %.1f; building %.2f, %.2f, %.2f s\n", few.tests,
                  more.tests, most.tests, few.build, more.build, most.build);
    assert_true(few.hits > 0.5 && most.hits > 0.5);
    // How many solids lie around the first one that is hit does not depend on how many there are:
    // 2 here, and 2.2 times as many with each decade if a ray looked at all along its way.
    assert_true(more.tests < few.tests + 1 && most.tests < few.tests + 1);
    // n log n is 12 times as much; without a tree it would be 100 times.
    assert_true(most.build < 30 * more.build + 0.2);
}

// 2,000 copies of 200 solids: as much as a definition and the copies, 400,000 solids would be 100
// times as much.
static void test_copies(void **state) {
    (void)state;
    enum { PARTS = 200, COPIES = 2000 };
    Rng rng = {3};
    Stage stage = stage_begin();
    uint32_t items[PARTS];
    for (uint32_t i = 0; i < PARTS; i++) {
        Object sphere = stage_sphere(random_vec(&rng, 0.5), 0.05);
        items[i] = stage_put(&stage, &sphere);
    }
    array_push(&stage.definitions, stage_put_group(&stage, OBJECT_UNION, items, PARTS));
    for (uint32_t i = 0; i < COPIES; i++) {
        Object instance = object_default(OBJECT_INSTANCE);
        Transform turn = transform_rotate(random_vec(&rng, 180));
        Transform move = transform_translate(random_vec(&rng, 20));
        instance.has_transform = true;
        instance.transform = transform_compose(&turn, &move);
        stage_put_root(&stage, stage_put(&stage, &instance));
    }
    stage_ready(&stage, false);
    uint64_t bytes = world_memory(stage.world);
    print_message("%.2f MB\n", (double)bytes / 1e6);
    assert_true(bytes < 2000 * (COPIES + PARTS));
    stage_end(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_and_building),
        cmocka_unit_test(test_copies),
    };
    return cmocka_run_group_tests_name("scaling", tests, NULL, NULL);
}
