// SPDX-License-Identifier: MIT
// The flat triangle.
#include "shape/shape.h"

void triangle_prepare(Shape *shape, const TriangleShape *triangle) {
    // Without area there is nothing to hit.
    if (facet_make(&shape->as.triangle, triangle->p, (Vec3){0, 0, 0}))
        shape->kind = SHAPE_TRIANGLE;
}

int triangle_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    double t;
    if (!facet_hit(&shape->as.triangle, ray, &t))
        return 0;
    hits[0] = (ShapeHit){.t = t};
    return 1;
}

Box triangle_bounds(const Shape *shape) {
    const Vec3 *p = shape->as.triangle.p;
    return box_extend(box_extend(box_extend(box_empty(), p[0]), p[1]), p[2]);
}
