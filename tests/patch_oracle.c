// SPDX-License-Identifier: MIT
#include "patch_oracle.h"

#include <stdlib.h>

typedef long double Real;
enum { SIDE = BEZIER_MAX_DEGREE + 1 };

typedef struct {
    int du, dv;
    Real p[SIDE][SIDE][3]; // across the ray twice, and along it
} Net;

typedef struct {
    const Net *whole;
    OracleHits *out;
    Real t_min, t_max, size;
} Hunt;

static Real bernstein(int d, int i, Real t) {
    Real value = 1.0L;
    for (int k = 1; k <= i; k++)
        value *= (Real)(d - k + 1) / k;
    for (int k = 0; k < i; k++)
        value *= t;
    for (int k = 0; k < d - i; k++)
        value *= 1.0L - t;
    return value;
}

static Real bernstein_slope(int d, int i, Real t) {
    Real before = i > 0 ? bernstein(d - 1, i - 1, t) : 0.0L;
    return d * (before - (i < d ? bernstein(d - 1, i, t) : 0.0L));
}

static void eval(const Net *n, Real u, Real v, Real s[3], Real su[3], Real sv[3]) {
    for (int c = 0; c < 3; c++)
        s[c] = su[c] = sv[c] = 0.0L;
    for (int i = 0; i <= n->du; i++) {
        for (int j = 0; j <= n->dv; j++) {
            Real bu = bernstein(n->du, i, u), bv = bernstein(n->dv, j, v);
            Real cu = bernstein_slope(n->du, i, u), cv = bernstein_slope(n->dv, j, v);
            for (int c = 0; c < 3; c++) {
                s[c] += bu * bv * n->p[i][j][c];
                su[c] += cu * bv * n->p[i][j][c];
                sv[c] += bu * cv * n->p[i][j][c];
            }
        }
    }
}

static Net plain_net(const Bezier *s) {
    Net n = {.du = s->du, .dv = s->dv};
    for (int i = 0; i <= s->du; i++) {
        for (int j = 0; j <= s->dv; j++) {
            Vec3 p = bezier_at(s, i, j);
            n.p[i][j][0] = p.x, n.p[i][j][1] = p.y, n.p[i][j][2] = p.z;
        }
    }
    return n;
}

static void halve(const Net *n, bool along_u, Net *low, Net *high) {
    *low = *high = *n;
    int lines = along_u ? n->dv : n->du, d = along_u ? n->du : n->dv;
    for (int k = 0; k <= lines; k++) {
        for (int c = 0; c < 3; c++) {
            Real line[SIDE];
            for (int i = 0; i <= d; i++)
                line[i] = along_u ? n->p[i][k][c] : n->p[k][i][c];
            for (int level = 0; level <= d; level++) {
                *(along_u ? &low->p[level][k][c] : &low->p[k][level][c]) = line[0];
                *(along_u ? &high->p[d - level][k][c] : &high->p[k][d - level][c]) =
                    line[d - level];
                for (int i = 0; i < d - level; i++)
                    line[i] = 0.5L * (line[i] + line[i + 1]);
            }
        }
    }
}

static void keep_root(Hunt *h, Real u, Real v) {
    Real s[3], su[3], sv[3];
    eval(h->whole, u, v, s, su, sv);
    Real det = su[0] * sv[1] - su[1] * sv[0];
    Real nx = su[1] * sv[2] - su[2] * sv[1], ny = su[2] * sv[0] - su[0] * sv[2];
    Real area = sqrtl(nx * nx + ny * ny + det * det);
    Real edge = fminl(fminl(u, 1.0L - u), fminl(v, 1.0L - v));
    Real sine = area > 0.0L ? fabsl(det) / area : 0.0L;
    bool inside = edge >= 0.0L && s[2] >= h->t_min && s[2] < h->t_max;
    bool near_inside = edge > -1e-7L && s[2] > h->t_min - 1e-7L && s[2] < h->t_max + 1e-7L;
    if (near_inside && (sine < 1e-4L || fabsl(edge) < 1e-7L || fabsl(s[2] - h->t_min) < 1e-7L ||
                        fabsl(s[2] - h->t_max) < 1e-7L || area < 1e-6L * h->size * h->size))
        h->out->doubtful = true;
    if (!inside)
        return;
    for (int k = 0; k < h->out->count; k++) {
        OracleHit *o = &h->out->hits[k];
        if (fabsl((Real)o->u - u) + fabsl((Real)o->v - v) < 1e-9L)
            return;
    }
    if (h->out->count < 256)
        h->out->hits[h->out->count++] =
            (OracleHit){(double)s[2], (double)u, (double)v, (double)sine};
}

// False: Newton did not end on a root beside the cell.
static bool newton(Hunt *h, Real u, Real v, Real width) {
    Real u0 = u, v0 = v, s[3], su[3], sv[3];
    for (int n = 0; n < 60; n++) {
        eval(h->whole, u, v, s, su, sv);
        Real det = su[0] * sv[1] - su[1] * sv[0];
        Real du = (sv[1] * s[0] - sv[0] * s[1]) / det, dv = (su[0] * s[1] - su[1] * s[0]) / det;
        u -= du, v -= dv;
        if (!(fabsl(u - u0) <= 4.0L * width && fabsl(v - v0) <= 4.0L * width))
            return false;
        if (fabsl(du) + fabsl(dv) < 1e-17L)
            break;
    }
    eval(h->whole, u, v, s, su, sv);
    if (!(fabsl(s[0]) + fabsl(s[1]) <= 1e-14L * h->size))
        return false;
    keep_root(h, u, v);
    return fabsl(u - u0) <= width && fabsl(v - v0) <= width;
}

static void hunt(Hunt *h, const Net *n, Real u, Real v, Real width, int depth) {
    Real low[3], high[3];
    for (int c = 0; c < 3; c++) {
        low[c] = high[c] = n->p[0][0][c];
        for (int i = 0; i <= n->du; i++) {
            for (int j = 0; j <= n->dv; j++) {
                low[c] = fminl(low[c], n->p[i][j][c]);
                high[c] = fmaxl(high[c], n->p[i][j][c]);
            }
        }
    }
    Real slack = 1e-15L * h->size;
    if (low[0] > slack || high[0] < -slack || low[1] > slack || high[1] < -slack ||
        high[2] < h->t_min - 1e-6L || low[2] > h->t_max + 1e-6L)
        return;
    if (depth >= 9 && newton(h, u + 0.5L * width, v + 0.5L * width, width))
        return;
    if (depth == 16) {
        h->out->doubtful = true;
        return;
    }
    Net a, b, parts[4];
    halve(n, true, &a, &b);
    halve(&a, false, &parts[0], &parts[1]);
    halve(&b, false, &parts[2], &parts[3]);
    width *= 0.5L;
    for (int k = 0; k < 4; k++)
        hunt(h, &parts[k], u + (k / 2) * width, v + (k % 2) * width, width, depth + 1);
}

static int by_t(const void *a, const void *b) {
    double x = ((const OracleHit *)a)->t, y = ((const OracleHit *)b)->t;
    return x < y ? -1 : x > y;
}

void oracle_hits(const Bezier *patch, Ray ray, double t_min, double t_max, OracleHits *out) {
    // Skewed coordinates will do: solve for the ray with its largest component.
    Real d[3] = {ray.dir.x, ray.dir.y, ray.dir.z}, o[3] = {ray.org.x, ray.org.y, ray.org.z};
    int k = fabsl(d[0]) > fabsl(d[1]) ? 0 : 1;
    k = fabsl(d[2]) > fabsl(d[k]) ? 2 : k;
    int a = (k + 1) % 3, b = (k + 2) % 3;
    Net n = plain_net(patch);
    Hunt h = {&n, out, t_min, t_max, 0.0L};
    for (int i = 0; i <= n.du; i++) {
        for (int j = 0; j <= n.dv; j++) {
            Real q[3], *p = n.p[i][j];
            for (int c = 0; c < 3; c++)
                q[c] = p[c] - o[c];
            Real t = q[k] / d[k];
            p[0] = q[a] - t * d[a];
            p[1] = q[b] - t * d[b];
            p[2] = t;
            h.size = fmaxl(h.size, fmaxl(fabsl(p[0]), fabsl(p[1])));
        }
    }
    out->count = 0;
    out->doubtful = false;
    hunt(&h, &n, 0.0L, 0.0L, 1.0L, 0);
    // The angle between ray and surface, unskewed.
    Net plain = plain_net(patch);
    for (int i = 0; i < out->count; i++) {
        Real s[3], su[3], sv[3];
        eval(&plain, out->hits[i].u, out->hits[i].v, s, su, sv);
        Real x = su[1] * sv[2] - su[2] * sv[1], y = su[2] * sv[0] - su[0] * sv[2],
             z = su[0] * sv[1] - su[1] * sv[0];
        Real across = fabsl(x * d[0] + y * d[1] + z * d[2]);
        Real both = (x * x + y * y + z * z) * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        out->hits[i].sine = both > 0.0L ? (double)(across / sqrtl(both)) : 0.0;
    }
    qsort(out->hits, (size_t)out->count, sizeof out->hits[0], by_t);
}

static Vec3 rounded(const Real s[3]) { return vec3((double)s[0], (double)s[1], (double)s[2]); }

Vec3 oracle_point(const Bezier *patch, double u, double v) {
    Net n = plain_net(patch);
    Real s[3], su[3], sv[3];
    eval(&n, u, v, s, su, sv);
    return rounded(s);
}

void oracle_tangents(const Bezier *patch, double u, double v, Vec3 *out_u, Vec3 *out_v) {
    Net n = plain_net(patch);
    Real s[3], su[3], sv[3];
    eval(&n, u, v, s, su, sv);
    *out_u = rounded(su);
    *out_v = rounded(sv);
}

double oracle_residual(const Bezier *patch, Ray ray, double t, double u, double v) {
    Net n = plain_net(patch);
    // Relative to the ray's origin, so that a common offset costs no digits.
    Real o[3] = {ray.org.x, ray.org.y, ray.org.z}, s[3], su[3], sv[3];
    for (int i = 0; i <= n.du; i++)
        for (int j = 0; j <= n.dv; j++)
            for (int c = 0; c < 3; c++)
                n.p[i][j][c] -= o[c];
    eval(&n, u, v, s, su, sv);
    Real x = (Real)t * ray.dir.x - s[0], y = (Real)t * ray.dir.y - s[1],
         z = (Real)t * ray.dir.z - s[2];
    return (double)sqrtl(x * x + y * y + z * z);
}

void random_patch(Rng *rng, int du, int dv, double wild, Bezier *out) {
    out->du = du;
    out->dv = dv;
    for (int i = 0; i <= du; i++)
        for (int j = 0; j <= dv; j++)
            out->p[i * (dv + 1) + j] = vec3((double)i / du + wild * rng_range(rng, -1.0, 1.0),
                                            (double)j / dv + wild * rng_range(rng, -1.0, 1.0),
                                            (0.3 + wild) * rng_range(rng, -1.0, 1.0));
}

Vec3 random_direction(Rng *rng) {
    for (;;) {
        Vec3 d = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        double length = vec_length(d);
        if (length > 0.1 && length < 1.0)
            return vec_scale(d, 1.0 / length);
    }
}

Ray ray_to(const Bezier *patch, double u, double v, Vec3 dir, double distance) {
    return (Ray){vec_madd(bezier_eval(patch, u, v), -distance / vec_length(dir), dir), dir};
}

// A quarter of a body of revolution as the teapot has them: a profile of four (radius, height)
// turned from +x to +y with the factor 0.56 of the original data. u runs along the profile.
static void quarter(const double profile[4][2], Bezier *out) {
    const double k = 0.56;
    out->du = out->dv = 3;
    for (int i = 0; i < 4; i++) {
        double r = profile[i][0], z = profile[i][1];
        out->p[4 * i] = vec3(r, 0.0, z);
        out->p[4 * i + 1] = vec3(r, r * k, z);
        out->p[4 * i + 2] = vec3(r * k, r, z);
        out->p[4 * i + 3] = vec3(0.0, r, z);
    }
}

void teapot_lid(Bezier *out) {
    static const double profile[4][2] = {{0.0, 3.15}, {0.8, 3.15}, {0.0, 2.7}, {0.2, 2.55}};
    quarter(profile, out);
}

void teapot_bottom(Bezier *out) {
    static const double profile[4][2] = {{0.0, 0.0}, {1.425, 0.0}, {1.5, 0.075}, {1.5, 0.15}};
    quarter(profile, out);
}

void teapot_body(Bezier *out) {
    static const double profile[4][2] = {
        {1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}};
    quarter(profile, out);
}
