// SPDX-License-Identifier: MIT
// Points of patches in long double.
#include "ray_oracle_set.h"

// ---- Points

// Bernstein polynomials of degree n, and n times those of degree n - 1, which the differences of
// control points have in the derivative: equal points have the derivative 0 exactly. All terms are
// >= 0 for t in [0,1], so a sum of them keeps its relative accuracy, that of weights too.
static void basis(int n, Real t, Real *value, Real *slope) {
    Real low[ORACLE_SIDE] = {1};
    for (int m = 1; m < n; m++) {
        for (int i = m; i > 0; i--)
            low[i] = (i < m ? low[i] * (1 - t) : 0) + low[i - 1] * t;
        low[0] *= 1 - t;
    }
    for (int i = 0; i <= n; i++) {
        value[i] = (i < n ? low[i] * (1 - t) : 0) + (i > 0 ? low[i - 1] * t : 0);
        slope[i] = i < n ? n * low[i] : 0;
    }
}

typedef struct {
    Real u[ORACLE_SIDE], v[ORACLE_SIDE], slope_u[ORACLE_SIDE], slope_v[ORACLE_SIDE];
} Basis;

// One axis less `from`, times the weights; axis 3: the weights. out[1] and out[2], the derivatives,
// only when asked for.
static void coordinate(const PatchDef *def, const Basis *b, int axis, double from, bool slopes,
                       Real out[3]) {
    int nu = (int)def->degree_u, nv = (int)def->degree_v;
    Real before = 0;
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i <= nu; i++) {
        Real row = 0, slope = 0, last = 0;
        for (int j = 0; j <= nv; j++) {
            int k = i * (nv + 1) + j;
            Real p = axis < 3 ? (Real)vec_get(def->points[k], axis) - from : 1;
            if (def->weights)
                p *= def->weights[k];
            row += b->v[j] * p;
            if (slopes && j > 0)
                slope += b->slope_v[j - 1] * (p - last);
            last = p;
        }
        out[0] += b->u[i] * row;
        if (i > 0)
            out[1] += b->slope_u[i - 1] * (row - before);
        out[2] += b->u[i] * slope;
        before = row;
    }
}

void oracle_jet_less(const PatchDef *def, Vec3 from, Real u, Real v, bool slopes, Real s[3][3]) {
    Basis b;
    Real w[3] = {1, 0, 0};
    basis((int)def->degree_u, u, b.u, b.slope_u);
    basis((int)def->degree_v, v, b.v, b.slope_v);
    if (def->weights)
        coordinate(def, &b, 3, 0.0, slopes, w);
    for (int axis = 0; axis < 3; axis++) {
        coordinate(def, &b, axis, vec_get(from, axis), slopes, s[axis]);
        s[axis][0] /= w[0];
        for (int k = 1; k < 3; k++)
            s[axis][k] = (s[axis][k] - s[axis][0] * w[k]) / w[0];
    }
}

void ray_oracle_jet(const PatchDef *def, double u, double v, Vec3 out[3]) {
    Real s[3][3];
    oracle_jet_less(def, vec3(0.0, 0.0, 0.0), u, v, true, s);
    for (int k = 0; k < 3; k++)
        out[k] = vec3((double)s[0][k], (double)s[1][k], (double)s[2][k]);
}

double ray_oracle_residual(const PatchDef *def, const Ray *ray, double t, double u, double v) {
    Real s[3][3], square = 0;
    oracle_jet_less(def, ray->org, u, v, false, s);
    for (int axis = 0; axis < 3; axis++) {
        Real off = (Real)t * vec_get(ray->dir, axis) - s[axis][0];
        square += off * off;
    }
    return (double)sqrtl(square);
}
