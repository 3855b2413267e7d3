// SPDX-License-Identifier: MIT
// B-splines and NURBS as Bézier patches, a span at a time: exactly the same surface.
//
// A span of degree d depends on d + 1 control points each way and on the 2 d knots about it, of
// which the middle two are its ends: in a surface with knots U and control points P the span [U[k],
// U[k+1]) has points P[k-d .. k] and knots U[k-d+1 .. k+d]. Bézier control point i is the span's
// polar form at (a,..a,b,..b) with i times b, which is what repeated knot insertion at both ends
// leaves behind (Ramshaw; Boehm). Where a Catmull-Clark mesh is regular it is the uniform bicubic
// B-spline of the 4 x 4 points about a face; a regular Doo-Sabin mesh is the uniform biquadratic
// one of 3 x 3.
#ifndef PATCH_BSPLINE_H
#define PATCH_BSPLINE_H

#include "patch/bezier.h"

typedef struct {
    int degree_u, degree_v;          // 1..16
    const Vec3 *points;              // (degree_u + 1) * (degree_v + 1), row by row
    const double *weights;           // as many, > 0, of a rational surface; or NULL
    const double *knots_u, *knots_v; // 2 degree of each; NULL: uniform, one apart
} BsplineSpan;

// What is wrong with `count` = 2 degree knots: a static text; NULL: nothing.
const char *bspline_knots_fault(const double *knots, int degree);

// The span over [0,1]^2. weights is filled if the span has some, else it may be NULL.
void bspline_span(const BsplineSpan *span, Vec3 *points, double *weights);

// How many spans of degree d a row of n control points has with its n + d + 1 knots, and the first
// control point of each (first may be NULL; n - d of them at most). Knots may be repeated.
int bspline_spans(const double *knots, int n, int degree, int *first);

#endif
