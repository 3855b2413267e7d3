// SPDX-License-Identifier: MIT
// Polynomials of any order in x, y and z. Along a ray each is a polynomial in the depth, made by
// Horner's rule with polynomials in place of numbers; counted from the point nearest to the origin,
// so that its coefficients do not lose their digits far away.
#include "shape/roots.h"
#include "shape/solid.h"

enum { TERMS = SCENE_MAX_ORDER + 1 };

// A polynomial in the depth; degree -1: it is 0, and p is not set. Most coefficients of the
// surfaces that people write are 0, so that is asked first.
typedef struct {
    double p[TERMS];
    int degree;
} Along;

// f = f * (a + b t) + g
static inline void multiply_add(Along *f, double a, double b, const Along *g) {
    int n = f->degree;
    if (n >= 0) {
        f->p[n + 1] = b * f->p[n];
        for (int i = n; i > 0; i--)
            f->p[i] = a * f->p[i] + b * f->p[i - 1];
        f->p[0] *= a;
        f->degree = ++n;
    }
    for (; n < g->degree; f->degree = n)
        f->p[++n] = 0.0;
    for (int i = 0; i <= g->degree; i++)
        f->p[i] += g->p[i];
}

// Coefficients in t of the polynomial at org + t dir.
static void along_ray(const PolyShape *poly, Vec3 org, Vec3 dir, double out[TERMS]) {
    const double *next = poly->coefficients;
    int n = poly->order;
    Along x, y, z, constant;
    x.degree = -1;
    for (int i = n; i >= 0; i--) {
        y.degree = -1;
        for (int j = n - i; j >= 0; j--) {
            z.degree = -1;
            for (int k = n - i - j; k >= 0; k--) {
                constant.p[0] = *next++;
                constant.degree = constant.p[0] != 0.0 ? 0 : -1;
                multiply_add(&z, org.z, dir.z, &constant);
            }
            multiply_add(&y, org.y, dir.y, &z);
        }
        multiply_add(&x, org.x, dir.x, &y);
    }
    for (int i = 0; i <= n; i++)
        out[i] = i <= x.degree ? x.p[i] : 0.0;
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const PolyShape *poly = data;
    double c[TERMS], roots[TERMS];
    double nearest = -vec_dot(ray->org, ray->dir);
    along_ray(poly, vec_madd(ray->org, nearest, ray->dir), ray->dir, c);
    double bound = roots_bound(c, poly->order);
    double low = fmax(-bound, fmax(sink->t_min, 0.0) - nearest);
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

static bool inside(const void *data, Vec3 p) {
    const PolyShape *poly = data;
    const double *next = poly->coefficients;
    int n = poly->order;
    double x = 0.0;
    for (int i = n; i >= 0; i--) {
        double y = 0.0;
        for (int j = n - i; j >= 0; j--) {
            double z = 0.0;
            for (int k = n - i - j; k >= 0; k--)
                z = z * p.z + *next++;
            y = y * p.y + z;
        }
        x = x * p.x + y;
    }
    return x <= 0.0;
}

static const SolidOps OPS = {
    .near = 1e-4, .far = SHAPE_FARTHEST, .hits = hits, .normal = normal, .inside = inside};

SolidData poly_prepare(const PolyShape *poly, Arena *arena) {
    PolyShape *copy = arena_copy(arena, poly, sizeof *poly);
    return (SolidData){&OPS, copy, SOLID_INFINITE};
}
