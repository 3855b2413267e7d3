// SPDX-License-Identifier: MIT
// `make stress`: rays over all cases of stress_cases.h, judged by stress_judge.h, as a table for
// each method.
#ifndef TESTS_STRESS_H
#define TESTS_STRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    uint64_t seed;
    double rays;       // over all cases but the watertight ones, for the method qi
    double watertight; // over those at closed edges
    const char *only_case, *only_method; // NULL: all
    int64_t scene, ray;                  // >= 0: this one alone, told in full
    bool times;                          // judge the times too
} StressOptions;

StressOptions stress_options_default(void);
// Prints the tables. Returns the number of failures of the method qi.
uint64_t stress_run(const StressOptions *options);

#endif
