// SPDX-License-Identifier: MIT
// Points of one patch in long double, its crossings by ray_oracle.h, and the patches tests use.
// Shares no code with src/patch.
#ifndef TESTS_PATCH_ORACLE_H
#define TESTS_PATCH_ORACLE_H

#include "base/rng.h"
#include "patch/bezier.h"

typedef struct {
    double t, u, v;
    double sine; // of the angle between the ray and the tangent plane
} OracleHit;

typedef struct {
    int count;
    OracleHit hits[256];
    bool doubtful; // a root is nearly double, on the border, or at the end of the range
} OracleHits;

// All crossings with t_min <= t < t_max, by increasing t.
void oracle_hits(const Bezier *patch, Ray ray, double t_min, double t_max, OracleHits *out);
// S(u,v) and the ray's point, compared in long double: |org + t dir - S(u,v)|.
double oracle_residual(const Bezier *patch, Ray ray, double t, double u, double v);
// S(u,v) itself, rounded at the end.
Vec3 oracle_point(const Bezier *patch, double u, double v);
void oracle_tangents(const Bezier *patch, double u, double v, Vec3 *su, Vec3 *sv);

void random_patch(Rng *rng, int du, int dv, double wild, Bezier *out); // a net over [0,1]^2 + noise
Vec3 random_direction(Rng *rng);
// A ray through S(u,v) from `distance` away, along dir.
Ray ray_to(const Bezier *patch, double u, double v, Vec3 dir, double distance);
// The lid (collapsed at its top) and the bottom (at its middle) of Newell's teapot, one of four
// quarters each, z up; and a quarter of its body's upper half.
void teapot_lid(Bezier *out);
void teapot_bottom(Bezier *out);
void teapot_body(Bezier *out);

#endif
