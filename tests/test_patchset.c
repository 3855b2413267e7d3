// SPDX-License-Identifier: MIT
// Sets of patches, METHOD_QI above all: against the oracle, against METHOD_QI_PAPER, at the edges
// that patches share, and in the cases that break other systems.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "ray_oracle.h"

#include "base/rng.h"
#include "patch/bezier.h"
#include "patch/patch.h"

#include <float.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

enum { MAX_PATCHES = 64 };

// ---- Scenes

typedef struct {
    int count;
    Bezier patch[MAX_PATCHES];
    Box box[MAX_PATCHES];
    PatchSet *set;
} Scene;

static Scene scene; // too large for the stack

static PatchDef def_of(int i) {
    return (PatchDef){.degree_u = (uint32_t)scene.patch[i].du,
                      .degree_v = (uint32_t)scene.patch[i].dv,
                      .points = scene.patch[i].p,
                      .id = (uint32_t)i,
                      .mask = 1u << (i % 8),
                      .u_steps = 4,
                      .v_steps = 4};
}

// Builds the set from the patches of the scene.
static void commit(PatchMethod method) {
    PatchSetOptions options = patchset_options_default();
    assert_true(options.method == METHOD_QI);
    options.method = method;
    scene.set = patchset_create(&options);
    for (int i = 0; i < scene.count; i++) {
        PatchDef def = def_of(i);
        patchset_add(scene.set, &def);
        scene.box[i] = bezier_bounds(&scene.patch[i]);
    }
    patchset_commit(scene.set);
}

static void release(void) {
    patchset_destroy(scene.set);
    scene.set = NULL;
    scene.count = 0;
}

// A sheet over [0,1]^2, noise added.
static void random_patch(Rng *rng, int du, int dv, double wild, Bezier *out) {
    out->du = du;
    out->dv = dv;
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j <= dv; j++)
            out->p[i * (dv + 1) + j] = vec3((double)i / du + wild * rng_range(rng, -1, 1),
                                            (double)j / dv + wild * rng_range(rng, -1, 1),
                                            (0.3 + wild) * rng_range(rng, -1, 1));
    }
}

static Vec3 random_direction(Rng *rng) {
    for (;;) {
        Vec3 d = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        double length = vec_length(d);
        if (length > 0.1 && length < 1.0)
            return vec_scale(d, 1.0 / length);
    }
}

// The 32 patches of POV-Ray's example.
static bool load_teapot(void) {
    FILE *f = fopen("/usr/share/doc/povray/examples/advanced/teapot/teapot.inc", "r");
    if (!f)
        return false;
    char line[1000];
    int points = 0;
    while (fgets(line, sizeof line, f)) {
        if (strstr(line, "//"))
            continue;
        for (char *p = line; (p = strchr(p, '<')) != NULL; p++) {
            Vec3 q;
            if (sscanf(p, "<%lf, %lf, %lf>", &q.x, &q.y, &q.z) == 3 && points < 32 * 16) {
                scene.patch[points / 16].p[points % 16] = q;
                points++;
            }
        }
    }
    fclose(f);
    assert_int_equal(points, 32 * 16);
    scene.count = 32;
    for (int i = 0; i < 32; i++)
        scene.patch[i].du = scene.patch[i].dv = 3;
    return true;
}

#define NEED_TEAPOT()                                                                              \
    do {                                                                                           \
        if (!load_teapot()) {                                                                      \
            printf("skipped: no teapot.inc (package povray-examples)\n");                          \
            skip();                                                                                \
        }                                                                                          \
    } while (0)

static void move_scene(double scale, Vec3 offset) {
    for (int i = 0; i < scene.count; i++)
        for (int k = 0; k < bezier_count(&scene.patch[i]); k++)
            scene.patch[i].p[k] = vec_add(vec_scale(scene.patch[i].p[k], scale), offset);
}

// ---- Judgement

static bool meets_box(const Box *box, const Ray *ray) {
    double near = -INFINITY, far = INFINITY;
    double pad = 1e-6 * vec_length(vec_sub(box->high, box->low)) +
                 1e-12 * (fabs(ray->org.x) + fabs(ray->org.y) + fabs(ray->org.z));
    for (int axis = 0; axis < 3; axis++) {
        double o = vec_get(ray->org, axis), d = vec_get(ray->dir, axis);
        double low = vec_get(box->low, axis) - pad, high = vec_get(box->high, axis) + pad;
        if (d == 0.0) {
            if (o < low || o > high)
                return false;
            continue;
        }
        near = fmax(near, fmin((low - o) / d, (high - o) / d));
        far = fmin(far, fmax((low - o) / d, (high - o) / d));
    }
    return near <= far && far >= 0.0;
}

// What is true of every hit: its place, its bound, its normal.
static void check_hit(const Ray *ray, const PatchHit *hit, double t_min, double t_max) {
    assert_true(hit->id < (uint32_t)scene.count);
    const Bezier *patch = &scene.patch[hit->id];
    const PatchDef def = def_of((int)hit->id);
    assert_true(hit->t >= t_min && hit->t < t_max);
    assert_true(hit->u >= 0.0 && hit->u <= 1.0 && hit->v >= 0.0 && hit->v <= 1.0);
    double off = ray_oracle_residual(&def, ray, hit->t, hit->u, hit->v);
    double far = vec_length(vec_sub(ray->org, patch->p[0])) + bezier_diameter(patch);
    assert_true(off <= hit->bound);
    assert_true(hit->bound <= 1e-9 * bezier_diameter(patch) + 1e-13 * far);
    assert_true(fabs(vec_length(hit->normal) - 1.0) < 1e-12);
    Vec3 jet[3];
    ray_oracle_jet(&def, hit->u, hit->v, jet);
    Vec3 n = vec_cross(jet[1], jet[2]);
    if (vec_length(n) > 1e-4 * vec_length(jet[1]) * vec_length(jet[2]))
        assert_true(vec_dot(vec_normalize(n), hit->normal) > 1.0 - 1e-9);
}

typedef struct {
    int rays, hits, doubtful, wrong;
    double slack; // depths may differ by this, beyond the bounds
} Tally;

typedef struct {
    int count;
    PatchHit hits[256];
} HitList;

static void collect(void *context, const PatchHit *hit) {
    HitList *list = context;
    assert_true(list->count < 256);
    list->hits[list->count++] = *hit;
}

// Nearest, any and all of one ray against the oracle.
static void judge(Tally *tally, const Ray *ray, double t_min, double t_max, uint32_t mask) {
    RayOracle truth = {.count = 0};
    double nearest = INFINITY, sine = 1.0, uncertain = 0.0;
    for (int i = 0; i < scene.count; i++) {
        if (!(mask & 1u << (i % 8)) || !meets_box(&scene.box[i], ray))
            continue;
        PatchDef def = def_of(i);
        RayOracle one = {.count = 0};
        ray_oracle(&one, &def, ray, t_min, t_max);
        truth.count += one.count;
        truth.doubtful |= one.doubtful;
        for (int k = 0; k < one.count; k++) {
            sine = fmin(sine, one.root[k].sine);
            uncertain = fmax(uncertain, one.root[k].dt);
            nearest = fmin(nearest, one.root[k].t);
        }
    }
    PatchHit hit;
    PatchStats stats = {0};
    bool found = patchset_intersect(scene.set, ray, t_min, t_max, mask, &stats, &hit);
    if (found)
        check_hit(ray, &hit, t_min, t_max);
    assert_int_equal(stats.hits, found);
    assert_int_equal(patchset_occluded(scene.set, ray, t_min, t_max, mask, NULL), found);
    HitList list = {0};
    patchset_all(scene.set, ray, t_min, t_max, mask, NULL, collect, &list);
    double first = INFINITY;
    for (int k = 0; k < list.count; k++) {
        check_hit(ray, &list.hits[k], t_min, t_max);
        first = fmin(first, list.hits[k].t);
    }
    tally->rays++;
    tally->hits += found;
    if (truth.doubtful) {
        tally->doubtful++;
        return;
    }
    bool right = found == (truth.count > 0) && list.count == truth.count;
    if (right && found) {
        double length = vec_length(ray->dir),
               depth = 4.0 * hit.bound / fmax(sine, 1e-6) + tally->slack + uncertain * length;
        right = fabs(hit.t - nearest) * length <= depth && fabs(first - hit.t) * length <= depth;
    }
    if (!right && tally->wrong++ < 5)
        printf("org %.17g %.17g %.17g dir %.17g %.17g %.17g: %d, %.17g instead of %d, %.17g (sine "
               "%g)\n",
               ray->org.x, ray->org.y, ray->org.z, ray->dir.x, ray->dir.y, ray->dir.z, list.count,
               found ? hit.t : -1.0, truth.count, nearest, sine);
}

static void expect(const char *what, const Tally *tally, int least_hits) {
    printf("%s: %d rays, %d hits, %d doubtful, %d wrong\n", what, tally->rays, tally->hits,
           tally->doubtful, tally->wrong);
    assert_int_equal(tally->wrong, 0);
    assert_true(tally->hits >= least_hits);
    assert_true(tally->slack > 0.0 || tally->doubtful * 20 <= tally->rays);
}

static Vec3 random_in(Rng *rng, const Box *box) {
    return vec3(rng_range(rng, box->low.x, box->high.x), rng_range(rng, box->low.y, box->high.y),
                rng_range(rng, box->low.z, box->high.z));
}

// A point of a sphere around the scene, `distance` sizes away from its middle.
static Vec3 random_start(Rng *rng, double distance) {
    Box box = patchset_bounds(scene.set);
    Vec3 middle = vec_scale(vec_add(box.low, box.high), 0.5);
    double size = vec_length(vec_sub(box.high, box.low));
    return vec_madd(middle, distance * size, random_direction(rng));
}

// A ray from such a point towards one of the scene's box.
static Ray random_ray(Rng *rng, double distance) {
    Box box = patchset_bounds(scene.set);
    Ray ray = {.org = random_start(rng, distance)};
    ray.dir = vec_sub(random_in(rng, &box), ray.org);
    return ray;
}

// ---- Tests

static void random_patches_as_the_oracle(void **state) {
    (void)state;
    Rng rng = {1};
    Tally tally = {0};
    for (int round = 0; round < 12; round++) {
        scene.count = 1 + round % 4;
        for (int i = 0; i < scene.count; i++)
            random_patch(&rng, round < 6 ? 3 : 1 + (int)(rng_next(&rng) % 6),
                         round < 6 ? 3 : 1 + (int)(rng_next(&rng) % 6), round % 3 * 0.4,
                         &scene.patch[i]);
        commit(METHOD_QI);
        for (int i = 0; i < 60; i++) {
            Ray ray = random_ray(&rng, i % 2 ? 2.0 : 0.1);
            judge(&tally, &ray, 0.0, INFINITY, 0xff);
            judge(&tally, &ray, rng_range(&rng, 0.5, 1.0), rng_range(&rng, 1.0, 1.2), 0x5);
        }
        release();
    }
    expect("random patches", &tally, 300);
}

static void teapot_as_the_oracle(void **state) {
    (void)state;
    NEED_TEAPOT();
    commit(METHOD_QI);
    Rng rng = {2};
    Tally tally = {0};
    for (int i = 0; i < 500; i++) {
        Ray ray = random_ray(&rng, i % 2 ? 1.5 : 0.2);
        judge(&tally, &ray, 0.0, INFINITY, 0xff);
    }
    expect("teapot", &tally, 200);
    release();
}

// Aims at S(u,v) of one patch from outside the scene.
static Ray ray_at(Rng *rng, int patch, double u, double v) {
    Ray ray = {.org = random_start(rng, 1.2)};
    ray.dir = vec_sub(bezier_eval(&scene.patch[patch], u, v), ray.org);
    return ray;
}

// Where pieces end: each crossing is found from two or four of them and must count once.
static void piece_borders_count_once(void **state) {
    (void)state;
    Rng rng = {3};
    Tally tally = {0};
    for (int round = 0; round < 3; round++) {
        scene.count = 1;
        random_patch(&rng, 3, 3, round * 0.3, &scene.patch[0]);
        commit(METHOD_QI);
        for (int i = 0; i < 200; i++) {
            int steps = 2 << rng_next(&rng) % 5,
                at = 1 + (int)(rng_next(&rng) % (uint64_t)(steps - 1));
            double u = (double)at / steps, v = rng_unit(&rng);
            if (i % 3 == 0)
                v = 0.5;
            Ray ray = i % 2 ? ray_at(&rng, 0, u, v) : ray_at(&rng, 0, v, u);
            judge(&tally, &ray, 0.0, INFINITY, 0xff);
        }
        release();
    }
    expect("piece borders", &tally, 500);
}

static void methods_agree(void **state) {
    (void)state;
    NEED_TEAPOT();
    enum { RAYS = 700 };
    static PatchHit hits[2][RAYS];
    static bool found[2][RAYS];
    static Ray rays[RAYS];
    int both = 0;
    for (int method = METHOD_QI; method <= METHOD_QI_PAPER; method++) {
        commit((PatchMethod)method);
        Rng rng = {4};
        for (int i = 0; i < RAYS; i++) {
            rays[i] = random_ray(&rng, 1.0);
            found[method][i] =
                patchset_intersect(scene.set, &rays[i], 0, INFINITY, 0xff, NULL, &hits[method][i]);
            if (found[method][i])
                check_hit(&rays[i], &hits[method][i], 0, INFINITY);
        }
        patchset_destroy(scene.set);
    }
    for (int i = 0; i < RAYS; i++) {
        assert_int_equal(found[0][i], found[1][i]);
        if (!found[0][i])
            continue;
        both++;
        double sine = fabs(vec_dot(vec_normalize(rays[i].dir), hits[0][i].normal));
        double bound = 2.0 * (hits[0][i].bound + hits[1][i].bound) / sine;
        assert_true(fabs(hits[0][i].t - hits[1][i].t) * vec_length(rays[i].dir) <= bound);
    }
    assert_true(both > 200);
    scene.count = 0;
}

// The four points of a side: 0 u = 0, 1 u = 1, 2 v = 0, 3 v = 1.
static void side_of(const Bezier *s, int side, bool backwards, Vec3 out[4]) {
    for (int k = 0; k < 4; k++) {
        int at = backwards ? 3 - k : k;
        out[k] = side < 2 ? bezier_at(s, 3 * side, at) : bezier_at(s, at, 3 * (side - 2));
    }
}

typedef struct {
    int patch, side;
} Side;

// Sides that two patches of the scene have in common and that are curves; and those that are
// points.
static void find_sides(Side shared[64], int *shared_count, Side poles[16], int *pole_count) {
    *shared_count = *pole_count = 0;
    for (int a = 0; a < scene.count * 4; a++) {
        Vec3 own[4], other[4];
        side_of(&scene.patch[a / 4], a % 4, false, own);
        if (memcmp(&own[0], &own[1], sizeof own[0]) == 0 &&
            memcmp(&own[0], &own[3], sizeof own[0]) == 0) {
            poles[(*pole_count)++] = (Side){a / 4, a % 4};
            continue;
        }
        for (int b = 0; b < scene.count * 8; b++) {
            if (b / 8 <= a / 4)
                continue;
            side_of(&scene.patch[b / 8], b / 2 % 4, b % 2, other);
            if (memcmp(own, other, sizeof own) == 0)
                shared[(*shared_count)++] = (Side){a / 4, a % 4};
        }
    }
}

static Vec3 side_point(Side side, double t) {
    const Bezier *patch = &scene.patch[side.patch];
    return side.side < 2 ? bezier_eval(patch, side.side, t) : bezier_eval(patch, t, side.side - 2);
}

// 20,000 rays at edges and corners that patches share: each must be stopped there, or before.
static void shared_edges_do_not_leak(void **state) {
    (void)state;
    NEED_TEAPOT();
    commit(METHOD_QI);
    Side shared[64], poles[16];
    int shared_count, pole_count, leaks = 0;
    find_sides(shared, &shared_count, poles, &pole_count);
    assert_true(shared_count >= 40);
    Rng rng = {5};
    for (int i = 0; i < 20000; i++) {
        double t = i % 10 == 0 ? (double)(i / 10 % 2) : i % 10 == 1 ? 0.5 : rng_unit(&rng);
        Vec3 target = side_point(shared[rng_next(&rng) % (uint64_t)shared_count], t);
        Ray ray = {vec_madd(vec3(0, 0, 1.5), 8.0, random_direction(&rng)), {0, 0, 0}};
        ray.dir = vec_sub(target, ray.org);
        PatchHit hit;
        bool found = patchset_intersect(scene.set, &ray, 0, INFINITY, 0xff, NULL, &hit);
        if (!found || hit.t > 1.0 + 1e-6)
            leaks++;
        if (found && i % 50 == 0)
            check_hit(&ray, &hit, 0, INFINITY);
    }
    printf("%d shared edges: %d leaks of 20000\n", shared_count, leaks);
    assert_int_equal(leaks, 0);
    release();
}

static void poles_are_one_hit(void **state) {
    (void)state;
    NEED_TEAPOT();
    commit(METHOD_QI);
    Side shared[64], poles[16];
    int shared_count, pole_count, leaks = 0;
    find_sides(shared, &shared_count, poles, &pole_count);
    assert_int_equal(pole_count, 8);
    Rng rng = {6};
    Tally tally = {0};
    for (int i = 0; i < 1500; i++) {
        Vec3 pole = side_point(poles[i % pole_count], rng_unit(&rng));
        // From above at the lid, from below at the bottom.
        Vec3 from = random_direction(&rng);
        from.z = copysign(fabs(from.z) + 0.1, pole.z - 0.1);
        Ray ray = {vec_madd(pole, 5.0, from), {0, 0, 0}};
        double off = i % 3 == 0 ? 0.0 : pow(10.0, -2 - (int)(rng_next(&rng) % 11));
        Vec3 target = vec_add(pole, vec_scale(vec3(rng_unit(&rng), rng_unit(&rng), 0), off));
        ray.dir = vec_sub(target, ray.org);
        PatchHit hit;
        if (!patchset_intersect(scene.set, &ray, 0, INFINITY, 0xff, NULL, &hit) || hit.t > 1.1)
            leaks++;
        else
            check_hit(&ray, &hit, 0, INFINITY);
        if (off >= 1e-6 && i % 4 == 0)
            judge(&tally, &ray, 0, INFINITY, 0xff);
    }
    printf("poles: %d leaks\n", leaks);
    assert_int_equal(leaks, 0);
    expect("beside poles", &tally, 100);
    // Exactly at the pole one patch gives one hit, whatever v.
    int only = poles[0].patch;
    scene.patch[0] = scene.patch[only];
    release();
    scene.count = 1;
    commit(METHOD_QI);
    for (int i = 0; i < 100; i++) {
        Vec3 pole = side_point((Side){0, poles[0].side}, 0.5), from = random_direction(&rng);
        Ray ray = {vec_madd(pole, 5.0, from), vec_neg(from)};
        HitList list = {0};
        patchset_all(scene.set, &ray, 4.999, 5.001, 0xff, NULL, collect, &list);
        assert_true(list.count <= 2); // a second one where the ray comes back close by
        for (int k = 1; k < list.count; k++)
            assert_true(fabs(list.hits[k].t - list.hits[0].t) > 1e-9);
    }
    release();
}

// Parallel to a tangent plane and a little above or below.
static void grazing_as_the_oracle(void **state) {
    (void)state;
    Rng rng = {7};
    for (int power = 2; power <= 8; power += 2) {
        Tally tally = {0};
        for (int round = 0; round < 3; round++) {
            scene.count = 1;
            random_patch(&rng, 3, 3, 0.1, &scene.patch[0]);
            commit(METHOD_QI);
            for (int i = 0; i < 60; i++) {
                Vec3 su, sv;
                Vec3 p = bezier_eval1(&scene.patch[0], rng_unit(&rng), rng_unit(&rng), &su, &sv);
                Vec3 n = vec_normalize(vec_cross(su, sv));
                Vec3 d = vec_add(vec_scale(su, rng_range(&rng, -1, 1)),
                                 vec_scale(sv, rng_range(&rng, -1, 1)));
                p = vec_madd(p, (i % 2 ? 1 : -1) * pow(10.0, -power), n);
                Ray ray = {vec_madd(p, -4.0 / vec_length(d), d), d};
                judge(&tally, &ray, 0, INFINITY, 0xff);
            }
            release();
        }
        char what[32];
        snprintf(what, sizeof what, "grazing 1e-%d", power);
        expect(what, &tally, 60);
    }
}

static void scales_and_offsets(void **state) {
    (void)state;
    static const struct {
        double scale, offset, dir;
    } cases[] = {{1e-6, 0, 1}, {1e-2, 0, 1e8}, {1e6, 0, 1e-8}, {1, 1e4, 1},
                 {1, 1e7, 1},  {1e-30, 0, 1},  {1e30, 0, 1}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        NEED_TEAPOT();
        move_scene(cases[k].scale, vec3(cases[k].offset, -cases[k].offset, cases[k].offset / 3));
        commit(METHOD_QI);
        Rng rng = {8};
        Tally tally = {0};
        for (int i = 0; i < 80; i++) {
            Ray ray = random_ray(&rng, 1.5);
            ray.dir = vec_scale(ray.dir, cases[k].dir);
            judge(&tally, &ray, 0, INFINITY, 0xff);
        }
        char what[64];
        snprintf(what, sizeof what, "scale %g offset %g", cases[k].scale, cases[k].offset);
        expect(what, &tally, 30);
        release();
    }
}

// Patches of sizes from 1e-6 to 1e6 about one place: all are found, each to its own tolerance.
static void mixed_sizes(void **state) {
    (void)state;
    Rng rng = {14};
    Tally tally = {0};
    scene.count = 3;
    for (int i = 0; i < 3; i++) {
        random_patch(&rng, 3, i == 1 ? 12 : 3, 0.05, &scene.patch[i]);
        double scale = pow(10.0, 6 * i - 6);
        for (int k = 0; k < bezier_count(&scene.patch[i]); k++) {
            Vec3 *p = &scene.patch[i].p[k];
            *p = vec_scale(vec_add(*p, vec3(-0.5, -0.5, 2.0 * i)), scale);
        }
    }
    commit(METHOD_QI);
    for (int i = 0; i < 150; i++) {
        int target = i % 3;
        Vec3 p = bezier_eval(&scene.patch[target], rng_unit(&rng), rng_unit(&rng));
        Vec3 d = vec_scale(random_direction(&rng), pow(10.0, 6 * target - 6));
        Ray ray = {vec_madd(p, -rng_range(&rng, 0, 5), d), d};
        judge(&tally, &ray, 0, INFINITY, 0xff);
    }
    expect("mixed sizes", &tally, 150);
    release();
}

// Sizes at the ends of double's range, directions of any length: denormal coordinates were never
// hit, a direction of length 1e-310 was no direction, 1e300 had an infinite tolerance.
static void ends_of_the_range(void **state) {
    (void)state;
    static const double sizes[] = {1e-315, 1e-300, 1.0, 1e160, 1e300};
    static const double lengths[] = {1e-312, 1e-200, 1.0, 1e200, 1e306};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        Rng rng = {15};
        scene.count = 1;
        random_patch(&rng, 3, 3, 0.1, &scene.patch[0]);
        for (int i = 0; i < 16; i++)
            scene.patch[0].p[i] = vec_scale(scene.patch[0].p[i], sizes[k]);
        commit(METHOD_QI);
        for (size_t n = 0; n < sizeof lengths / sizeof *lengths; n++) {
            double length = lengths[n] < sizes[k] * 1e-300 || lengths[n] > sizes[k] * 1e300
                                ? sizes[k] // t itself must be a number
                                : lengths[n];
            Ray ray = {{0.4 * sizes[k], 0.6 * sizes[k], -2.0 * sizes[k]}, {0, 0, length}};
            PatchHit hit;
            assert_true(patchset_intersect(scene.set, &ray, 0, INFINITY, 1, NULL, &hit));
            assert_true(patchset_occluded(scene.set, &ray, 0, INFINITY, 1, NULL));
            PatchDef def = def_of(0);
            assert_true(ray_oracle_residual(&def, &ray, hit.t, hit.u, hit.v) <= hit.bound);
            assert_true(hit.bound <= 1e-8 * sizes[k] + 0x1p-1073);
            assert_true(fabs(hit.u - 0.4) < 0.2 && fabs(hit.v - 0.6) < 0.2);
            HitList list = {0};
            patchset_all(scene.set, &ray, 0, INFINITY, 1, NULL, collect, &list);
            assert_int_equal(list.count, 1);
        }
        release();
    }
}

// A ray from very far away: its own rounding is all that may be lost.
static void far_origins(void **state) {
    (void)state;
    Rng rng = {9};
    scene.count = 1;
    random_patch(&rng, 3, 3, 0.1, &scene.patch[0]);
    commit(METHOD_QI);
    for (int i = 0; i < 200; i++) {
        double far = pow(10.0, 2 + i % 14);
        Vec3 d = vec3(rng_range(&rng, -0.2, 0.2), rng_range(&rng, -0.2, 0.2), i % 3 ? 1 : -1);
        Vec3 p = bezier_eval(&scene.patch[0], rng_range(&rng, 0.3, 0.7), rng_range(&rng, 0.3, 0.7));
        Ray ray = {vec_madd(p, -far, d), d};
        PatchHit hit;
        bool found = patchset_intersect(scene.set, &ray, 0, INFINITY, 0xff, NULL, &hit);
        if (far < 1e13) // beyond, rounding moves the ray by a share of the patch
            assert_true(found);
        PatchDef def = def_of(0);
        if (found)
            assert_true(ray_oracle_residual(&def, &ray, hit.t, hit.u, hit.v) <= hit.bound);
    }
    release();
}

static void thin_and_long_patches(void **state) {
    (void)state;
    static const double thin[] = {1e-5, 1e-10};
    Rng rng = {10};
    for (int k = 0; k < 2; k++) {
        Tally tally = {0};
        if (k == 1)
            tally.slack = 1e-8; // all of the patch is within the tolerance of its axis
        for (int round = 0; round < 4; round++) {
            scene.count = 1;
            random_patch(&rng, 3, 3, 0.1, &scene.patch[0]);
            for (int i = 0; i < 16; i++) {
                // Straight in the long direction, so that no two sheets lie on each other.
                Vec3 *p = &scene.patch[0].p[i];
                if (round % 2)
                    *p = vec3(p->x * thin[k], i % 4 / 3.0, p->z);
                else
                    *p = vec3(i / 4 / 3.0, p->y * thin[k], p->z);
                if (round >= 2)
                    p->z *= thin[k];
            }
            commit(METHOD_QI);
            for (int i = 0; i < 50; i++) {
                Ray ray = ray_at(&rng, 0, rng_unit(&rng), rng_unit(&rng));
                judge(&tally, &ray, 0, INFINITY, 0xff);
            }
            release();
        }
        char what[32];
        snprintf(what, sizeof what, "aspect %g", thin[k]);
        expect(what, &tally, 150);
    }
}

static void thin_sheets(void **state) {
    (void)state;
    Rng rng = {11};
    Tally tally = {0};
    scene.count = 2;
    random_patch(&rng, 3, 3, 0.2, &scene.patch[0]);
    scene.patch[1] = scene.patch[0];
    for (int i = 0; i < 16; i++)
        scene.patch[1].p[i].z += 1e-6;
    commit(METHOD_QI);
    for (int i = 0; i < 300; i++) {
        Ray ray = ray_at(&rng, i % 2, rng_unit(&rng), rng_unit(&rng));
        judge(&tally, &ray, 0, INFINITY, 0xff);
    }
    expect("thin sheets", &tally, 250);
    release();
}

// Infinitely many answers, or none: whatever comes is honest, and comes soon.
static void degenerate_patches(void **state) {
    (void)state;
    Rng rng = {12};
    int flat_hits = 0;
    for (int kind = 0; kind < 3; kind++) {
        scene.count = 1;
        random_patch(&rng, 3, 3, 0.0, &scene.patch[0]);
        for (int i = 0; i < 16; i++) {
            Vec3 *p = &scene.patch[0].p[i];
            *p = kind == 0   ? vec3(i / 4 / 3.0, i % 4 / 3.0, 0.25) // flat
                 : kind == 1 ? vec3(i * i / 225.0, i / 15.0, 0.5)   // a curve's points, thin
                             : vec3(0.1, 0.2, 0.3);                 // a point
            if (kind == 1)
                *p = vec3(i / 15.0, 2 * i / 15.0, -i / 15.0); // a segment
        }
        commit(METHOD_QI);
        for (int i = 0; i < 40; i++) {
            Vec3 on = bezier_eval(&scene.patch[0], rng_unit(&rng), rng_unit(&rng));
            Vec3 d = kind == 0 ? vec3(rng_range(&rng, -1, 1), rng_range(&rng, -1, 1), 0)
                               : random_direction(&rng);
            Ray ray = {vec_madd(on, -3.0, d), d};
            if (kind == 1 && i % 2)
                ray = (Ray){vec3(-1, -2, 1), vec3(1, 2, -1)}; // along the segment
            PatchHit hit;
            if (patchset_intersect(scene.set, &ray, 0, INFINITY, 0xff, NULL, &hit)) {
                check_hit(&ray, &hit, 0, INFINITY);
                flat_hits += kind == 0;
            }
            patchset_occluded(scene.set, &ray, 0, INFINITY, 0xff, NULL);
        }
        release();
    }
    assert_int_equal(flat_hits, 40);
}

static void odd_questions(void **state) {
    (void)state;
    PatchHit hit;
    scene.count = 0;
    commit(METHOD_QI);
    Ray ray = {vec3(0.5, 0.5, -5), vec3(0, 0, 1)};
    assert_false(patchset_intersect(scene.set, &ray, 0, INFINITY, 0xff, NULL, &hit));
    assert_true(patchset_bounds(scene.set).low.x > patchset_bounds(scene.set).high.x);
    release();
    Rng rng = {13};
    scene.count = 1;
    random_patch(&rng, 3, 3, 0.05, &scene.patch[0]);
    for (int method = 0; method < METHOD_COUNT; method++) {
        commit((PatchMethod)method);
        assert_true(patchset_intersect(scene.set, &ray, 0, INFINITY, 1, NULL, &hit));
        // The limits count exactly: from the hit on, and up to but without it.
        assert_true(patchset_occluded(scene.set, &ray, hit.t, INFINITY, 1, NULL));
        assert_false(patchset_occluded(scene.set, &ray, 0, hit.t, 1, NULL));
        assert_true(patchset_occluded(scene.set, &ray, 0, nextafter(hit.t, 10), 1, NULL));
        assert_false(patchset_occluded(scene.set, &ray, nextafter(hit.t, 10), INFINITY, 1, NULL));
        assert_false(patchset_occluded(scene.set, &ray, 0, INFINITY, 2, NULL));
        assert_false(patchset_occluded(scene.set, &ray, 5, 5, 1, NULL));
        Ray odd = {ray.org, vec3(-0.0, 0.0, 1)};
        assert_true(patchset_occluded(scene.set, &odd, 0, INFINITY, 1, NULL));
        if (method != METHOD_FACETS) { // behind the origin, when t_min says so
            odd = (Ray){vec_madd(ray.org, 9, ray.dir), ray.dir};
            assert_false(patchset_occluded(scene.set, &odd, 0, INFINITY, 1, NULL));
            assert_true(patchset_occluded(scene.set, &odd, -INFINITY, INFINITY, 1, NULL));
        }
        odd.dir = vec3(0, 0, 0);
        assert_false(patchset_occluded(scene.set, &odd, 0, INFINITY, 1, NULL));
        odd.dir = vec3(0, NAN, 1);
        assert_false(patchset_occluded(scene.set, &odd, 0, INFINITY, 1, NULL));
        odd = (Ray){vec3(INFINITY, 0, 0), vec3(0, 0, 1)};
        assert_false(patchset_occluded(scene.set, &odd, 0, INFINITY, 1, NULL));
        patchset_destroy(scene.set);
    }
    scene.count = 0;
    PatchMethod method;
    for (int i = 0; i < METHOD_COUNT; i++) {
        assert_true(patch_method_parse(patch_method_name((PatchMethod)i), &method));
        assert_int_equal(method, i);
    }
    assert_false(patch_method_parse("triangles", &method));
}

// The same hits, bit for bit, however many threads prepare and trace.
static void same_bits(void **state) {
    (void)state;
    enum { RAYS = 2000 };
    static PatchHit hits[2][RAYS];
    NEED_TEAPOT();
    for (int run = 0; run < 2; run++) {
        omp_set_num_threads(run ? 3 : 1);
        commit(METHOD_QI);
        memset(hits[run], 0, sizeof hits[run]);
#pragma omp parallel for schedule(dynamic, 7)
        for (int i = 0; i < RAYS; i++) {
            Rng rng = {(uint64_t)i};
            Ray ray = random_ray(&rng, 1.0);
            patchset_intersect(scene.set, &ray, 0, INFINITY, 0xff, NULL, &hits[run][i]);
        }
        if (run)
            printf("teapot: %.2f MB\n", (double)patchset_memory(scene.set) / 1e6);
        assert_true(patchset_memory(scene.set) < 2000000);
        patchset_destroy(scene.set);
    }
    scene.count = 0;
    assert_memory_equal(hits[0], hits[1], sizeof hits[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_patches_as_the_oracle),
        cmocka_unit_test(teapot_as_the_oracle),
        cmocka_unit_test(piece_borders_count_once),
        cmocka_unit_test(methods_agree),
        cmocka_unit_test(shared_edges_do_not_leak),
        cmocka_unit_test(poles_are_one_hit),
        cmocka_unit_test(grazing_as_the_oracle),
        cmocka_unit_test(scales_and_offsets),
        cmocka_unit_test(mixed_sizes),
        cmocka_unit_test(far_origins),
        cmocka_unit_test(ends_of_the_range),
        cmocka_unit_test(thin_and_long_patches),
        cmocka_unit_test(thin_sheets),
        cmocka_unit_test(degenerate_patches),
        cmocka_unit_test(odd_questions),
        cmocka_unit_test(same_bits),
    };
    return cmocka_run_group_tests_name("patchset", tests, NULL, NULL);
}
