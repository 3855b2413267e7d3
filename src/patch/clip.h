// SPDX-License-Identifier: MIT
// Bézier clipping: a sub-patch projected along a ray, and the part of it that the ray can meet.
//
// Nishita, Sederberg and Kakimoto, "Ray tracing trimmed rational surface patches" (1990): take a
// line through the ray's image whose direction is that of the net along one parameter. The signed
// distances of the control points from it are a Bézier function; with their parameters i/n they
// have a convex hull, and the other parameter of a root lies where that hull meets the axis.
// Campagna, Slusallek and Seidel (1997): the directions are taken anew from the part that is left,
// and the part is left a little larger; here by what rounding can do to the distances.
// Efremov, Havran and Seidel (2005): opposite sides whose directions cancel get the line at right
// angles to the other direction; sides nearly parallel to each other are tested with both lines; a
// part is finished by its size in space, not in parameters.
#ifndef PATCH_CLIP_H
#define PATCH_CLIP_H

#include "patch/refine.h"

// Control points as the ray sees them, one coordinate after the other; the ray is the origin. Those
// of a rational patch are times their weights, so that they are a Bézier function again. The index
// along which the next clip goes is the first: clips go along both in turn, so the net is turned
// over each time.
typedef struct {
    int rows, columns; // degrees along the first and the second index
    bool turned;       // the first index runs along v
    BezierRect rect;   // of the sub-patch's own parameters
    double x[BEZIER_MAX_POINTS], y[BEZIER_MAX_POINTS];
} ClipNet;

// All of a sub-patch.
void clip_project(const RefineRay *ray, const SubPatch *sub, ClipNet *out);
// The part of a whole net over a rectangle.
void clip_restrict(const ClipNet *whole, BezierRect rect, ClipNet *out);
// Length and width of the box around the control points. False: the ray passes it by more than
// slack.
bool clip_meets(const ClipNet *net, double slack, double *size);

// Clips along the first index and turns the net over. False: the ray misses the part. *kept is the
// share of the parameter's range that is left; nothing is cut off when that is more than
// CLIP_ENOUGH.
#define CLIP_ENOUGH 0.8
bool clip_step(ClipNet *net, double slack, double *kept);

// The halves of what is left, across the direction that is longer as the ray sees it.
void clip_halve(const ClipNet *net, BezierRect *low, BezierRect *high);

#endif
