// SPDX-License-Identifier: MIT
#include "bench/views.h"

#include "base/diag.h"
#include "base/rng.h"

#include <stdio.h>
#include <string.h>

// ORDER view
static const char *const names[VIEW_COUNT] = {"full", "zoom", "scattered"};

const char *view_name(View view) { return names[view]; }

const Vec3 *teapot_points(Arena *arena) {
    static const char path[] = "/usr/share/doc/povray/examples/advanced/teapot/teapot.inc";
    enum { COUNT = TEAPOT_PATCHES * 16 };
    Vec3 *points = ARENA_ARRAY(arena, Vec3, COUNT);
    FILE *in = fopen(path, "r");
    if (!in)
        die("cannot read '%s' (package povray-examples)", path);
    char line[1000];
    int count = 0;
    while (fgets(line, sizeof line, in)) {
        for (char *at = strstr(line, "//") ? NULL : line; at && (at = strchr(at, '<')); at++) {
            Vec3 p;
            if (count < COUNT && sscanf(at, "<%lf, %lf, %lf>", &p.x, &p.y, &p.z) == 3)
                points[count++] = p;
        }
    }
    fclose(in);
    if (count != COUNT)
        die("'%s' has %d points instead of %d", path, count, COUNT);
    return points;
}

const Vec3 *lattice_points(Arena *arena, size_t patches) {
    const Vec3 *teapot = teapot_points(arena);
    Box box = points_bounds(teapot, (size_t)TEAPOT_PATCHES * 16);
    Vec3 step = vec_scale(vec_sub(box.high, box.low), 1.1);
    size_t teapots = (patches + TEAPOT_PATCHES - 1) / TEAPOT_PATCHES, side = 1;
    while (side * side * side < teapots)
        side++;
    Vec3 *points = ARENA_ARRAY(arena, Vec3, patches * 16);
    Rng rng = {patches};
    for (size_t i = 0; i < patches; i++) {
        size_t pot = i / TEAPOT_PATCHES;
        Vec3 at = vec3(step.x * (double)(pot % side), step.y * (double)(pot / side % side),
                       step.z * (double)(pot / side / side));
        for (size_t k = 0; k < 16; k++) {
            Vec3 jitter = vec3(rng_range(&rng, -1e-3, 1e-3), rng_range(&rng, -1e-3, 1e-3),
                               rng_range(&rng, -1e-3, 1e-3));
            points[i * 16 + k] = vec_add(vec_add(teapot[i % TEAPOT_PATCHES * 16 + k], at), jitter);
        }
    }
    return points;
}

Box points_bounds(const Vec3 *points, size_t count) {
    Box box = box_empty();
    for (size_t i = 0; i < count; i++)
        box = box_extend(box, points[i]);
    return box;
}

PatchSet *set_of_points(const Vec3 *points, size_t patches, const PatchSetOptions *options) {
    PatchSet *set = patchset_create(options);
    for (size_t i = 0; i < patches; i++) {
        PatchDef def = {.degree_u = 3,
                        .degree_v = 3,
                        .points = points + 16 * i,
                        .id = (uint32_t)i,
                        .mask = 1,
                        .u_steps = 5,
                        .v_steps = 5};
        patchset_add(set, &def);
    }
    return set;
}

// ---- Rays

// Pixels in tiles of 4 x 4.
static void camera(Ray *rays, double x0, double x1, double z0, double z1) {
    const Vec3 org = vec3(0.0, -10.0, 1.5);
    for (int y = 0; y < VIEW_SIDE; y += 4) {
        for (int x = 0; x < VIEW_SIDE; x += 4) {
            for (int k = 0; k < VIEW_GROUP; k++) {
                double px = x0 + (x1 - x0) * (x + k % 4 + 0.5) / VIEW_SIDE;
                double pz = z1 + (z0 - z1) * (y + k / 4 + 0.5) / VIEW_SIDE;
                *rays++ = (Ray){org, vec_sub(vec3(px, 0.0, pz), org)};
            }
        }
    }
}

static Vec3 on_sphere(Rng *rng, Vec3 center, double radius) {
    for (;;) {
        Vec3 d = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        double length = vec_length(d);
        if (length > 0.1 && length < 1.0)
            return vec_madd(center, radius / length, d);
    }
}

static void scatter(Ray *rays, Box box) {
    Rng rng = {1};
    Vec3 center = vec_scale(vec_add(box.low, box.high), 0.5);
    double radius = 0.5 * vec_length(vec_sub(box.high, box.low));
    for (int i = 0; i < VIEW_RAYS; i++) {
        Vec3 a = on_sphere(&rng, center, radius), b = on_sphere(&rng, center, radius);
        rays[i] = (Ray){a, vec_normalize(vec_sub(b, a))};
    }
}

const Ray *view_rays(Arena *arena, View view, Box bounds) {
    Ray *rays = ARENA_ARRAY(arena, Ray, VIEW_RAYS);
    switch (view) {
    case VIEW_FULL:
        camera(rays, -3.6, 3.6, -2.1, 5.1);
        break;
    case VIEW_ZOOM:
        camera(rays, -1.35, 1.35, 0.15, 2.2);
        break;
    case VIEW_SCATTERED:
    case VIEW_COUNT:
        scatter(rays, bounds);
        break;
    }
    return rays;
}
