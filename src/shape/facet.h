// SPDX-License-Identifier: MIT
// A triangle as POV-Ray tests it: the plane first, then the sides of the shadow that it throws
// along the largest component of its normal. Points on an edge count for both neighbours.
#ifndef SHAPE_FACET_H
#define SHAPE_FACET_H

#include "base/vec.h"

#include <stdbool.h>

// Corners with the orientation of the shadow made positive: p[0] and p[1] may have changed places.
typedef struct {
    Vec3 p[3], normal;
    double distance; // normal . p
    int axis;        // the largest component of the normal
    bool turned;     // they have
} Facet;

// normal: as it is to be reported, unit; (0, 0, 0): cross(p0 - p1, p2 - p1). False: no area.
bool facet_make(Facet *facet, const Vec3 p[3], Vec3 normal);
// The depth at which the ray is in the triangle; false: nowhere within POV-Ray's limits.
bool facet_hit(const Facet *facet, const Ray *ray, double *t);
// Weights of the corners, in the order in which they were given, at a point of the plane; they add
// up to 1.
void facet_weights(const Facet *facet, Vec3 p, double w[3]);

#endif
