// SPDX-License-Identifier: MIT
// Curves in a plane, as lathe and prism have them: pieces of cubics in a parameter w from 0 to 1.
#ifndef SHAPE_CURVE_H
#define SHAPE_CURVE_H

#include "base/arena.h"
#include "model/solid.h"

// u(w) = u[0] + u[1] w + u[2] w^2 + u[3] w^3, v likewise.
typedef struct {
    double u[4], v[4];
    int degree;
    Vec2 start, end; // exactly, so that neighbours agree
    Vec2 low, high;  // the box around
} CurvePiece;

typedef struct {
    CurvePiece *pieces;
    uint32_t count;
    Vec2 low, high;
} Curve;

// rings: closed curves stand one after the other in points (prism), else one curve (lathe).
Curve curve_make(OutlineType type, const Vec2 *points, uint32_t count, bool rings, Arena *arena);
// The part of the plane that a ray can be over.
typedef struct {
    Vec2 low, high;
} CurveBox;
#define CURVE_EVERYWHERE ((CurveBox){{-INFINITY, -INFINITY}, {INFINITY, INFINITY}})

// Around the way from one point to another, slack wider; everywhere if that is not finite.
CurveBox curve_shadow(double u0, double v0, double u1, double v1, double slack);
// Has what lies between low and high no point in the shadow?
bool curve_apart(const CurveBox *shadow, Vec2 low, Vec2 high);

// Quadratic arcs of start, control and end point each (six numbers).
Curve curve_of_arcs(const double *arcs, uint32_t count, Arena *arena);
Vec2 curve_at(const CurvePiece *piece, double w);
Vec2 curve_slope(const CurvePiece *piece, double w);
// Is (u, v) within the curves, by the even-odd rule along +u? The pieces need not be closed.
bool curve_holds(const Curve *curve, double u, double v);

#endif
