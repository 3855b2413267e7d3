// SPDX-License-Identifier: MIT
// Roots by pieces: between two neighbouring zeros of its derivative a polynomial is monotone, so a
// sign change there is one root, and Newton's steps kept inside the bracket find it. Two levels:
// the cubic 4 t^3 + 2 p t + q is monotone between -w and w, where 6 w^2 = -p, and outside; its
// zeros cut the quartic. No formula with nested radicals, hence no loss at double roots.
#include "shape/quartic.h"

#include <math.h>
#include <stdbool.h>

typedef struct {
    int degree;
    double c[5]; // c[i] t^i
} Polynomial;

static double value_at(const Polynomial *f, double t, double *slope) {
    double v = f->c[f->degree], s = 0.0;
    for (int i = f->degree - 1; i >= 0; i--) {
        s = s * t + v;
        v = v * t + f->c[i];
    }
    *slope = s;
    return v;
}

// The root in [low, high], where f is monotone and rises when `rising`, and changes its sign.
static double bracketed_root(const Polynomial *f, double low, double high, bool rising) {
    double t = 0.5 * (low + high);
    // Each step halves the bracket or converges quadratically: 200 is more than halving alone needs
    // from the largest to the smallest double that matters here.
    for (int i = 0; i < 200; i++) {
        double slope, v = value_at(f, t, &slope);
        if (v == 0.0)
            break;
        if ((v < 0.0) == rising)
            low = t;
        else
            high = t;
        double next = t - v / slope;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        // Done when the step is lost in rounding.
        if (next == t || fabs(next - t) <= 0x1p-52 * fabs(t) || next <= low || next >= high) {
            t = next;
            break;
        }
        t = next;
    }
    return t;
}

// All sign changes of f between consecutive cuts (ascending).
static int roots_between(const Polynomial *f, const double *cuts, int cut_count, double *roots) {
    int count = 0;
    double unused, before = value_at(f, cuts[0], &unused);
    for (int i = 1; i < cut_count; i++) {
        double after = value_at(f, cuts[i], &unused);
        // Zero counts as positive on both sides, so that no root is seen twice; what only touches
        // zero from above is none.
        if ((before < 0.0) != (after < 0.0))
            roots[count++] = bracketed_root(f, cuts[i - 1], cuts[i], before < 0.0);
        before = after;
    }
    return count;
}

int quartic_roots(double p, double q, double r, double limit, double roots[4]) {
    if (!isfinite(p) || !isfinite(q) || !isfinite(r) || !(limit > 0.0) || !isfinite(limit))
        return 0;
    const Polynomial quartic = {4, {r, q, p, 0.0, 1.0}};
    const Polynomial cubic = {3, {q, 2.0 * p, 0.0, 4.0, 0.0}};
    double turns[4] = {-limit, limit, 0, 0}, cuts[5];
    int turn_count = 2, cut_count = 0;
    double w = p < 0.0 ? sqrt(-p / 6.0) : 0.0;
    if (w > 0.0 && w < limit) {
        turns[1] = -w, turns[2] = w, turns[3] = limit;
        turn_count = 4;
    }
    cuts[cut_count++] = -limit;
    cut_count += roots_between(&cubic, turns, turn_count, cuts + cut_count);
    cuts[cut_count++] = limit;
    return roots_between(&quartic, cuts, cut_count, roots);
}
