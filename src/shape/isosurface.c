// SPDX-License-Identifier: MIT
// Isosurfaces, as POV-Ray finds them: an interval of the ray is halved as long as its two values do
// not prove, by the largest gradient, that the function stays positive; one shorter than the
// accuracy whose end is below 0 is a hit. So the accuracy and too low a gradient are seen. Depths
// are those of the world times the sink's scale.
#include "function/function.h"
#include "shape/container.h"
#include "shape/solid.h"

typedef struct {
    const IsosurfaceShape *shape;
    const FunctionPool *pool;
} Iso;

enum {
    PART_SURFACE = CONTAINER_SPHERE + 1,
    MAX_EVALUATIONS = 100000, // for one ray: a scene cannot keep it busy for ever
};

typedef struct {
    const Iso *iso;
    const Ray *ray;
    double accuracy, gradient;
    int turned; // -1: looked at from inside, all values negated
    int left;   // evaluations
} Search;

static double value_at(const Iso *iso, Vec3 p) {
    const double arguments[3] = {p.x, p.y, p.z};
    return function_value(iso->pool, iso->shape->function, arguments) - iso->shape->threshold;
}

static double value_on(Search *s, double t) {
    s->left--;
    return value_at(s->iso, vec_madd(s->ray->org, t, s->ray->dir));
}

// The first place in from..to where the value is below 0.
static bool search(Search *s, double from, double at_from, double to, double at_to, double *hit) {
    const IsosurfaceShape *shape = s->iso->shape;
    double length = to - from, steep = fabs(at_to - at_from) / length;
    if (shape->evaluate && s->gradient < steep * shape->evaluate_over)
        s->gradient = steep * shape->evaluate_over * shape->evaluate_over;
    if (length < s->accuracy) {
        *hit = to;
        return at_to < 0.0;
    }
    if (!(at_from + at_to - s->gradient * length < 0.0) || s->left <= 0)
        return false;
    double middle = from + 0.5 * length;
    if (!(middle > from && middle < to))
        return false;
    double at_middle = s->turned * value_on(s, middle);
    return search(s, from, at_from, middle, at_middle, hit) ||
           search(s, middle, at_middle, to, at_to, hit);
}

static bool find_root(Search *s, double from, double to, double *hit) {
    const IsosurfaceShape *shape = s->iso->shape;
    double at_from = s->turned * value_on(s, from);
    if (shape->open && at_from < 0.0) {
        s->turned = -s->turned;
        at_from = -at_from;
    }
    double at_to = s->turned * value_on(s, to);
    if (shape->evaluate && s->gradient > shape->evaluate_from)
        s->gradient *= shape->evaluate_fall;
    return search(s, from, at_from, to, at_to, hit);
}

// The ray begins on the surface (as those that leave it do): it is looked for a little farther on.
static double leave_surface(Search *s, double from, bool near) {
    double next = 5.0 * s->accuracy;
    if (!near)
        return from;
    if (value_on(s, next) < 0.0)
        s->turned = -1;
    return next;
}

// The container's own surface where the solid is cut by it; returns how many were put in front. A
// ray that begins closer to the end than is left of it has no hit at all.
static int close_ends(Search *s, double *from, double to, const int part[2], HitSink *sink) {
    const Vec3 none = {0, 0, 0};
    double at = value_on(s, *from);
    if (*from > s->accuracy) {
        if (!(at < 0.0))
            return 0;
        sink_put(sink, *from, part[0], none);
        s->turned = -1;
        return 1;
    }
    *from = leave_surface(s, *from, at < 4.0 * s->gradient * s->accuracy);
    if (to - *from >= s->accuracy && value_on(s, to) < 0.0)
        sink_put(sink, to, part[1], none);
    return 0;
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Iso *iso = data;
    const IsosurfaceShape *shape = iso->shape;
    double t[2], hit;
    int part[2], count = 0;
    if (!container_meet(&shape->container, ray, t, part))
        return;
    // The gradient is one of the local space, the accuracy one of the world.
    Search s = {iso, ray, shape->accuracy * sink->scale, shape->max_gradient, 1, MAX_EVALUATIONS};
    double from = fmax(t[0], 0.0), to = t[1];
    if (to - from < s.accuracy)
        return;
    if (!shape->open)
        count = close_ends(&s, &from, to, part, sink);
    if (from < s.accuracy && s.turned == 1)
        from = leave_surface(&s, from, fabs(value_on(&s, from)) < 4.0 * s.gradient * s.accuracy);
    for (; count < shape->max_trace && to - from >= s.accuracy; count++) {
        if (!find_root(&s, from, to, &hit))
            return;
        sink_put(sink, hit, PART_SURFACE, vec3(0, 0, 0));
        from = hit + 5.0 * s.accuracy;
        s.turned = -s.turned;
    }
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Iso *iso = data;
    if (hit->part != PART_SURFACE)
        return container_normal(&iso->shape->container, p, hit->part);
    double h = iso->shape->accuracy, at = value_at(iso, p);
    Vec3 n = vec3(value_at(iso, vec_add(p, vec3(h, 0, 0))) - at,
                  value_at(iso, vec_add(p, vec3(0, h, 0))) - at,
                  value_at(iso, vec_add(p, vec3(0, 0, h))) - at);
    bool good = vec_is_finite(n) && vec_dot(n, n) > 0.0;
    return good ? vec_normalize(n) : vec3(1, 0, 0);
}

static bool inside(const void *data, Vec3 p) {
    const Iso *iso = data;
    const IsosurfaceShape *shape = iso->shape;
    if (!container_holds(&shape->container, p))
        return false;
    return value_at(iso, p) <= 0.0;
}

static const SolidOps OPS = {
    .near = 0.0, .far = INFINITY, .hits = hits, .normal = normal, .inside = inside};

SolidData isosurface_prepare(const IsosurfaceShape *shape, const FunctionPool *pool, Arena *arena) {
    Iso *iso = ARENA_NEW(arena, Iso);
    *iso = (Iso){shape, pool};
    return (SolidData){&OPS, iso, container_bounds(&shape->container)};
}
