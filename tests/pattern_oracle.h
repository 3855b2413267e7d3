// SPDX-License-Identifier: MIT
// For tests of patterns: POV-Ray evaluates functions at many points and prints all digits.
#ifndef TESTS_PATTERN_ORACLE_H
#define TESTS_PATTERN_ORACLE_H

#include "base/arena.h"
#include "base/vec.h"

typedef struct Oracle Oracle;

enum { ORACLE_POINTS = 150 };
// Dyadic, decimal, whole, far, tiny and negative coordinates.
Vec3 oracle_point(int i);

// A script that begins with those lines. Everything lives until oracle_finish().
Oracle *oracle_create(const char *head);
Arena *oracle_arena(Oracle *oracle);
// Asks for "function { ... }" at all points; after is put behind each call (".red").
void oracle_function(Oracle *oracle, const char *function, const char *after);
// The answers in the order of asking. Leaves the test as skipped when there is no povray.
const double *oracle_run(Oracle *oracle);
// Counts, and prints the first, values that are not the same double (a NaN for a NaN is).
void oracle_equal(Oracle *oracle, double have, double want, const char *what, int point);
// The test has failed if any value differed.
void oracle_finish(Oracle *oracle);

#endif
