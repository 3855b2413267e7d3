// SPDX-License-Identifier: MIT
// Every ray of a ray file against its patches, one line of text a ray.
#ifndef BENCH_TRACE_H
#define BENCH_TRACE_H

#include "bench/ray_file.h"
#include "patch/patch.h"

#include <stdio.h>

// Writes `t u v patch bound` of the nearest hit, or `miss`, for each ray in turn, with 17
// significant digits, so that every number reads back to the same bits. A hit within its own bound
// of the ray's origin is the surface that the ray leaves: the next one counts. The text is the same
// for any number of threads.
void trace_rays(RayFile *file, const PatchSet *set, int threads, FILE *out);

#endif
