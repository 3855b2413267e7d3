// SPDX-License-Identifier: MIT
// The inside of closed patches (--patch-solids; not in POV-Ray): a point is inside when a ray from
// it crosses them an odd number of times.
#ifndef RENDER_PATCH_SOLID_H
#define RENDER_PATCH_SOLID_H

#include "model/scene.h"
#include "patch/patch.h"

typedef struct PatchSolid PatchSolid;

// All patches below the tree; arena: for the record itself.
PatchSolid *patch_solid_create(const Scene *scene, const Object *tree,
                               const PatchSetOptions *options, Arena *arena);
void patch_solid_destroy(PatchSolid *solid);
Box patch_solid_bounds(const PatchSolid *solid);
uint64_t patch_solid_memory(const PatchSolid *solid);
bool patch_solid_inside(const PatchSolid *solid, Vec3 p);

#endif
