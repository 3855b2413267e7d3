// SPDX-License-Identifier: MIT
// For tests of patterns: POV-Ray evaluates functions at many points and prints all digits.
#ifndef TESTS_DIGITS_H
#define TESTS_DIGITS_H

#include "base/arena.h"
#include "base/vec.h"

typedef struct Digits Digits;

enum { DIGITS_POINTS = 150 };
// Dyadic, decimal, whole, far, tiny and negative coordinates.
Vec3 digits_point(int i);

// A script that begins with those lines. Everything lives until digits_finish().
Digits *digits_create(const char *head);
// Asks for "function { ... }" at all points; after is put behind each call (".red").
void digits_function(Digits *digits, const char *function, const char *after);
// The answers in the order of asking. Leaves the test as skipped when there is no povray.
const double *digits_run(Digits *digits);
// Counts, and prints the first, values that are not the same double (a NaN for a NaN is).
void digits_equal(Digits *digits, double have, double want, const char *what, int point);
// The test has failed if any value differed.
void digits_finish(Digits *digits);

#endif
