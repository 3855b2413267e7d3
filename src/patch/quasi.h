// SPDX-License-Identifier: MIT
// The quasi-interpolating control net of a Bézier patch, and how far the patch is from it.
//
// Fougerolle, Lanquetin, Neveu, Lauthelie: "A Geometric Algorithm for Ray/Bézier Surfaces
// Intersection using Quasi-interpolating Control Net", sections 2 and 3; the constants are those
// of Nairn, Peters and Lutterkort (N) and of Zhang and Wang (Z).
//
// M_d is the identity with each inner row replaced by (1, 2, 1)/4 about the diagonal. The net
// Q = M_du P M_dv^T is read as a piecewise bilinear surface with break points (i/du, j/dv), and
//     |S(u,v) - Q(u,v)| <= Z(du) max|D1^2 P| + Z(dv) max|D2^2 P|
// at each (u,v), in any norm, so in each coordinate alone as well.
#ifndef PATCH_QUASI_H
#define PATCH_QUASI_H

#include "patch/bezier.h"

// N(d) = floor(d/2) ceil(d/2) / (2 d): the same bound for the control polygon itself.
double quasi_n_infinity(int degree);
// Z(1) = 0, Z(2) = 1/16, Z(d) = N(d) - 1/4 from d = 3 on.
double quasi_z_infinity(int degree);

// The net of a patch, as many points as control points and in the same order. net may be patch.
void quasi_net(const Bezier *patch, Bezier *net);
void quasi_net2(const Bezier2 *patch, Bezier2 *net);
// The net as a surface, at (u,v) in [0,1]^2.
Vec3 quasi_eval(const Bezier *net, double u, double v);

// Second differences P_{i-1} - 2 P_i + P_{i+1} along u and along v, over the whole patch: the
// largest Euclidean length, and the largest absolute value of each coordinate. Degree 1 gives 0.
typedef struct {
    double length_u, length_v;
    Vec3 axis_u, axis_v;
} QuasiDifferences;
QuasiDifferences quasi_differences(const Bezier *patch);

double quasi_deviation(const Bezier *patch);    // the bound in Euclidean length
Vec3 quasi_deviation_axes(const Bezier *patch); // the bound of each coordinate
Vec2 quasi_deviation_axes2(const Bezier2 *patch);

#endif
