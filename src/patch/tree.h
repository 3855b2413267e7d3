// SPDX-License-Identifier: MIT
// A tree of boxes over anything that has a box, for rays. Nodes hold eight boxes side by side in
// single precision, one array per plane, so that a plain loop over the lanes becomes vector code.
//
// Single precision is made safe as follows. Boxes are kept in tree space, x' = (x - center) scale,
// in which the whole tree lies in [-1,1]^3 whatever the scene's size and place. A ray is first
// moved along itself, in double, to where it enters the tree, so its numbers are small too. All
// boxes are grown by TREE_PAD, which is more than every rounding of the slab test together (see
// tree_ray_begin). A ray that starts so far away that double itself is too coarse for that visits
// all leaves instead.
#ifndef PATCH_TREE_H
#define PATCH_TREE_H

#include "base/arena.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    TREE_WIDTH = 8,
    TREE_MAX_DEPTH = 64,
    TREE_STACK = TREE_MAX_DEPTH * (TREE_WIDTH - 1) + 1,
};
#define TREE_PAD 0x1p-20f
#define TREE_LEAF 0x80000000u // in child: the rest is the number of a leaf
#define TREE_NONE UINT32_MAX  // in child: nothing here

typedef struct {
    float low[3][TREE_WIDTH], high[3][TREE_WIDTH];
    uint32_t child[TREE_WIDTH];
} TreeNode;

typedef struct {
    TreeNode *nodes;
    uint32_t node_count, leaf_count;
    uint32_t *leaf_first; // leaf i holds order[leaf_first[i] .. leaf_first[i + 1]); leaf_count + 1
    uint32_t *order;      // numbers of the boxes given to tree_build
    uint32_t root;        // as a child
    Box bounds;           // of all boxes, world space
    Vec3 center;
    double scale;  // a power of two
    Vec3 half;     // half sizes of bounds in tree space, 4 TREE_PAD added
    double unused; // vectors are read as four numbers
} Tree;

// Boxes of no volume are welcome, empty boxes are not. A leaf gets at most leaf_size boxes.
// Everything is put into the arena. count may be 0.
void tree_build(Arena *arena, const Box *boxes, uint32_t count, uint32_t leaf_size, Tree *tree);

// A ray in tree space: origin + s dir, |dir| = 1, s = t s_per_t - s_base.
typedef struct {
    float start[3], inverse[3]; // origin, 1 / dir
    float s_min, s_max;
    double origin[3], dir[3];
    double error; // bound of the rounding of each coordinate of origin + s dir, |s| < 4
    double s_per_t, s_base;
    Vec3 unit; // the ray's dir by its length, zeros kept
    bool far;  // too far away for the boxes
} TreeRay;

// False: the ray meets nothing between t_min and t_max.
bool tree_ray_begin(const Tree *tree, const Ray *ray, double t_min, double t_max, TreeRay *out);

// Nothing at or beyond t matters from now on.
static inline void tree_ray_cut(TreeRay *ray, double t) {
    double s = t * ray->s_per_t - ray->s_base + (double)TREE_PAD;
    ray->s_max = (float)(s < 4.0 ? s : 4.0);
}

typedef struct {
    float near;
    uint32_t child;
} TreeEntry;

// Where the ray enters the eight boxes of a node, and whether it does.
static inline void tree_test(const TreeNode *node, const TreeRay *ray, float *near, int32_t *met) {
    const float ox = ray->start[0], oy = ray->start[1], oz = ray->start[2];
    const float ix = ray->inverse[0], iy = ray->inverse[1], iz = ray->inverse[2];
    const float s_min = ray->s_min, s_max = ray->s_max;
    const float *x0 = ix < 0.0f ? node->high[0] : node->low[0];
    const float *x1 = ix < 0.0f ? node->low[0] : node->high[0];
    const float *y0 = iy < 0.0f ? node->high[1] : node->low[1];
    const float *y1 = iy < 0.0f ? node->low[1] : node->high[1];
    const float *z0 = iz < 0.0f ? node->high[2] : node->low[2];
    const float *z1 = iz < 0.0f ? node->low[2] : node->high[2];
    for (int i = 0; i < TREE_WIDTH; i++) {
        float from = (x0[i] - ox) * ix, to = (x1[i] - ox) * ix;
        float a = (y0[i] - oy) * iy, b = (y1[i] - oy) * iy;
        from = a > from ? a : from;
        to = b < to ? b : to;
        a = (z0[i] - oz) * iz;
        b = (z1[i] - oz) * iz;
        from = a > from ? a : from;
        to = b < to ? b : to;
        from = s_min > from ? s_min : from;
        to = s_max < to ? s_max : to;
        near[i] = from;
        met[i] = from <= to;
    }
}

// Appends the children met to the stack, the farthest first.
static inline int tree_push(const TreeNode *node, const TreeRay *ray, TreeEntry *stack, int top) {
    float near[TREE_WIDTH];
    int32_t met[TREE_WIDTH];
    tree_test(node, ray, near, met);
    int base = top;
    for (int i = 0; i < TREE_WIDTH; i++) {
        if (met[i]) {
            TreeEntry entry = {near[i], node->child[i]};
            int at = top++;
            for (; at > base && stack[at - 1].near < entry.near; at--)
                stack[at] = stack[at - 1];
            stack[at] = entry;
        }
    }
    return top;
}

// Calls leaf(context, number of the leaf, ray) for every leaf whose box the ray meets, roughly from
// near to far, until it returns false. leaf may shorten the ray by tree_ray_cut.
typedef bool (*TreeVisit)(void *context, uint32_t leaf, TreeRay *ray);
static inline void tree_walk(const Tree *tree, TreeRay *ray, TreeVisit visit, void *context) {
    if (ray->far) {
        for (uint32_t leaf = 0; leaf < tree->leaf_count; leaf++) {
            if (!visit(context, leaf, ray))
                return;
        }
        return;
    }
    TreeEntry stack[TREE_STACK];
    int top = 0;
    stack[top++] = (TreeEntry){-INFINITY, tree->root};
    while (top > 0) {
        TreeEntry entry = stack[--top];
        if (entry.near > ray->s_max)
            continue;
        if (entry.child & TREE_LEAF) {
            if (!visit(context, entry.child & ~TREE_LEAF, ray))
                return;
        } else {
            top = tree_push(&tree->nodes[entry.child], ray, stack, top);
        }
    }
}

#endif
