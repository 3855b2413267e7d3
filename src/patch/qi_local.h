// SPDX-License-Identifier: MIT
// A patch of high degree seen close by: over a small part of it three orders of its Taylor series
// are a bicubic patch, and the fourth derivatives bound the rest. Such a net costs a fifth of the
// true one at degree 16, and all bounds hold for it with that rest as its rounding.
#ifndef PATCH_QI_LOCAL_H
#define PATCH_QI_LOCAL_H

#include "patch/qi_root.h"

typedef struct {
    int du, dv;
    BezierRect over;
    QiNet net;           // the true one over that
    double slack[3];     // its rounding, by coordinate
    double fourth[3][5]; // by coordinate: of the i-th derivative in u, (4-i)-th in v, largest
} QiLocal;

// Is it worth while at that degree?
bool qi_local_pays(int du, int dv);

// From the net of a part of a polynomial patch, over `over`.
void qi_local_init(QiLocal *local, const QiFrame *frame, int du, int dv, const QiNet *net,
                   BezierRect over);

// A part of `over`: its half sizes there, and weights of the control points.
typedef struct {
    double hu, hv;
    double u[4 * (BEZIER_MAX_DEGREE + 1)], v[4 * (BEZIER_MAX_DEGREE + 1)];
} QiLocalPart;

void qi_local_part(const QiLocal *local, BezierRect rect, QiLocalPart *part);

// One coordinate (0, 1, 2: x, y, z) over the part: out gets 16 control points, and rest what they
// may be off by, rounding included. The derivatives along both of the part's own parameters, taken
// together, are off by 8 rest at most.
void qi_local_cut(const QiLocal *local, const QiLocalPart *part, int coordinate, double out[16],
                  double *rest);

#endif
