// SPDX-License-Identifier: MIT
// The crossings of a ray with one piece of a patch, found in double and certified: what the thick
// parallelograms of accel.c leave over goes through here. Private to accel.c and the kernels.
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

// dir: the ray's, of unit length; t_per_s: 1 / length of the ray's own dir.
static inline void patch_ray_init(PatchRay *out, const AccelPatch *patch, const Ray *ray, Vec3 dir,
                                  double t_per_s) {
    Vec3 away = vec_sub(ray->org, patch->center);
    double shift = -vec_dot(away, dir);
    *out = (PatchRay){patch, vec_madd(away, shift, dir), dir, shift * t_per_s, t_per_s, 0.0};
    // With w = 2^-53 and A the distance to the center: org less center 1 w A in each coordinate,
    // the shift times dir 5 w A (dir and its length carry 4 w), the sum 1 w A, in length 12 w A;
    // t_base + s t_per_s 8 w A. S: its rounding in each coordinate, below twice that in length; the
    // parameters' rounding and dir's over the patch's own size, below twice that again.
    double size = fabs(away.x) + fabs(away.y) + fabs(away.z);
    out->error = 24.0 * 0x1p-53 * size + 4.0 * patch->rounding;
}

// Is the whole patch farther from the ray than the tolerance or rounding may make up for? So that
// it takes nothing away from what is found. FRAME_LEAST is for lengths whose squares underflow.
static inline bool patch_ray_misses(const PatchRay *ray) {
    const AccelPatch *patch = ray->patch;
    double reach =
        patch->radius * (1.0 + 0x1p-48) + patch->tolerance + 4.0 * ray->error + FRAME_LEAST;
    return vec_dot(ray->org, ray->org) > reach * reach;
}

typedef struct {
    PatchHit hit;
    double error_u, error_v; // a root of the same piece farther away in u or v is another one
    int sign;                // of the Jacobian along the ray; 0: tangent or singular
} Root;

// How far apart two values for one root may be, given the distance between ray and surface, from
// m1 = dir x Sv, m2 = Su x dir, det = Su . m1. Sets the sign too.
static inline void root_set_errors(Root *root, Vec3 m1, Vec3 m2, double det) {
    double steep = fabs(det);
    root->sign = det > 0.0 ? 1 : -1;
    root->error_u = 2.0 * root->hit.bound * vec_length(m1) / steep;
    root->error_v = 2.0 * root->hit.bound * vec_length(m2) / steep;
}

#endif
