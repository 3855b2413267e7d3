// SPDX-License-Identifier: MIT
// The crossings of a ray with one piece of a patch, found in double and certified: what the thick
// parallelograms of accel.c leave over goes through here. Private to accel.c and root.c.
#ifndef PATCH_ROOT_H
#define PATCH_ROOT_H

#include "patch/piece.h"
#include "patch/query.h"

// A ray as one patch sees it: points org + s dir about the patch's center, org being the ray's
// nearest point to it.
typedef struct {
    const AccelPatch *patch;
    Vec3 org, dir;          // |dir| = 1
    double t_base, t_per_s; // t = t_base + s t_per_s
    double error;           // rounding of a distance between ray and S, a length in scene units
} PatchRay;

void patch_ray_init(PatchRay *out, const AccelPatch *patch, const Ray *ray);

typedef struct {
    PatchHit hit;
    double error_u, error_v; // a root of the same piece farther away in u or v is another one
    int sign;                // of the Jacobian along the ray; 0: tangent or singular
} Root;

// Calls take for every crossing in rect, a part of the piece's rectangle, that lies within the
// query's limits on t as they are at the time. take may lower query->t_max; it returns false to
// end the search. Crossings outside the patch by less than its tolerance are taken too, with (u,v)
// on the patch's edge; crossings on the edge of rect may be found by the neighbour as well.
typedef bool (*RootTake)(void *context, const Root *root);
bool root_search(const PatchRay *ray, const Piece *piece, BezierRect rect, Query *query,
                 RootTake take, void *context);

#endif
