// SPDX-License-Identifier: MIT
// Roots by pieces: between two neighbouring zeros of its derivative a polynomial is monotone, so a
// sign change there is one root, and Newton's steps kept inside the bracket find it. Two levels:
// the cubic 4 t^3 + 2 p t + q is monotone between -w and w, where 6 w^2 = -p, and outside; its
// zeros cut the quartic. No formula with nested radicals, hence no loss at double roots.
#include "shape/quartic.h"

#include <math.h>
#include <stdbool.h>

// t^4 + p t^2 + q t + r, or its derivative.
typedef struct {
    bool derived;
    double p, q, r;
} Polynomial;

static inline double value_at(const Polynomial *f, double t, double *slope) {
    double square = t * t;
    if (f->derived) {
        *slope = 12.0 * square + 2.0 * f->p;
        return (4.0 * square + 2.0 * f->p) * t + f->q;
    }
    *slope = (4.0 * square + 2.0 * f->p) * t + f->q;
    return ((square + f->p) * t + f->q) * t + f->r;
}

// A place near the root in [low, high]. If one end, `turn`, is where f turns, f is nearly a
// parabola there, and its zero lies mostly beyond the root, where Newton's steps do not leave the
// bracket.
static inline double root_guess(const Polynomial *f, double low, double high, double turn) {
    double unused, middle = 0.5 * (low + high);
    if (turn != low && turn != high)
        return middle;
    double bend = f->derived ? 24.0 * turn : 12.0 * turn * turn + 2.0 * f->p;
    double square = -2.0 * value_at(f, turn, &unused) / bend;
    double guess = turn == low ? low + sqrt(square) : high - sqrt(square);
    return guess > low && guess < high ? guess : middle;
}

// The root in [low, high], where f is monotone and rises when `rising`, and changes its sign. Of
// the derivative half the digits will do: a step that is so small is squared by the next, and the
// quartic hardly changes around such a place.
static inline double bracketed_root(const Polynomial *f, double low, double high, bool rising,
                                    double t) {
    double close = f->derived ? 0x1p-26 : 0x1p-52;
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
        if (next == t || fabs(next - t) <= close * fabs(t) || next <= low || next >= high) {
            t = next;
            break;
        }
        t = next;
    }
    return t;
}

// Between the cuts i - 1 and i: all but the first and the last are where f turns.
static inline double guess_between(const Polynomial *f, const double *cuts, int count, int i) {
    double turn = NAN;
    if (count > 2 && i == 1)
        turn = cuts[1];
    else if (count > 2 && i == count - 1)
        turn = cuts[i - 1];
    return root_guess(f, cuts[i - 1], cuts[i], turn);
}

// All sign changes of f between consecutive cuts (ascending).
static inline int roots_between(const Polynomial *f, const double *cuts, int cut_count,
                                double *roots) {
    int count = 0;
    double unused, before = value_at(f, cuts[0], &unused);
    for (int i = 1; i < cut_count; i++) {
        double after = value_at(f, cuts[i], &unused);
        // Zero counts as positive on both sides, so that no root is seen twice; what only touches
        // zero from above is none.
        if ((before < 0.0) != (after < 0.0))
            roots[count++] = bracketed_root(f, cuts[i - 1], cuts[i], before < 0.0,
                                            guess_between(f, cuts, cut_count, i));
        before = after;
    }
    return count;
}

// Is the quartic positive everywhere? It is (t^2 - a)^2 + (p + 2 a) t^2 + q t + r - a^2 for every
// a; the quadratic is positive if q^2 < 4 (p + 2 a) (r - a^2), and the a at which the right side is
// largest decides. What is lost in rounding counts against it.
static bool is_positive(double p, double q, double r) {
    double root = p * p + 12.0 * r;
    if (!(root >= 0.0))
        return false;
    double a = (sqrt(root) - p) / 6.0, rest = r - a * a - 1e-12 * (fabs(r) + a * a);
    double lead = p + 2.0 * a - 1e-12 * (fabs(p) + 2.0 * fabs(a));
    return lead > 0.0 && rest > 0.0 && q * q < 4.0 * lead * rest;
}

int quartic_roots(double p, double q, double r, double limit, double roots[4]) {
    if (!isfinite(p) || !isfinite(q) || !isfinite(r) || !(limit > 0.0) || !isfinite(limit))
        return 0;
    if (is_positive(p, q, r))
        return 0;
    const Polynomial quartic = {false, p, q, r}, cubic = {true, p, q, r};
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
