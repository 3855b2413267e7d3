// SPDX-License-Identifier: MIT
// One point of a sweep, measured in a process of its own: its peak of memory and its processor time
// are nobody else's, and one that hangs can be given up.
#ifndef BENCH_SWEEP_CHILD_H
#define BENCH_SWEEP_CHILD_H

#include "base/color.h"
#include "base/vec.h"
#include "bench/sweep.h"
#include "model/scene.h"

// What a ray through the middle of a pixel met.
typedef struct {
    double t;        // infinite: nothing
    Vec3 normal;     // of unit length
    uint32_t object; // NO_INDEX: nothing
    uint32_t leaves, steps, newton;
} SweepLook;

// Memory that parent and child share: a header, then looks and pixels.
typedef struct {
    bool done;
    double prepare, trace, picture; // seconds
    double megabytes;
    SweepLook *looks; // width x height
    float *pixels;    // three channels, as in a file of 16 bits
} SweepShared;

SweepShared *sweep_shared_create(int width, int height);
void sweep_shared_destroy(SweepShared *shared, int width, int height);

// Measures. NULL: it went well, else why it did not ("more than 60 s", ...). scene's patches get
// the steps of the point while it lasts.
const char *sweep_measure(Scene *scene, const SweepOptions *options, const SweepPoint *point,
                          SweepShared *shared);

#endif
