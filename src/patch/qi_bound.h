// SPDX-License-Identifier: MIT
// Parts of a patch and bounds of linear functions of their coordinates: what qi_reduce.c and
// qi_bend.h share. Inline, so that the bicubic case becomes loops of known length. Private to them.
#ifndef PATCH_QI_BOUND_H
#define PATCH_QI_BOUND_H

#include "base/lanes.h"
#include "patch/qi_root.h"

#include <float.h>
#include <string.h>

enum { LINE = BEZIER_MAX_DEGREE + 1, POINTS = BEZIER_MAX_POINTS };

typedef struct {
    double low, high;
} Span;

// The remainder's QI bounds, and L of qi_reduce.c.
typedef struct {
    Span span;
    double slope;
} Remainder;

// ---- Pieces ----

// Weights of the control points in the control points of the part [a,b]: those of the k-th are the
// coefficients of ((1-a) + a x)^(d-k) ((1-b) + b x)^k. All are >= 0, so relative errors stay
// relative. Weight i of point k is w[k * step_k + i * step_i].
static inline void restriction(double *w, int step_k, int step_i, int d, double a, double b) {
    double at_a[LINE], row[LINE];
    at_a[0] = 1.0;
    for (int k = d; k >= 0; k--) {
        for (int i = 0; i <= d - k; i++)
            row[i] = at_a[i];
        for (int n = d - k + 1; n <= d; n++) { // n: degree reached
            row[n] = row[n - 1] * b;
            for (int i = n - 1; i > 0; i--)
                row[i] = row[i] * (1.0 - b) + row[i - 1] * b;
            row[0] *= 1.0 - b;
        }
        for (int i = 0; i <= d; i++)
            w[k * step_k + i * step_i] = row[i];
        if (k > 0) {
            int n = d - k + 1;
            at_a[n] = at_a[n - 1] * a;
            for (int i = n - 1; i > 0; i--)
                at_a[i] = at_a[i] * (1.0 - a) + at_a[i - 1] * a;
            at_a[0] *= 1.0 - a;
        }
    }
}

// out = a b, of so many rows and columns; n: columns of a. Four columns at a time, the last four
// once more where four do not divide them.
static inline void multiply(const double *a, const double *b, int rows, int n, int columns,
                            double *restrict out) {
    for (int k = 0; k < rows; k++, a += n, out += columns) {
        for (int at = 0; columns >= 4 && at < columns; at += 4) {
            int m = at + 4 <= columns ? at : columns - 4;
            Lanes2 low = a[0] * lanes2_load(b + m), high = a[0] * lanes2_load(b + m + 2);
            for (int j = 1; j < n; j++) {
                low += a[j] * lanes2_load(b + j * columns + m);
                high += a[j] * lanes2_load(b + j * columns + m + 2);
            }
            memcpy(out + m, &low, sizeof low);
            memcpy(out + m + 2, &high, sizeof high);
        }
        for (int m = 0; columns < 4 && m < columns; m++) {
            out[m] = a[0] * b[m];
            for (int j = 1; j < n; j++)
                out[m] += a[j] * b[j * columns + m];
        }
    }
}

// out = wu p wv.
static inline void restrict_axis(const double *p, const double *wu, const double *wv, int du,
                                 int dv, double *restrict out) {
    double half[POINTS];
    multiply(wu, p, du + 1, du + 1, dv + 1, half);
    multiply(half, wv, du + 1, dv + 1, dv + 1, out);
}

static inline Span span_of(const double *p, int count) {
    Span s = {p[0], p[0]};
    for (int k = 1; k < count; k++) {
        s.low = p[k] < s.low ? p[k] : s.low;
        s.high = p[k] > s.high ? p[k] : s.high;
    }
    return s;
}

static inline Span span_hull(Span a, Span b) {
    return (Span){a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}

// Mean difference between opposite sides.
static inline double trend_u(const double *p, int du, int dv) {
    double sum = 0.0;
    for (int j = 0; j <= dv; j++)
        sum += p[du * (dv + 1) + j] - p[j];
    return sum / (dv + 1);
}

static inline double trend_v(const double *p, int du, int dv) {
    double sum = 0.0;
    for (int i = 0; i <= du; i++)
        sum += p[i * (dv + 1) + dv] - p[i * (dv + 1)];
    return sum / (du + 1);
}

// ---- Bounds ----

static inline double larger(double a, double b) { return a > b ? a : b; }

static inline double largest(const double *a, int count) {
    double most = a[0];
    for (int k = 1; k < count; k++)
        most = larger(most, a[k]);
    return most;
}

// Largest absolute second differences, and slopes of the control points, along both directions.
// Maxima are kept by column, so that the inner loops vectorise.
static inline void differences(const double *r, int du, int dv, double second[2], double slope[2]) {
    int row = dv + 1;
    double first[LINE], before[LINE], most[LINE], most2[LINE];
    most[0] = most2[0] = 0.0; // for gcc, which does not know that dv >= 1
    for (int j = 0; j <= dv; j++) {
        before[j] = r[row + j] - r[j];
        most[j] = fabs(before[j]);
        most2[j] = 0.0;
    }
    for (int i = 1; i < du; i++) {
        const double *c = r + i * row;
        for (int j = 0; j <= dv; j++) {
            double here = c[row + j] - c[j];
            most[j] = larger(most[j], fabs(here));
            most2[j] = larger(most2[j], fabs(here - before[j]));
            before[j] = here;
        }
    }
    second[0] = largest(most2, dv + 1);
    slope[0] = du * largest(most, dv + 1);

    for (int j = 0; j < dv; j++)
        most[j] = most2[j] = 0.0;
    for (int i = 0; i <= du; i++) {
        const double *c = r + i * row;
        for (int j = 0; j < dv; j++) {
            first[j] = c[j + 1] - c[j];
            most[j] = larger(most[j], fabs(first[j]));
        }
        for (int j = 1; j < dv; j++)
            most2[j] = larger(most2[j], fabs(first[j] - first[j - 1]));
    }
    second[1] = largest(most2, dv);
    slope[1] = dv * largest(most, dv);
}

// Span of the net M r M^T.
static inline Span quasi_span(const double *r, int du, int dv) {
    int row = dv + 1;
    double low[LINE], high[LINE], c[LINE], q[LINE];
    low[0] = high[0] = r[0]; // for gcc, which does not know that du >= 0
    for (int i = 0; i <= du; i++) {
        const double *here = r + i * row;
        for (int j = 0; j <= dv; j++)
            c[j] = i == 0 || i == du ? here[j]
                                     : 0.25 * (here[j - row] + 2.0 * here[j] + here[j + row]);
        q[0] = c[0];
        q[dv] = c[dv];
        for (int j = 1; j < dv; j++)
            q[j] = 0.25 * (c[j - 1] + 2.0 * c[j] + c[j + 1]);
        for (int j = 0; j <= dv; j++) {
            low[j] = i == 0 || q[j] < low[j] ? q[j] : low[j];
            high[j] = i == 0 || q[j] > high[j] ? q[j] : high[j];
        }
    }
    return span_hull(span_of(low, row), span_of(high, row));
}

static inline Remainder bound_remainder(const QiNet *p, int du, int dv, QiForm f, double zu,
                                        double zv, const QiFrame *frame) {
    double r[POINTS], second[2], slope[2], base_v[LINE];
    for (int j = 0; j <= dv; j++)
        base_v[j] = f.av * ((double)j / dv);
    for (int i = 0; i <= du; i++) {
        double base = f.au * ((double)i / du);
        for (int j = 0; j <= dv; j++) {
            int k = i * (dv + 1) + j;
            r[k] = f.bx * p->x[k] + f.by * p->y[k] - (base + base_v[j]);
        }
    }
    differences(r, du, dv, second, slope);
    Span s = quasi_span(r, du, dv);
    // Rounding: that of the coordinates, and of the parameters' share.
    double eps = zu * second[0] + zv * second[1] + fabs(f.bx) * frame->slack_x +
                 fabs(f.by) * frame->slack_y + 16.0 * DBL_EPSILON * (fabs(f.au) + fabs(f.av));
    return (Remainder){{s.low - eps, s.high + eps}, slope[0] + slope[1]};
}

// Solves a p + b q + r = 0 for p: p in [0,1] already narrowed to *p, q in *q, r in its span.
// False when no p is left. A product with 0 is 0 here, since q is finite.
static inline bool clip(double a, double b, Span r, Span q, Span *p) {
    double low = -r.high - larger(b * q.low, b * q.high);
    double high = -r.low - (b * q.low < b * q.high ? b * q.low : b * q.high);
    if (a < 0.0) {
        double swap = -low;
        low = -high, high = swap, a = -a;
    }
    // a p in [low, high]: multiplied out, so that a tiny a only fails to clip.
    if (p->low * a > high || p->high * a < low)
        return false;
    if (p->low * a < low)
        p->low = low / a;
    if (p->high * a > high)
        p->high = high / a;
    return true;
}

#endif
