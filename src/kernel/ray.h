// SPDX-License-Identifier: MIT
// A ray as the tree's nodes and blocks see it. See patch/tree.h for tree space and the rounding.
#ifndef KERNEL_RAY_H
#define KERNEL_RAY_H

#include "kernel/simd.h"
#include "patch/tree.h"

typedef struct {
    D4 origin, dir;             // tree space, where the ray enters the tree; |dir| = 1
    float start[4], inverse[4]; // the same in single precision, 1 / dir
    int near[3], far[3];        // which planes of a node are near: offsets in floats
    float s_min, s_max;         // s_max goes with the query's t_max,
    float s_end;                // this one stays
    float k;                    // see leaf.h
    double s_per_t, s_base;     // s = t s_per_t - s_base
    double t_per_s;
    Vec3 unit; // dir with its zeros kept
} KernelRay;

typedef enum { RAY_MISSES, RAY_ENTERS, RAY_FAR } RayEntry;

static inline double ray_larger(double a, double b) { return a > b ? a : b; }
static inline double ray_smaller(double a, double b) { return a < b ? a : b; }
static inline D4 d4_min(D4 a, D4 b) {
    L4 less = a < b;
    return (D4)((less & (L4)a) | (~less & (L4)b));
}
static inline D4 d4_max(D4 a, D4 b) {
    L4 more = a > b;
    return (D4)((more & (L4)a) | (~more & (L4)b));
}
static inline D4 d4_abs(D4 a) { return (D4)((L4)a & INT64_MAX); }

// What counts from t on is of no use; see walk_order for what counts. For the order t of a hit in a
// leaf that begins at s = near, s_max is no less than near: ray_least(near) becomes near + TREE_PAD
// / 2 here but for roundings of 2^-25 (|s_base| < 2^27) and, to float, 2^-23.
static inline void ray_cut(KernelRay *ray, double t) {
    double s = t * ray->s_per_t - ray->s_base + (double)TREE_PAD;
    ray->s_max = (float)(s < 4.0 ? s : 4.0);
}

static inline double ray_least(const KernelRay *ray, float near) {
    return ((double)near - 0.5 * (double)TREE_PAD + ray->s_base) * ray->t_per_s;
}

// The tree's own box is tested here, in double. Its sides are 4 TREE_PAD farther out, so what the
// nodes' boxes hold is inside.
static inline RayEntry ray_begin(const Tree *tree, const Ray *ray, double t_min, double t_max,
                                 KernelRay *out) {
    // Four numbers are read; the fourth lanes are never looked at.
    D4 start = d4_load(&ray->org.x), dir = d4_load(&ray->org.z), size;
    dir = __builtin_shufflevector(dir, dir, 1, 2, 3, 0);
    size = d4_abs(dir);
    double largest = ray_larger(size[0], ray_larger(size[1], size[2]));
    if (tree->root == TREE_NONE || !(largest > 0.0) || !(t_min < t_max))
        return RAY_MISSES;
    // Squares of very large or small lengths would not fit.
    if (!(largest > 0x1p-500 && largest < 0x1p500))
        return RAY_FAR;
    // Components below 2^-60 of the length are taken for that.
    D4 least = d4_all(largest * 0x1p-60);
    L4 tiny = size < least;
    D4 d = (D4)((tiny & ((L4)least | ((L4)dir & INT64_MIN))) | (~tiny & (L4)dir));
    D4 inverse = d4_all(1.0) / d;
    D4 o = (start - d4_load(&tree->center.x)) * d4_all(tree->scale);
    D4 half = d4_load(&tree->half.x);
    D4 a = (-half - o) * inverse, b = (half - o) * inverse;
    D4 near = d4_min(a, b), far = d4_max(a, b), away = d4_abs(o);
    double entry = ray_larger(near[0], ray_larger(near[1], near[2]));
    double exit = ray_smaller(far[0], ray_smaller(far[1], far[2]));
    double reach = ray_larger(away[0], ray_larger(away[1], away[2]));
    if (t_min >= 0.0)
        entry = ray_larger(entry, 0.0);
    if (!(reach < 0x1p25))
        return RAY_FAR;
    if (entry > exit)
        return RAY_MISSES;

    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), short_by = 1.0 / length;
    out->unit = vec_scale(ray->dir, short_by);
    out->dir = d * d4_all(short_by);
    F4 start_float, inverse_float;
    entry *= length;
    out->origin = o + d4_all(entry) * out->dir;
    out->s_per_t = length * tree->scale;
    out->t_per_s = 1.0 / out->s_per_t;
    out->s_base = entry;
    double s_min = t_min * out->s_per_t - entry - (double)TREE_PAD;
    out->s_min = (float)(s_min > -4.0 ? s_min : -4.0);
    ray_cut(out, t_max);
    out->s_end = out->s_max;
    start_float = __builtin_convertvector(out->origin, F4);
    inverse_float = __builtin_convertvector(inverse * d4_all(length), F4);
    memcpy(out->start, &start_float, sizeof start_float);
    memcpy(out->inverse, &inverse_float, sizeof inverse_float);
    for (int axis = 0; axis < 3; axis++) {
        int back = d[axis] < 0.0;
        out->near[axis] = TREE_WIDTH * (axis + (back ? 3 : 0));
        out->far[axis] = TREE_WIDTH * (axis + (back ? 0 : 3));
    }
    // The error of the shift: two roundings each of origin, entry x dir and their sum; and dir's
    // own rounding (four) over the way that is left. frame.c has room for 2^-38 in the boxes, half
    // of their size at most.
    double error = (reach + fabs(entry) + 4.0) * 0x1p-50;
    if (!(error < 0x1p-23))
        return RAY_FAR;
    out->k = error > 0x1p-38 ? (float)(1.0 + error * 0x1p37) * 1.0001f : 1.0f;
    return out->s_min <= out->s_max ? RAY_ENTERS : RAY_MISSES;
}

#endif
