// SPDX-License-Identifier: MIT
// The scene's trees of unions, merges and intersections, as far as they decide which points count
// (facts: rendering 8). A hit of a leaf lies on the surface of the whole tree when each tree around
// it lets its point through: a merge where no other child of it contains the point, an intersection
// where all others do, a clipped object where all its clips do. So no list of hits is needed:
// every hit is judged on its own, by its point.
#ifndef RENDER_CSG_H
#define RENDER_CSG_H

#include "base/arena.h"
#include "model/scene.h"
#include "render/patch_solid.h"
#include "shape/bvh.h"
#include "shape/shape.h"

// The children of a wide tree by where their answer is not the same as almost everywhere: inside a
// child of a merge or union, outside of one of an intersection.
typedef struct {
    Bvh tree;
    uint32_t *nodes; // in its leaf order
    uint32_t *rest;  // children without such a box
    uint32_t rest_count;
} CsgWide;

typedef struct {
    const Object *object;
    const Shape *shape; // leaves, but patches
    PatchSolid *body;   // what the patches of a solid union enclose
    uint32_t parent;    // this and the next three: nodes or NO_INDEX
    uint32_t next;      // sibling, also in a list of clips
    uint32_t first, first_clip, first_bound;
    uint32_t child_count, solid_count;
    bool solid;    // some point may be inside
    Box inside;    // holds all that are
    Box outside;   // holds all that are not
    Box reach;     // holds the surface as far as the trees around let it be seen
    uint32_t gate; // the innermost node with bounds, of it and those around; NO_INDEX: none
    // The innermost node around that has a say in which points count, no plain union, and its child
    // that this one is or lies below; NO_INDEX: none.
    uint32_t judge, judged;
    bool outermost;      // it is what POV-Ray has as one object
    const CsgWide *wide; // of a tree with many children
} CsgNode;

typedef struct {
    CsgNode *nodes;
    uint32_t count;
    // Node of each object; NO_INDEX: an instance, or a patch that no tree can hide.
    uint32_t *of_object;
    ShapeShared *shared;
} Csg;

// Everything in arena. Dies when trees are nested too deeply.
Csg csg_create(const Scene *scene, const PatchSetOptions *patches, Arena *arena);
void csg_destroy(Csg *csg);          // what is not in the arena
uint64_t csg_memory(const Csg *csg); // of that, bytes
// Is there anything that could hide hits of this leaf?
bool csg_is_watched(const Csg *csg, uint32_t node);
// Does a hit of the leaf at p count, to a ray of that kind (RayKind; 0: flags hide nothing)? A
// child of a merge that is hidden from the ray hides nothing of the others.
bool csg_keeps(const Csg *csg, uint32_t node, Vec3 p, uint32_t kind);
bool csg_inside(const Csg *csg, uint32_t node, Vec3 p);
bool csg_inside_unclipped(const Csg *csg, uint32_t node, Vec3 p); // its own clips do not count
// Does the ray, of unit direction, meet all that bounds the leaves with this gate? *entry: where it
// comes into the box of POV-Ray's object, if that is one of the bounds; else -INFINITY.
bool csg_admits(const Csg *csg, uint32_t gate, const Ray *ray, double *entry);
// Could rays that meet the object within that reach miss its bounds?
bool csg_bounds_cut(const Scene *scene, const ObjectList *bounds, const Box *reach);
// Is p inside the leaf where the trees around let its inside be?
bool csg_fills(const Csg *csg, uint32_t node, Vec3 p);
// cutaway_textures: the tree whose textures a hit of the leaf shows; NO_INDEX: it has its own. And
// those textures at p, with weights that add up to 1 (to less where there are more than
// SHAPE_MAX_TEXTURES); returns how many.
uint32_t csg_cut_tree(const Csg *csg, uint32_t leaf);
uint32_t csg_cut_textures(const Csg *csg, uint32_t tree, Vec3 p,
                          ShapeTexture out[SHAPE_MAX_TEXTURES]);

#endif
