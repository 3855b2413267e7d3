// SPDX-License-Identifier: MIT
// Isosurfaces, as POV-Ray finds them: an interval of the ray is halved as long as its two values do
// not prove, by the largest gradient, that the function stays positive; one shorter than the
// accuracy whose end is below 0 is a hit. So the accuracy and too low a gradient are seen. Depths
// are those of the world times the sink's scale.
#include "function/function.h"
#include "shape/solid.h"

typedef struct {
    const IsosurfaceShape *shape;
    FunctionPool pool;
} Iso;

enum {
    PART_SURFACE = 0,
    PART_SIDE = 1, // and which: 2 axis + (1 at its high end)
    PART_SPHERE = 7,
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
    return function_value(&iso->pool, iso->shape->function, arguments) - iso->shape->threshold;
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

static bool sphere_container(const IsosurfaceShape *shape, const Ray *ray, double t[2]) {
    Vec3 o = vec_sub(ray->org, shape->center);
    double b = vec_dot(o, ray->dir);
    double half = shape->radius * shape->radius - vec_dot(o, o) + b * b;
    if (!(half > SHAPE_EPSILON))
        return false;
    t[0] = -b - sqrt(half), t[1] = -b + sqrt(half);
    return t[1] > 0.0;
}

// Depths at which the ray enters and leaves the box, and through which sides.
static bool box_container(const IsosurfaceShape *shape, const Ray *ray, double t[2], int part[2]) {
    t[0] = -INFINITY, t[1] = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = vec_get(ray->org, axis), d = vec_get(ray->dir, axis);
        double low = vec_get(shape->low, axis), high = vec_get(shape->high, axis);
        if (d == 0.0) {
            if (o < low || o > high)
                return false;
            continue;
        }
        double a = (low - o) / d, b = (high - o) / d;
        int side = PART_SIDE + 2 * axis;
        if (fmin(a, b) > t[0])
            t[0] = fmin(a, b), part[0] = side + (d > 0.0 ? 0 : 1);
        if (fmax(a, b) < t[1])
            t[1] = fmax(a, b), part[1] = side + (d > 0.0 ? 1 : 0);
    }
    return t[0] < t[1] && t[1] > 0.0;
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

// The container's own surface where the solid is cut by it; returns how many were put in front.
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
    if (value_on(s, to) < 0.0)
        sink_put(sink, to, part[1], none);
    return 0;
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Iso *iso = data;
    const IsosurfaceShape *shape = iso->shape;
    double t[2], hit;
    int part[2] = {PART_SPHERE, PART_SPHERE}, count = 0;
    if (shape->in_sphere ? !sphere_container(shape, ray, t) : !box_container(shape, ray, t, part))
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
    if (hit->part == PART_SPHERE)
        return vec_sub(p, iso->shape->center);
    if (hit->part != PART_SURFACE) {
        double side = (hit->part - PART_SIDE) % 2 ? 1.0 : -1.0;
        int axis = (hit->part - PART_SIDE) / 2;
        return vec3(axis == 0 ? side : 0.0, axis == 1 ? side : 0.0, axis == 2 ? side : 0.0);
    }
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
    if (shape->in_sphere) {
        Vec3 o = vec_sub(p, shape->center);
        if (vec_dot(o, o) > shape->radius * shape->radius)
            return false;
    } else if (p.x < shape->low.x || p.x > shape->high.x || p.y < shape->low.y ||
               p.y > shape->high.y || p.z < shape->low.z || p.z > shape->high.z) {
        return false;
    }
    return value_at(iso, p) <= 0.0;
}

static const SolidOps OPS = {
    .near = 0.0, .far = INFINITY, .hits = hits, .normal = normal, .inside = inside};

SolidData isosurface_prepare(const Scene *scene, const IsosurfaceShape *shape, Arena *arena) {
    Iso *iso = ARENA_NEW(arena, Iso);
    iso->shape = shape;
    iso->pool = (FunctionPool){.functions = scene->functions,
                               .noise_generator = scene->settings.noise_generator};
    Box box = {shape->low, shape->high};
    if (shape->in_sphere) {
        Vec3 reach = vec3(shape->radius, shape->radius, shape->radius);
        box = (Box){vec_sub(shape->center, reach), vec_add(shape->center, reach)};
    }
    return (SolidData){&OPS, iso, box};
}
