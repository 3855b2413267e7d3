// SPDX-License-Identifier: MIT
// A ray against the eight boxes of a block, each in the frame of its piece (patch/piece.h).
//
// With p + s q the ray in a frame it meets the box [-k,k]^3 only if no axis separates the two. Of
// the six axes the three across the ray say
//     |px qz - pz qx| <= k (|qx| + |qz|)   and so on,
// and along the ray it is in the slab |z| <= k for s = (-pz +- k) / qz, multiplied out by |qz|. k
// is 1 unless the ray comes from very far away: patch/frame.c derives the room for rounding in the
// boxes.
#ifndef KERNEL_LEAF_H
#define KERNEL_LEAF_H

#include "kernel/simd.h"
#include "patch/piece.h"

// A ray at a block: origin about the block's center.
typedef struct {
    float o[4], d[4];
    float s_low, s_high; // limits from that origin
    float k;
} LeafRay;

typedef struct {
    float p[3][BLOCK_LANES], q[3][BLOCK_LANES];
    unsigned meets, single; // one bit a lane
} LeafLanes;

static inline F8 leaf_dot(const float row[3][BLOCK_LANES], F8 x, F8 y, F8 z) {
    return f8_load(row[0]) * x + f8_load(row[1]) * y + f8_load(row[2]) * z;
}

static inline void leaf_test(const Block *block, const LeafRay *ray, LeafLanes *out) {
    F8 dx = f8_all(ray->d[0]), dy = f8_all(ray->d[1]), dz = f8_all(ray->d[2]);
    F8 ox = f8_all(ray->o[0]), oy = f8_all(ray->o[1]), oz = f8_all(ray->o[2]);
    F8 k = f8_all(ray->k);
    F8 qx = leaf_dot(block->axis[0], dx, dy, dz), qy = leaf_dot(block->axis[1], dx, dy, dz),
       qz = leaf_dot(block->axis[2], dx, dy, dz);
    F8 px = leaf_dot(block->axis[0], ox, oy, oz) + f8_load(block->shift[0]);
    F8 py = leaf_dot(block->axis[1], ox, oy, oz) + f8_load(block->shift[1]);
    F8 pz = leaf_dot(block->axis[2], ox, oy, oz) + f8_load(block->shift[2]);
    F8 ax = f8_abs(qx), ay = f8_abs(qy), az = f8_abs(qz), along = f8_turn(pz, qz);
    I8 meets = (f8_abs(px * qz - pz * qx) <= k * (ax + az)) &
               (f8_abs(py * qz - pz * qy) <= k * (ay + az)) &
               (f8_abs(px * qy - py * qx) <= k * (ax + ay)) &
               (k - along >= f8_all(ray->s_low) * az) & (-along - k <= f8_all(ray->s_high) * az);
    I8 single = az > f8_load(block->steep[0]) * ax + f8_load(block->steep[1]) * ay +
                         f8_load(block->steep[2]);
    out->meets = i8_bits(meets) & ((1u << block->count) - 1u);
    out->single = i8_bits(single);
    f8_store(out->p[0], px);
    f8_store(out->p[1], py);
    f8_store(out->p[2], pz);
    f8_store(out->q[0], qx);
    f8_store(out->q[1], qy);
    f8_store(out->q[2], qz);
}

#endif
