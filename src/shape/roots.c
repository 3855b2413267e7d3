// SPDX-License-Identifier: MIT
// Between two neighbouring roots of the derivative a polynomial is monotonic, so a change of sign
// there brackets exactly one root; the derivative's roots are found in the same way, from the
// linear one upwards (as in Yuksel 2022). Newton's steps that leave the bracket are replaced by
// halving it: no input makes it fail or hang.
#include "shape/roots.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

double roots_value(const double *c, int n, double x) {
    double y = c[n];
    for (int i = n - 1; i >= 0; i--)
        y = y * x + c[i];
    return y;
}

double roots_bound(const double *c, int n) {
    while (n > 0 && c[n] == 0.0)
        n--;
    double high = 0.0;
    for (int i = 0; i < n; i++)
        high = fmax(high, fabs(c[i] / c[n]));
    return n > 0 ? 1.0 + high : 0.0;
}

// The root in low..high, where the polynomial changes sign; up: it is positive at high; x: a guess.
static double refine(const double *c, int n, double low, double high, bool up, double x) {
    // Halving alone takes a bracket of doubles to two neighbours in 2100 steps; Newton's steps
    // make it a handful. Ten in a row without halving the bracket are followed by a half.
    for (int step = 0; step < 2200; step++) {
        double y = c[n], slope = 0.0;
        for (int i = n - 1; i >= 0; i--) {
            slope = slope * x + y;
            y = y * x + c[i];
        }
        if (y == 0.0)
            return x;
        if ((y > 0.0) == up)
            high = x;
        else
            low = x;
        double next = x - y / slope;
        if (!(next > low && next < high) || step % 10 == 9)
            next = 0.5 * low + 0.5 * high;
        if (fabs(next - x) <= DBL_EPSILON * fabs(next) || !(next > low && next < high))
            return next;
        x = next;
    }
    return x;
}

// Roots of c (degree n) given those of its derivative.
static int between(const double *c, int n, double low, double high, const double *turns,
                   int turn_count, double *roots) {
    int count = 0;
    double from = low, at_from = roots_value(c, n, from);
    if (at_from == 0.0)
        roots[count++] = from;
    // No more than n, whatever rounding makes of the turns.
    for (int i = 0; i <= turn_count && count < n; i++) {
        double to = i < turn_count ? turns[i] : high;
        double at_to = roots_value(c, n, to);
        // A zero at `from` was counted with the interval before.
        if (at_to == 0.0 && to > from)
            roots[count++] = to;
        else if ((at_from < 0.0 && at_to > 0.0) || (at_from > 0.0 && at_to < 0.0))
            roots[count++] = refine(c, n, from, to, at_to > 0.0, 0.5 * from + 0.5 * to);
        from = to;
        at_from = at_to;
    }
    return count;
}

// The same for all degrees up to n, one after the other.
static int by_derivatives(const double *c, int n, double low, double high, double *roots) {
    double derived[ROOTS_MAX_DEGREE + 1][ROOTS_MAX_DEGREE + 1];
    double buffers[2][ROOTS_MAX_DEGREE + 1];
    // derived[k] has degree k.
    for (int i = 0; i <= n; i++)
        derived[n][i] = c[i];
    for (int k = n - 1; k >= 1; k--)
        for (int i = 0; i <= k; i++)
            derived[k][i] = derived[k + 1][i + 1] * (i + 1);
    int count = 0;
    for (int k = 1; k <= n; k++) {
        double *out = k == n ? roots : buffers[k & 1];
        count = between(derived[k], k, low, high, buffers[(k & 1) ^ 1], count, out);
    }
    return count;
}

// ---- Bernstein's form -----------------------------------------------------------------------

enum { MOST_BERNSTEIN = 6, MOST_HALVINGS = 5 };

// Returns what the coefficients in b may be off by.
static double to_bernstein(const double *c, int n, double low, double high, double *b) {
    static const double inverse_binomials[MOST_BERNSTEIN + 1][MOST_BERNSTEIN + 1] = {
        {1},
        {1, 1},
        {1, 1.0 / 2, 1},
        {1, 1.0 / 3, 1.0 / 3, 1},
        {1, 1.0 / 4, 1.0 / 6, 1.0 / 4, 1},
        {1, 1.0 / 5, 1.0 / 10, 1.0 / 10, 1.0 / 5, 1},
        {1, 1.0 / 6, 1.0 / 15, 1.0 / 20, 1.0 / 15, 1.0 / 6, 1},
    };
    double size = 0.0;
    if (low == 0.0 && high == 1.0) {
        for (int i = 0; i <= n; i++) {
            b[i] = c[i] * inverse_binomials[n][i];
            size += fabs(c[i]);
        }
    } else {
        // In the variable that runs from 0 to 1. The terms of all sums, and the polynomial itself,
        // are within that of |low| + width with its coefficients' absolute values.
        double width = high - low, reach = fabs(low) + width, power = 1.0;
        for (int i = 0; i <= n; i++)
            b[i] = c[i];
        for (int k = 0; k < n; k++)
            for (int i = n - 1; i >= k; i--)
                b[i] += low * b[i + 1];
        for (int i = 0; i <= n; i++, power *= width)
            b[i] *= power * inverse_binomials[n][i];
        for (int i = n; i >= 0; i--)
            size = size * reach + fabs(c[i]);
    }
    for (int k = 1; k <= n; k++)
        for (int i = n; i >= k; i--)
            b[i] += b[i - 1];
    // At most 2^n terms of up to `size` were added, each with up to 4 n roundings. Halvings add
    // n roundings each.
    return 0x1p-40 * size;
}

typedef struct {
    const double *c;
    int n;
    double least; // coefficients that are no larger have no known sign
    double *roots;
    int count;
} Search;

// Changes of sign along the coefficients; -1: not all signs are known. None: no root between low
// and high; one: one root (Descartes).
static int sign_changes(const Search *s, const double *b) {
    int changes = 0;
    for (int i = 0; i <= s->n; i++) {
        if (!(fabs(b[i]) > s->least))
            return -1;
        changes += i > 0 && (b[i] > 0.0) != (b[i - 1] > 0.0);
    }
    return changes;
}

// b[0] and b[n], the values at low and high, have known signs.
static void search(Search *s, double *b, double low, double high, int halvings) {
    int n = s->n, changes = sign_changes(s, b);
    if (changes == 0)
        return;
    if (changes == 1) {
        // Where the chord meets the axis, but not at an end.
        double share = fmin(fmax(b[0] / (b[0] - b[n]), 0.05), 0.95);
        double x = low + share * (high - low);
        s->roots[s->count++] = refine(s->c, n, low, high, b[n] > 0.0, x);
        return;
    }
    double left[MOST_BERNSTEIN + 1], middle = 0.5 * low + 0.5 * high;
    // De Casteljau's triangle: b becomes the right half.
    for (int k = 0; k <= n; k++) {
        left[k] = b[0];
        for (int i = 0; i < n - k; i++)
            b[i] = 0.5 * b[i] + 0.5 * b[i + 1];
    }
    if (halvings == 0 || !(fabs(b[0]) > s->least)) {
        s->count += by_derivatives(s->c, n, low, high, s->roots + s->count);
        return;
    }
    search(s, left, low, middle, halvings - 1);
    search(s, b, middle, high, halvings - 1);
}

int roots_find(const double *c, int n, double low, double high, double *roots) {
    while (n > 0 && c[n] == 0.0)
        n--;
    if (n == 0 || !(low <= high))
        return 0;
    if (n > MOST_BERNSTEIN)
        return by_derivatives(c, n, low, high, roots);
    double b[MOST_BERNSTEIN + 1];
    Search s = {.c = c, .n = n, .roots = roots};
    s.least = to_bernstein(c, n, low, high, b);
    if (!(fabs(b[0]) > s.least && fabs(b[n]) > s.least))
        return by_derivatives(c, n, low, high, roots);
    search(&s, b, low, high, MOST_HALVINGS);
    return s.count;
}
