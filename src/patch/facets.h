// SPDX-License-Identifier: MIT
// METHOD_FACETS: the triangles that POV-Ray 3.7 makes of a patch, found by the same arithmetic, so
// that a picture can be equal to POV-Ray's bit for bit.
#ifndef PATCH_FACETS_H
#define PATCH_FACETS_H

#include "base/arena.h"
#include "patch/query.h"

#include <stddef.h>

typedef struct Facets Facets;

// Keeps pointers into defs and its points; everything else lies in the arena.
Facets *facets_create(Arena *arena, const PatchDef *defs, size_t count);
// Equal depths: of one patch the triangle later in POV-Ray's order wins, of two patches the earlier
// patch.
void facets_query(const Facets *facets, Query *query);

#endif
