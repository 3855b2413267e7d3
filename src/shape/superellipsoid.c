// SPDX-License-Identifier: MIT
// Superellipsoids: (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1 within the unit cube. With e and n
// up to 2 the left side is a power of a norm, which is convex along the ray. Else the ray is cut
// where it passes the planes of symmetry, and each smooth piece is searched in steps.
#include "shape/solid.h"

#include <stdlib.h>

typedef struct {
    double inner, outer, z; // exponents: 2/e, e/n, 2/n
    bool convex;
} Super;

// x^k for x not below 0. Most exponents that people write are small whole numbers or a half: a few
// products are as exact as pow to some units in the last place, at a tenth of the cost.
static double power(double x, double k) {
    if (k == 1.0)
        return x;
    if (k == 2.0)
        return x * x;
    if (k == 0.5)
        return sqrt(x);
    int whole = k > 0.0 && k <= 20.0 ? (int)k : 0;
    if (whole != k || whole == 0)
        return pow(x, k);
    double out = whole & 1 ? x : 1.0;
    while (whole >>= 1) {
        x *= x;
        if (whole & 1)
            out *= x;
    }
    return out;
}

static double value(const Super *s, Vec3 p) {
    return power(power(fabs(p.x), s->inner) + power(fabs(p.y), s->inner), s->outer) +
           power(fabs(p.z), s->z) - 1.0;
}

// The three powers at a depth, and the value.
typedef struct {
    double x, y, z, value;
    Vec3 p;
} Terms;

static Terms terms_at(const Super *s, const Ray *ray, double t) {
    Vec3 p = vec_madd(ray->org, t, ray->dir);
    Terms terms = {power(fabs(p.x), s->inner), power(fabs(p.y), s->inner), power(fabs(p.z), s->z),
                   0, p};
    terms.value = power(terms.x + terms.y, s->outer) + terms.z - 1.0;
    return terms;
}

// The least of a term between two depths. A piece ends on planes of symmetry but for rounding: what
// is that near to one may be on it.
static double least_term(double a, double at_a, double b, double at_b) {
    if (fabs(at_a) < 1e-12 || fabs(at_b) < 1e-12)
        return 0.0;
    return a < b ? a : b;
}

// Between two depths of one piece each coordinate grows or shrinks, and so do the powers: is the
// value surely of one sign there?
static bool stays_off(const Super *s, const Terms *a, const Terms *b, bool above) {
    if (!above)
        return power(fmax(a->x, b->x) + fmax(a->y, b->y), s->outer) + fmax(a->z, b->z) - 1.0 <
               -1e-9;
    double x = least_term(a->x, a->p.x, b->x, b->p.x), y = least_term(a->y, a->p.y, b->y, b->p.y);
    return power(x + y, s->outer) + least_term(a->z, a->p.z, b->z, b->p.z) - 1.0 > 1e-9;
}

static double value_on(const Super *s, const Ray *ray, double t) {
    return value(s, vec_madd(ray->org, t, ray->dir));
}

// Level and z together along the ray, and the slope.
static double sum_on(const Super *s, const Ray *ray, double t, double *rise) {
    Vec3 p = vec_madd(ray->org, t, ray->dir), d = ray->dir;
    double x = power(fabs(p.x), s->inner), y = power(fabs(p.y), s->inner),
           z = power(fabs(p.z), s->z), xy = x + y, level = power(xy, s->outer);
    double flat = (p.x != 0.0 ? x / p.x * d.x : 0.0) + (p.y != 0.0 ? y / p.y * d.y : 0.0);
    *rise = (xy > 0.0 ? s->outer * level / xy * s->inner * flat : 0.0) +
            (p.z != 0.0 ? s->z * z / p.z * d.z : 0.0);
    return level + z;
}

// A change of sign in low..high: Newton's steps, or halves where those leave it or do not end.
static double crossing(const Super *s, const Ray *ray, double low, double at_low, double high,
                       double at_high) {
    double x = (low * at_high - high * at_low) / (at_high - at_low);
    if (!(x > low && x < high))
        x = 0.5 * (low + high);
    for (int step = 0; step < 100; step++) {
        double rise, at = sum_on(s, ray, x, &rise) - 1.0;
        if (at == 0.0)
            return x;
        if ((at < 0.0) == (at_low < 0.0))
            low = x;
        else
            high = x;
        double next = x - at / rise;
        if (!(next > low && next < high) || step % 4 == 3)
            next = 0.5 * (low + high);
        if (!(next > low && next < high) || fabs(next - x) < 1e-15 * fabs(next))
            return next;
        x = next;
    }
    return x;
}

// The least value in low..high if there is one valley (golden section: 0.618^60 < 1e-12).
static double valley(const Super *s, const Ray *ray, double low, double high, double sign) {
    const double part = 0.3819660112501051;
    double a = low + part * (high - low), b = high - part * (high - low);
    double at_a = sign * value_on(s, ray, a), at_b = sign * value_on(s, ray, b);
    for (int step = 0; step < 60; step++) {
        if (at_a < at_b) {
            high = b, b = a, at_b = at_a;
            a = low + part * (high - low);
            at_a = sign * value_on(s, ray, a);
        } else {
            low = a, a = b, at_a = at_b;
            b = high - part * (high - low);
            at_b = sign * value_on(s, ray, b);
        }
        // Any point below the surface will do.
        if (sign * fmin(at_a, at_b) < 0.0 && sign > 0.0)
            break;
    }
    return at_a < at_b ? a : b;
}

static void put_crossing(const Super *s, const Ray *ray, double low, double at_low, double high,
                         double at_high, HitSink *sink) {
    if ((at_low < 0.0) != (at_high < 0.0))
        sink_put(sink, crossing(s, ray, low, at_low, high, at_high), 0, vec3(0, 0, 0));
}

// The norm less 1 along the ray, and its slope.
static double norm_on(const Super *s, const Ray *ray, double t, double *slope_out) {
    double rise, sum = sum_on(s, ray, t, &rise), norm = power(sum, 1.0 / s->z);
    *slope_out = sum > 0.0 ? norm / (s->z * sum) * rise : 0.0;
    return norm - 1.0;
}

// A norm is convex along a line: Newton's steps from outside go down to the nearest crossing and
// never beyond. forward: from the left. False: there is none.
static bool walk_in(const Super *s, const Ray *ray, double t, bool forward, double *out) {
    for (int step = 0; step < 100; step++) {
        double down, at = norm_on(s, ray, t, &down);
        *out = t;
        if (at <= 0.0)
            return true;
        if (!(forward ? down < 0.0 : down > 0.0))
            return false;
        double next = t - at / down;
        if (!(forward ? next > t : next < t) || fabs(next - t) <= 1e-15 * fabs(next))
            return true;
        t = next;
    }
    return true;
}

static void hits_convex(const Super *s, const Ray *ray, double low, double high, HitSink *sink) {
    double enter, leave;
    if (!walk_in(s, ray, low, true, &enter) || !walk_in(s, ray, high, false, &leave))
        return;
    if (enter > low)
        sink_put(sink, enter, 0, vec3(0, 0, 0));
    if (leave < high && leave > enter)
        sink_put(sink, leave, 0, vec3(0, 0, 0));
}

enum { STEPS = 12 };

// A smooth piece; between steps that have one sign a bend towards the other is looked into.
static void hits_piece(const Super *s, const Ray *ray, double low, double high, HitSink *sink) {
    double t[STEPS + 1], at[STEPS + 1];
    Terms terms[STEPS + 1];
    for (int i = 0; i <= STEPS; i += STEPS)
        terms[i] = terms_at(s, ray, low + (high - low) * i / STEPS);
    if ((terms[0].value < 0.0) == (terms[STEPS].value < 0.0) &&
        stays_off(s, &terms[0], &terms[STEPS], terms[0].value >= 0.0))
        return;
    for (int i = 0; i <= STEPS; i++) {
        t[i] = low + (high - low) * i / STEPS;
        terms[i] = terms_at(s, ray, t[i]);
        at[i] = terms[i].value;
    }
    for (int i = 0; i < STEPS; i++) {
        if ((at[i] < 0.0) == (at[i + 1] < 0.0)) {
            double sign = at[i] < 0.0 ? -1.0 : 1.0;
            double before = i > 0 ? sign * at[i - 1] : INFINITY;
            double after = i + 2 <= STEPS ? sign * at[i + 2] : INFINITY;
            bool bends = sign * at[i] <= before && sign * at[i + 1] <= after;
            if (!bends || stays_off(s, &terms[i], &terms[i + 1], sign > 0.0))
                continue;
            double turn = valley(s, ray, t[i], t[i + 1], sign), at_turn = value_on(s, ray, turn);
            put_crossing(s, ray, t[i], at[i], turn, at_turn, sink);
            put_crossing(s, ray, turn, at_turn, t[i + 1], at[i + 1], sink);
            continue;
        }
        put_crossing(s, ray, t[i], at[i], t[i + 1], at[i + 1], sink);
    }
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum { PLANES = 9 };

static void hits_by_pieces(const Super *s, const Ray *ray, double low, double high, HitSink *sink) {
    static const double planes[PLANES][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                             {1, 1, 0},  {1, -1, 0}, {1, 0, 1},
                                             {1, 0, -1}, {0, 1, 1},  {0, 1, -1}};
    double cuts[PLANES + 2];
    int count = 0;
    cuts[count++] = low;
    for (int i = 0; i < PLANES; i++) {
        Vec3 n = vec3(planes[i][0], planes[i][1], planes[i][2]);
        double t = -vec_dot(n, ray->org) / vec_dot(n, ray->dir);
        if (t > low && t < high)
            cuts[count++] = t;
    }
    cuts[count++] = high;
    qsort(cuts, (size_t)count, sizeof *cuts, ascending);
    for (int i = 0; i + 1 < count; i++)
        if (cuts[i] < cuts[i + 1])
            hits_piece(s, ray, cuts[i], cuts[i + 1], sink);
}

// The cube in which POV-Ray looks.
static const double CUBE = 1.0001;

static bool cube_range(const Ray *ray, double *low, double *high) {
    for (int axis = 0; axis < 3; axis++) {
        double o = vec_get(ray->org, axis), d = vec_get(ray->dir, axis);
        if (d == 0.0) {
            if (fabs(o) > CUBE)
                return false;
            continue;
        }
        double a = (-CUBE - o) / d, b = (CUBE - o) / d;
        *low = fmax(*low, fmin(a, b));
        *high = fmin(*high, fmax(a, b));
    }
    return *low < *high;
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Super *s = data;
    double low = -INFINITY, high = INFINITY;
    if (!cube_range(ray, &low, &high) || high <= 0.0 || low > sink->t_max)
        return;
    if (s->convex)
        hits_convex(s, ray, low, high, sink);
    else
        hits_by_pieces(s, ray, low, high, sink);
}

// d|v|^k / dv
static double slope(double v, double k) {
    return v == 0.0 ? 0.0 : copysign(k * power(fabs(v), k - 1.0), v);
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Super *s = data;
    (void)hit;
    double xy = power(fabs(p.x), s->inner) + power(fabs(p.y), s->inner);
    double k = xy > 0.0 ? s->outer * power(xy, s->outer - 1.0) : 0.0;
    Vec3 n = vec3(k * slope(p.x, s->inner), k * slope(p.y, s->inner), slope(p.z, s->z));
    return isfinite(vec_dot(n, n)) && vec_dot(n, n) > 0.0 ? n : p;
}

static bool inside(const void *data, Vec3 p) { return value(data, p) < SHAPE_EPSILON; }

static const SolidOps OPS = {
    .near = 1e-4, .far = SHAPE_FARTHEST, .hits = hits, .normal = normal, .inside = inside};

SolidData superellipsoid_prepare(const SuperellipsoidShape *shape, Arena *arena) {
    Super *s = ARENA_NEW(arena, Super);
    *s = (Super){2.0 / shape->e, shape->e / shape->n, 2.0 / shape->n,
                 shape->e <= 2.0 && shape->n <= 2.0};
    return (SolidData){&OPS, s, {{-CUBE, -CUBE, -CUBE}, {CUBE, CUBE, CUBE}}};
}
