// SPDX-License-Identifier: MIT
// Random programs that print the values of random expressions and functions with #debug, in lines
// that begin with '@' and the number of the case.
#ifndef TESTS_RANDOM_EXPRESSION_H
#define TESTS_RANDOM_EXPRESSION_H

#include "base/rng.h"

#include <stdio.h>

// Expressions of 1 to 5 components, each component with 17 digits.
void random_expressions(FILE *out, Rng *rng, int count);
// Bodies of user functions, each called twice. Of operators, calls, sums, products, other
// functions, transforms and splines; without what is an error (a division by a constant 0).
void random_functions(FILE *out, Rng *rng, int count);

#endif
