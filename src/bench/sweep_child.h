// SPDX-License-Identifier: MIT
// One point of a sweep, measured in a process of its own: its peak of memory and its processor time
// are nobody else's, and one that hangs can be given up.
#ifndef BENCH_SWEEP_CHILD_H
#define BENCH_SWEEP_CHILD_H

#include "base/color.h"
#include "base/vec.h"
#include "bench/edges.h"
#include "bench/sweep.h"
#include "model/scene.h"

// The ray through the middle of a pixel, and what it met.
typedef struct {
    Vec3 dir;
    double t;        // infinite: nothing
    Vec3 normal;     // of unit length
    uint32_t object; // NO_INDEX: nothing
    uint32_t leaves, steps, newton;
} SweepLook;

// Memory that parent and child share: a header, then looks and pixels.
typedef struct {
    bool done;
    double used;                    // seconds of processor time, all of the process
    double prepare, trace, picture; // seconds
    double megabytes;
    size_t leaks;     // of the rays through edges
    SweepLook *looks; // width x height
    float *pixels;    // three channels, as in a file of 16 bits
} SweepShared;

SweepShared *sweep_shared_create(int width, int height);
void sweep_shared_destroy(SweepShared *shared, int width, int height);

// Measures. NULL: it went well, else why it did not ("too slow", ...). scene's patches get the
// steps of the point. edges: rays to count leaks of; NULL: none.
const char *sweep_measure(Scene *scene, const SweepOptions *options, const SweepPoint *point,
                          const EdgeRays *edges, SweepShared *shared);

#endif
