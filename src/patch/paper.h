// SPDX-License-Identifier: MIT
// METHOD_QI_PAPER: the paper's loop (qi.h) on every patch whose box the ray meets.
#ifndef PATCH_PAPER_H
#define PATCH_PAPER_H

#include "base/arena.h"
#include "patch/query.h"

#include <stddef.h>

typedef struct Paper Paper;

// Keeps pointers into defs and its points; everything else lies in the arena.
Paper *paper_create(Arena *arena, const PatchDef *defs, size_t count);
void paper_query(const Paper *paper, Query *query);

#endif
