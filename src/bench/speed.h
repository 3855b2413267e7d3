// SPDX-License-Identifier: MIT
// The measurements behind README's tables of speed. Each prints one table in Markdown. What is
// compared is measured in turn, in rounds, in this process; the median of the rounds is shown.
// Times are processor time of the process, but where threads are compared: there the clock's.
#ifndef BENCH_SPEED_H
#define BENCH_SPEED_H

#include "bench/views.h"

typedef struct {
    int rounds;         // odd
    double share;       // of the rays of each view, for a quick look; 1: all
    int view;           // a View, or -1: all
    int method;         // a PatchMethod, or -1: all
    double tolerance;   // or 0: 1e-3, 1e-6, 1e-9, 1e-12
    size_t max_patches; // of the lattices
    int prepare;        // a PatchPrepare: of qi
} SpeedOptions;

SpeedOptions speed_options_default(void);

// Nearest hits of single rays by methods and tolerances, beside Embree's triangles.
void speed_methods(const SpeedOptions *options);
// From the patches to a traced picture at an error, and the memory held then, beside Embree's
// triangles cut as finely as that error needs.
void speed_picture(const SpeedOptions *options);
// Lattices of 32 to 1,000,000 patches.
void speed_lattices(const SpeedOptions *options);
// Two threads beside one.
void speed_threads(const SpeedOptions *options);

#endif
