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

// One coordinate (0, 1, 2: x, y, z) over rect, a part of `over`: out gets 16 control points, and
// rest what they may be off by, rounding included. The derivatives along both of the part's own
// parameters, taken together, are off by 8 rest at most.
void qi_local_cut(const QiLocal *local, BezierRect rect, int coordinate, double out[16],
                  double *rest);

#endif
