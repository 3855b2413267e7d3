// SPDX-License-Identifier: MIT
// The flat triangle: ray against its plane, then three edges in the projection along the largest
// component of the normal. Edges and corners are inside, so that neighbours leave no gap; the
// orientation of the projection is made the same for all by exchanging two corners beforehand.
#include "shape/shape.h"

// Least depth.
static const double NEAREST = 1e-6;

// The coordinates that stay when `axis` is projected away.
static double first(Vec3 p, int axis) { return axis == 0 ? p.y : p.x; }
static double second(Vec3 p, int axis) { return axis == 2 ? p.y : p.z; }

// Twice the signed area of (a, b, q) in the projection.
static double side_of(Vec3 a, Vec3 b, double qx, double qy, int axis) {
    return (first(b, axis) - first(a, axis)) * (qy - second(a, axis)) -
           (second(b, axis) - second(a, axis)) * (qx - first(a, axis));
}

void triangle_prepare(Shape *shape, const TriangleShape *triangle) {
    const Vec3 *p = triangle->p;
    Vec3 n = vec_cross(vec_sub(p[0], p[1]), vec_sub(p[2], p[1]));
    double length = vec_length(n);
    // Without area there is nothing to hit.
    if (!(length > 0.0) || !isfinite(1.0 / length) || !isfinite(length))
        return;
    n = vec_scale(n, 1.0 / length);
    Vec3 size = vec3(fabs(n.x), fabs(n.y), fabs(n.z));
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    bool turned = side_of(p[0], p[1], first(p[2], axis), second(p[2], axis), axis) < 0.0;
    shape->kind = SHAPE_TRIANGLE;
    shape->as.triangle = (TriangleData){
        {turned ? p[1] : p[0], turned ? p[0] : p[1], p[2]}, n, vec_dot(n, p[0]), axis};
}

int triangle_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    const TriangleData *triangle = &shape->as.triangle;
    double slope = vec_dot(triangle->normal, ray->dir);
    if (!(fabs(slope) >= SHAPE_EPSILON))
        return 0;
    double t = -(vec_dot(triangle->normal, ray->org) - triangle->distance) / slope;
    if (!(t >= NEAREST && t <= SHAPE_FARTHEST))
        return 0;
    int axis = triangle->axis;
    double qx = first(ray->org, axis) + t * first(ray->dir, axis);
    double qy = second(ray->org, axis) + t * second(ray->dir, axis);
    const Vec3 *p = triangle->p;
    if (!(side_of(p[0], p[1], qx, qy, axis) >= 0.0 && side_of(p[1], p[2], qx, qy, axis) >= 0.0 &&
          side_of(p[2], p[0], qx, qy, axis) >= 0.0))
        return 0;
    hits[0] = (ShapeHit){t, 0};
    return 1;
}

Box triangle_bounds(const Shape *shape) {
    const Vec3 *p = shape->as.triangle.p;
    return box_extend(box_extend(box_extend(box_empty(), p[0]), p[1]), p[2]);
}
