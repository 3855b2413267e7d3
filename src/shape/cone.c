// SPDX-License-Identifier: MIT
// Cylinder and cone, open or with caps, in a frame of their own in which the cylinder is
// x^2 + y^2 = 1 with 0 <= z <= 1 and the cone x^2 + y^2 = z^2 with start <= z <= 1: the larger
// radius is at z = 1, the tip at the origin. Least depth, farthest hit and the slack of the inside
// test are POV-Ray's, in that frame.
#include "shape/shape.h"

static const double NEAREST = 1e-9;

enum { PART_SIDE, PART_LOW, PART_HIGH };

// A frame with w as third axis; axis-aligned when w is, so that exact numbers stay exact.
static Transform frame_of(Vec3 w) {
    Vec3 u = fabs(w.x) > fabs(w.z) ? vec3(0, 0, 1) : vec3(1, 0, 0);
    u = vec_normalize(vec_madd(u, -vec_dot(u, w), w));
    Vec3 v = vec_cross(w, u);
    const Vec3 axes[3] = {u, v, w};
    Transform t = transform_identity();
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            t.m[i][j] = t.inv[j][i] = vec_get(axes[i], j);
    return t;
}

static const Transform *place(Vec3 scale, Vec3 axis, Vec3 origin, const Transform *outer,
                              Arena *arena) {
    Transform size = transform_scale(scale), turn = frame_of(axis),
              move = transform_translate(origin);
    Transform *whole = ARENA_NEW(arena, Transform);
    *whole = transform_compose(&size, &turn);
    *whole = transform_compose(whole, &move);
    if (outer)
        *whole = transform_compose(whole, outer);
    return whole;
}

void cone_prepare(Shape *shape, const ConeShape *cone, Arena *arena) {
    Vec3 low = cone->base, high = cone->apex;
    double low_radius = fabs(cone->base_radius), high_radius = fabs(cone->apex_radius);
    if (low_radius > high_radius) {
        Vec3 p = low;
        low = high, high = p;
        double r = low_radius;
        low_radius = high_radius, high_radius = r;
    }
    Vec3 axis = vec_sub(high, low);
    double length = vec_length(axis);
    if (!(length > 0.0) || !(high_radius > 0.0))
        return;
    axis = vec_scale(axis, 1.0 / length);
    shape->as.cone.open = cone->open;
    // Radii that differ by a fraction f put the tip length / f away, and rounding there is 1e-16 /
    // f of the radius; the cylinder is wrong by f. At f = 1e-8 both are the same.
    double f = (high_radius - low_radius) / high_radius;
    if (f < 1e-8) {
        shape->kind = SHAPE_CYLINDER;
        shape->transform =
            place(vec3(high_radius, high_radius, length), axis, low, shape->transform, arena);
        return;
    }
    shape->kind = SHAPE_CONE;
    shape->as.cone.start = low_radius / high_radius;
    double height = length / f;
    Vec3 tip = vec_madd(low, -height * shape->as.cone.start, axis);
    shape->transform =
        place(vec3(high_radius, high_radius, height), axis, tip, shape->transform, arena);
}

// Depths, from org on, at which the infinite side is met; ascending. org is near the cone.
static int side_depths(bool is_cone, Vec3 org, Vec3 dir, double t[2]) {
    double a = dir.x * dir.x + dir.y * dir.y, b = org.x * dir.x + org.y * dir.y,
           c = org.x * org.x + org.y * org.y;
    if (is_cone)
        a -= dir.z * dir.z, b -= org.z * dir.z, c -= org.z * org.z;
    else
        c -= 1.0;
    double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0))
        return 0;
    // One root without cancellation, the other from their product c / a.
    double q = -(b + copysign(sqrt(discriminant), b));
    if (q == 0.0) {
        // b = 0 and a c = 0: along the side, or through the tip.
        t[0] = 0.0;
        return a != 0.0 ? 1 : 0;
    }
    t[0] = c / q, t[1] = q / a; // a = 0: the second root is at infinity, outside every length
    if (t[0] > t[1]) {
        double swap = t[0];
        t[0] = t[1], t[1] = swap;
    }
    return 2;
}

int cone_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    const ConeData *cone = &shape->as.cone;
    bool is_cone = shape->kind == SHAPE_CONE;
    double start = is_cone ? cone->start : 0.0;
    LocalRay local;
    if (!shape_local_ray(shape->transform, ray, &local))
        return 0;
    // Move the origin to the point of the ray nearest to the middle: no cancellation from afar.
    Vec3 dir = local.ray.dir;
    double shift = vec_dot(vec_sub(vec3(0, 0, 0.5 * (start + 1.0)), local.ray.org), dir);
    Vec3 org = vec_madd(local.ray.org, shift, dir);
    double t[2];
    int count = 0;
    int sides = side_depths(is_cone, org, dir, t);
    for (int i = 0; i < sides; i++) {
        double z = org.z + t[i] * dir.z, depth = shift + t[i];
        if (z >= start && z <= 1.0 && depth > NEAREST && depth < SHAPE_FARTHEST)
            hits[count++] = (ShapeHit){.t = depth / local.scale, .part = PART_SIDE};
    }
    if (cone->open || !(fabs(dir.z) >= SHAPE_EPSILON))
        return count;
    for (int part = PART_HIGH; part >= PART_LOW && count < SHAPE_MAX_HITS; part--) {
        double level = part == PART_HIGH ? 1.0 : start;
        double radius = is_cone ? level : 1.0;
        double s = (level - org.z) / dir.z, depth = shift + s;
        double x = org.x + s * dir.x, y = org.y + s * dir.y;
        if (x * x + y * y <= radius * radius && depth > NEAREST && depth < SHAPE_FARTHEST)
            hits[count++] = (ShapeHit){.t = depth / local.scale, .part = part};
    }
    return count;
}

Vec3 cone_normal(const Shape *shape, Vec3 p, int part) {
    Vec3 n = vec3(0, 0, part == PART_HIGH ? 1 : -1);
    Vec3 down = shape_world_normal(shape->transform, vec3(0, 0, -1), vec3(0, 1, 0));
    if (part == PART_SIDE) {
        n = transform_inv_point(shape->transform, p);
        n.z = shape->kind == SHAPE_CONE ? -n.z : 0.0;
    }
    return shape_world_normal(shape->transform, n, down); // the tip itself looks along the axis
}

bool cone_inside(const Shape *shape, Vec3 p) {
    const ConeData *cone = &shape->as.cone;
    Vec3 q = transform_inv_point(shape->transform, p);
    double slack = cone->open ? SHAPE_EPSILON : -SHAPE_EPSILON;
    bool is_cone = shape->kind == SHAPE_CONE;
    double start = is_cone ? cone->start : 0.0, radius2 = is_cone ? q.z * q.z : 1.0;
    return q.x * q.x + q.y * q.y < radius2 + slack && q.z > start - slack && q.z < 1.0 + slack;
}

Box cone_bounds(const Shape *shape) {
    const Transform *t = shape->transform;
    bool is_cone = shape->kind == SHAPE_CONE;
    // An open one holds points up to SHAPE_EPSILON outside, in this frame.
    double start = is_cone ? shape->as.cone.start : 0.0, slack = 1.0 + SHAPE_EPSILON;
    double low_radius = is_cone ? sqrt(start * start + SHAPE_EPSILON) : slack;
    Box ends[2];
    for (int i = 0; i < 2; i++) {
        double r = i == 0 ? low_radius : slack;
        Vec3 center = vec3(0, 0, i == 0 ? start - SHAPE_EPSILON : slack);
        ends[i] =
            shape_ellipsoid_box(transform_point(t, center), transform_dir(t, vec3(r, 0, 0)),
                                transform_dir(t, vec3(0, r, 0)), transform_dir(t, vec3(0, 0, 0)));
    }
    return box_union(ends[0], ends[1]);
}
