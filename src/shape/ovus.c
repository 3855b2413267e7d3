// SPDX-License-Identifier: MIT
// Eggs: a ball at the origin, a smaller or larger one above it, and between them the inner part of
// a torus that touches both.
#include "shape/roots.h"
#include "shape/solid.h"

typedef struct {
    double bottom, top;        // radii
    double low, high;          // heights between which the torus counts
    double ring, height, tube; // the torus: radius and height of its ring, radius of its tube
} Ovus;

enum { PART_BOTTOM, PART_TOP, PART_MIDDLE };

static void ball_hits(const Ovus *ovus, const Ray *ray, double height, double radius, int part,
                      HitSink *sink) {
    Vec3 o = vec3(ray->org.x, ray->org.y - height, ray->org.z);
    double b = vec_dot(o, ray->dir);
    Vec3 away = vec_madd(o, -b, ray->dir);
    double half2 = radius * radius - vec_dot(away, away);
    if (!(half2 > 0.0))
        return;
    for (int side = -1; side <= 1; side += 2) {
        double t = -b + side * sqrt(half2), y = ray->org.y + t * ray->dir.y;
        if (part == PART_BOTTOM ? y < ovus->low : y > ovus->high)
            sink_put(sink, t, part, vec3(0, 0, 0));
    }
}

// (x^2 + z^2 + ring^2 + (y - height)^2 - tube^2)^2 = 4 ring^2 (x^2 + z^2), and the bracket < 0:
// that is the side of the tube across the axis.
static void middle_hits(const Ovus *ovus, const Ray *ray, HitSink *sink) {
    double start = -vec_dot(ray->org, ray->dir);
    Vec3 o = vec_madd(ray->org, start, ray->dir), d = ray->dir;
    o.y -= ovus->height;
    double a = vec_dot(o, d), ring2 = ovus->ring * ovus->ring;
    double k = vec_dot(o, o) + ring2 - ovus->tube * ovus->tube;
    double flat = d.x * d.x + d.z * d.z, across = o.x * d.x + o.z * d.z;
    double c[5] = {k * k - 4.0 * ring2 * (o.x * o.x + o.z * o.z),
                   4.0 * a * k - 8.0 * ring2 * across, 4.0 * a * a + 2.0 * k - 4.0 * ring2 * flat,
                   4.0 * a, 1.0};
    double reach = ovus->ring + ovus->tube + fabs(ovus->height) + fabs(a), roots[4];
    int count = roots_find(c, 4, -reach, reach, roots);
    for (int i = 0; i < count; i++) {
        double t = roots[i], y = o.y + t * d.y + ovus->height;
        double bracket = (t + 2.0 * a) * t + k;
        if (bracket <= 0.0 && y >= ovus->low && y <= ovus->high)
            sink_put(sink, start + t, PART_MIDDLE, vec3(0, 0, 0));
    }
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Ovus *ovus = data;
    ball_hits(ovus, ray, 0.0, ovus->bottom, PART_BOTTOM, sink);
    ball_hits(ovus, ray, ovus->bottom, ovus->top, PART_TOP, sink);
    middle_hits(ovus, ray, sink);
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Ovus *ovus = data;
    if (hit->part == PART_BOTTOM)
        return p;
    if (hit->part == PART_TOP)
        return vec3(p.x, p.y - ovus->bottom, p.z);
    double r = sqrt(p.x * p.x + p.z * p.z), k = r > 0.0 ? 1.0 + ovus->ring / r : 1.0;
    return vec3(p.x * k, p.y - ovus->height, p.z * k);
}

static bool inside(const void *data, Vec3 p) {
    const Ovus *ovus = data;
    Vec3 up = vec3(p.x, p.y - ovus->bottom, p.z);
    if (vec_dot(p, p) < ovus->bottom * ovus->bottom || vec_dot(up, up) < ovus->top * ovus->top)
        return true;
    double r = sqrt(p.x * p.x + p.z * p.z) + ovus->ring, h = p.y - ovus->height;
    return p.y > ovus->low && p.y < ovus->high && r * r + h * h < ovus->tube * ovus->tube;
}

static Vec2 uv(const void *data, Vec3 p, const ShapeHit *hit) {
    const Ovus *ovus = data;
    (void)hit;
    Vec3 q = vec3(p.x, p.y - 0.5 * ovus->top, p.z);
    double length = vec_length(q);
    if (!(length > 0.0))
        return (Vec2){0, 0};
    q = vec_scale(q, 1.0 / length);
    return (Vec2){solid_angle(q), 0.5 + asin(fmax(-1.0, fmin(1.0, q.y))) / M_PI};
}

static const SolidOps OPS = {.near = 1e-4,
                             .far = SHAPE_FARTHEST,
                             .hits = hits,
                             .normal = normal,
                             .inside = inside,
                             .uv = uv};

// The torus that touches both balls from outside. Its tube is as thick as the larger ball is wide.
SolidData ovus_prepare(const OvusShape *shape, Arena *arena) {
    Ovus *o = ARENA_NEW(arena, Ovus);
    double b = shape->bottom, t = shape->top;
    *o = (Ovus){.bottom = b, .top = t};
    if (b > t) {
        o->tube = 2.0 * b;
        o->height = 2.0 * t - b - t * t / (2.0 * b);
        o->ring = sqrt(fmax(b * b - o->height * o->height, 0.0));
        o->low = -o->height;
        o->high = (b - o->height) * t / (o->tube - t) + b;
    } else {
        o->tube = 2.0 * t;
        o->height = -2.0 * t + b + 1.5 * t * t / b;
        o->ring = sqrt(fmax(t * t - (o->height - b) * (o->height - b), 0.0));
        o->high = 2.0 * b - o->height;
        o->low = -o->height * b / (o->tube - b);
    }
    double r = fmax(fmax(b, t), o->tube - o->ring);
    return (SolidData){&OPS, o, {{-r, -b, -r}, {r, b + t, r}}};
}
