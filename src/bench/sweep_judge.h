// SPDX-License-Identifier: MIT
// How far a point of a sweep is from the truth: its hits, its picture.
#ifndef BENCH_SWEEP_JUDGE_H
#define BENCH_SWEEP_JUDGE_H

#include "bench/sweep.h"
#include "bench/sweep_child.h"
#include "render/footprint.h"

typedef struct {
    const SweepOptions *options;
    const SweepShared *truth;
    Footprint footprint;
    double *diameter; // of each object's patch, 0: no patch
    Image *truth_picture;
    EdgeRays edges;
} Judge;

double *judge_diameters(const Scene *scene, Arena *arena);
// The picture that a process left.
Image *judge_image(const SweepShared *shared, const SweepOptions *options, Arena *arena);

// Fill what of the result has to do with hits, and with the picture. shared: the hits of the
// picture's own camera rays; NULL: not known.
void judge_hits(const Judge *judge, const SweepShared *shared, SweepResult *result);
void judge_picture(const Judge *judge, const SweepShared *shared, const Image *picture,
                   SweepResult *result);

// The maps of the sweep: facets against the truth, and the work of the truth.
void judge_maps(const Judge *judge, const SweepShared *facets, Sweep *sweep, Arena *arena);

#endif
