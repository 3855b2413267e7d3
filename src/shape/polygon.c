// SPDX-License-Identifier: MIT
// Flat polygons with any number of rings, by the even-odd rule in a frame of their plane that the
// first points span, as POV-Ray has it: the normal's side depends on them.
#include "shape/solid.h"

typedef struct {
    Vec3 origin, u, v, w;
    Vec2 *points;
    uint32_t count;
} Polygon;

// Points exactly on a lower or left edge are inside, on an upper or right one outside.
static bool holds(const Polygon *polygon, double x, double y) {
    bool odd = false;
    Vec2 first = polygon->points[0];
    for (uint32_t i = 1; i < polygon->count; i++) {
        Vec2 a = polygon->points[i - 1], b = polygon->points[i];
        if ((a.v > y) != (b.v > y) && x < a.u + (y - a.v) / (b.v - a.v) * (b.u - a.u))
            odd = !odd;
        // The ring is closed: the next point begins another.
        if (b.u == first.u && b.v == first.v && i + 1 < polygon->count)
            first = polygon->points[++i];
    }
    return odd;
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Polygon *polygon = data;
    double slope = vec_dot(ray->dir, polygon->w);
    Vec3 from = vec_sub(ray->org, polygon->origin);
    if (!(fabs(slope) >= SHAPE_EPSILON))
        return;
    double t = -vec_dot(from, polygon->w) / slope;
    if (!(t >= 1e-8 && t <= SHAPE_FARTHEST))
        return;
    Vec3 p = vec_madd(from, t, ray->dir);
    if (holds(polygon, vec_dot(p, polygon->u), vec_dot(p, polygon->v)))
        sink_put(sink, t, 0, vec3(0, 0, 0));
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Polygon *polygon = data;
    (void)p, (void)hit;
    return polygon->w;
}

static const SolidOps OPS = {.near = 0.0, .far = INFINITY, .hits = hits, .normal = normal};

// Two directions from the first point; false: all points are (nearly) in one line.
static bool span(const Vec3 *p, uint32_t count, Vec3 *u, Vec3 *w) {
    uint32_t i = 1;
    for (; i < count; i++) {
        *u = vec_sub(p[i], p[0]);
        if (vec_dot(*u, *u) > SHAPE_EPSILON)
            break;
    }
    for (i++; i < count; i++) {
        Vec3 v = vec_sub(p[i], p[0]);
        *w = vec_cross(*u, v);
        if (vec_dot(v, v) > SHAPE_EPSILON && vec_dot(*w, *w) > SHAPE_EPSILON)
            return true;
    }
    return false;
}

SolidData polygon_prepare(const PolygonShape *shape, Arena *arena) {
    Polygon *polygon = ARENA_NEW(arena, Polygon);
    Box box = box_empty();
    Vec3 u, w;
    if (!span(shape->points, shape->count, &u, &w))
        return (SolidData){0};
    *polygon = (Polygon){.origin = shape->points[0],
                         .u = vec_normalize(u),
                         .w = vec_normalize(w),
                         .points = ARENA_ARRAY(arena, Vec2, shape->count),
                         .count = shape->count};
    polygon->v = vec_normalize(vec_cross(w, u));
    for (uint32_t i = 0; i < shape->count; i++) {
        Vec3 p = vec_sub(shape->points[i], polygon->origin);
        // POV-Ray drops what is not flat.
        if (fabs(vec_dot(p, polygon->w)) > SHAPE_EPSILON)
            return (SolidData){0};
        polygon->points[i] = (Vec2){vec_dot(p, polygon->u), vec_dot(p, polygon->v)};
        box = box_extend(box, shape->points[i]);
    }
    return (SolidData){&OPS, polygon, box};
}
