// SPDX-License-Identifier: MIT
// From near the only root of a piece to that root, by Newton steps in double. The last correction
// needs no new look: its Taylor rest (search.h) is part of the bound.
#ifndef KERNEL_NEWTON_H
#define KERNEL_NEWTON_H

#include "kernel/simd.h"
#include "patch/walk.h"

enum { NEWTON_STEPS = 6 }; // two, as a rule
// Before them in single precision: as a rule one is enough for one step in double.
enum { GUESS_STEPS = 1 };
// Of the normal, a sine: pictures have 16 bits.
static const double NEWTON_NORMAL_ERROR = 1e-6;
// Below it the normal is taken from where the last step begins: rounding is not far.
static const double NEWTON_NORMAL_TURN = 1e-12;

typedef enum { NEWTON_LOST, NEWTON_TAKEN, NEWTON_STOP } Newton;

static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }
static inline double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}
static inline double length1(Vec3 a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

// S, Su, Sv of a cubic patch; points as [column][row][x y z]; four numbers are read for each. Along
// each parameter two quadrics, whose mean is the cubic and whose difference its slope: half of the
// weights, and a third less to do than with those of the cubic and of its derivative. Of the
// rounding that AccelPatch allows less is used: a weight of a quadric carries 3 roundings, its sums
// 3 more, the means 3; and differences of such sums carry those of both.
static inline void eval_cubic(const double *p, double u, double v, Vec3 out[3]) {
    double r = 1.0 - u, s = 1.0 - v;
    D4 wu[3] = {d4_all(r * r), d4_all(2.0 * r * u), d4_all(u * u)};
    D4 wv[3] = {d4_all(s * s), d4_all(2.0 * s * v), d4_all(v * v)};
    D4 low[4], high[4]; // the quadrics along u, of each column
#pragma GCC unroll 4
    for (int j = 0; j < 4; j++) {
        D4 p0 = d4_load(p + 12 * j), p1 = d4_load(p + 12 * j + 3), p2 = d4_load(p + 12 * j + 6),
           p3 = d4_load(p + 12 * j + 9);
        low[j] = wu[0] * p0 + wu[1] * p1 + wu[2] * p2;
        high[j] = wu[0] * p1 + wu[1] * p2 + wu[2] * p3;
    }
    D4 ll = wv[0] * low[0] + wv[1] * low[1] + wv[2] * low[2];
    D4 lh = wv[0] * low[1] + wv[1] * low[2] + wv[2] * low[3];
    D4 hl = wv[0] * high[0] + wv[1] * high[1] + wv[2] * high[2];
    D4 hh = wv[0] * high[1] + wv[1] * high[2] + wv[2] * high[3];
    D4 bu = d4_all(u), br = d4_all(r), bv = d4_all(v), bs = d4_all(s), three = d4_all(3.0);
    D4 near = bs * ll + bv * lh, far = bs * hl + bv * hh; // at the ends of u
    D4 at = br * near + bu * far, along_u = three * (far - near);
    D4 along_v = three * (br * (lh - ll) + bu * (hh - hl));
    out[0] = vec3(at[0], at[1], at[2]);
    out[1] = vec3(along_u[0], along_u[1], along_u[2]);
    out[2] = vec3(along_v[0], along_v[1], along_v[2]);
}

static inline void eval_patch(const AccelPatch *patch, double u, double v, Vec3 out[3]) {
    if (patch->cubic)
        eval_cubic(patch->own, u, v, out);
    else
        piece_eval(patch, u, v, out);
}

// walk->ray and walk->piece are set; (u,v) lies in rect, which is the piece's or a part of it.
static inline Newton newton_sharpen(Walk *walk, const Piece *piece, BezierRect rect, double u,
                                    double v) {
    const PatchRay *ray = &walk->ray;
    Query *query = walk->query;
    // Up to a hair outside of it, where the piece's bounds still hold: then neighbours agree.
    double hair_u = PIECE_MARGIN * (rect.u1 - rect.u0), hair_v = PIECE_MARGIN * (rect.v1 - rect.v0);
    const double u0 = larger(rect.u0 - hair_u, 0.0), u1 = smaller(rect.u1 + hair_u, 1.0);
    const double v0 = larger(rect.v0 - hair_v, 0.0), v1 = smaller(rect.v1 + hair_v, 1.0);
    const double muu = (double)piece->muu, muv = (double)piece->muv, mvv = (double)piece->mvv;
    // What rounding leaves is as good as can be had.
    const double least = 2.0 * ray->error, tolerance = larger(ray->patch->tolerance, least);
    // On the patch's own border: else a patch would be wider than it is by its tolerance.
    const double beside = larger(smaller(tolerance, ray->patch->border), least);
    for (int step = 0; step < NEWTON_STEPS; step++) {
        query->stats.newton++;
        Vec3 s[3];
        eval_patch(ray->patch, u, v, s);
        Vec3 su = s[1], sv = s[2], r = vec_sub(ray->org, s[0]);
        Vec3 m1 = vec_cross(ray->dir, sv), m2 = vec_cross(su, ray->dir);
        double det = vec_dot(su, m1), steep = 1.0 / det;
        if (!(fabs(det) > 0.0)) // also NaN
            return NEWTON_LOST;
        double a = clamp(vec_dot(r, m1) * steep, u0 - u, u1 - u);
        double b = clamp(vec_dot(r, m2) * steep, v0 - v, v1 - v);
        double turn_u = muu * fabs(a) + muv * fabs(b), turn_v = muv * fabs(a) + mvv * fabs(b);
        double rest = 0.5 * (turn_u * fabs(a) + turn_v * fabs(b));
        u = clamp(u + a, u0, u1);
        v = clamp(v + b, v0, v1);
        const bool border = u <= 0.0 || u >= 1.0 || v <= 0.0 || v >= 1.0;
        const double limit = border ? beside : tolerance;
        if (!(rest <= limit))
            continue;
        Vec3 off = vec_sub(vec_sub(r, vec_scale(su, a)), vec_scale(sv, b));
        double depth = -vec_dot(off, ray->dir);
        Vec3 across = vec_madd(off, depth, ray->dir), n = vec_cross(su, sv);
        // The sum of the coordinates is no less than the length, and cheaper.
        double distance = length1(across) + rest + ray->error, area = vec_length(n);
        // Does the correction turn the normal? Then look there. Where it goes nowhere (a ray beside
        // the patch's edge) the turn is 0.
        double turn = turn_u * length1(sv) + turn_v * length1(su);
        if (!(distance <= limit && turn <= NEWTON_NORMAL_ERROR * area)) {
            // A step that small goes nowhere else.
            if (distance > 4.0 * limit)
                return NEWTON_LOST;
            continue;
        }
        const double t = ray->t_base + depth * ray->t_per_s;
        if (!walk_in_range(walk, t))
            return NEWTON_TAKEN;
        // What is left of the turn is seen in mirrors whose pictures lie a thousand units away.
        if (query->kind != QUERY_ANY && turn > NEWTON_NORMAL_TURN * area) {
            eval_patch(ray->patch, clamp(u, 0.0, 1.0), clamp(v, 0.0, 1.0), s);
            n = vec_cross(s[1], s[2]);
            area = vec_length(n);
            if (!(area > 0.0))
                return NEWTON_LOST;
        }
        Root root = {.hit = {.t = t,
                             .u = u,
                             .v = v,
                             .normal = vec_scale(n, 1.0 / area),
                             .bound = distance,
                             .id = ray->patch->id}};
        if (query->kind == QUERY_ALL)
            root_set_errors(&root, m1, m2, det);
        return walk_take(walk, &root) ? NEWTON_TAKEN : NEWTON_STOP;
    }
    return NEWTON_LOST;
}

#endif
