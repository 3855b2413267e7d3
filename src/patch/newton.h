// SPDX-License-Identifier: MIT
// METHOD_NEWTON: Newton's iteration from the middles of the sub-patches whose boxes the ray meets.
#ifndef PATCH_NEWTON_H
#define PATCH_NEWTON_H

#include "base/arena.h"
#include "patch/query.h"

#include <stddef.h>

typedef struct Newton Newton;

// Keeps pointers into defs and its points; everything else lies in the arena.
Newton *newton_create(Arena *arena, const PatchDef *defs, size_t count);
void newton_query(const Newton *newton, Query *query);

#endif
