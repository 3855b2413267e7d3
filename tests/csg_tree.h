// SPDX-License-Identifier: MIT
// Random trees of solids and patches, as POV-Ray's text and as data for the oracle. All numbers are
// decimals that both read as the same double.
#ifndef TESTS_CSG_TREE_H
#define TESTS_CSG_TREE_H

#include "base/arena.h"
#include "base/rng.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stdio.h>

typedef enum {
    TREE_SPHERE,   // center, radius
    TREE_BOX,      // two corners
    TREE_CYLINDER, // this and the next: base, apex, two radii
    TREE_CONE,
    TREE_TORUS, // two radii
    TREE_PLANE, // normal, distance
    TREE_PATCH, // 16 points
    TREE_UNION, // from here on: trees
    TREE_MERGE,
    TREE_INTERSECTION,
    TREE_DIFFERENCE,
} TreeKind;

typedef struct CsgTree {
    TreeKind kind;
    double numbers[48];
    bool open;                     // of a cylinder or cone
    Vec3 rotate, scale, translate; // in this order
    bool inverse;                  // written behind them
    bool textured;
    double color[4];                // r g b, and what is let through
    struct CsgTree *first, *next;   // children
    struct CsgTree *clips, *bounds; // lists; moved with the object
} CsgTree;

// A tree whose deepest branch has so many unions, merges and so on inside one another. bounded:
// parts of it have bounds, also such as cut; and patches have clips.
CsgTree *csg_tree_random(Rng *rng, Arena *arena, int depth, bool bounded);
void csg_tree_write(const CsgTree *tree, FILE *file);

#endif
