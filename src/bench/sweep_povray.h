// SPDX-License-Identifier: MIT
// POV-Ray's own points of a sweep: the scene with other steps, which means another text.
#ifndef BENCH_SWEEP_POVRAY_H
#define BENCH_SWEEP_POVRAY_H

#include "bench/sweep.h"

// A copy of the scene's folder in a temporary one, removed by the caller with sweep_povray_end.
typedef struct {
    char folder[64];
    const char *scene;   // its name there
    const char *version; // of POV-Ray
    // With two triangles a patch: processor time of a picture of one pixel, so of reading the
    // scene; peak of memory of a whole picture.
    double seconds, megabytes;
} SweepCopy;

// What a picture takes beyond that; used: all that it took.
typedef struct {
    double seconds, megabytes, used;
} SweepPovray;

// NULL: done; else why not.
const char *sweep_povray_begin(const SweepOptions *options, SweepCopy *copy, Arena *arena);
void sweep_povray_end(const SweepCopy *copy);

// Renders with u_steps and v_steps n and flatness 0 wherever the text gives a number or a name for
// them; on one pinned thread, not for longer than the patience beyond reading the scene, with at
// most half of the machine's memory. NULL: done; else why not.
const char *sweep_povray(const SweepOptions *options, const SweepCopy *copy, int steps,
                         SweepPovray *run, Image **picture, Arena *arena);

#endif
