// SPDX-License-Identifier: MIT
// The accuracy study: what a sweep says about POV-Ray's triangles, as tables in Markdown.
#ifndef BENCH_STUDY_H
#define BENCH_STUDY_H

#include "bench/sweep.h"

#include <stdio.h>

// How wrong POV-Ray is at each depth and flatness, where it cracks, and what qi takes for no more
// than that error, beside what POV-Ray takes.
void study_print(const Sweep *sweep, FILE *out);

// A row a scene: what depth makes POV-Ray's error small, and what that costs it.
void study_print_all(const Sweep *const *sweeps, size_t count, FILE *out);

#endif
