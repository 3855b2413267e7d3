// SPDX-License-Identifier: MIT
// The box, axis-aligned in local space, as three slabs. Sides are numbered 2 axis + (high ? 1 : 0).
// Texture coordinates unfold it to a cross of 4 x 3 cells.
#include "shape/shape.h"

// Least depth, in the world's units: the local direction is not made unit.
static const double NEAREST = 1e-6;
// Two sides met within this depth are one edge; the side that faces the ray more is taken.
static const double EDGE = 1e-6;

void box_prepare(Shape *shape, const BoxShape *box) {
    shape->kind = SHAPE_BOX;
    shape->as.box = (BoxShape){vec_min(box->low, box->high), vec_max(box->low, box->high)};
}

typedef struct {
    double t, facing; // facing: |component of the direction| across the side
    int side;
} Crossing;

// What to keep of two crossings: the later entry or the earlier exit (sign -1).
static void take(Crossing *best, Crossing c, double sign) {
    double later = sign * (c.t - best->t);
    if (later > EDGE || (later > -EDGE && c.facing > best->facing))
        *best = c;
}

int box_hits(const Shape *shape, const Ray *ray, ShapeHit hits[SHAPE_MAX_HITS]) {
    const BoxShape *box = &shape->as.box;
    Vec3 org = ray->org, dir = ray->dir;
    if (shape->transform) {
        org = transform_inv_point(shape->transform, org);
        dir = transform_inv_dir(shape->transform, dir);
    }
    // The interval of depths within all slabs decides; the crossings only name the sides.
    double t_in = -INFINITY, t_out = INFINITY;
    Crossing in = {-INFINITY, 0, -1}, out = {INFINITY, 0, -1};
    for (int axis = 0; axis < 3; axis++) {
        double o = vec_get(org, axis), d = vec_get(dir, axis);
        double low = vec_get(box->low, axis), high = vec_get(box->high, axis);
        if (!(fabs(d) >= SHAPE_EPSILON)) {
            if (!(o >= low && o <= high))
                return 0;
            continue;
        }
        double t_low = (low - o) / d, t_high = (high - o) / d;
        double enter = d > 0.0 ? t_low : t_high, leave = d > 0.0 ? t_high : t_low;
        take(&in, (Crossing){enter, fabs(d), 2 * axis + (d > 0.0 ? 0 : 1)}, 1.0);
        take(&out, (Crossing){leave, fabs(d), 2 * axis + (d > 0.0 ? 1 : 0)}, -1.0);
        t_in = enter > t_in ? enter : t_in;
        t_out = leave < t_out ? leave : t_out;
    }
    if (!(t_in <= t_out) || in.side < 0)
        return 0;
    int count = 0;
    if (t_in > NEAREST && isfinite(t_in))
        hits[count++] = (ShapeHit){.t = t_in, .part = in.side};
    if (t_out > NEAREST && isfinite(t_out))
        hits[count++] = (ShapeHit){.t = t_out, .part = out.side};
    return count;
}

Vec3 box_normal(const Shape *shape, int part) {
    double sign = part % 2 ? 1.0 : -1.0;
    Vec3 n = part < 2 ? vec3(sign, 0, 0) : part < 4 ? vec3(0, sign, 0) : vec3(0, 0, sign);
    return shape_world_normal(shape->transform, n, n);
}

// The cross, with the sides' names in it (v up, u to the right, cells 1/4 x 1/3):
//
//         +y
//    -x   +z   +x   -z
//         -y
Vec2 box_uv(const Shape *shape, Vec3 p, int part) {
    const BoxShape *box = &shape->as.box;
    Vec3 q = vec_sub(shape_local_point(shape->transform, p), box->low);
    Vec3 size = vec_sub(box->high, box->low);
    double x = size.x > 0.0 ? q.x / size.x : 0.0, y = size.y > 0.0 ? q.y / size.y : 0.0,
           z = size.z > 0.0 ? q.z / size.z : 0.0;
    switch (part) {
    case 0:
        return (Vec2){z / 4.0, (1.0 + y) / 3.0};
    case 1:
        return (Vec2){(3.0 - z) / 4.0, (1.0 + y) / 3.0};
    case 2:
        return (Vec2){(1.0 + x) / 4.0, z / 3.0};
    case 3:
        return (Vec2){(1.0 + x) / 4.0, (3.0 - z) / 3.0};
    case 4:
        return (Vec2){(4.0 - x) / 4.0, (1.0 + y) / 3.0};
    default:
        return (Vec2){(1.0 + x) / 4.0, (1.0 + y) / 3.0};
    }
}

bool box_inside(const Shape *shape, Vec3 p) {
    const BoxShape *box = &shape->as.box;
    Vec3 q = shape_local_point(shape->transform, p);
    return q.x >= box->low.x && q.x <= box->high.x && q.y >= box->low.y && q.y <= box->high.y &&
           q.z >= box->low.z && q.z <= box->high.z;
}

Box box_bounds(const Shape *shape) {
    const BoxShape *box = &shape->as.box;
    Box bounds = box_empty();
    for (int i = 0; i < 8; i++) {
        Vec3 corner = vec3(i & 1 ? box->high.x : box->low.x, i & 2 ? box->high.y : box->low.y,
                           i & 4 ? box->high.z : box->low.z);
        bounds = box_extend(bounds, shape_world_point(shape->transform, corner));
    }
    return bounds;
}
