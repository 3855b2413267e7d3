// SPDX-License-Identifier: MIT
// What ray_oracle.c prepares once for many rays: each patch cut into leaves, their control points
// in double, boxes about them and one tree of these over all patches. A ray then looks only at
// leaves whose boxes it meets. Nothing is lost by it: boxes are rounded outwards.
#ifndef TESTS_RAY_ORACLE_SET_H
#define TESTS_RAY_ORACLE_SET_H

#include "ray_oracle.h"

typedef long double Real;

enum { ORACLE_SIDE = 17, ORACLE_POINTS = ORACLE_SIDE * ORACLE_SIDE };

// Control points of [u, u + wu] x [v, v + wv], times the weights: less the patch's corner and
// scaled, at most 1 in size. They err by ORACLE_NET_ERROR (6 halvings of degree 4 or 4 of degree
// 16, of one rounding to 64 bits a degree, and 3 more) and 2^-53 of their size.
typedef struct {
    double u, v, wu, wv;
    double most[3], most_weight; // of the sizes in net
    double *net;                 // x, y, z, weights: each of all points, row by row
} OracleLeaf;
#define ORACLE_NET_ERROR 0x1p-57

typedef struct {
    const PatchDef *def;
    Vec3 corner;
    long double scale, inverse; // powers of two: a point is corner + scale x net / weight
} OraclePatch;

// Of four boxes; the rays' side of them is outside.
typedef struct {
    double low[3][4], high[3][4];
    int32_t child[4]; // a node; less than 0: leaf ~child; ORACLE_NOTHING
    int32_t patch;    // of the leaves below; -1: several
} OracleNode;
#define ORACLE_NOTHING INT32_MAX

struct RayOracleSet {
    const PatchDef *defs;
    int count, node_count, leaf_count;
    int32_t root;
    OraclePatch *patches;
    OracleNode *nodes;
    OracleLeaf *leaves;
};

// A point of the patch less `from`, and its derivatives (s[axis][1] along u, [2] along v) if asked
// for.
void oracle_jet_less(const PatchDef *def, Vec3 from, Real u, Real v, bool slopes, Real s[3][3]);

// A line of n + 1 control points, `step` apart, cut in half: the first half stays in `low`.
static inline void oracle_halve_line(Real *low, Real *high, int n, int step) {
    Real row[ORACLE_SIDE];
    for (int i = 0; i <= n; i++)
        row[i] = low[i * step];
    for (int k = 0; k <= n; k++) {
        low[k * step] = row[0];
        high[(n - k) * step] = row[n - k];
        for (int i = 0; i < n - k; i++)
            row[i] = 0.5L * (row[i] + row[i + 1]);
    }
}

// One patch as a single leaf, without boxes: the memory is the caller's (net: 4 x ORACLE_POINTS).
void oracle_patch_whole(const PatchDef *def, OraclePatch *patch, OracleLeaf *leaf, double *net);

// The leaves whose boxes come within `reach` of the ray at depths t0..t1, patch by patch.
typedef struct {
    const RayOracleSet *set;
    double org[3], inverse[3], reach, t0, t1; // of the ray with its direction scaled
    int way[3];
    int top;
    int32_t stack[160]; // node, patch
} OracleWalk;
void oracle_walk_begin(OracleWalk *walk, const RayOracleSet *set, const Ray *ray, double t0,
                       double t1, double reach);
bool oracle_walk_next(OracleWalk *walk, int *patch, const OracleLeaf **leaf);

#endif
