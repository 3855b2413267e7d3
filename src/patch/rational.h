// SPDX-License-Identifier: MIT
// Rational Bézier patches: S(u,v) = N / W, N = sum B_i B_j w_ij P_ij, W = sum B_i B_j w_ij, with
// positive weights, so that S lies in the hull of the P_ij. And METHOD_QI on sets of them.
#ifndef PATCH_RATIONAL_H
#define PATCH_RATIONAL_H

#include "base/arena.h"
#include "patch/bezier.h"
#include "patch/query.h"

#include <stddef.h>

// S, dS/du and dS/dv at (u,v) in [0,1]^2. weights NULL: the patch is polynomial.
void rational_eval(const Bezier *patch, const double *weights, double u, double v, Vec3 out[3]);

// As bezier_normal().
Vec3 rational_normal(const Bezier *patch, const double *weights, double u, double v, Vec3 facing);

typedef struct Rational Rational;

// qi_reduce_* on sub-patches (refine.h). Keeps pointers into defs; everything else lies in the
// arena.
Rational *rational_create(Arena *arena, const PatchDef *defs, size_t count);
void rational_query(const Rational *rational, Query *query);

#endif
