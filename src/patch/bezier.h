// SPDX-License-Identifier: MIT
// Tensor-product Bézier patches in double, any bi-degree from 1 to 16 each way.
//
// A patch of bi-degree (du, dv) is S(u,v) = sum B_i^du(u) B_j^dv(v) P_ij over [0,1]^2. Control
// points lie row by row: P_ij = p[i * (dv + 1) + j], u runs over rows (i), v within a row (j).
//
// Everything is built from one step, the linear interpolation of neighbours, done so that
//   - equal neighbours give exactly their value (collapsed edges stay exactly collapsed),
//   - t = 0 and t = 1 give the end points exactly,
//   - a line read backwards at 1 - t gives the same bits whenever 1 - t is exact.
// Rounding: one step errs by at most 3 ulp/2 of C = max |coordinate| (difference, product with
// t <= 1/2, sum), so a value after du + dv steps by at most 3 (du + dv) 2^-53 C, up to terms of
// second order. See bezier_rounding().
#ifndef PATCH_BEZIER_H
#define PATCH_BEZIER_H

#include "base/vec.h"

#include <stdbool.h>

enum {
    BEZIER_MAX_DEGREE = 16,
    BEZIER_MAX_POINTS = (BEZIER_MAX_DEGREE + 1) * (BEZIER_MAX_DEGREE + 1)
};

// How far apart the weights of a rational patch may be. A part of small weights beside one of large
// ones takes 1 / that of the parameters, so at 1e12 a double's last bits place a point there to
// four digits; at 1e15 to one, and crossings there cannot be told from their neighbours.
#define BEZIER_MAX_WEIGHTS 1e12

typedef struct {
    int du, dv; // 1..16
    Vec3 p[BEZIER_MAX_POINTS];
} Bezier;

// The same in two coordinates: a patch projected along a ray.
typedef struct {
    int du, dv;
    Vec2 p[BEZIER_MAX_POINTS];
} Bezier2;

// A rectangle of parameters, u0 <= u1 and v0 <= v1 within [0,1].
typedef struct {
    double u0, u1, v0, v1;
} BezierRect;

static inline BezierRect bezier_whole(void) { return (BezierRect){0.0, 1.0, 0.0, 1.0}; }
static inline int bezier_count(const Bezier *s) { return (s->du + 1) * (s->dv + 1); }
static inline Vec3 bezier_at(const Bezier *s, int i, int j) { return s->p[i * (s->dv + 1) + j]; }

// Fills *out from (du + 1) * (dv + 1) points, row by row. Points finite, degrees 1..16 (asserted).
void bezier_init(Bezier *out, int du, int dv, const Vec3 *points);
// Copies only the points in use.
void bezier_copy(Bezier *out, const Bezier *s);

// S, and where the pointers are not NULL its derivatives, at (u,v) in [0,1]^2.
typedef struct {
    Vec3 s, su, sv, suu, suv, svv;
} BezierJet;
Vec3 bezier_eval(const Bezier *s, double u, double v);
Vec3 bezier_eval1(const Bezier *s, double u, double v, Vec3 *su, Vec3 *sv); // S, dS/du, dS/dv
void bezier_eval2(const Bezier *s, double u, double v, BezierJet *jet);     // up to second order

// Cuts at a parameter: *low covers [0,t], *high [t,1]. Either may be s itself, or NULL.
void bezier_split_u(const Bezier *s, double t, Bezier *low, Bezier *high);
void bezier_split_v(const Bezier *s, double t, Bezier *low, Bezier *high);

// The part of the patch over a rectangle, as a patch over [0,1]^2. Each new point is a blossom
// value; the points on the side u = u1 depend on u1 and on the v range only, so two rectangles of
// one patch that share a whole side get the same bits there. out may be s.
void bezier_restrict(const Bezier *s, BezierRect r, Bezier *out);
void bezier2_restrict(const Bezier2 *s, BezierRect r, Bezier2 *out);

Box bezier_bounds(const Bezier *s);      // of the control points, so of the patch too
double bezier_diameter(const Bezier *s); // diagonal of bezier_bounds
// Bound of what rounding does to one coordinate of S, or of one restricted control point or net
// point, computed by this file: (3 (du + dv) + 8) 2^-53 max|coordinate|. The 8 covers the averages
// of a net (4), products of a second difference (2) and the terms of second order.
double bezier_rounding(const Bezier *s);

// Unit normal, along dS/du x dS/dv. Where that product vanishes within rounding (collapsed edges
// and corners, cusps) it is the limit when (u,v) is approached from inside the patch, on the way
// to its farther sides in u and v at equal pace: the first non-zero term of the product's Taylor
// series along that line. If all terms vanish, the patch is a curve or a point: then the part of
// `facing` across the curve's tangent (any perpendicular of the tangent when facing lies on it;
// facing itself for a point). facing need not be unit; the result is always finite and unit.
Vec3 bezier_normal(const Bezier *s, double u, double v, Vec3 facing);

#endif
