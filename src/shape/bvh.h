// SPDX-License-Identifier: MIT
// A tree of boxes, four children to a node, over items that only their boxes describe. Built once;
// read-only then, any number of threads. Rays walk it by bvh_walk.h.
#ifndef SHAPE_BVH_H
#define SHAPE_BVH_H

#include "base/arena.h"
#include "base/vec.h"

#include <stdint.h>

enum {
    BVH_WIDTH = 4,
    // From this depth on ranges are halved by count, 32 more levels at most; each level leaves at
    // most WIDTH - 1 nodes on the stack of those who walk.
    BVH_SAH_DEPTH = 48,
    BVH_STACK = (BVH_SAH_DEPTH + 32) * (BVH_WIDTH - 1) + 1,
};
#define BVH_LEAF 0x80000000U

// Boxes in single precision, rounded outwards; per axis all lanes together. A child is the index of
// a node, or BVH_LEAF + the place of one item in leaf order. The box of an empty lane is inside
// out.
typedef struct {
    float low[3][BVH_WIDTH], high[3][BVH_WIDTH];
    uint32_t child[BVH_WIDTH];
} BvhNode;

typedef struct {
    BvhNode *nodes; // nodes[0] is the root; none when there are no items
    uint32_t node_count;
    uint32_t *items; // leaf order -> the caller's index
    uint32_t item_count;
} Bvh;

// boxes: finite, not empty; fewer than 2^31. Nodes and items live in arena.
Bvh bvh_build(const Box *boxes, uint32_t count, Arena *arena);

// Calls visit for the items whose box holds p; ends when it returns true, and then is true.
typedef bool (*BvhVisitPoint)(void *context, uint32_t place);
bool bvh_walk_point(const Bvh *bvh, Vec3 p, BvhVisitPoint visit, void *context);

#endif
