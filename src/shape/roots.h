// SPDX-License-Identifier: MIT
// Real roots of polynomials in an interval, to the last place of their coefficients' arithmetic.
#ifndef SHAPE_ROOTS_H
#define SHAPE_ROOTS_H

enum { ROOTS_MAX_DEGREE = 36 };

// c[0] + c[1] x + ... + c[n] x^n in low..high, n <= ROOTS_MAX_DEGREE; ascending; returns how many,
// at most n.
// Where the graph crosses the axis there is a root; where it only touches it, perhaps one. Finite
// numbers in, finite numbers out.
int roots_find(const double *c, int n, double low, double high, double *roots);
double roots_value(const double *c, int n, double x);
// No root lies farther from 0 than this (Cauchy's bound); 0 for a constant.
double roots_bound(const double *c, int n);

#endif
