// SPDX-License-Identifier: MIT
// Quadrics: a quadratic in the depth. POV-Ray wants a discriminant above zero.
#include "shape/solid.h"

static double slope(const double *coefficient, double a, double b) {
    return coefficient[0] * a + coefficient[1] * b;
}

// Half the gradient without the linear terms, at v: the matrix times v.
static Vec3 matrix_times(const QuadricShape *q, Vec3 v) {
    const double x[2] = {0.5 * q->mixed.x, 0.5 * q->mixed.y};
    const double y[2] = {0.5 * q->mixed.x, 0.5 * q->mixed.z};
    const double z[2] = {0.5 * q->mixed.y, 0.5 * q->mixed.z};
    return vec3(q->square.x * v.x + slope(x, v.y, v.z), q->square.y * v.y + slope(y, v.x, v.z),
                q->square.z * v.z + slope(z, v.x, v.y));
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const QuadricShape *q = data;
    Vec3 md = matrix_times(q, ray->dir), mo = matrix_times(q, ray->org);
    double a = vec_dot(md, ray->dir);
    double b = vec_dot(mo, ray->dir) + 0.5 * vec_dot(q->linear, ray->dir);
    double c = vec_dot(mo, ray->org) + vec_dot(q->linear, ray->org) + q->constant;
    const Vec3 none = {0, 0, 0};
    // a t^2 + 2 b t + c; the roots' sizes tell when a is as good as none.
    double scale = fmax(fabs(b), fabs(c));
    if (fabs(a) <= 1e-15 * scale) {
        if (b != 0.0)
            sink_put(sink, -0.5 * c / b, 0, none);
        return;
    }
    double discriminant = b * b - a * c;
    if (!(discriminant > 0.0))
        return;
    double s = -(b + copysign(sqrt(discriminant), b));
    double t0 = s / a, t1 = s != 0.0 ? c / s : t0;
    sink_put(sink, fmin(t0, t1), 0, none);
    sink_put(sink, fmax(t0, t1), 0, none);
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const QuadricShape *q = data;
    (void)hit;
    return vec_add(vec_scale(matrix_times(q, p), 2.0), q->linear);
}

static bool inside(const void *data, Vec3 p) {
    const QuadricShape *q = data;
    return vec_dot(vec_add(matrix_times(q, p), q->linear), p) + q->constant <= 0.0;
}

// POV-Ray turns the normal of an inverse quadric round twice.
static const SolidOps OPS = {.near = 1e-6,
                             .far = SHAPE_FARTHEST,
                             .hits = hits,
                             .normal = normal,
                             .inside = inside,
                             .keeps_normal = true};

// With negative squares the inside is what lies around the ellipsoid.
static const SolidOps OPS_AROUND = {.near = 1e-6,
                                    .far = SHAPE_FARTHEST,
                                    .hits = hits,
                                    .normal = normal,
                                    .inside = inside,
                                    .deep = true,
                                    .keeps_normal = true};

// Of ellipsoids and elliptic cylinders along the axes: sum of k (x - c)^2 = rest, all k of one
// sign. Infinite where there is no such bound.
static Box box_of(const QuadricShape *q) {
    Box box = SOLID_INFINITE;
    double rest = -q->constant, sign = 0.0;
    if (q->mixed.x != 0.0 || q->mixed.y != 0.0 || q->mixed.z != 0.0)
        return box;
    for (int axis = 0; axis < 3; axis++) {
        double k = vec_get(q->square, axis), linear = vec_get(q->linear, axis);
        if (k == 0.0 ? linear != 0.0 : k * sign < 0.0)
            return box;
        if (k != 0.0)
            sign = k, rest += 0.25 * linear * linear / k;
    }
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        double k = vec_get(q->square, axis), reach = sqrt(fmax(rest / k, 0.0));
        double center = -0.5 * vec_get(q->linear, axis) / k;
        low[axis] = k != 0.0 ? center - reach : -INFINITY;
        high[axis] = k != 0.0 ? center + reach : INFINITY;
        if (isnan(low[axis]) || isnan(high[axis]))
            return box;
    }
    return (Box){vec3(low[0], low[1], low[2]), vec3(high[0], high[1], high[2])};
}

SolidData quadric_prepare(const QuadricShape *quadric, Arena *arena) {
    (void)arena;
    bool around = quadric->square.x < 0.0 || quadric->square.y < 0.0 || quadric->square.z < 0.0;
    return (SolidData){around ? &OPS_AROUND : &OPS, quadric, box_of(quadric)};
}

const QuadricShape *solid_quadric(const SolidData *solid) {
    return solid->ops == &OPS || solid->ops == &OPS_AROUND ? solid->data : NULL;
}
