// SPDX-License-Identifier: MIT
// Polynomials of any order in x, y and z. Along a ray each is a polynomial in the depth, made by
// Horner's rule with polynomials in place of numbers; counted from the point nearest to the origin,
// so that its coefficients do not lose their digits far away.
#include "shape/roots.h"
#include "shape/solid.h"

#include <string.h>

enum { TERMS = SCENE_MAX_ORDER + 1 };

// p = p * (a + b t) + q; p has `degree` + 1 terms before and one more after, q the same or less.
static void multiply_add(double *p, int degree, double a, double b, const double *q, int q_degree) {
    p[degree + 1] = degree >= 0 ? b * p[degree] : 0.0;
    for (int i = degree; i > 0; i--)
        p[i] = a * p[i] + b * p[i - 1];
    if (degree >= 0)
        p[0] *= a;
    for (int i = 0; i <= q_degree; i++)
        p[i] += q[i];
}

// Coefficients in t of the polynomial at org + t dir.
static void along_ray(const PolyShape *poly, Vec3 org, Vec3 dir, double out[TERMS + 1]) {
    const double *next = poly->coefficients;
    int n = poly->order;
    double x[TERMS + 1], y[TERMS + 1], z[TERMS + 1];
    memset(x, 0, sizeof x);
    for (int i = n; i >= 0; i--) {
        memset(y, 0, sizeof y);
        for (int j = n - i; j >= 0; j--) {
            memset(z, 0, sizeof z);
            for (int k = n - i - j; k >= 0; k--) {
                const double constant = *next++;
                multiply_add(z, n - i - j - k - 1, org.z, dir.z, &constant, 0);
            }
            multiply_add(y, n - i - j - 1, org.y, dir.y, z, n - i - j);
        }
        multiply_add(x, n - i - 1, org.x, dir.x, y, n - i);
    }
    memcpy(out, x, sizeof(double) * (size_t)(n + 1));
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const PolyShape *poly = data;
    double c[TERMS + 1], roots[TERMS];
    double nearest = -vec_dot(ray->org, ray->dir);
    along_ray(poly, vec_madd(ray->org, nearest, ray->dir), ray->dir, c);
    double bound = roots_bound(c, poly->order);
    double low = fmax(-bound, -nearest);
    double high = fmin(bound, fmin(sink->t_max, SHAPE_FARTHEST * sink->scale) - nearest);
    int count = roots_find(c, poly->order, low, high, roots);
    for (int i = 0; i < count; i++)
        sink_put(sink, nearest + roots[i], 0, vec3(0, 0, 0));
}

// Value and derivatives of one variable's Horner rule.
typedef struct {
    double value;
    Vec3 gradient;
} Dual;

static Dual times_plus(Dual p, double x, Vec3 axis, Dual q) {
    return (Dual){p.value * x + q.value,
                  vec_add(vec_add(vec_scale(p.gradient, x), vec_scale(axis, p.value)), q.gradient)};
}

static Dual value_at(const PolyShape *poly, Vec3 p) {
    const double *next = poly->coefficients;
    int n = poly->order;
    Dual x = {0};
    for (int i = n; i >= 0; i--) {
        Dual y = {0};
        for (int j = n - i; j >= 0; j--) {
            Dual z = {0};
            for (int k = n - i - j; k >= 0; k--)
                z = times_plus(z, p.z, vec3(0, 0, 1), (Dual){*next++, {0, 0, 0}});
            y = times_plus(y, p.y, vec3(0, 1, 0), z);
        }
        x = times_plus(x, p.x, vec3(1, 0, 0), y);
    }
    return x;
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    (void)hit;
    return value_at(data, p).gradient;
}

static bool inside(const void *data, Vec3 p) { return value_at(data, p).value <= 0.0; }

static const SolidOps OPS = {
    .near = 1e-4, .far = SHAPE_FARTHEST, .hits = hits, .normal = normal, .inside = inside};

SolidData poly_prepare(const PolyShape *poly, Arena *arena) {
    PolyShape *copy = arena_copy(arena, poly, sizeof *poly);
    return (SolidData){&OPS, copy, SOLID_INFINITE};
}
