// SPDX-License-Identifier: MIT
// The page of a sweep: curves, tables and maps of each scene in one self-contained HTML file.
#ifndef BENCH_SWEEP_PAGE_H
#define BENCH_SWEEP_PAGE_H

#include "bench/sweep.h"

// Whole or not at all; dies with a message when gnuplot is missing or the file cannot be written.
void sweep_page_write(const Sweep *const *sweeps, size_t count, const char *command,
                      const char *path);

#endif
