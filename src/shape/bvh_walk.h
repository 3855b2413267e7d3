// SPDX-License-Identifier: MIT
// A ray's way through a Bvh, with a stack of its own, the nearest child first. In a header, so that
// what is done at each item becomes part of the loop.
//
// All in single precision, four boxes at once, and conservative: a box that the ray meets is never
// left out. An axis' depths are (plane - origin) / direction. The origin is moved away from the box
// by more than its own rounding, so that entering is never found too late nor leaving too early;
// the rest (direction, quotient, difference, product: (1 +- 2^-24)^4) is in SLACK.
#ifndef SHAPE_BVH_WALK_H
#define SHAPE_BVH_WALK_H

#include "base/lanes.h"
#include "shape/bvh.h"

#include <assert.h>
#include <string.h>

static const float BVH_SLACK = 0x1p-21F;

typedef struct {
    float enter_org[3], leave_org[3], inverse[3];
    int near[3], far[3]; // which planes of a node are near: offsets in floats
    float t_min;
} BvhRay;

// t upwards, never less: exact enough for limits.
static inline float bvh_round_up(double t) {
    float f = (float)t;
    int32_t bits;
    if (!((double)f < t))
        return f;
    memcpy(&bits, &f, sizeof bits);
    bits = f == 0.0F ? 1 : f > 0.0F ? bits + 1 : bits - 1;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static inline void bvh_ray_axis(BvhRay *out, int axis, double org, double dir) {
    float d = (float)dir;
    // A direction (nearly) within the slab gets a huge inverse that is no infinity: 0 x it is 0,
    // not NaN, when the origin lies in the plane of a side.
    float inverse = fabsf(d) < 1e-37F ? copysignf(1e37F, d) : 1.0F / d;
    // Rounding to float is off by 2^-24 of the number, or 2^-150 near 0.
    double away = copysign(fabs(org) * 0x1p-23 + 0x1p-140, dir);
    int back = inverse < 0.0F;
    out->inverse[axis] = inverse;
    out->enter_org[axis] = (float)(org + away);
    out->leave_org[axis] = (float)(org - away);
    out->near[axis] = BVH_WIDTH * (axis + (back ? 3 : 0));
    out->far[axis] = BVH_WIDTH * (axis + (back ? 0 : 3));
}

// t_min >= 0.
static inline void bvh_ray(BvhRay *out, const Ray *ray, double t_min) {
    bvh_ray_axis(out, 0, ray->org.x, ray->dir.x);
    bvh_ray_axis(out, 1, ray->org.y, ray->dir.y);
    bvh_ray_axis(out, 2, ray->org.z, ray->dir.z);
    out->t_min = (float)(t_min * (1.0 - 0x1p-23));
}

// Where the ray enters the node's four boxes; one bit for each that it meets up to t_max.
static inline unsigned bvh_meet(const BvhNode *node, const BvhRay *ray, float t_max,
                                float near[BVH_WIDTH]) {
    const float *planes = &node->low[0][0];
    Lanes from = lanes_all(ray->t_min), to = lanes_all(t_max);
    for (int axis = 0; axis < 3; axis++) {
        Lanes inverse = lanes_all(ray->inverse[axis]);
        Lanes enter = (lanes_load(planes + ray->near[axis]) - lanes_all(ray->enter_org[axis]));
        Lanes leave = (lanes_load(planes + ray->far[axis]) - lanes_all(ray->leave_org[axis]));
        from = lanes_max(enter * inverse, from);
        to = lanes_min(leave * inverse, to);
    }
    from = from * lanes_all(1.0F - BVH_SLACK); // it is >= 0
    to = to * lanes_all(1.0F + BVH_SLACK);     // where it is negative the box lies behind
    memcpy(near, &from, sizeof from);
    return lanes_at_most(from, to);
}

// Calls visit for the items (their place in leaf order) whose boxes the ray meets between its t_min
// and t_max, nearer boxes first; visit returns the new t_max, -INFINITY to end. Boxes that begin
// exactly at t_max are visited.
typedef double (*BvhVisit)(void *context, uint32_t place);
__attribute__((always_inline)) static inline void
bvh_walk_ray(const Bvh *bvh, const BvhRay *ray, double t_max, BvhVisit visit, void *context) {
    struct {
        float t;
        uint32_t child;
    } stack[BVH_STACK], at;
    if (bvh->node_count == 0)
        return;
    float limit = bvh_round_up(t_max);
    int size = 0;
    at.child = 0; // the root
    for (;;) {
        if (at.child & BVH_LEAF) {
            limit = bvh_round_up(visit(context, at.child & ~BVH_LEAF));
        } else {
            const BvhNode *node = &bvh->nodes[at.child];
            float near[BVH_WIDTH];
            unsigned met = bvh_meet(node, ray, limit, near);
            // The farther children go deeper into the stack.
            for (int base = size; met; met &= met - 1) {
                int k = __builtin_ctz(met), place = size++;
                assert(size <= BVH_STACK);
                for (; place > base && stack[place - 1].t < near[k]; place--)
                    stack[place] = stack[place - 1];
                stack[place].t = near[k];
                stack[place].child = node->child[k];
            }
        }
        do {
            if (size == 0)
                return;
            at = stack[--size];
        } while (!(at.t <= limit));
    }
}

__attribute__((always_inline)) static inline void bvh_walk(const Bvh *bvh, const Ray *ray,
                                                           double t_min, double t_max,
                                                           BvhVisit visit, void *context) {
    BvhRay walk;
    bvh_ray(&walk, ray, t_min);
    bvh_walk_ray(bvh, &walk, t_max, visit, context);
}

#endif
