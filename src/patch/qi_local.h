// SPDX-License-Identifier: MIT
// A patch of high degree seen close by: over a small part of it three orders of its Taylor series
// are a bicubic patch, and the fourth derivatives bound the rest. Such a net costs a fifth of the
// true one at degree 16, and all bounds hold for it with that rest as its rounding.
#ifndef PATCH_QI_LOCAL_H
#define PATCH_QI_LOCAL_H

#include "patch/qi_root.h"

typedef struct {
    int du, dv;
    const QiNet *net; // of the whole patch
    double slack[3];  // its rounding, by coordinate
    BezierRect over;  // where the bounds hold
    // By coordinate: of the i-th derivative in u, (4-i)-th in v, by the parameters of `over`,
    // largest absolute value.
    double fourth[3][5];
    // The bicubic made last, over `from`; its coordinates come when they are asked for.
    bool made, has[3];
    BezierRect from;
    double u[4 * (BEZIER_MAX_DEGREE + 1)], v[4 * (BEZIER_MAX_DEGREE + 1)]; // weights of points
    double cubic[3][16], rest[3];
} QiLocal;

// Is it worth while at that degree?
bool qi_local_pays(int du, int dv);

// The bounds over a part of a patch, from its own net, whose coordinates err by `error`; upwards.
void qi_local_fourth(const Bezier *part, double error, float most[3][5]);

// The frame, degrees and net of a target; fourth: what is known of the patch over what holds rect,
// else NULL. False: there is nothing to be gained. target must stay.
bool qi_local_init(QiLocal *local, const QiTarget *target, BezierRect rect, const QiFourth *fourth);

// A part of `over`.
typedef struct {
    bool whole; // all of the bicubic made last
    double u[16], v[16];
} QiLocalPart;

// Of the bicubic made last, if that holds rect, which costs a fifth; else one is made for it.
void qi_local_part(QiLocal *local, BezierRect rect, QiLocalPart *part);
// The next part gets its own.
void qi_local_forget(QiLocal *local);

// One coordinate (0, 1, 2: x, y, z) over the part, which is the last one: out gets 16 control
// points, and rest what they may be off by, rounding included. The derivatives along both of the
// part's own parameters, taken together, are off by 8 rest at most.
void qi_local_cut(QiLocal *local, const QiLocalPart *part, int coordinate, double out[16],
                  double *rest);

#endif
