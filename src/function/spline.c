// SPDX-License-Identifier: MIT
// Splines (facts: sdl 2.8): keys in ascending order, each with a value of up to five components.
// The order of the operations is POV-Ray's: spline values become coordinates and must have its
// bits.
#include "function/function.h"

#include <math.h>
#include <stddef.h>

void spline_prepare(Spline *s, double *work) {
    // The C2 spline without second derivatives at both ends: the tridiagonal system of the middle
    // keys, eliminated downwards, solved upwards.
    size_t n = s->key_count;
    SplineKey *k = s->keys;
    double *pivot = work, *right = work + n;
    for (int c = 0; n > 2 && c < FUNCTION_WIDTH; c++) {
        double before = 0, slope_before = 0; // length and slope of the segment before key i
        for (size_t i = 0; i + 1 < n; i++) {
            double after = k[i + 1].at - k[i].at;
            double slope_after = (k[i + 1].value[c] - k[i].value[c]) / after;
            if (i > 0) {
                pivot[i] = 2 * (after + before);
                right[i] = 6 * (slope_after - slope_before);
            }
            if (i > 1) {
                pivot[i] -= before * before / pivot[i - 1];
                right[i] -= before * right[i - 1] / pivot[i - 1];
            }
            before = after;
            slope_before = slope_after;
        }
        k[n - 1].second[c] = k[0].second[c] = 0;
        for (size_t i = n - 2; i > 0; i--)
            k[i].second[c] = (right[i] - (k[i + 1].at - k[i].at) * k[i + 1].second[c]) / pivot[i];
    }
}

// This and the next three: one component c at t, in the segment from key a to a + 1.
static double linear(const SplineKey *a, int c, double t) {
    const SplineKey *b = a + 1;
    return (t - a->at) * (b->value[c] - a->value[c]) / (b->at - a->at) + a->value[c];
}

// Through the keys a - 1, a, a + 1: the coefficients by Cramer's rule, then Horner.
static double quadratic(const SplineKey *a, int c, double t) {
    double t0 = a[-1].at, t1 = a[0].at, t2 = a[1].at;
    double v0 = a[-1].value[c], v1 = a[0].value[c], v2 = a[1].value[c];
    double det = (t1 - t0) * (t2 - t0) * (t2 - t1);
    double square = -t1 * v0 + t2 * v0 + t0 * v1 - t2 * v1 - t0 * v2 + t1 * v2;
    double first =
        t1 * t1 * v0 - t2 * t2 * v0 - t0 * t0 * v1 + t2 * t2 * v1 + t0 * t0 * v2 - t1 * t1 * v2;
    double constant = -t1 * t1 * t2 * v0 + t1 * t2 * t2 * v0 + t0 * t0 * t2 * v1 -
                      t0 * t2 * t2 * v1 - t0 * t0 * t1 * v2 + t0 * t1 * t1 * v2;
    return (square / det * t + first / det) * t + constant / det;
}

// Hermite's cubic; the tangent at a key is the mean of the slopes on both sides.
static double cubic(const SplineKey *a, int c, double t) {
    double h = a[1].at - a[0].at, u = (t - a[0].at) / h;
    double slope = (a[1].value[c] - a[0].value[c]) / (a[1].at - a[0].at);
    double before = (a[0].value[c] - a[-1].value[c]) / (a[0].at - a[-1].at);
    double after = (a[2].value[c] - a[1].value[c]) / (a[2].at - a[1].at);
    double tangent_a = (before + slope) / 2 * h, tangent_b = (after + slope) / 2 * h;
    return a[0].value[c] * (2 * u * u * u - 3 * u * u + 1) +
           a[1].value[c] * (3 * u * u - 2 * u * u * u) + tangent_a * (u * u * u - 2 * u * u + u) +
           tangent_b * (u * u * u - u * u);
}

// Taylor's polynomial about key a.
static double natural(const SplineKey *a, int c, double t) {
    double h = a[1].at - a[0].at, d = t - a[0].at;
    double curve = a[0].second[c] / 2 + d * (a[1].second[c] - a[0].second[c]) / (6 * h);
    double slope = -(h / 6) * (a[1].second[c] + 2 * a[0].second[c]) +
                   (a[1].value[c] - a[0].value[c]) / h + d * curve;
    return a[0].value[c] + d * slope;
}

// How many keys lie before t.
static size_t keys_before(const Spline *s, double t) {
    size_t low = 0, high = s->key_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (s->keys[middle].at < t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static double evaluate(const Spline *s, SplineKind kind, double t, size_t i, int c) {
    const SplineKey *k = s->keys;
    size_t n = s->key_count;
    if (n == 1)
        return k[0].value[c];
    if (kind == SPLINE_CUBIC) {
        // Without a key on both sides there is no tangent: only the inner segments exist.
        if (n == 2)
            return (k[0].value[c] + k[1].value[c]) / 2;
        if (i < 2)
            return k[1].value[c];
        return i >= n - 1 ? k[n - 2].value[c] : cubic(&k[i - 1], c, t);
    }
    if (i == 0)
        return k[0].value[c];
    if (t >= k[n - 1].at || i == n)
        return k[n - 1].value[c];
    if (kind == SPLINE_QUADRATIC && n > 2)
        return quadratic(&k[i == 1 ? 1 : i - 1], c, t);
    return kind == SPLINE_NATURAL ? natural(&k[i - 1], c, t) : linear(&k[i - 1], c, t);
}

void spline_value(const Spline *s, SplineKind kind, double t, double out[FUNCTION_WIDTH]) {
    size_t i = keys_before(s, t);
    if (isnan(t) && s->key_count > 1) {
        for (int c = 0; c < FUNCTION_WIDTH; c++)
            out[c] = t;
        return;
    }
    for (int c = 0; c < FUNCTION_WIDTH; c++)
        out[c] = evaluate(s, kind, t, i, c);
}
