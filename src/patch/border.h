// SPDX-License-Identifier: MIT
// How far from its border a patch may be hit, so that neighbours stay closed. Private to piece.c.
//
// A patch ends where it ends: a ray beside it is let through. But neighbours that share an edge may
// have their points computed apart (by numerical derivatives, say, or in single precision), and
// then there is a gap as wide as their control points of that edge differ, the curves being means
// of those. So where two sides are the same up to the tolerance, both patches may be hit as far
// outside as those points differ; where they are the same to the last bit, or nobody is there, not
// at all but for rounding. Patches of other bi-degrees or halves of a side are not known as
// neighbours: of their points only the rounding is allowed for.
#ifndef PATCH_BORDER_H
#define PATCH_BORDER_H

#include "patch/piece.h"

// Sets the border of each patch.
void borders_find(AccelPatch *patches, size_t count);

#endif
