// SPDX-License-Identifier: MIT
// What METHOD_QI prepares: patches are cut into pieces that are nearly parallelograms, and the
// pieces lie eight to a leaf of one tree. Private to accel.c, piece.c and root.c.
//
// For a piece with local parameters (a,b) in [0,1]^2, the QI net Q (quasi.h) is split into an
// affine part and a rest, Q_ij = c + (i/du) eu + (j/dv) ev + R_ij with the box of R centred at 0.
// With e the QI bound of |S - Q|,
//     S(a,b) - c - a eu - b ev  lies in the box of half size rho = half box of R + e + rounding
// for all (a,b): a parallelogram with a thickness that holds the whole piece.
#ifndef PATCH_PIECE_H
#define PATCH_PIECE_H

#include "base/arena.h"
#include "patch/bezier.h"
#include "patch/patch.h"
#include "patch/tree.h"

#include <stddef.h>

enum { BLOCK_LANES = 8 };

// Everything local counts from the patch's center, so that its rounding is relative to the patch
// and not to its place.
typedef struct {
    const PatchDef *def;
    Vec3 center;
    const double *local; // points less center; cubic: [column][row][4], else [3][row][column]
    bool cubic;          // bi-degree (3,3)
    double rounding;     // of a coordinate of S; of its derivatives: times twice the degree
    double tolerance;    // scene units
} AccelPatch;

// How far outside its rectangle, in shares of its size, a piece's bounds still hold.
#define PIECE_MARGIN 0x1p-20

typedef struct {
    BezierRect rect;
    float muu, muv, mvv; // bounds of the lengths of the second derivatives, patch's parameters
    float suu[3], suv[3], svv[3]; // about what they are
    uint32_t patch;
} Piece;

// Eight thick parallelograms side by side, in tree units (tree.h) about the block's center.
typedef struct {
    float c[3][BLOCK_LANES], eu[3][BLOCK_LANES], ev[3][BLOCK_LANES], rho[3][BLOCK_LANES];
    double center[3];      // tree space
    double radius;         // all pieces lie in this ball about the center
    double edge;           // max |coordinate of eu, ev|
    uint32_t first, count; // lane i is pieces[first + i]
} Block;

typedef struct Accel {
    const PatchDef *defs;
    AccelPatch *patches;
    Piece *pieces;
    Block *blocks; // one per leaf of the tree
    Tree tree;
    size_t patch_count, piece_count;
} Accel;

// Cuts the patches (in parallel) and builds the tree. defs and their points must stay.
void pieces_build(Arena *arena, const PatchDef *defs, size_t count, double tolerance, Accel *accel);

// S, dS/du and dS/dv at (u,v) in [0,1]^2, about the patch's center.
void piece_eval(const AccelPatch *patch, double u, double v, Vec3 out[3]);

#endif
