// SPDX-License-Identifier: MIT
// All crossings of a ray with one patch, in long double by plain bisection: slow, and nothing in
// common with the methods under test. Its tolerances scale with the patch as the ray sees it, so it
// judges the extremes too (tiny, far away, thin, grazing).
#ifndef TESTS_RAY_ORACLE_H
#define TESTS_RAY_ORACLE_H

#include "patch/patch.h"

enum { RAY_ORACLE_ROOTS = 64 };

typedef struct {
    double t, u, v;
    double sine; // of the angle between ray and surface, 0: grazing
} RayOracleRoot;

typedef struct {
    int count;
    bool doubtful; // tangent or singular, on the patch's edge, or at the end of the range
    RayOracleRoot root[RAY_ORACLE_ROOTS];
} RayOracle;

// Adds the roots with t_min <= t < t_max.
void ray_oracle(RayOracle *oracle, const PatchDef *def, const Ray *ray, double t_min, double t_max);
// |org + t dir - S(u,v)|, rounded once.
double ray_oracle_residual(const PatchDef *def, const Ray *ray, double t, double u, double v);
// S and its derivatives.
void ray_oracle_jet(const PatchDef *def, double u, double v, Vec3 out[3]);

#endif
