// SPDX-License-Identifier: MIT
// Things that trace rays, behind one function type: sets of patches by any method, and Embree's
// triangles as single rays and as packets of 16.
#ifndef BENCH_TRACERS_H
#define BENCH_TRACERS_H

#include "base/vec.h"
#include "patch/embree.h"
#include "patch/patch.h"

// Traces count rays for their nearest hits; returns how many hit.
typedef long (*Tracer)(const void *scene, const Ray *rays, long count);

long trace_set(const void *set, const Ray *rays, long count);         // a PatchSet
long trace_set_packets(const void *set, const Ray *rays, long count); // PATCH_PACKET at once
// An EmbreeMesh; 0 without Embree.
long trace_embree(const void *mesh, const Ray *rays, long count);
long trace_embree_packets(const void *mesh, const Ray *rays, long count); // count: times 16

#endif
