// SPDX-License-Identifier: MIT
// A packet: up to 16 rays side by side, number by number what ray.h and patch/root.h make of each.
// Sets of rays are words with one bit a ray.
#ifndef KERNEL_RAYS_H
#define KERNEL_RAYS_H

#include "kernel/ray.h"
#include "kernel/wide.h"
#include "patch/kernels.h"

enum { RAYS = PATCH_PACKET };
_Static_assert(RAYS == 16, "a whole number of registers");
// Bits of the rays of one vector.
static const unsigned FLOAT_BITS = (1u << FLOATS) - 1, DOUBLE_BITS = (1u << DOUBLES) - 1;

#define RAYS_ALIGNED _Alignas(64)

typedef struct {
    // As KernelRay.
    RAYS_ALIGNED double origin[3][RAYS];
    double way[3][RAYS]; // tree space, as the origin
    double s_per_t[RAYS], s_base[RAYS], tree_t_per_s[RAYS];
    float start[3][RAYS], inverse[3][RAYS];
    float s_min[RAYS], s_max[RAYS], s_end[RAYS], k[RAYS];
    // As Walk and Query.
    double org[3][RAYS], dir[3][RAYS]; // scene space; |dir| = 1
    double t_per_s[RAYS], t_min[RAYS], t_max[RAYS], t_least[RAYS];
    uint32_t best_patch[RAYS], best_piece[RAYS];
    // The best hits.
    double t[RAYS], u[RAYS], v[RAYS], normal[3][RAYS], bound[RAYS];

    const Accel *accel;
    const Packet *asked;
    QueryKind kind;
    PatchStats *stats;
    uint32_t mask[RAYS];
    uint32_t masks; // kinds of patches that all rays may meet
    // Sets of rays.
    unsigned found;
    unsigned back[3]; // whose direction goes down in an axis
    unsigned enter;   // that ray_begin lets into the tree
    unsigned left;    // that are too far away for the boxes, or are not finite
} RayPacket;

static inline void rays_cut(RayPacket *p, int i, WD t) {
    WD s = t * wd_load(p->s_per_t + i) - wd_load(p->s_base + i) + (double)TREE_PAD;
    wd_to_floats(p->s_max + i, wd_min(s, wd_all(4.0)));
}

// The rays i + lanes of the packet, by the steps of ray_begin.
static inline void rays_begin_some(RayPacket *p, int i, unsigned lanes) {
    const Tree *tree = &p->accel->tree;
    const double center[3] = {tree->center.x, tree->center.y, tree->center.z};
    const double half[3] = {tree->half.x, tree->half.y, tree->half.z};
    WD dir[3], d[3], inverse[3], o[3], entry, exit, reach;
    for (int axis = 0; axis < 3; axis++)
        dir[axis] = wd_load(p->dir[axis] + i);
    WD t_min = wd_load(p->t_min + i), t_max = wd_load(p->t_max + i);
    WD largest = wd_max(wd_abs(dir[0]), wd_max(wd_abs(dir[1]), wd_abs(dir[2])));
    // Where a direction is not finite the largest may be, but not the sum.
    WD sum = wd_abs(dir[0] + dir[1] + dir[2]);
    unsigned fits = wd_lt(wd_all(0x1p-500), largest) & wd_lt(largest, wd_all(0x1p500)) &
                    wd_lt(sum, wd_all(INFINITY));
    unsigned far = lanes & ~fits, rest = lanes & fits & wd_lt(t_min, t_max);
    WD least = largest * 0x1p-60;
    for (int axis = 0; axis < 3; axis++) {
        unsigned tiny = wd_lt(wd_abs(dir[axis]), least);
        d[axis] = wd_pick(tiny, wd_sign(least, dir[axis]), dir[axis]);
        inverse[axis] = 1.0 / d[axis];
        o[axis] = (wd_load(p->org[axis] + i) - center[axis]) * tree->scale;
        p->back[axis] |= wd_lt(d[axis], wd_all(0.0)) << i;
    }
    for (int axis = 2; axis >= 0; axis--) {
        WD a = (-half[axis] - o[axis]) * inverse[axis], b = (half[axis] - o[axis]) * inverse[axis];
        WD near = wd_min(a, b), far_side = wd_max(a, b), away = wd_abs(o[axis]);
        entry = axis == 2 ? near : wd_max(near, entry);
        exit = axis == 2 ? far_side : wd_min(far_side, exit);
        reach = axis == 2 ? away : wd_max(away, reach);
    }
    entry = wd_pick(wd_le(wd_all(0.0), t_min), wd_max(entry, wd_all(0.0)), entry);
    unsigned near_enough = wd_lt(reach, wd_all(0x1p25));
    far |= rest & ~near_enough;
    rest &= near_enough & ~wd_lt(exit, entry);

    WD length = wd_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), short_by = 1.0 / length;
    entry *= length;
    WD s_per_t = length * tree->scale, t_per_s = 1.0 / s_per_t;
    for (int axis = 0; axis < 3; axis++) {
        WD way = d[axis] * short_by, origin = o[axis] + entry * way;
        wd_store(p->dir[axis] + i, dir[axis] * short_by);
        wd_store(p->way[axis] + i, way);
        wd_store(p->origin[axis] + i, origin);
        wd_to_floats(p->start[axis] + i, origin);
        wd_to_floats(p->inverse[axis] + i, inverse[axis] * length);
    }
    wd_store(p->s_per_t + i, s_per_t);
    wd_store(p->tree_t_per_s + i, t_per_s);
    wd_store(p->t_per_s + i, tree->scale * t_per_s);
    wd_store(p->s_base + i, entry);
    WD s_min = t_min * s_per_t - entry - (double)TREE_PAD;
    wd_to_floats(p->s_min + i, wd_max(s_min, wd_all(-4.0)));
    rays_cut(p, i, t_max);
    memcpy(p->s_end + i, p->s_max + i, DOUBLES * sizeof(float));
    WD error = (reach + wd_abs(entry) + 4.0) * 0x1p-50;
    unsigned exact = wd_lt(error, wd_all(0x1p-23));
    far |= rest & ~exact;
    rest &= exact;
    unsigned rough = wd_lt(wd_all(0x1p-38), error);
    for (int lane = 0; lane < DOUBLES; lane++) {
        p->k[i + lane] = rough >> lane & 1 ? (float)(1.0 + error[lane] * 0x1p37) * 1.0001f : 1.0f;
        if (!(p->s_min[i + lane] <= p->s_max[i + lane]))
            rest &= ~(1u << lane);
    }
    p->enter |= rest << i;
    p->left |= far << i;
}

static inline void rays_begin(RayPacket *p, const Packet *packet) {
    p->accel = packet->accel;
    p->asked = packet;
    p->kind = packet->kind;
    p->stats = packet->stats;
    p->found = p->enter = p->left = p->back[0] = p->back[1] = p->back[2] = 0;
    p->masks = UINT32_MAX;
    unsigned lanes = (1u << packet->count) - 1;
    for (int i = 0; i < RAYS; i++) {
        const Ray *ray = &packet->rays[i < packet->count ? i : 0];
        p->org[0][i] = ray->org.x, p->org[1][i] = ray->org.y, p->org[2][i] = ray->org.z;
        p->dir[0][i] = ray->dir.x, p->dir[1][i] = ray->dir.y, p->dir[2][i] = ray->dir.z;
        p->t_min[i] = 0.0;
        p->t_max[i] = INFINITY;
    }
    for (int i = 0; packet->ranges && i < packet->count; i++) {
        const PatchRange *range = &packet->ranges[i];
        p->t_min[i] = range->t_min;
        p->t_max[i] = range->t_max;
        p->mask[i] = range->mask;
        p->masks &= range->mask;
        if (!range->mask)
            lanes &= ~(1u << i);
    }
    if (p->accel->tree.root == TREE_NONE)
        return;
    for (int i = 0; i < RAYS; i += DOUBLES)
        rays_begin_some(p, i, lanes >> i & DOUBLE_BITS);
}

#endif
