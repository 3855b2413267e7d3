// SPDX-License-Identifier: MIT
// Where triangles crack: rays through points of edges that two patches share. The surface goes on
// there, so a ray through such a point always meets it; triangles that were cut differently on
// both sides, or edges that are tested without tolerance, let some of the rays through.
#ifndef BENCH_EDGES_H
#define BENCH_EDGES_H

#include "base/arena.h"
#include "model/scene.h"
#include "patch/patch.h"

#include <stddef.h>

typedef struct {
    size_t edges; // shared ones, where both surfaces have one tangent plane
    size_t count; // of rays
    Ray *rays;    // from a quarter of the patch's diameter before the point: t = 1 there
} EdgeRays;

// About `most` rays, seeded; fewer edges get more rays each. Both sides, up to 45 degrees off the
// normal; every second one at a quarter of an edge, where triangles have their corners. Edges are
// shared when their control points agree within 1e-9 of the patch's diameter, smooth when the
// normals at the point are less than 10 degrees apart. Memory in arena.
EdgeRays edges_find(const Scene *scene, size_t most, Arena *arena);

// How many of the rays meet nothing within a quarter of the diameter of the point.
size_t edges_leaks(const EdgeRays *rays, const PatchSet *set);

#endif
