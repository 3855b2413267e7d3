// SPDX-License-Identifier: MIT
// Roots of one patch in a ray's skew frame: points of the patch, the last steps towards a root that
// qi_reduce.c has isolated, and what to answer where roots are not single.
#ifndef PATCH_QI_ROOT_H
#define PATCH_QI_ROOT_H

#include "patch/qi_frame.h"

// A patch in the ray's frame, coordinate by coordinate; index i * (dv + 1) + j.
// Of a rational patch: the coordinates times the weights, and the weights w.
typedef struct {
    double x[BEZIER_MAX_POINTS], y[BEZIER_MAX_POINTS], z[BEZIER_MAX_POINTS], w[BEZIER_MAX_POINTS];
} QiNet;

// A patch, a ray, and what was found so far.
typedef struct {
    QiFrame frame;
    QiList list;
    int du, dv;
    bool rational;
    QiNet whole;
    double weight_x, weight_y; // bring x and y to size 1, unless they are rounding and no more
    double unit_x, unit_y;     // bring their rounding to size 1
    uint64_t newton;           // points evaluated on the way to a root
} QiTarget;

// A linear function of the projected coordinates, bx x + by y = au u + av v + remainder over a
// piece's own [0,1]^2.
typedef struct {
    double bx, by, au, av;
} QiForm;

// Puts a patch and a ray into the target. False as qi_frame_init().
// weights: of a rational patch, else NULL.
bool qi_target_init(QiTarget *target, const Bezier *patch, const double *weights, const Ray *ray);
// Begins a query of it; found holds `capacity` hits. False as qi_frame_ask().
bool qi_target_ask(QiTarget *target, const QiQuery *query, QiMode mode, QiFound *found,
                   int capacity);

// Distance of S(u,v) from the ray as the weights measure it.
double qi_root_off(const QiTarget *target, double u, double v);

// A root with its rounding, in slacks: what Newton may end on and still be on a root.
#define QI_ROOT_SLACKS 4.0

// A point of the patch: x and y, of a rational patch times the weight w; else w is 1.
typedef struct {
    double u, v, x, y, w;
} QiPoint;

// Newton inside `rect`, which can hold one root only: true if it ends on it, and then it is added;
// else *last is where it ended, which proves nothing: rounding may have kept it from a root.
// error_u, error_v: how far off QI_ROOT_SLACKS can move the root.
bool qi_root_sharpen(QiTarget *target, BezierRect rect, double error_u, double error_v,
                     QiPoint *last);

// A piece whose every point is within the tolerance of the ray: adds one hit, as near to the ray as
// least squares bring it. False: no corner's depth is in range, nor the middle's.
bool qi_root_settle(QiTarget *target, BezierRect rect);

// The same from a given point of the piece, which is where its depths begin. False: not in range.
bool qi_root_settle_at(QiTarget *target, BezierRect rect, double u, double v);
// May a point of that depth be a hit?
bool qi_root_in_range(const QiTarget *target, double z);

// A piece in which the form grows strictly in both parameters (in the directions of the signs of au
// and av) and any form across it is rounding: the form vanishes on a curve from border to border,
// or nowhere. Adds the first end of that curve whose depth is in range, or the place where it
// reaches t_min. slack: rounding of the form. False: there is a curve and no such place.
bool qi_root_settle_curve(QiTarget *target, BezierRect rect, QiForm form, double slack);

#endif
