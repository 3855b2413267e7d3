// SPDX-License-Identifier: MIT
// What is right. For one ray and one method's answers (nearest, any, all):
//
//   allowed   of a patch: tolerance x its diameter + the rounding that the ray's distance costs
//   (and,
//             of a rational patch, the last bit of u and v).
//   false     a hit farther than `allowed` from S(u,v), or outside of the range, or (u,v) outside
//   of
//             the patch; a hit of the surface that a ray leaves.
//   over      a hit farther than its own bound from S(u,v), or a bound above `allowed`.
//   missed    the oracle proves a crossing, inside the range, and there is no hit.
//   order     the nearest hit lies behind a proved crossing.
//   lost      a proved crossing of which the list of all hits has nothing.
//   twice     two hits in one place where the oracle proves a single crossing.
//   differ    `any` and `nearest` do not agree.
//   bits      answers that differ on another instruction set (qi).
//   NaN       in any number of a hit, or a normal that is not of unit length.
//
// A hit at depth t accounts for a proved crossing at depth c when |t - c| is no more than what a
// hit off by its bound b across the ray can be off along it, 4 b / sine of the angle between ray
// and surface; or, where the surface is nearly tangent or bent at the size of b, when it stays
// within 4 b of the ray all the way between the two (ray_oracle_near); and the same between a
// crossing and an end of the range. So both answers count as
// right exactly where the decision lies inside the hit's own bound. A crossing that the oracle
// can't tell from a near miss even with 113 bits (on the patch's edge, tangent, singular) may be
// reported or not, except by rays aimed at closed edges: there something must stop the ray.
//
// Triangles (POV-Ray's facets, Embree's tessellation) are judged with 1e-2 of the diameter for a
// tolerance.
#ifndef TESTS_STRESS_JUDGE_H
#define TESTS_STRESS_JUDGE_H

#include "ray_oracle.h"
#include "stress_cases.h"

typedef enum {
    STRESS_FINE,
    STRESS_MISSED,
    STRESS_FALSE,
    STRESS_OVER,
    STRESS_ORDER,
    STRESS_LOST,
    STRESS_TWICE,
    STRESS_DIFFER,
    STRESS_NAN,
    STRESS_VERDICTS,
} StressVerdict;

const char *stress_verdict_name(StressVerdict verdict);
bool stress_is_triangles(PatchMethod method);

enum { STRESS_ALL = 128 };
typedef struct {
    bool found, any, has_all;
    PatchHit hit;
    int count; // of all
    PatchHit all[STRESS_ALL];
} StressAnswer;

// All crossings of one ray, found when they are asked for.
typedef struct {
    const StressScene *scene;
    const StressRay *ray;
    int made;             // 0: not yet, else 1 + the precision
    RayOracleRange range; // of the depths at which they are known
    RayOracle oracle;
    bool open; // a decision was left open
} StressTruth;

void stress_truth_init(StressTruth *truth, const StressScene *scene, const StressRay *ray);
StressVerdict stress_judge(const StressCase *which, PatchMethod method, StressTruth *truth,
                           const StressAnswer *answer);
// Of a ray that began at the hit `left`; bound: the largest of its own and those of hits that were
// taken to be the same surface.
StressVerdict stress_judge_left(const StressAnswer *answer, StressTruth *truth,
                                const PatchHit *left, double bound);
void stress_truth_print(StressTruth *truth);

#endif
