// SPDX-License-Identifier: MIT
// Edges and corners are inside, so that neighbours leave no gap.
#include "shape/facet.h"

#include <math.h>

static const double NEAREST = 1e-6, FARTHEST = 1e7, ALONG = 1e-10;

// The coordinates that stay when `axis` is projected away.
static double first(Vec3 p, int axis) { return axis == 0 ? p.y : p.x; }
static double second(Vec3 p, int axis) { return axis == 2 ? p.y : p.z; }

// Twice the signed area of (a, b, q) in the projection.
static double side_of(Vec3 a, Vec3 b, double qx, double qy, int axis) {
    return (first(b, axis) - first(a, axis)) * (qy - second(a, axis)) -
           (second(b, axis) - second(a, axis)) * (qx - first(a, axis));
}

bool facet_make(Facet *facet, const Vec3 p[3], Vec3 normal) {
    Vec3 n = vec_cross(vec_sub(p[0], p[1]), vec_sub(p[2], p[1]));
    double length = vec_length(n);
    if (!(length > 0.0) || !isfinite(1.0 / length) || !isfinite(length))
        return false;
    n = vec_dot(normal, normal) > 0.0 ? normal : vec_scale(n, 1.0 / length);
    Vec3 size = vec3(fabs(n.x), fabs(n.y), fabs(n.z));
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    bool turned = side_of(p[0], p[1], first(p[2], axis), second(p[2], axis), axis) < 0.0;
    *facet = (Facet){
        {turned ? p[1] : p[0], turned ? p[0] : p[1], p[2]}, n, vec_dot(n, p[0]), axis, turned};
    return true;
}

bool facet_hit(const Facet *facet, const Ray *ray, double *t) {
    double slope = vec_dot(facet->normal, ray->dir);
    if (!(fabs(slope) >= ALONG))
        return false;
    *t = -(vec_dot(facet->normal, ray->org) - facet->distance) / slope;
    if (!(*t >= NEAREST && *t <= FARTHEST))
        return false;
    int axis = facet->axis;
    double qx = first(ray->org, axis) + *t * first(ray->dir, axis);
    double qy = second(ray->org, axis) + *t * second(ray->dir, axis);
    const Vec3 *p = facet->p;
    return side_of(p[0], p[1], qx, qy, axis) >= 0.0 && side_of(p[1], p[2], qx, qy, axis) >= 0.0 &&
           side_of(p[2], p[0], qx, qy, axis) >= 0.0;
}

void facet_weights(const Facet *facet, Vec3 p, double w[3]) {
    const Vec3 *c = facet->p;
    int axis = facet->axis;
    double x = first(p, axis), y = second(p, axis);
    double area = side_of(c[0], c[1], first(c[2], axis), second(c[2], axis), axis);
    double w0 = side_of(c[1], c[2], x, y, axis) / area, w1 = side_of(c[2], c[0], x, y, axis) / area;
    w[0] = facet->turned ? w1 : w0;
    w[1] = facet->turned ? w0 : w1;
    w[2] = 1.0 - w0 - w1;
}
