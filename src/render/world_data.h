// SPDX-License-Identifier: MIT
// What a World is made of: for world_make.c, which fills it, and world.c, which traces it.
#ifndef RENDER_WORLD_DATA_H
#define RENDER_WORLD_DATA_H

#include "shape/bvh.h"
#include "render/csg.h"
#include "render/world.h"
#include "shape/shape.h"

// A definition's world moved to where the instance is.
typedef struct {
    const World *world;         // in its own space
    const Transform *transform; // NULL: it stays where it is
    double stretch;             // no length grows by more
    // Depths of its hits are off by slack[0] (|origin| + depth) + slack[1] at most for the way
    // there and back: hits that are no farther apart are in the same place.
    double slack[2];
} Instance;

// What patches, primitives and instances have in common. Leaves are numbered in the order of the
// source.
typedef struct {
    uint32_t object;
    uint32_t position;
    uint32_t rank;            // which of two hits at the same depth counts: the lower
    uint32_t mask;            // RayKind bits of the rays that see it
    uint32_t node;            // in the Csg; NO_INDEX: an unhidden patch
    uint32_t gate;            // in the Csg: what bounds it, or NO_INDEX
    bool watched;             // its hits may be hidden
    uint32_t cut;             // in the Csg: the tree whose textures it shows, or NO_INDEX
    const Box *span;          // of a poly: rays need not look for hits out of it; NULL: anywhere
    double tolerance;         // of a patch's hits, scene units
    const Instance *instance; // it is one: `object` is the instance
} Leaf;

typedef struct {
    Shape shape; // SHAPE_NONE: an instance, or (without one in leaf) all patches
    Leaf leaf;
} Prim;

struct World {
    Arena *arena;
    const Scene *scene;
    Leaf *leaves;
    uint32_t leaf_count;
    Csg csg;
    bool in_order; // POV-Ray has enough objects to look at them box by box
    // In the tree's leaf order, then those that are in no box.
    Prim *prims;
    uint32_t tree_count, prim_count;
    Bvh tree;
    // Prims with an inside that is not bounded by their box.
    uint32_t *boundless;
    Box *boundless_boxes; // hold what they contain where the trees around let it be
    uint32_t boundless_count;
    PatchSet *patches;    // that nothing hides; id: leaf position
    bool packets;         // they are faster together
    bool patches_in_tree; // one of its items is all patches; else they are asked after it
    bool exact;           // their hits carry bounds: not POV-Ray's triangles
    double size, unit;    // diameter of all patches; see world_unit()
    PatchSet *filtered;   // below a tree that may hide their hits
    bool without_uv;      // see world_without_uv()
    World **definitions;  // of the scene; their csg is this one's
    uint32_t definition_count;
    bool inner; // it is one of them
    Box bounds; // of all that can be seen
};

// A direction that camera and shading have made unit is left alone, bit for bit: its square is
// within rounding of 1.
static inline bool ray_is_unit(const Ray *ray) {
    return vec_is_finite(ray->org) && fabs(vec_dot(ray->dir, ray->dir) - 1.0) <= 0x1p-48;
}

#endif
