// SPDX-License-Identifier: MIT
// Rays that `make stress` found, at bicubic patches: what the tests of them share.
#ifndef TESTS_FOUND_RAY_H
#define TESTS_FOUND_RAY_H

#include "patch/patch.h"

typedef struct {
    const char *before; // what came out
    Vec3 points[16];
    Ray ray;
} Found;

// points must stay.
static inline PatchDef def_of(const Vec3 points[16]) {
    return (PatchDef){.degree_u = 3, .degree_v = 3, .points = points, .mask = UINT32_MAX};
}

// A committed set of one patch; the caller destroys it.
static inline PatchSet *set_of(const PatchDef *def) {
    PatchSetOptions options = patchset_options_default();
    PatchSet *set = patchset_create(&options);
    patchset_add(set, def);
    patchset_commit(set);
    return set;
}

// A sink; count: an int.
static inline void count_hit(void *count, const PatchHit *hit) {
    (void)hit;
    ++*(int *)count;
}

#endif
