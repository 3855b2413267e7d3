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

// The root in low..high, where the polynomial changes sign; up: it is positive at high.
static double refine(const double *c, int n, double low, double high, bool up) {
    // Halving alone takes a bracket of doubles to two neighbours in 2100 steps; Newton's steps
    // make it a handful. Ten in a row without halving the bracket are followed by a half.
    double x = 0.5 * low + 0.5 * high;
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
            roots[count++] = refine(c, n, from, to, at_to > 0.0);
        from = to;
        at_from = at_to;
    }
    return count;
}

// In Bernstein's form between low and high a polynomial lies between its least and largest
// coefficient: of one sign, it has no root there. Few of those that are asked about have one.
static bool has_none(const double *c, int n, double low, double high) {
    static const double inverse_binomials[7][7] = {
        {1},
        {1, 1},
        {1, 1.0 / 2, 1},
        {1, 1.0 / 3, 1.0 / 3, 1},
        {1, 1.0 / 4, 1.0 / 6, 1.0 / 4, 1},
        {1, 1.0 / 5, 1.0 / 10, 1.0 / 10, 1.0 / 5, 1},
        {1, 1.0 / 6, 1.0 / 15, 1.0 / 20, 1.0 / 15, 1.0 / 6, 1},
    };
    double b[7] = {0}, size = 0.0;
    if (n > 6)
        return false;
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
    // At most 2^n terms of up to `size` were added, each with up to 4 n roundings.
    double least = 0x1p-40 * size, lowest = b[0], highest = b[0];
    for (int i = 1; i <= n; i++) {
        lowest = b[i] < lowest ? b[i] : lowest;
        highest = b[i] > highest ? b[i] : highest;
    }
    return lowest > least || highest < -least;
}

int roots_find(const double *c, int n, double low, double high, double *roots) {
    double derived[ROOTS_MAX_DEGREE + 1][ROOTS_MAX_DEGREE + 1];
    double buffers[2][ROOTS_MAX_DEGREE + 1];
    while (n > 0 && c[n] == 0.0)
        n--;
    if (n == 0 || !(low <= high))
        return 0;
    if (has_none(c, n, low, high))
        return 0;
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
