// SPDX-License-Identifier: MIT
// The primitives of random trees in long double: all roots along a line, normals, membership.
#ifndef TESTS_CSG_SHAPE_H
#define TESTS_CSG_SHAPE_H

#include "tests/csg_tree.h"

typedef struct {
    long double x, y, z;
} Point;

Point csg_point_of(Vec3 v);
Point csg_point_add(Point a, Point b);
Point csg_point_sub(Point a, Point b);
Point csg_point_scale(Point a, long double s);
Point csg_point_cross(Point a, Point b);
long double csg_point_dot(Point a, Point b);
Point csg_point_unit(Point a);

// p' = x a[0] + y a[1] + z a[2] + a[3]
typedef struct {
    Point a[4];
} Place;

Place csg_place_none(void);
// The place of what is inside the tree, when the tree itself stands at `around`.
Place csg_place_within(const CsgTree *tree, const Place *around);

typedef struct {
    TreeKind kind;
    const CsgTree *tree;
    Place place, back;  // local to world, world to local
    struct Cell *cells; // of a patch
} SolidShape;

SolidShape csg_solid_shape(const CsgTree *leaf, const Place *place, Arena *arena);

typedef struct {
    long double t;
    Point normal; // unit, either side
} SolidRoot;

enum { SOLID_MAX_ROOTS = 64 };
// All roots of org + t dir, in no order; returns how many.
int csg_solid_roots(const SolidShape *shape, Point org, Point dir,
                    SolidRoot roots[SOLID_MAX_ROOTS]);
bool csg_solid_inside(const SolidShape *shape, Point p);

#endif
