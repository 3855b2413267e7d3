// SPDX-License-Identifier: MIT
// For tests: a world of spheres and planes, one after the other, until the real one is linked (its
// functions are strong, these are weak).
#include "render/world.h"

#include <math.h>
#include <stdlib.h>

struct World {
    const Scene *scene;
};

__attribute__((weak)) World *world_create(const Scene *scene, const PatchSetOptions *patches) {
    (void)patches;
    World *world = malloc(sizeof *world);
    if (world != NULL)
        world->scene = scene;
    return world;
}

__attribute__((weak)) void world_destroy(World *world) { free(world); }

static int crossings(const Object *object, const Ray *ray, double t[2]) {
    if (object->type == OBJECT_PLANE) {
        double slope = vec_dot(object->shape.plane.normal, ray->dir);
        if (fabs(slope) < 1e-10)
            return 0;
        t[0] =
            -(vec_dot(object->shape.plane.normal, ray->org) - object->shape.plane.distance) / slope;
        return 1;
    }
    if (object->type != OBJECT_SPHERE)
        return 0;
    Vec3 c = vec_sub(object->shape.sphere.center, ray->org);
    double length = vec_length(ray->dir), b = vec_dot(c, ray->dir) / length;
    double r = object->shape.sphere.radius, h = r * r - (vec_dot(c, c) - b * b);
    if (h < 1e-10)
        return 0;
    t[0] = (b - sqrt(h)) / length, t[1] = (b + sqrt(h)) / length;
    return 2;
}

static Vec3 normal_at(const Object *object, Vec3 p) {
    Vec3 n = object->type == OBJECT_PLANE ? object->shape.plane.normal
                                          : vec_scale(vec_sub(p, object->shape.sphere.center),
                                                      1.0 / object->shape.sphere.radius);
    return object->inverse ? vec_neg(n) : n;
}

__attribute__((weak)) bool world_intersect(const World *world, const Ray *ray, double t_min,
                                           double t_max, RayKind kind, RayStats *stats,
                                           WorldHit *hit) {
    (void)stats;
    bool found = false;
    for (uint32_t i = 0; i < world->scene->object_count; i++) {
        const Object *object = &world->scene->objects[i];
        if ((kind == RAY_CAMERA && object->no_image) ||
            (kind == RAY_REFLECTION && object->no_reflection) ||
            (kind == RAY_SHADOW && object->no_shadow))
            continue;
        double t[2];
        int count = crossings(object, ray, t);
        for (int k = 0; k < count; k++) {
            if (!(t[k] >= t_min && t[k] < t_max && t[k] > 1e-6))
                continue;
            t_max = hit->t = t[k];
            hit->p = vec_madd(ray->org, t[k], ray->dir);
            hit->normal = normal_at(object, hit->p);
            hit->u = hit->v = hit->bound = 0.0;
            hit->object = i;
            found = true;
        }
    }
    return found;
}

__attribute__((weak)) bool world_occluded(const World *world, const Ray *ray, double t_min,
                                          double t_max, RayStats *stats) {
    WorldHit hit;
    return world_intersect(world, ray, t_min, t_max, RAY_SHADOW, stats, &hit);
}

__attribute__((weak)) bool world_inside(const World *world, uint32_t index, Vec3 p) {
    const Object *object = &world->scene->objects[index];
    bool inside = false;
    if (object->type == OBJECT_PLANE)
        inside = vec_dot(object->shape.plane.normal, p) < object->shape.plane.distance;
    if (object->type == OBJECT_SPHERE)
        inside = vec_length(vec_sub(p, object->shape.sphere.center)) < object->shape.sphere.radius;
    return inside != object->inverse;
}

__attribute__((weak)) uint32_t world_containing(const World *world, Vec3 p, uint32_t *objects,
                                                uint32_t max) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < world->scene->object_count && count < max; i++)
        if (world_inside(world, i, p))
            objects[count++] = i;
    return count;
}
