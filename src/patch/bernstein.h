// SPDX-License-Identifier: MIT
// Bernstein polynomials of a degree up to 16 and their derivatives at t in [0,1].
#ifndef PATCH_BERNSTEIN_H
#define PATCH_BERNSTEIN_H

#include "patch/bezier.h"

// w[i] = B_i^n(t), dw[i] = its derivative; n + 1 of each.
static inline void bernstein(int n, double t, double *w, double *dw) {
    double s = 1.0 - t, low[BEZIER_MAX_DEGREE + 2] = {0.0, 1.0}; // degree n - 1, shifted by one
    for (int k = 1; k < n; k++) {
        for (int i = k + 1; i > 0; i--)
            low[i] = low[i] * s + low[i - 1] * t;
    }
    for (int i = 0; i <= n; i++) {
        w[i] = low[i + 1] * s + low[i] * t;
        dw[i] = n * (low[i] - low[i + 1]);
    }
}

static inline void bernstein_cubic(double t, double w[4], double dw[4]) {
    double s = 1.0 - t;
    w[0] = s * s * s;
    w[1] = 3.0 * s * s * t;
    w[2] = 3.0 * s * t * t;
    w[3] = t * t * t;
    dw[0] = -3.0 * s * s;
    dw[1] = 3.0 * s * (s - 2.0 * t);
    dw[2] = 3.0 * t * (2.0 * s - t);
    dw[3] = 3.0 * t * t;
}

#endif
