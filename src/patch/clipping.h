// SPDX-License-Identifier: MIT
// METHOD_CLIPPING: Bézier clipping (clip.h) on the sub-patches whose boxes the ray meets.
#ifndef PATCH_CLIPPING_H
#define PATCH_CLIPPING_H

#include "base/arena.h"
#include "patch/query.h"

#include <stddef.h>

typedef struct Clipping Clipping;

// Keeps pointers into defs and its points; everything else lies in the arena.
Clipping *clipping_create(Arena *arena, const PatchDef *defs, size_t count);
void clipping_query(const Clipping *clipping, Query *query);

#endif
