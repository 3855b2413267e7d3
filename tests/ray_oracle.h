// SPDX-License-Identifier: MIT
// All crossings of a ray with patches, by exact subdivision: nothing in common with the methods
// under test, and certified. Each step bounds its own rounding; what double with that bound can't
// tell is done again with 106 bits and in __float128 (113 bits) when the caller asks for it. So the
// answer does not depend on any tolerance, and judges the extremes too (tiny, far away, thin,
// grazing).
#ifndef TESTS_RAY_ORACLE_H
#define TESTS_RAY_ORACLE_H

#include "base/arena.h"
#include "patch/patch.h"

enum { RAY_ORACLE_ROOTS = 64 };

typedef enum {
    ROOT_CERTAIN, // a single crossing, proved, and inside the patch or on its edge
    ROOT_BORDER,  // proved, but it may lie just inside or just outside
    ROOT_OPEN, // there may be any number of crossings here: tangent, singular, or infinitely many
} RayOracleKind;

typedef struct {
    RayOracleKind kind;
    int patch; // its place in the set
    double t, u, v;
    double dt, du, dv; // uncertainty of each
    double sine;       // see ray_oracle_sine()
} RayOracleRoot;

typedef struct {
    int count;
    int open;      // how many are not ROOT_CERTAIN
    bool doubtful; // see ray_oracle()
    RayOracleRoot root[RAY_ORACLE_ROOTS];
} RayOracle;

typedef enum {
    ORACLE_QUICK, // double; rough about what rounding hides
    ORACLE_FINE,  // as far as 106 bits go
    ORACLE_EXACT, // as far as __float128 does
} RayOraclePrecision;

// Patches made ready for many rays, in the arena; defs must stay.
typedef struct RayOracleSet RayOracleSet;
RayOracleSet *ray_oracle_prepare(Arena *arena, const PatchDef *defs, int count);

// Crossings at other depths may be left out: nobody asks for them.
typedef struct {
    double t0, t1;
} RayOracleRange;

// Adds the crossings with all patches. Direction not zero, everything finite.
void ray_oracle_search(RayOracle *oracle, const RayOracleSet *set, const Ray *ray,
                       RayOracleRange range, RayOraclePrecision precision);

// The sine of the angle between ray and surface at a root, which keeps it; 0: grazing or not known.
double ray_oracle_sine(RayOracleRoot *root, const PatchDef *def, const Ray *ray);

// The same for one patch, the whole line, behind the origin too; with the sines.
void ray_oracle_find(RayOracle *oracle, const PatchDef *def, const Ray *ray,
                     RayOraclePrecision precision);

// The crossings with t_min <= t < t_max, added. Doubtful: what another method can't be asked to see
// in the same way, since it is tangent or singular, within 1e-8 of the patch's edge or of the ends
// of the range, or two crossings as near to each other.
void ray_oracle(RayOracle *oracle, const PatchDef *def, const Ray *ray, double t_min, double t_max);

// Do the patches, taken together, come within `reach` of the ray at every depth between t0 and t1,
// give or take `reach` in depth as well?
// Answered for 16 steps of depth. False as well when that takes too long.
bool ray_oracle_near(const RayOracleSet *set, const Ray *ray, double t0, double t1, double reach);

// The same, shown by a way on one patch from (u0,v0) to (u1,v1): does it stay within `reach` of the
// ray? Answered for 32 steps. False: no such way is known.
bool ray_oracle_way(const PatchDef *def, const Ray *ray, const double from[2], const double to[2],
                    double reach);

// The same from the ray's origin to depth t1 beside one sheet, found by steps from (u,v) on.
// Answered for 32 steps. False: not found so.
bool ray_oracle_along(const PatchDef *def, const Ray *ray, const double from[2], double t1,
                      double reach);

// |org + t dir - S(u,v)|, rounded once.
double ray_oracle_residual(const PatchDef *def, const Ray *ray, double t, double u, double v);
// S and its derivatives.
void ray_oracle_jet(const PatchDef *def, double u, double v, Vec3 out[3]);

#endif
