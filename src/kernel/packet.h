// SPDX-License-Identifier: MIT
// A packet of rays through the tree. On the way down a node's boxes are tested once for the hull of
// the rays; at a leaf each ray is tested by itself, with the numbers that it has in single.h. A box
// holds those below it and the test is monotonous, rounding included, so a ray that passes at a
// leaf's box has passed at all boxes above: the hull leaves nothing out, and rays that are not
// meant for a leaf go no further. Rays that go different ways are taken apart.
#ifndef KERNEL_PACKET_H
#define KERNEL_PACKET_H

#include "kernel/rays_root.h"
#include "kernel/single.h"

// So many rays or fewer are faster one by one.
enum { FEW_RAYS = 3 };

// ---- One of the rays by itself

static void write_hit(const RayPacket *p, int i, PatchHit *hit) {
    *hit = (PatchHit){.t = p->t[i],
                      .u = p->u[i],
                      .v = p->v[i],
                      .normal = {p->normal[0][i], p->normal[1][i], p->normal[2][i]},
                      .bound = p->bound[i],
                      .id = p->accel->patches[p->best_patch[i]].id};
}

// Goes on with what the packet knows of the ray.
static inline void ray_leave(const RayPacket *p, int i, Walk *walk, Query *query) {
    const PatchRange *ranges = p->asked->ranges;
    query_begin(query, p->kind, &p->asked->rays[i], p->t_min[i], p->t_max[i],
                ranges ? p->mask[i] : UINT32_MAX);
    walk->accel = p->accel;
    walk->query = query;
    walk->t_limit = ranges ? ranges[i].t_max : INFINITY;
    query->found = p->found >> i & 1;
    walk->dir = vec3(p->dir[0][i], p->dir[1][i], p->dir[2][i]);
    walk->t_per_s = p->t_per_s[i];
    walk->patch = UINT32_MAX;
    walk->endless = 0;
    if (p->kind == QUERY_NEAREST && query->found) {
        walk->best_patch = p->best_patch[i];
        walk->best_piece = p->best_piece[i];
        write_hit(p, i, &query->best);
    }
}

static inline void add_query_stats(PatchStats *to, const PatchStats *from) {
    to->patch_tests += from->patch_tests;
    to->steps += from->steps;
    to->newton += from->newton;
}

static inline void ray_return(RayPacket *p, int i, const Walk *walk, const Query *query) {
    add_query_stats(p->stats, &query->stats);
    p->found |= (query->found ? 1u : 0u) << i;
    if (p->kind != QUERY_NEAREST || !query->found)
        return;
    const PatchHit *best = &query->best;
    p->t[i] = best->t, p->u[i] = best->u, p->v[i] = best->v, p->bound[i] = best->bound;
    for (int axis = 0; axis < 3; axis++)
        p->normal[axis][i] = vec_get(best->normal, axis);
    p->best_patch[i] = walk->best_patch;
    p->best_piece[i] = walk->best_piece;
    p->t_max[i] = query->t_max;
    double s = query->t_max * p->s_per_t[i] - p->s_base[i] + (double)TREE_PAD;
    p->s_max[i] = (float)(s < 4.0 ? s : 4.0);
}

static KernelRay tree_ray_of(const RayPacket *p, int i) {
    KernelRay ray = {.origin = {p->origin[0][i], p->origin[1][i], p->origin[2][i]},
                     .dir = {p->way[0][i], p->way[1][i], p->way[2][i]},
                     .s_min = p->s_min[i],
                     .s_max = p->s_max[i],
                     .s_end = p->s_end[i],
                     .k = p->k[i],
                     .s_per_t = p->s_per_t[i],
                     .s_base = p->s_base[i],
                     .t_per_s = p->tree_t_per_s[i]};
    for (int axis = 0; axis < 3; axis++) {
        ray.start[axis] = p->start[axis][i];
        ray.inverse[axis] = p->inverse[axis][i];
        int back = (int)(p->back[axis] >> i & 1);
        ray.near[axis] = TREE_WIDTH * (axis + 3 * back);
        ray.far[axis] = TREE_WIDTH * (axis + 3 - 3 * back);
    }
    return ray;
}

// All below a child of a node that the ray meets.
static void tree_of_ray(RayPacket *p, int i, uint32_t child, float near) {
    Walk walk;
    Query query;
    ray_leave(p, i, &walk, &query);
    KernelRay ray = tree_ray_of(p, i);
    walk_from(&walk, &ray, (Entry){near, child});
    ray_return(p, i, &walk, &query);
}

// Of a piece that the ray meets: Newton has not been tried, or has got lost.
static void piece_of_ray(RayPacket *p, int i, const Block *block, int lane, float near) {
    Walk walk;
    Query query;
    LeafLanes lanes;
    ray_leave(p, i, &walk, &query);
    KernelRay ray = tree_ray_of(p, i);
    walk.t_least = ray_least(&ray, near);
    LeafRay at = leaf_ray(block, &ray, near);
    leaf_test(block, &at, &lanes);
    const Piece *piece = piece_begin(&walk, block, lane);
    bool lost = (lanes.single >> lane & 1) && walk.ray.patch->cubic;
    if (lost)
        search_rest(&walk, piece, &lanes, lane, ray.k);
    else
        search_piece(&walk, block, &lanes, lane, ray.k);
    ray_return(p, i, &walk, &query);
}

// ---- A leaf

// The rays about the block's center, as leaf_ray.
typedef struct {
    RAYS_ALIGNED float o[3][RAYS];
    float d[3][RAYS], s_low[RAYS], s_high[RAYS];
} RaysAtLeaf;

static inline void rays_at_leaf(RayPacket *p, const Block *block, const float *near,
                                RaysAtLeaf *out) {
    for (int i = 0; i < RAYS; i += DOUBLES) {
        WD start = wd_from_floats(near + i);
        for (int axis = 0; axis < 3; axis++) {
            WD way = wd_load(p->way[axis] + i);
            WD o = wd_load(p->origin[axis] + i) - (double)block->center[axis] + start * way;
            wd_to_floats(out->o[axis] + i, o);
            wd_to_floats(out->d[axis] + i, way);
        }
        wd_store(p->t_least + i, (start - 0.5 * (double)TREE_PAD + wd_load(p->s_base + i)) *
                                     wd_load(p->tree_t_per_s + i));
    }
    for (int i = 0; i < RAYS; i += FLOATS) {
        WF start = wf_load(near + i);
        wf_store(out->s_low + i, wf_load(p->s_min + i) - start - 2.0f * TREE_PAD);
        wf_store(out->s_high + i, wf_load(p->s_end + i) - start + 2.0f * TREE_PAD);
    }
}

// As leaf_test, for one lane of the block. Returns the rays that meet it; *single as there.
static inline unsigned rays_meet(const RayPacket *p, const Block *block, int lane,
                                 const RaysAtLeaf *rays, RaysLocal *local, unsigned *single) {
    unsigned meets = 0;
    *single = 0;
    for (int i = 0; i < RAYS; i += FLOATS) {
        WF d[3], o[3], q[3], at[3], k = wf_load(p->k + i);
        for (int axis = 0; axis < 3; axis++) {
            d[axis] = wf_load(rays->d[axis] + i);
            o[axis] = wf_load(rays->o[axis] + i);
        }
        for (int row = 0; row < 3; row++) {
            float x = block->axis[row][0][lane], y = block->axis[row][1][lane],
                  z = block->axis[row][2][lane];
            q[row] = x * d[0] + y * d[1] + z * d[2];
            at[row] = x * o[0] + y * o[1] + z * o[2] + block->shift[row][lane];
        }
        WF ax = wf_abs(q[0]), ay = wf_abs(q[1]), az = wf_abs(q[2]), along = wf_turn(at[2], q[2]);
        unsigned met = wf_le(wf_abs(at[0] * q[2] - at[2] * q[0]), k * (ax + az)) &
                       wf_le(wf_abs(at[1] * q[2] - at[2] * q[1]), k * (ay + az)) &
                       wf_le(wf_abs(at[0] * q[1] - at[1] * q[0]), k * (ax + ay)) &
                       wf_le(wf_load(rays->s_low + i) * az, k - along) &
                       wf_le(-along - k, wf_load(rays->s_high + i) * az);
        if (!met)
            continue;
        meets |= met << i;
        *single |=
            wf_lt(block->steep[0][lane] * ax + block->steep[1][lane] * ay + block->steep[2][lane],
                  az)
            << i;
        for (int row = 0; row < 3; row++) {
            wf_store(local->q[row] + i, q[row]);
            wf_store(local->p[row] + i, at[row]);
        }
    }
    return meets;
}

// Of these rays, those that may meet the piece's kind.
static inline unsigned rays_of_mask(const RayPacket *p, unsigned rays, uint32_t mask) {
    if (p->masks & mask)
        return rays;
    for (unsigned left = rays; left; left &= left - 1) {
        if (!(p->mask[__builtin_ctz(left)] & mask))
            rays &= ~(left & -left);
    }
    return rays;
}

static inline void rays_search(RayPacket *p, const Block *block, int lane, unsigned meets,
                               unsigned single, const RaysLocal *local, const float *near) {
    uint32_t number = block_piece(block, (uint32_t)lane);
    const Piece *piece = accel_piece(p->accel, number);
    meets = rays_of_mask(p, meets, block->mask[lane]);
    if (!p->accel->patches[piece->patch].cubic)
        single = 0;
    unsigned fast = meets & single, slow = meets & ~single;
    RAYS_ALIGNED float a[RAYS], b[RAYS];
    for (int i = 0; i < RAYS; i += FLOATS) {
        if (fast >> i & FLOAT_BITS)
            rays_guess(piece, local, i, a, b);
    }
    for (int i = 0; i < RAYS; i += DOUBLES) {
        unsigned some = fast >> i & DOUBLE_BITS;
        if (some)
            slow |= rays_sharpen(p, i, some, number, a, b) << i;
    }
    for (; slow; slow &= slow - 1) {
        int i = __builtin_ctz(slow);
        piece_of_ray(p, i, block, lane, near[i]);
    }
}

static void rays_visit_leaf(RayPacket *p, uint32_t leaf, unsigned rays, const float *near) {
    const Block *block = accel_block(p->accel, leaf);
    RaysAtLeaf at;
    RaysLocal local;
    rays_at_leaf(p, block, near, &at);
    uint64_t tests = (uint64_t)block->count * (uint64_t)__builtin_popcount(rays);
    p->stats->patch_tests += tests;
    p->stats->steps += tests;
    for (int lane = 0; lane < (int)block->count; lane++) {
        unsigned single, meets = rays & rays_meet(p, block, lane, &at, &local, &single);
        if (meets)
            rays_search(p, block, lane, meets, single, &local, near);
        if (p->kind == QUERY_ANY)
            rays &= ~p->found;
    }
}

// ---- The tree

// The hull of rays whose directions have the same signs: their origins and inverses.
typedef struct {
    float near_o[3], far_o[3], least[3], most[3];
    float s_min, s_max;
    int near[3], far[3];
} RaysHull;

static inline float least_of(const float *x, unsigned rays) {
    WF least = wf_all(INFINITY);
    for (int i = 0; i < RAYS; i += FLOATS)
        least = wf_min(wf_pick(rays >> i, wf_load(x + i), least), least);
    return wf_least(least);
}

static inline float most_of(const float *x, unsigned rays) {
    WF most = wf_all(-INFINITY);
    for (int i = 0; i < RAYS; i += FLOATS)
        most = wf_max(wf_pick(rays >> i, wf_load(x + i), most), most);
    return wf_most(most);
}

static void hull_of(const RayPacket *p, unsigned rays, RaysHull *hull) {
    for (int axis = 0; axis < 3; axis++) {
        bool back = (p->back[axis] & rays) != 0;
        float low = least_of(p->start[axis], rays), high = most_of(p->start[axis], rays);
        hull->near_o[axis] = back ? low : high;
        hull->far_o[axis] = back ? high : low;
        hull->least[axis] = least_of(p->inverse[axis], rays);
        hull->most[axis] = most_of(p->inverse[axis], rays);
        hull->near[axis] = TREE_WIDTH * (axis + (back ? 3 : 0));
        hull->far[axis] = TREE_WIDTH * (axis + (back ? 0 : 3));
    }
    hull->s_min = least_of(p->s_min, rays);
}

static void hull_cut(const RayPacket *p, unsigned rays, RaysHull *hull) {
    hull->s_max = most_of(p->s_max, rays);
}

// As node_test, for all rays of the hull: entries no later and exits no earlier than theirs.
static inline unsigned hull_test(const TreeNode *node, const RaysHull *hull,
                                 float near[TREE_WIDTH]) {
    const float *base = &node->low[0][0];
    F8 from = f8_all(hull->s_min), to = f8_all(hull->s_max);
    for (int axis = 0; axis < 3; axis++) {
        F8 least = f8_all(hull->least[axis]), most = f8_all(hull->most[axis]);
        F8 a = f8_load(base + hull->near[axis]) - f8_all(hull->near_o[axis]);
        F8 b = f8_load(base + hull->far[axis]) - f8_all(hull->far_o[axis]);
        from = f8_max(f8_min(a * least, a * most), from);
        to = f8_min(f8_max(b * least, b * most), to);
    }
    f8_store(near, from);
    return i8_bits(from <= to);
}

// As node_test, box by box: the rays that meet child `slot`, and where they enter.
static inline unsigned rays_enter(const RayPacket *p, const TreeNode *node, int slot,
                                  const RaysHull *hull, float *near) {
    const float *base = &node->low[0][0] + slot;
    unsigned met = 0;
    for (int i = 0; i < RAYS; i += FLOATS) {
        WF from, to;
        for (int axis = 0; axis < 3; axis++) {
            WF o = wf_load(p->start[axis] + i), inverse = wf_load(p->inverse[axis] + i);
            WF in = (base[hull->near[axis]] - o) * inverse;
            WF out = (base[hull->far[axis]] - o) * inverse;
            from = axis == 0 ? in : wf_max(in, from);
            to = axis == 0 ? out : wf_min(out, to);
        }
        from = wf_max(wf_load(p->s_min + i), from);
        to = wf_min(wf_load(p->s_max + i), to);
        wf_store(near + i, from);
        met |= wf_le(from, to) << i;
    }
    return met;
}

typedef struct {
    float near;
    uint32_t child, node; // child of that node
    uint16_t slot, rays;
} RaysEntry;

// Pushes those of a node's children that the hull meets, the nearest on top.
static inline int rays_push(const RayPacket *p, uint32_t number, unsigned rays,
                            const RaysHull *hull, RaysEntry *stack, int top) {
    const TreeNode *node = &p->accel->tree.nodes[number];
    float near[TREE_WIDTH];
    int base = top;
    for (unsigned met = hull_test(node, hull, near); met; met &= met - 1) {
        int slot = __builtin_ctz(met);
        RaysEntry entry = {near[slot], node->child[slot], number, (uint16_t)slot, (uint16_t)rays};
        int place = top++;
        for (; place > base && stack[place - 1].near < entry.near; place--)
            stack[place] = stack[place - 1];
        stack[place] = entry;
    }
    return top;
}

// Rays that go the same way.
static void rays_walk(RayPacket *p, unsigned rays) {
    const Tree *tree = &p->accel->tree;
    RaysEntry stack[TREE_STACK];
    RAYS_ALIGNED float near[RAYS] = {0.0f};
    RaysHull hull;
    if (tree->root & TREE_LEAF) {
        rays_visit_leaf(p, tree->root & ~TREE_LEAF, rays, near);
        return;
    }
    hull_of(p, rays, &hull);
    hull_cut(p, rays, &hull);
    int top = rays_push(p, tree->root, rays, &hull, stack, 0);
    while (top > 0) {
        const RaysEntry at = stack[--top];
        if (at.near > hull.s_max)
            continue;
        unsigned met = at.rays & rays & rays_enter(p, &tree->nodes[at.node], at.slot, &hull, near);
        if (__builtin_popcount(met) <= FEW_RAYS) {
            for (unsigned few = met; few; few &= few - 1)
                tree_of_ray(p, __builtin_ctz(few), at.child, near[__builtin_ctz(few)]);
        } else if (at.child & TREE_LEAF) {
            rays_visit_leaf(p, at.child & ~TREE_LEAF, met, near);
        } else {
            top = rays_push(p, at.child, met, &hull, stack, top);
            continue;
        }
        if (!met)
            continue;
        if (p->kind == QUERY_ANY) {
            rays &= ~p->found;
            if (!rays)
                return;
        } else {
            hull_cut(p, rays, &hull);
        }
    }
}

static unsigned same_way(const RayPacket *p, unsigned rays) {
    unsigned first = rays & -rays;
    for (int axis = 0; axis < 3; axis++)
        rays &= p->back[axis] & first ? p->back[axis] : ~p->back[axis];
    return rays;
}

static PacketAnswer packet_query(const Packet *packet) {
    RayPacket p;
    rays_begin(&p, packet);
    for (unsigned rest = p.enter; rest;) {
        unsigned group = same_way(&p, rest);
        rest &= ~group;
        if (__builtin_popcount(group) <= FEW_RAYS)
            p.left |= group;
        else
            rays_walk(&p, group);
    }
    if (p.kind == QUERY_NEAREST) {
        for (unsigned found = p.found; found; found &= found - 1)
            write_hit(&p, __builtin_ctz(found), &packet->hits[__builtin_ctz(found)]);
    }
    return (PacketAnswer){p.found, p.left};
}

#endif
