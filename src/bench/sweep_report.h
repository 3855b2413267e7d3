// SPDX-License-Identifier: MIT
// What a sweep has found, to read: a table in Markdown, CSV, JSON and a page.
#ifndef BENCH_SWEEP_REPORT_H
#define BENCH_SWEEP_REPORT_H

#include "bench/sweep.h"

#include <stdio.h>

void sweep_print(const Sweep *sweep, FILE *out); // Markdown

// Files in folder, each whole or not at all: sweep.csv and sweep.json of all scenes, index.html
// with everything inside it. Curves are drawn by gnuplot; dies when it is not installed. command:
// what made it.
void sweep_write(const Sweep *const *sweeps, size_t count, const char *folder, const char *command);

#endif
