// SPDX-License-Identifier: MIT
// Real roots of t^4 + p t^2 + q t + r in an interval.
#ifndef SHAPE_QUARTIC_H
#define SHAPE_QUARTIC_H

// Finds the sign changes of the depressed quartic in [-limit, limit], ascending, each as exact as
// the polynomial can be evaluated; the two roots of a graze without a sign change are none. Returns
// their number, 0..4. Not finite: 0.
int quartic_roots(double p, double q, double r, double limit, double roots[4]);

#endif
