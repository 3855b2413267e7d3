// SPDX-License-Identifier: MIT
// Ray against one Bézier patch with the quasi-interpolating net: complete, certified, any
// bi-degree.
//
// qi_paper_*   the published loop, readable, no Newton: the reference (qi.c)
// qi_reduce_*  the same bounds used to read the parameter interval off: converges quadratically,
//              proves roots single before it sharpens them; the certain fallback of the fast path
//              (qi_reduce.c)
//
// What is promised, for finite input (anything else, or a zero direction, gives no hit):
//   - t_min <= t < t_max, (u,v) inside the rectangle asked for, |org + t dir - S(u,v)| <= bound,
//     and bound <= tolerance + R, where R = qi_rounding() is what rounding alone can do. The bound
//     counts all rounding; the control points and the ray count as exact.
//   - No crossing inside the rectangle, its sides included, is missed. A ray that passes within
//     the tolerance of the surface without crossing it may or may not be reported.
//   - Of crossings whose depths rounding cannot tell apart, within R of each other along the ray,
//     any may be the nearest.
//   - One crossing is one hit, also where search pieces meet, at collapsed edges and at corners.
//     Two crossings that the tolerance cannot tell apart (the two sides of a fold that the ray
//     leaves by less than the tolerance) may be reported as one.
//   - Where the ray lies in the surface (in the plane of a flat patch, along a ruling, along a
//   patch
//     whose points are all on one line) the answers are infinitely many: some are reported, never
//     none. With qi_reduce the one with the smallest t, within the tolerance, is among them; where
//     the ray begins in the surface that is t_min. Where the patch is one point or a curve across
//     the ray, and passes it by no more than rounding, that is one hit.
//   - Where all of a piece lies within the tolerance of one point, depth included (a pole), the
//     range has it or has it not: no more is tried to tell the two apart.
//   - Work is bounded: after qi_work_limit() nets only one child of each net is followed. Separate
//     crossings stay far below the limit; rays in the surface may reach it.
//   - No heap, less than 200 KB of stack, no state: any number of threads.
#ifndef PATCH_QI_H
#define PATCH_QI_H

#include "patch/bezier.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    double t, u, v; // u, v: parameters of the whole patch
    Vec3 normal;    // unit, along dS/du x dS/dv, see bezier_normal()
    double bound;   // scene units
} QiHit;

// Bounds of the fourth derivatives over a part of a patch; see qi_local.h.
typedef struct {
    BezierRect over;
    const float (*most)[5]; // by coordinate, scene units
} QiFourth;

typedef struct {
    Ray ray;                // dir of any length; t counts in it
    double t_min, t_max;    // t_min <= t < t_max; t_max may be INFINITY
    double tolerance;       // scene units, >= 0
    BezierRect rect;        // where to look
    const QiFourth *fourth; // over what holds rect; NULL: not known. For polynomial patches
} QiQuery;

// The whole patch, t from 0 to infinity, tolerance 1e-9 of its diameter.
QiQuery qi_query_default(const Bezier *patch, Ray ray);

// Added to, never cleared. May be NULL.
typedef struct {
    uint64_t steps;   // nets built
    uint64_t newton;  // Newton steps
    uint64_t hits;    // hits reported
    uint64_t limited; // queries that reached the work limit
    uint64_t full; // qi_reduce_*, not bicubic: nets of the patch's own bi-degree, the dearer ones
} QiStats;

typedef void (*QiSink)(void *context, const QiHit *hit);

// Every hit, by increasing t; returns their number. At most QI_MAX_HITS are reported.
enum { QI_MAX_HITS = 640 }; // 2 * 16 * 16 are possible at degree 16, and some room
int qi_paper_all(const Bezier *patch, const QiQuery *query, QiStats *stats, QiSink sink,
                 void *context);
int qi_reduce_all(const Bezier *patch, const QiQuery *query, QiStats *stats, QiSink sink,
                  void *context);
// The hit with the smallest t; false and *hit untouched when there is none.
bool qi_paper_nearest(const Bezier *patch, const QiQuery *query, QiStats *stats, QiHit *hit);
bool qi_reduce_nearest(const Bezier *patch, const QiQuery *query, QiStats *stats, QiHit *hit);
// Is there a hit? Stops at the first one found.
bool qi_paper_any(const Bezier *patch, const QiQuery *query, QiStats *stats);
bool qi_reduce_any(const Bezier *patch, const QiQuery *query, QiStats *stats);

// The same for a rational patch (rational.h); weights > 0, one a point.
int qi_rational_all(const Bezier *patch, const double *weights, const QiQuery *query,
                    QiStats *stats, QiSink sink, void *context);
bool qi_rational_nearest(const Bezier *patch, const double *weights, const QiQuery *query,
                         QiStats *stats, QiHit *hit);

// Bound of the rounding in a distance between ray and patch, scene units: a few dozen ulps of the
// distance from the ray's origin to the farthest control point.
double qi_rounding(const Bezier *patch, Vec3 org);
int qi_work_limit(const Bezier *patch);

#endif
