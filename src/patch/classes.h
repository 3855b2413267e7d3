// SPDX-License-Identifier: MIT
// Classes of size of METHOD_QI's patches, each with a tree of its own (piece.h). A tree holds its
// boxes in single precision of its own size: beside patches of 1e30 all patches of 1 are one point
// of it, which every ray that comes near must ask one by one.
#ifndef PATCH_CLASSES_H
#define PATCH_CLASSES_H

#include "patch/piece.h"

// Accels for all patches, one after the other by `next`, the largest patches first. Keeps pointers
// into defs and its points; everything else lies in the arena.
Accel *classes_build(Arena *arena, const PatchDef *defs, size_t count, PatchPrepare prepare);

// The same line from a point of it beside the accel's patches, to the roundings of that point: what
// the ray's own rounding is, where it comes from very far away, is more than the patches' size.
// False where even that is not known.
bool classes_near(const Accel *accel, const Ray *ray, Ray *near);

#endif
