// SPDX-License-Identifier: MIT
// One ray through the tree: eight boxes of a node at a time, eight pieces of a leaf at a time,
// Newton where a piece is met.
#ifndef KERNEL_SINGLE_H
#define KERNEL_SINGLE_H

#include "kernel/leaf.h"
#include "kernel/newton.h"
#include "kernel/ray.h"
#include "kernel/search.h"
#include "kernel/simd.h"
#include "patch/classes.h"

typedef struct {
    float near;
    uint32_t child;
} Entry;

// Where the ray enters the eight boxes of a node; one bit for each that it meets.
static inline unsigned node_test(const TreeNode *node, const KernelRay *ray,
                                 float near[TREE_WIDTH]) {
    const float *base = &node->low[0][0];
    F8 o = f8_all(ray->start[0]), inverse = f8_all(ray->inverse[0]);
    F8 from = (f8_load(base + ray->near[0]) - o) * inverse;
    F8 to = (f8_load(base + ray->far[0]) - o) * inverse;
    for (int axis = 1; axis < 3; axis++) {
        o = f8_all(ray->start[axis]);
        inverse = f8_all(ray->inverse[axis]);
        from = f8_max((f8_load(base + ray->near[axis]) - o) * inverse, from);
        to = f8_min((f8_load(base + ray->far[axis]) - o) * inverse, to);
    }
    from = f8_max(f8_all(ray->s_min), from);
    to = f8_min(f8_all(ray->s_max), to);
    f8_store(near, from);
    return i8_bits(from <= to);
}

// ---- A leaf

// The part of a parameter's range from `from` to `to` in which the ray can meet the piece: its
// place in the frame is middle +- width.
static void narrow(double scale, double shift, double rest, double middle, double width,
                   double *from, double *to) {
    double at = scale * middle + shift, room = (scale * width + rest) * (1.0 + 0x1p-18);
    room += 0x1p-20 * fabs(scale * middle);
    double half = 0.5 * (*to - *from), center = 0.5 * (*from + *to);
    double low = center + half * (at - room), high = center + half * (at + room);
    if (low > *from)
        *from = smaller(low, *to);
    if (high < *to)
        *to = larger(high, *from);
}

// Not part of the loop that must stay in registers. Beyond k = 1 the box is larger by what a ray
// from far away errs (ray.h), and so are x and y known less well than the piece's rests say.
__attribute__((noinline)) static bool search_rest(Walk *walk, const Piece *piece,
                                                  const LeafLanes *lanes, int lane, float k) {
    BezierRect rect = piece_rect(piece);
    double qz = (double)lanes->q[2][lane], pz = (double)lanes->p[2][lane];
    if (fabs(qz) > 0.0 && piece->rest_a < 2.0f && piece->rest_b < 2.0f) {
        double gx = (double)lanes->q[0][lane] / qz, gy = (double)lanes->q[1][lane] / qz;
        double half = (double)k, more = half - 1.0;
        narrow((double)piece->scale_a, (double)piece->shift_a, (double)piece->rest_a,
               (double)lanes->p[0][lane] - pz * gx, half * fabs(gx) + more, &rect.u0, &rect.u1);
        narrow((double)piece->scale_b, (double)piece->shift_b, (double)piece->rest_b,
               (double)lanes->p[1][lane] - pz * gy, half * fabs(gy) + more, &rect.v0, &rect.v1);
    }
    return search_rect(walk, piece, rect);
}

static inline float unit(float x) { return x < -1.0f ? -1.0f : x > 1.0f ? 1.0f : x; }

// The piece's parameters where the ray meets it, to about four digits: Newton on the polynomial.
// With g = q / qz the ray has x - gx z = x0, y - gy z = y0.
static inline void guess(const Piece *piece, const LeafLanes *lanes, int lane, double *u,
                         double *v) {
    float steep = 1.0f / lanes->q[2][lane];
    float gx = lanes->q[0][lane] * steep, gy = lanes->q[1][lane] * steep;
    float x0 = lanes->p[0][lane] - lanes->p[2][lane] * gx;
    float y0 = lanes->p[1][lane] - lanes->p[2][lane] * gy;
    float a = unit(x0 * piece->scale_a + piece->shift_a);
    float b = unit(y0 * piece->scale_b + piece->shift_b);
    const float *c = &piece->poly[0][0][0];
    // Powers 0 and 1 of a side by side, and 2 and 3.
    F8 c0 = f8_load(c), c1 = f8_load(c + 16), c2 = f8_load(c + 32), c3 = f8_load(c + 48);
    F8 e0 = f8_load(c + 8), e1 = f8_load(c + 24), e2 = f8_load(c + 40),
       e3 = f8_first_three(f8_load(c + 56)); // whole numbers lie there
    for (int i = 0; i < GUESS_STEPS; i++) {
        F8 bb = f8_all(b), b2 = bb * bb, twice = bb + bb, thrice = f8_all(3.0f) * b2;
        F8 r = (c0 + bb * c1) + b2 * (c2 + bb * c3), s = (e0 + bb * e1) + b2 * (e2 + bb * e3);
        F8 dr = c1 + (twice * c2 + thrice * c3), ds = e1 + (twice * e2 + thrice * e3);
        F8 a2 = f8_all(a * a);
        F8 f = r + a2 * s, fb = dr + a2 * ds;
        F8 slope = f8_pair(2.0f * a, 3.0f * (a * a)) * s;
        F4 at = f8_low(f) + f4_all(a) * f8_high(f);
        F4 along_b = f8_low(fb) + f4_all(a) * f8_high(fb);
        F4 along_a = f8_high(r) + (f8_low(slope) + f8_high(slope));
        float x = at[0] - gx * at[2] - x0, y = at[1] - gy * at[2] - y0;
        float xa = along_a[0] - gx * along_a[2], ya = along_a[1] - gy * along_a[2];
        float xb = along_b[0] - gx * along_b[2], yb = along_b[1] - gy * along_b[2];
        float part = 1.0f / (xa * yb - xb * ya);
        a = unit(a - (x * yb - y * xb) * part);
        b = unit(b - (y * xa - x * ya) * part);
    }
    const BezierRect r = piece_rect(piece);
    *u = clamp(0.5 * (r.u0 + r.u1) + 0.5 * (r.u1 - r.u0) * (double)a, r.u0, r.u1);
    *v = clamp(0.5 * (r.v0 + r.v1) + 0.5 * (r.v1 - r.v0) * (double)b, r.v0, r.v1);
}

static inline const Piece *piece_begin(Walk *walk, const Block *block, int lane) {
    const Accel *accel = walk->accel;
    uint32_t patch = block->patch[lane];
    walk->piece = block_piece(block, (uint32_t)lane);
    if (walk->patch != patch)
        walk_see(walk, patch);
    return accel_piece(accel, walk->piece);
}

static inline bool search_piece(Walk *walk, const Block *block, const LeafLanes *lanes, int lane,
                                float k) {
    if (!(block->mask[lane] & walk->query->mask))
        return true;
    const Piece *piece = piece_begin(walk, block, lane);
    // Beside patches 1e10 times their size others are one point of the tree.
    if (block->coarse >> lane & 1 && patch_ray_misses(&walk->ray))
        return true;
    if (lanes->single >> lane & 1) {
        double u, v;
        guess(piece, lanes, lane, &u, &v);
        Newton done = newton_sharpen(walk, piece, piece_rect(piece), u, v);
        if (done != NEWTON_LOST)
            return done == NEWTON_TAKEN;
    }
    return search_rest(walk, piece, lanes, lane, k);
}

static inline LeafRay leaf_ray(const Block *block, const KernelRay *tree, float near) {
    LeafRay ray = {.k = tree->k};
    D4 center = __builtin_convertvector(f4_load(block->center), D4);
    F4 o = __builtin_convertvector(tree->origin - center + d4_all((double)near) * tree->dir, F4);
    F4 d = __builtin_convertvector(tree->dir, F4);
    memcpy(ray.o, &o, sizeof o);
    memcpy(ray.d, &d, sizeof d);
    // Within a block s goes up to 8, so a difference and a product are rounded by less than this.
    ray.s_low = tree->s_min - near - 2.0f * TREE_PAD;
    ray.s_high = tree->s_end - near + 2.0f * TREE_PAD;
    return ray;
}

static inline bool visit_leaf(Walk *walk, const KernelRay *tree, uint32_t leaf, float near) {
    const Block *block = accel_block(walk->accel, leaf);
    walk->t_least = ray_least(tree, near);
    LeafRay ray = leaf_ray(block, tree, near);
    LeafLanes lanes;
    leaf_test(block, &ray, &lanes);
    walk->query->stats.patch_tests += block->count;
    walk->query->stats.steps += block->count;
    unsigned meets = lanes.meets;
    for (unsigned left = meets; left; left &= left - 1) {
        uint32_t lane = (uint32_t)__builtin_ctz(left);
        prefetch(accel_piece(walk->accel, block_piece(block, lane)), sizeof(Piece));
        if (block->patch[lane] != walk->patch)
            prefetch(&walk->accel->patches[block->patch[lane]], sizeof(AccelPatch));
    }
    while (meets) {
        // From near to far.
        int lane = __builtin_ctz(meets);
        if (meets & (meets - 1)) {
            float first = INFINITY;
            for (unsigned left = meets; left; left &= left - 1) {
                int i = __builtin_ctz(left);
                float s = -lanes.p[2][i] / lanes.q[2][i];
                if (s < first) {
                    first = s;
                    lane = i;
                }
            }
        }
        meets &= ~(1u << lane);
        if (!search_piece(walk, block, &lanes, lane, tree->k))
            return false;
    }
    return true;
}

static bool visit_block(Walk *walk, const Block *block) {
    const Accel *accel = walk->accel;
    for (uint32_t i = 0; i < block->count; i++) {
        if (!(block->mask[i] & walk->query->mask))
            continue;
        walk->piece = block_piece(block, i);
        if (walk->patch != block->patch[i])
            walk_see(walk, block->patch[i]);
        if (patch_ray_misses(&walk->ray))
            continue;
        const Piece *piece = accel_piece(accel, walk->piece);
        if (!search_rect(walk, piece, piece_rect(piece)))
            return false;
    }
    return true;
}

static bool visit_near(void *walk, uint32_t leaf, TreeRay *ray) {
    (void)ray;
    return visit_block(walk, accel_block(((Walk *)walk)->accel, leaf));
}

// Pieces of every leaf, for rays that come from too far away for the boxes. Of one class of several
// those that the ray meets on its way, wherever it begins.
static void visit_all(Walk *walk) {
    const Accel *accel = walk->accel;
    TreeRay ray;
    if (!tree_ray_begin(&accel->tree, &walk->query->ray, walk->query->t_min, walk->query->t_max,
                        &ray))
        return;
    walk->dir = ray.unit;
    walk->t_per_s = accel->tree.scale / ray.s_per_t;
    walk->patch = UINT32_MAX;
    Ray near;
    if (accel->is_class && classes_near(accel, &walk->query->ray, &near)) {
        if (!tree_ray_begin(&accel->tree, &near, -INFINITY, INFINITY, &ray))
            return;
        if (!ray.far) {
            tree_walk(&accel->tree, &ray, visit_near, walk);
            return;
        }
    }
    for (uint32_t at = 0; at < accel->line_count;) {
        const Block *block = accel_block(accel, at);
        if (!visit_block(walk, block))
            return;
        at = block_piece(block, block->count);
    }
}

// ---- The tree

// What lies below `at`, which the ray meets.
static inline void walk_from(Walk *walk, KernelRay *ray, Entry at) {
    const Tree *tree = &walk->accel->tree;
    Query *query = walk->query;
    Entry stack[TREE_STACK];
    int top = 0;
    for (;;) {
        if (at.child & TREE_LEAF) {
            double before = query->t_max;
            if (!visit_leaf(walk, ray, at.child & ~TREE_LEAF, at.near))
                return;
            if (query->t_max < before)
                ray_cut(ray, query->t_max);
        } else {
            const TreeNode *node = &tree->nodes[at.child];
            float near[TREE_WIDTH];
            unsigned met = node_test(node, ray, near);
            if (met) {
                int first = __builtin_ctz(met);
                at = (Entry){near[first], node->child[first]};
                met &= met - 1;
                // The nearest is next, the others wait in order, the farthest deepest.
                int base = top;
                for (; met; met &= met - 1) {
                    int i = __builtin_ctz(met);
                    Entry other = {near[i], node->child[i]};
                    if (other.near < at.near) {
                        Entry swap = at;
                        at = other;
                        other = swap;
                    }
                    int place = top++;
                    for (; place > base && stack[place - 1].near < other.near; place--)
                        stack[place] = stack[place - 1];
                    stack[place] = other;
                    if (other.child & TREE_LEAF)
                        prefetch(accel_block(walk->accel, other.child & ~TREE_LEAF), sizeof(Block));
                    else
                        prefetch(&tree->nodes[other.child], sizeof(TreeNode));
                }
                continue;
            }
        }
        do {
            if (top == 0)
                return;
            at = stack[--top];
        } while (at.near > ray->s_max);
    }
}

static void walk_query(Walk *walk) {
    const Tree *tree = &walk->accel->tree;
    Query *query = walk->query;
    KernelRay ray;
    RayEntry entry = ray_begin(tree, &query->ray, query->t_min, query->t_max, &ray);
    if (entry == RAY_MISSES)
        return;
    walk->seen_count = walk->endless = 0;
    if (entry == RAY_FAR) {
        visit_all(walk);
        return;
    }
    walk->dir = ray.unit;
    walk->t_per_s = tree->scale * ray.t_per_s;
    walk->patch = UINT32_MAX;
    walk_from(walk, &ray, (Entry){0.0f, tree->root}); // the ray begins where it enters the tree
}

#endif
