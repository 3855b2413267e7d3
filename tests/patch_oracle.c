// SPDX-License-Identifier: MIT
#include "patch_oracle.h"

#include "ray_oracle.h"

#include <stdlib.h>

typedef long double Real;
enum { SIDE = BEZIER_MAX_DEGREE + 1 };

typedef struct {
    int du, dv;
    Real p[SIDE][SIDE][3]; // across the ray twice, and along it
} Net;

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

static int by_t(const void *a, const void *b) {
    double x = ((const OracleHit *)a)->t, y = ((const OracleHit *)b)->t;
    return x < y ? -1 : x > y;
}

void oracle_hits(const Bezier *patch, Ray ray, double t_min, double t_max, OracleHits *out) {
    PatchDef def = {
        .degree_u = (uint32_t)patch->du, .degree_v = (uint32_t)patch->dv, .points = patch->p};
    RayOracle all = {.count = 0};
    ray_oracle(&all, &def, &ray, t_min, t_max);
    out->count = all.count;
    out->doubtful = all.doubtful;
    for (int k = 0; k < all.count; k++) {
        const RayOracleRoot *r = &all.root[k];
        double edge = fmin(fmin(r->u, 1.0 - r->u), fmin(r->v, 1.0 - r->v));
        out->hits[k] = (OracleHit){r->t, r->u, r->v, r->sine};
        out->doubtful |= r->sine < 1e-4 || edge < 1e-7; // the tolerance's share of both
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
