// SPDX-License-Identifier: MIT
// The torus about the y axis: (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + z^2), a quartic in the depth.
// With the origin moved to the point of the ray nearest to the centre the cubic term vanishes and
// the numbers are of the torus' own size, whatever the distance.
#include "shape/quartic.h"
#include "shape/shape.h"

// Least depth, in local units.
static const double NEAREST = 1e-4;

void torus_prepare(Shape *shape, const TorusShape *torus) {
    double major = fabs(torus->major), minor = fabs(torus->minor);
    if (!(major + minor > 0.0))
        return;
    shape->kind = SHAPE_TORUS;
    shape->as.torus = (TorusData){major, minor};
}

int torus_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    double major2 = shape->as.torus.major * shape->as.torus.major;
    double minor2 = shape->as.torus.minor * shape->as.torus.minor;
    double reach = shape->as.torus.major + shape->as.torus.minor;
    LocalRay local;
    if (!shape_local_ray(shape->transform, ray, &local))
        return 0;
    Vec3 dir = local.ray.dir;
    double shift = -vec_dot(local.ray.org, dir);
    Vec3 near = vec_madd(local.ray.org, shift, dir);
    double near2 = vec_dot(near, near);
    double half2 = reach * reach - near2;
    if (!(half2 > 0.0)) // beside the bounding sphere
        return 0;
    double k = near2 + major2 - minor2;
    double p = 2.0 * k - 4.0 * major2 * (dir.x * dir.x + dir.z * dir.z);
    double q = 8.0 * major2 * near.y * dir.y;
    double r = k * k - 4.0 * major2 * (near.x * near.x + near.z * near.z);
    // What the origin's shift left of the linear term is rounding: |near . dir| <= 2^-52 |org|.
    // The margin keeps the roots at the bounding sphere inside the interval.
    double t[4];
    int roots = quartic_roots(p, q, r, sqrt(half2) * (1.0 + 1e-9) + 1e-9 * reach, t);
    int count = 0;
    for (int i = 0; i < roots; i++) {
        double depth = shift + t[i];
        if (depth > NEAREST && depth / local.scale < SHAPE_FARTHEST)
            hits[count++] = (ShapeHit){.t = depth / local.scale, .part = 0};
    }
    return count;
}

Vec3 torus_normal(const Shape *shape, Vec3 p) {
    Vec3 q = shape_local_point(shape->transform, p);
    double around = sqrt(q.x * q.x + q.z * q.z);
    double ratio = around > 0.0 ? shape->as.torus.major / around : 0.0;
    Vec3 out = vec3(q.x - ratio * q.x, q.y, q.z - ratio * q.z);
    return shape_world_normal(shape->transform, out, vec3(0, 1, 0));
}

// u runs once around the axis, v once around the tube, both from the inner side of -x.
Vec2 torus_uv(const Shape *shape, Vec3 p) {
    Vec3 q = shape_local_point(shape->transform, p);
    double out = sqrt(q.x * q.x + q.z * q.z) - shape->as.torus.major;
    double u = 0.5 - atan2(q.z, q.x) / (2.0 * M_PI), v = 0.5 + atan2(q.y, out) / (2.0 * M_PI);
    return (Vec2){u < 1.0 ? u : 0.0, v < 1.0 ? v : 0.0};
}

bool torus_inside(const Shape *shape, Vec3 p) {
    Vec3 q = shape_local_point(shape->transform, p);
    double out = sqrt(q.x * q.x + q.z * q.z) - shape->as.torus.major;
    return out * out + q.y * q.y <= shape->as.torus.minor * shape->as.torus.minor;
}

Box torus_bounds(const Shape *shape) {
    double major = shape->as.torus.major, minor = shape->as.torus.minor;
    const Transform *t = shape->transform;
    // A circle, thickened by a sphere: the half sizes add up.
    Vec3 x = shape_world_dir(t, vec3(1, 0, 0)), y = shape_world_dir(t, vec3(0, 1, 0)),
         z = shape_world_dir(t, vec3(0, 0, 1)), center = shape_world_point(t, vec3(0, 0, 0));
    Box circle =
        shape_ellipsoid_box(vec3(0, 0, 0), vec_scale(x, major), vec_scale(z, major), vec3(0, 0, 0));
    Box tube =
        shape_ellipsoid_box(center, vec_scale(x, minor), vec_scale(y, minor), vec_scale(z, minor));
    return (Box){vec_add(circle.low, tube.low), vec_add(circle.high, tube.high)};
}
