// SPDX-License-Identifier: MIT
// METHOD_QI: rays against all patches of a set by thick parallelograms (piece.h) and certified
// Newton steps (root.h), with qi_reduce_* (qi.h) where nothing less is certain.
#ifndef PATCH_ACCEL_H
#define PATCH_ACCEL_H

#include "base/arena.h"
#include "patch/query.h"

#include <stddef.h>

typedef struct Accel Accel;

// Keeps pointers into defs and its points; everything else lies in the arena.
Accel *accel_create(Arena *arena, const PatchDef *defs, size_t count, PatchPrepare prepare);
void accel_query(const Accel *accel, Query *query);

#endif
