// SPDX-License-Identifier: MIT
// The plane { p : normal . p = distance }; the inside is the half space that the normal leaves,
// its boundary included.
#include "shape/shape.h"

// POV-Ray's least depth of a plane.
static const double NEAREST = 1e-6;

int plane_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    const PlaneShape *plane = &shape->as.plane;
    double slope = vec_dot(plane->normal, ray->dir);
    if (!(fabs(slope) >= SHAPE_EPSILON))
        return 0;
    double t = -(vec_dot(plane->normal, ray->org) - plane->distance) / slope;
    if (!(t >= NEAREST && t <= SHAPE_FARTHEST))
        return 0;
    hits[0] = (ShapeHit){.t = t, .part = 0};
    return 1;
}

bool plane_inside(const Shape *shape, Vec3 p) {
    const PlaneShape *plane = &shape->as.plane;
    return vec_dot(plane->normal, p) - plane->distance < SHAPE_EPSILON;
}
