// SPDX-License-Identifier: MIT
// The disc with an optional hole, both rims included. Its inside is the whole half space behind it.
#include "shape/shape.h"

// Least depth, in the world's units.
static const double NEAREST = 1e-6;

void disc_prepare(Shape *shape, const DiscShape *disc) {
    Vec3 normal = disc->normal;
    double length = vec_length(normal);
    if (!(length > 0.0))
        return;
    shape->kind = SHAPE_DISC;
    shape->as.disc =
        (DiscData){disc->center, normal, disc->radius * disc->radius, disc->hole * disc->hole};
}

int disc_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    const DiscData *disc = &shape->as.disc;
    Vec3 org = ray->org, dir = ray->dir;
    if (shape->transform) {
        org = transform_inv_point(shape->transform, org);
        dir = transform_inv_dir(shape->transform, dir);
    }
    double slope = vec_dot(disc->normal, dir);
    if (!(fabs(slope) >= SHAPE_EPSILON))
        return 0;
    Vec3 from = vec_sub(org, disc->center);
    double t = -vec_dot(disc->normal, from) / slope;
    if (!(t >= NEAREST && t <= SHAPE_FARTHEST))
        return 0;
    Vec3 q = vec_madd(from, t, dir);
    double distance2 = vec_dot(q, q);
    if (!(distance2 >= disc->hole2 && distance2 <= disc->radius2))
        return 0;
    hits[0] = (ShapeHit){.t = t, .part = 0};
    return 1;
}

Vec3 disc_normal(const Shape *shape) {
    Vec3 n = shape->as.disc.normal;
    return shape_world_normal(shape->transform, n, n);
}

bool disc_inside(const Shape *shape, Vec3 p) {
    const DiscData *disc = &shape->as.disc;
    Vec3 q = shape_local_point(shape->transform, p);
    return vec_dot(vec_sub(q, disc->center), disc->normal) < 0.0;
}

Box disc_bounds(const Shape *shape) {
    const DiscData *disc = &shape->as.disc;
    Vec3 n = vec_normalize(disc->normal);
    Vec3 u = fabs(n.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    u = vec_normalize(vec_cross(n, u));
    Vec3 v = vec_cross(n, u);
    double r = sqrt(disc->radius2);
    return shape_ellipsoid_box(shape_world_point(shape->transform, disc->center),
                               shape_world_dir(shape->transform, vec_scale(u, r)),
                               shape_world_dir(shape->transform, vec_scale(v, r)), vec3(0, 0, 0));
}
