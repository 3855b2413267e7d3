// SPDX-License-Identifier: MIT
// The plane { p : normal . p = distance }; the inside is the half space that the normal leaves,
// its boundary included.
#include "shape/shape.h"

int plane_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    double t;
    if (!plane_depth(&shape->as.plane, ray, &t))
        return 0;
    hits[0] = (ShapeHit){.t = t, .part = 0};
    return 1;
}

bool plane_inside(const Shape *shape, Vec3 p) {
    const PlaneShape *plane = &shape->as.plane;
    return vec_dot(plane->normal, p) - plane->distance < SHAPE_EPSILON;
}
