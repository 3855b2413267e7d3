// SPDX-License-Identifier: MIT
// Lathes. With r^2 the square of the ray's distance from the axis as a function of the depth, and
// t = (v(w) - o_y) / d_y, each piece gives a polynomial in its parameter w of twice its degree.
// Rays almost level with the ground lose the digits of that one; they first take the w where the
// curve has their height, then both conditions together are sharpened.
#include "shape/curve.h"
#include "shape/roots.h"
#include "shape/solid.h"

typedef struct {
    Curve curve;
} Lathe;

enum { TERMS = 7 };

// What of the ray matters: r^2(t) = a t^2 + 2 b t + c.
typedef struct {
    const Ray *ray;
    double a, b, c;
} Turned;

// out = p q for polynomials of degree n.
static void multiply(const double *p, const double *q, int n, double *out) {
    for (int i = 0; i <= 2 * n; i++)
        out[i] = 0.0;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++)
            out[i + j] += p[i] * q[j];
}

static void put(uint32_t piece, double w, double t, HitSink *sink) {
    sink_put(sink, t, (int)piece, vec3(w, 0, 0));
}

// a h^2 + 2 b h d + c d^2 - d^2 u(w)^2 with h = v(w) - o_y, d = d_y.
static void hits_steep(const Turned *turned, const CurvePiece *piece, uint32_t index,
                       HitSink *sink) {
    double d = turned->ray->dir.y;
    double h[4], hh[TERMS], uu[TERMS], roots[TERMS];
    int n = piece->degree;
    for (int i = 0; i <= n; i++)
        h[i] = piece->v[i];
    h[0] -= turned->ray->org.y;
    multiply(h, h, n, hh);
    multiply(piece->u, piece->u, n, uu);
    for (int i = 0; i <= 2 * n; i++)
        hh[i] = turned->a * hh[i] - d * d * uu[i];
    for (int i = 0; i <= n; i++)
        hh[i] += 2.0 * turned->b * d * h[i];
    hh[0] += turned->c * d * d;
    for (int count = roots_find(hh, 2 * n, 0.0, 1.0, roots); count > 0; count--) {
        double w = roots[count - 1];
        put(index, w, roots_value(h, n, w) / d, sink);
    }
}

// Newton's steps on v(w) = o_y + t d_y and u(w)^2 = r^2(t).
static bool sharpen(const Turned *turned, const CurvePiece *piece, double *w, double *t) {
    for (int step = 0; step < 4; step++) {
        Vec2 p = curve_at(piece, *w), s = curve_slope(piece, *w);
        double f = p.v - turned->ray->org.y - *t * turned->ray->dir.y;
        double g = p.u * p.u - ((turned->a * *t + 2.0 * turned->b) * *t + turned->c);
        double fw = s.v, ft = -turned->ray->dir.y;
        double gw = 2.0 * p.u * s.u, gt = -2.0 * (turned->a * *t + turned->b);
        double det = fw * gt - ft * gw;
        if (det == 0.0)
            return true;
        *w -= (f * gt - g * ft) / det;
        *t -= (fw * g - gw * f) / det;
    }
    return *w >= 0.0 && *w <= 1.0;
}

static void hits_level(const Turned *turned, const CurvePiece *piece, uint32_t index,
                       HitSink *sink) {
    // Where the ray is nearest to the axis it decides on the height to look at.
    double middle = -turned->b / turned->a;
    double h[4], roots[4];
    for (int i = 0; i <= piece->degree; i++)
        h[i] = piece->v[i];
    h[0] -= turned->ray->org.y + middle * turned->ray->dir.y;
    for (int count = roots_find(h, piece->degree, 0.0, 1.0, roots); count > 0; count--) {
        double u = curve_at(piece, roots[count - 1]).u;
        double half = turned->b * turned->b - turned->a * (turned->c - u * u);
        if (!(half > 0.0))
            continue;
        for (int side = -1; side <= 1; side += 2) {
            double w = roots[count - 1], t = middle + side * sqrt(half) / turned->a;
            if (sharpen(turned, piece, &w, &t))
                put(index, w, t, sink);
        }
    }
}

static double distance2(const Turned *turned, double t) {
    return (turned->a * t + 2.0 * turned->b) * t + turned->c;
}

// Does the ray miss the ring of space around the piece's surface, or come to it beyond t_max?
static bool misses(const Turned *turned, const CurvePiece *piece, double t_max) {
    const Ray *ray = turned->ray;
    double o = ray->org.y, d = ray->dir.y;
    if ((d >= 0.0 && o > piece->high.v) || (d <= 0.0 && o < piece->low.v))
        return true;
    double outer = fmax(fabs(piece->low.u), fabs(piece->high.u));
    double inner = fmax(0.0, fmax(piece->low.u, -piece->high.u));
    // Rounding of the squares, generously.
    double slack = 1e-9 * outer * outer + 1e-12 * turned->c;
    double low2 = inner * inner - slack, high2 = outer * outer + slack;
    // The depths at which the ray is at the piece's heights.
    double enter = 0.0, leave = INFINITY;
    if (d != 0.0) {
        double a = (piece->low.v - o) / d, b = (piece->high.v - o) / d;
        enter = fmax(0.0, fmin(a, b));
        leave = fmax(a, b);
    }
    if (enter * (1.0 - 1e-12) > t_max)
        return true;
    double middle = turned->a > 0.0 ? -turned->b / turned->a : enter;
    if (distance2(turned, fmin(fmax(middle, enter), leave)) > high2)
        return true;
    return isfinite(leave) && distance2(turned, enter) < low2 && distance2(turned, leave) < low2;
}

// Below this a ray counts as level: what the steep way loses, 1e-16 / d^2 of a root's square, would
// be seen.
static const double LEVEL = 1e-5;

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Lathe *lathe = data;
    const Turned turned = {ray, ray->dir.x * ray->dir.x + ray->dir.z * ray->dir.z,
                           ray->dir.x * ray->org.x + ray->dir.z * ray->org.z,
                           ray->org.x * ray->org.x + ray->org.z * ray->org.z};
    for (uint32_t i = 0; i < lathe->curve.count; i++) {
        const CurvePiece *piece = &lathe->curve.pieces[i];
        if (misses(&turned, piece, sink->t_max))
            continue;
        if (fabs(ray->dir.y) < LEVEL)
            hits_level(&turned, piece, i, sink);
        else
            hits_steep(&turned, piece, i, sink);
    }
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Lathe *lathe = data;
    Vec2 s = curve_slope(&lathe->curve.pieces[hit->part], hit->keep.x);
    double r2 = p.x * p.x + p.z * p.z;
    if (!(r2 > SHAPE_EPSILON))
        return vec3(0, 1, 0);
    return vec3(s.v * p.x, -s.u * sqrt(r2), s.v * p.z);
}

static bool inside(const void *data, Vec3 p) {
    const Lathe *lathe = data;
    return curve_holds(&lathe->curve, sqrt(p.x * p.x + p.z * p.z), p.y);
}

static Vec2 uv(const void *data, Vec3 p, const ShapeHit *hit) {
    const Lathe *lathe = data;
    double v = (hit->keep.x + hit->part) / lathe->curve.count;
    return (Vec2){solid_angle(p), fmin(v, 1.0)};
}

static const SolidOps OPS = {.near = 1e-4,
                             .far = SHAPE_FARTHEST,
                             .hits = hits,
                             .normal = normal,
                             .inside = inside,
                             .uv = uv};

SolidData lathe_prepare(const LatheShape *lathe, Arena *arena) {
    Lathe *data = ARENA_NEW(arena, Lathe);
    data->curve = curve_make(lathe->outline, lathe->points, lathe->count, false, arena);
    double r = fmax(fabs(data->curve.low.u), fabs(data->curve.high.u));
    return (SolidData){&OPS, data, {{-r, data->curve.low.v, -r}, {r, data->curve.high.v, r}}};
}
