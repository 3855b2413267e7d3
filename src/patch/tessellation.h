// SPDX-License-Identifier: MIT
// METHOD_TESSELLATION: what a user would take instead, Embree over triangles. Each patch is cut
// until its triangles are within the tolerance of it, as far as single precision and memory allow.
#ifndef PATCH_TESSELLATION_H
#define PATCH_TESSELLATION_H

#include "base/arena.h"
#include "patch/query.h"

#include <stddef.h>
#include <stdint.h>

typedef struct Tessellation Tessellation;

// Keeps pointers into defs and its points. Dies when Embree is not there. Warns when the triangles
// cannot keep to the tolerance; hits tell their true distance from the patch in any case.
Tessellation *tessellation_create(Arena *arena, const PatchDef *defs, size_t count);
void tessellation_release(Tessellation *tessellation);
uint64_t tessellation_memory(const Tessellation *tessellation); // bytes outside of the arena
void tessellation_query(const Tessellation *tessellation, Query *query);

// Cuts each way that bring the triangles of a patch to within `distance` of it.
uint32_t tessellation_cuts(const PatchDef *def, double distance);

#endif
