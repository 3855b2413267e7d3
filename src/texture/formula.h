// SPDX-License-Identifier: MIT
// The formulas behind pattern.c, a file a family: tiles.c (lists of tiles and cells), solid.c
// (plain geometry), stone.c (made of noise), crackle.c, bump.c (normals). All take the point after
// the warps and return the value before frequency, phase and wave (facts: textures 2).
#ifndef TEXTURE_FORMULA_H
#define TEXTURE_FORMULA_H

#include "model/scene.h"

#define FORMULA_PI_2 6.283185307179586476925 // POV-Ray's 2 pi
#define FORMULA_EPS 1e-10                    // POV-Ray's near-zero

// One period of the sine at fraction v; odd, and rounded through a scale of 50000 as POV-Ray's.
double formula_cycloidal(double v);
// 0 at whole numbers, 1 half-way between.
double formula_triangle(double v);

double tiles_checker(Vec3 p);
double tiles_brick(const Pattern *pattern, Vec3 p);
double tiles_cells(Vec3 p);
double tiles_cubic(Vec3 p);
double tiles_hexagon(Vec3 p);
double tiles_quilted(const Pattern *pattern, Vec3 p);
double tiles_square(Vec3 p);
double tiles_triangular(Vec3 p);

double solid_gradient(const Pattern *pattern, Vec3 p);
double solid_boxed(Vec3 p);
double solid_cylindrical(Vec3 p);
double solid_leopard(Vec3 p);
double solid_onion(Vec3 p);
double solid_planar(Vec3 p);
double solid_radial(Vec3 p);
double solid_spherical(Vec3 p);
// ripples or waves
double solid_ripples(const Pattern *pattern, Vec3 p, int count);
double solid_waves(const Pattern *pattern, Vec3 p, int count);

double stone_agate(const Pattern *pattern, Vec3 p, int generator);
double stone_dents(Vec3 p, int generator);
double stone_granite(Vec3 p, int generator);
double stone_marble(const Pattern *pattern, Vec3 p, int generator);
double stone_spiral1(const Pattern *pattern, Vec3 p, int generator);
double stone_spiral2(const Pattern *pattern, Vec3 p, int generator);
double stone_wood(const Pattern *pattern, Vec3 p);
double stone_wrinkles(Vec3 p, int generator);

// quilted: the place in its cell, scaled by the curve of its distance from the middle.
Vec3 tiles_quilt(const Pattern *pattern, Vec3 p);

// The point that is strewn into the cell of p.
Vec3 crackle_site(Vec3 p);

// bump.c: n bent by the pattern at p.
Vec3 bump_bumps(double amount, Vec3 p, Vec3 n);
Vec3 bump_dents(double amount, Vec3 p, Vec3 n, int generator);
Vec3 bump_facets(const FacetsShape *shape, Vec3 p, Vec3 n);
Vec3 bump_quilted(const Pattern *pattern, double amount, Vec3 p, Vec3 n);
Vec3 bump_waves(const Pattern *pattern, double amount, Vec3 p, Vec3 n, int count); // or ripples
Vec3 bump_wrinkles(double amount, Vec3 p, Vec3 n);

double fractal_value(const Pattern *pattern, Vec3 p); // mandel, julia

double crackle_value(const CrackleShape *shape, Vec3 p, int generator);

#endif
