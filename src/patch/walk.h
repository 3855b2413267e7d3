// SPDX-License-Identifier: MIT
// One question on its way through the tree of METHOD_QI: what accel.c and the kernels share.
#ifndef PATCH_WALK_H
#define PATCH_WALK_H

#include "patch/piece.h"
#include "patch/query.h"
#include "patch/root.h"

enum { WALK_SEEN = 64 };

// A hit reported to QUERY_ALL, kept to know it again.
typedef struct {
    uint32_t patch;
    double t, u, v, error_t, error_u, error_v;
    int sign;
} WalkSeen;

typedef struct {
    const Accel *accel;
    Query *query;
    Vec3 dir;       // of unit length
    double t_per_s; // 1 / length of the ray's own
    uint32_t patch; // ray is set up for this one; UINT32_MAX: for none
    uint32_t piece; // being searched
    PatchRay ray;
    uint32_t best_patch, best_piece; // where query->best comes from
    uint64_t seen_count;
    WalkSeen seen[WALK_SEEN]; // the last ones, a ring
} Walk;

// Takes a crossing found in walk->piece; false to end the walk. Of hits in the same place the one
// of the first patch is kept, whatever the order they are found in.
bool walk_take(Walk *walk, const Root *root);

#endif
