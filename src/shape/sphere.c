// SPDX-License-Identifier: MIT
// The sphere; an ellipsoid under a transform. Texture coordinates are longitude and latitude: u
// runs from +x towards +z, v from the south to the north pole.
#include "shape/shape.h"

// Least depth, in local units.
static const double NEAREST = 1e-6;

void sphere_prepare(Shape *shape, const SphereShape *sphere) {
    shape->kind = SHAPE_SPHERE;
    shape->as.sphere =
        (SphereData){sphere->center, sphere->radius, sphere->radius * sphere->radius};
}

int sphere_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    const SphereData *sphere = &shape->as.sphere;
    LocalRay local;
    if (!shape_local_ray(shape->transform, ray, &local))
        return 0;
    // The middle of the chord, then half its length.
    Vec3 to_center = vec_sub(sphere->center, local.ray.org);
    double distance2 = vec_dot(to_center, to_center);
    double middle = vec_dot(to_center, local.ray.dir);
    double half2 = sphere->radius2 - distance2 + middle * middle;
    if (!(half2 > SHAPE_EPSILON))
        return 0;
    double half = sqrt(half2);
    int count = 0;
    for (int i = 0; i < 2; i++) {
        double t = i == 0 ? middle - half : middle + half;
        if (t > NEAREST && t < SHAPE_FARTHEST)
            hits[count++] = (ShapeHit){.t = t / local.scale, .part = 0};
    }
    return count;
}

Vec3 sphere_normal(const Shape *shape, Vec3 p) {
    const SphereData *sphere = &shape->as.sphere;
    Vec3 out = vec_sub(shape_local_point(shape->transform, p), sphere->center);
    // POV-Ray divides by the radius when there is no transform: a negative one turns the normal.
    if (!shape->transform)
        return vec_scale(out, 1.0 / sphere->radius);
    return shape_world_normal(shape->transform, out, vec3(0, 1, 0));
}

Vec2 sphere_uv(const Shape *shape, Vec3 p) {
    const SphereData *sphere = &shape->as.sphere;
    Vec3 out = vec_sub(shape_local_point(shape->transform, p), sphere->center);
    double length = vec_length(out);
    if (!(length > 0.0))
        return (Vec2){0, 0};
    out = vec_scale(out, 1.0 / length);
    double sine = out.y > 1.0 ? 1.0 : out.y < -1.0 ? -1.0 : out.y;
    double turn = out.x == 0.0 && out.z == 0.0 ? 0.0 : atan2(out.z, out.x);
    if (turn < 0.0)
        turn += 2.0 * M_PI;
    return (Vec2){turn / (2.0 * M_PI), 0.5 + asin(sine) / M_PI};
}

bool sphere_inside(const Shape *shape, Vec3 p) {
    const SphereData *sphere = &shape->as.sphere;
    Vec3 out = vec_sub(shape_local_point(shape->transform, p), sphere->center);
    double distance2 = vec_dot(out, out);
    // The surface itself belongs to neither.
    return shape->inverse ? distance2 > sphere->radius2 : distance2 < sphere->radius2;
}

Box sphere_bounds(const Shape *shape) {
    const SphereData *sphere = &shape->as.sphere;
    double r = fabs(sphere->radius);
    return shape_ellipsoid_box(shape_world_point(shape->transform, sphere->center),
                               shape_world_dir(shape->transform, vec3(r, 0, 0)),
                               shape_world_dir(shape->transform, vec3(0, r, 0)),
                               shape_world_dir(shape->transform, vec3(0, 0, r)));
}
