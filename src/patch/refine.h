// SPDX-License-Identifier: MIT
// What METHOD_CLIPPING and METHOD_NEWTON prepare: patches are refined into sub-patches, whose boxes
// lie in one tree (Sweeney and Bartels 1986; Martin, Cohen, Fish and Shirley 2000). A sub-patch
// keeps its own control net. And what both do with a hit.
//
// All that is local counts from the patch's center, in units that make the patch about as large as
// 1 (a power of two, so that no bit changes): no product leaves the range of numbers, and rounding
// is relative to the patch and not to its place.
#ifndef PATCH_REFINE_H
#define PATCH_REFINE_H

#include "base/arena.h"
#include "patch/bezier.h"
#include "patch/query.h"
#include "patch/tree.h"

#include <stddef.h>

typedef struct {
    const PatchDef *def;
    Vec3 center;     // scene units
    double scale;    // local units = scene units * scale
    double rounding; // of a coordinate of S; local units, as the next
    double tolerance;
} RefinePatch;

typedef struct {
    uint32_t patch;
    BezierRect rect;
    // Coordinate by coordinate, each row by row: x.. y.. z..; of a rational patch times the
    // weights, and then the weights, the largest of them 1.
    const double *net;
    double least_weight; // 1 for a polynomial patch
} SubPatch;

typedef struct {
    RefinePatch *patches;
    SubPatch *subs; // leaf i of the tree is subs[i]
    Tree tree;
} Refined;

// Cuts each patch until the net of a sub-patch is flat to within `share` of its size, in parallel;
// at most about a million sub-patches in all. Keeps pointers into defs.
void refine_build(Arena *arena, const PatchDef *defs, size_t count, double share, Refined *out);

// A ray as one patch sees it, in its units: points org + s dir about the patch's center, org being
// the ray's nearest point to it, t = t_base + s t_per_s; and two directions across it (Efremov,
// Havran and Seidel 2005: of unit length and at right angles, so that distances keep their
// meaning).
typedef struct {
    const RefinePatch *patch;
    Vec3 org, dir, e1, e2;
    double t_base, t_per_s;
    double error;     // rounding of a distance between ray and S
    double tolerance; // the patch's, or what rounding leaves of it
} RefineRay;

enum { REFINE_SEEN = 64 };

// A walk of one query through the tree.
typedef struct {
    const Refined *refined;
    Query *query;
    Vec3 dir, e1, e2;
    double t_per_s;
    uint32_t patch; // ray is set up for this one
    RefineRay ray;
    struct {
        uint32_t patch;
        double t, u, v, reach_t, reach_u, reach_v;
    } seen[REFINE_SEEN]; // hits reported to QUERY_ALL: one root can be met by two sub-patches
    uint64_t seen_count;
    int work; // clips so far
} RefineWalk;

// Calls search for each sub-patch whose box the ray meets, from near to far, until query_done().
typedef void (*RefineSearch)(RefineWalk *walk, const SubPatch *sub);
void refine_query(const Refined *refined, Query *query, RefineSearch search);

// S(u,v) of the sub-patch (u and v its own, in [0,1]) is within the tolerance of the ray: reports
// it with its true bound, if its t is in range and it was not reported before.
void refine_report(RefineWalk *walk, const SubPatch *sub, double u, double v);

// A hit found otherwise; u and v are the patch's own.
void refine_take(RefineWalk *walk, const PatchHit *hit);

#endif
