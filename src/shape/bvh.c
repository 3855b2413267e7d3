// SPDX-License-Identifier: MIT
// The tree is built from the top: a node's range is cut in two by the surface area heuristic over
// bins of the centres (Wald 2007), the larger part again, until there are four parts or all are
// small. bvh_walk.h walks it.
#include "shape/bvh.h"

#include "base/array.h"

#include <assert.h>
#include <float.h>
#include <string.h>

enum { BINS = 16 };

// ---- building -------------------------------------------------------------------------------

typedef struct {
    uint32_t first, count, depth;
    Box box;
} Range;

typedef struct {
    const Box *boxes;
    uint32_t *items;
} Builder;

static Vec3 center(const Box *b) {
    return vec3(0.5 * b->low.x + 0.5 * b->high.x, 0.5 * b->low.y + 0.5 * b->high.y,
                0.5 * b->low.z + 0.5 * b->high.z);
}

static double half_area(const Box *b) {
    Vec3 d = vec_sub(b->high, b->low);
    return d.x >= 0.0 ? d.x * d.y + d.y * d.z + d.z * d.x : 0.0;
}

static Box box_of(const Builder *b, uint32_t first, uint32_t count) {
    Box box = box_empty();
    for (uint32_t i = first; i < first + count; i++)
        box = box_union(box, b->boxes[b->items[i]]);
    return box;
}

// Maps a centre to a bin along an axis.
typedef struct {
    int axis;
    double low, scale;
} Binning;

static int bin_of(const Binning *binning, const Box *box) {
    double x = (vec_get(center(box), binning->axis) - binning->low) * binning->scale;
    return x >= BINS - 1 ? BINS - 1 : x > 0.0 ? (int)x : 0;
}

// Cost of the best cut along the axis; *cut: bins below it go left. INFINITY when all is one bin.
static double best_cut(const Builder *b, const Range *range, const Binning *binning, int *cut) {
    Box boxes[BINS];
    uint32_t counts[BINS] = {0};
    for (int i = 0; i < BINS; i++)
        boxes[i] = box_empty();
    for (uint32_t i = range->first; i < range->first + range->count; i++) {
        const Box *box = &b->boxes[b->items[i]];
        int bin = bin_of(binning, box);
        boxes[bin] = box_union(boxes[bin], *box);
        counts[bin]++;
    }
    double right_cost[BINS];
    Box box = box_empty();
    uint32_t count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        box = box_union(box, boxes[i]);
        count += counts[i];
        right_cost[i] = count ? half_area(&box) * count : INFINITY;
    }
    double best = INFINITY;
    box = box_empty();
    count = 0;
    for (int i = 1; i < BINS; i++) {
        box = box_union(box, boxes[i - 1]);
        count += counts[i - 1];
        double cost = count ? half_area(&box) * count + right_cost[i] : INFINITY;
        if (cost < best)
            best = cost, *cut = i;
    }
    return best;
}

// Cuts range in two parts, neither empty. range->count > 1.
static void split(const Builder *b, const Range *range, Range parts[2]) {
    uint32_t left = range->count / 2;
    Box centers = box_empty();
    for (uint32_t i = range->first; i < range->first + range->count; i++)
        centers = box_extend(centers, center(&b->boxes[b->items[i]]));
    Binning best_binning = {0, 0, 0};
    double best = INFINITY;
    int best_bin = 0;
    for (int axis = 0; axis < 3 && range->depth < BVH_SAH_DEPTH; axis++) {
        double low = vec_get(centers.low, axis), size = vec_get(centers.high, axis) - low;
        Binning binning = {axis, low, BINS / size};
        int cut = 0;
        if (!(size > 0.0) || !isfinite(binning.scale))
            continue;
        double cost = best_cut(b, range, &binning, &cut);
        if (cost < best)
            best = cost, best_bin = cut, best_binning = binning;
    }
    if (best < INFINITY) {
        uint32_t *items = b->items + range->first, end = range->count;
        left = 0;
        while (left < end) {
            if (bin_of(&best_binning, &b->boxes[items[left]]) < best_bin) {
                left++;
            } else {
                uint32_t item = items[left];
                items[left] = items[--end];
                items[end] = item;
            }
        }
    }
    assert(left > 0 && left < range->count);
    uint32_t depth = range->depth + 1, right = range->count - left;
    parts[0] = (Range){range->first, left, depth, box_of(b, range->first, left)};
    parts[1] = (Range){range->first + left, right, depth, box_of(b, range->first + left, right)};
}

static int part_to_split(const Range *parts, int count) {
    int best = -1;
    for (int i = 0; i < count; i++)
        if (parts[i].count > 1 &&
            (best < 0 || half_area(&parts[i].box) > half_area(&parts[best].box)))
            best = i;
    return best;
}

// Single precision, outwards. The pad is for the rounding of those who find the hits: it is 2^28
// times that of a double of the box' own size or distance from the origin.
static void store_box(BvhNode *node, int lane, const Box *box) {
    double reach = 0.0;
    for (int axis = 0; axis < 3; axis++)
        reach = fmax(reach, fmax(fabs(vec_get(box->low, axis)), fabs(vec_get(box->high, axis))));
    double pad = 0x1p-24 * reach;
    for (int axis = 0; axis < 3; axis++) {
        double low = vec_get(box->low, axis) - pad, high = vec_get(box->high, axis) + pad;
        node->low[axis][lane] = nextafterf((float)fmax(low, -FLT_MAX), -INFINITY);
        node->high[axis][lane] = nextafterf((float)fmin(high, FLT_MAX), INFINITY);
    }
}

static void clear_node(BvhNode *node) {
    memset(node, 0, sizeof *node);
    for (int axis = 0; axis < 3; axis++)
        for (int lane = 0; lane < BVH_WIDTH; lane++)
            node->low[axis][lane] = FLT_MAX, node->high[axis][lane] = -FLT_MAX;
}

Bvh bvh_build(const Box *boxes, uint32_t count, Arena *arena) {
    Bvh bvh = {.item_count = count};
    if (count == 0)
        return bvh;
    bvh.items = ARENA_ARRAY(arena, uint32_t, count);
    for (uint32_t i = 0; i < count; i++)
        bvh.items[i] = i;
    const Builder b = {boxes, bvh.items};
    ARRAY(BvhNode) nodes = {0};
    // Nodes still to be filled; the last first, so that a subtree stays together in memory.
    struct Work {
        uint32_t node;
        Range range;
    };
    ARRAY(struct Work) work = {0};
    BvhNode empty;
    clear_node(&empty);
    array_push(&nodes, empty);
    array_push(&work, ((struct Work){0, {0, count, 0, box_of(&b, 0, count)}}));
    while (work.count > 0) {
        uint32_t n = work.items[--work.count].node;
        Range parts[BVH_WIDTH] = {work.items[work.count].range};
        int part_count = 1;
        for (int chosen; part_count < BVH_WIDTH && (chosen = part_to_split(parts, part_count)) >= 0;
             part_count++) {
            Range halves[2];
            split(&b, &parts[chosen], halves);
            parts[chosen] = halves[0];
            parts[part_count] = halves[1];
        }
        for (int i = 0; i < part_count; i++) {
            store_box(&nodes.items[n], i, &parts[i].box);
            if (parts[i].count == 1) {
                nodes.items[n].child[i] = parts[i].first | BVH_LEAF;
                continue;
            }
            nodes.items[n].child[i] = (uint32_t)nodes.count;
            array_push(&work, ((struct Work){(uint32_t)nodes.count, parts[i]}));
            array_push(&nodes, empty);
        }
    }
    bvh.node_count = (uint32_t)nodes.count;
    bvh.nodes = arena_copy(arena, nodes.items, nodes.count * sizeof *nodes.items);
    array_free(&nodes);
    array_free(&work);
    return bvh;
}

// ---- points --------------------------------------------------------------------------------

bool bvh_walk_point(const Bvh *bvh, Vec3 p, BvhVisitPoint visit, void *context) {
    uint32_t stack[BVH_STACK];
    int size = 0;
    if (bvh->node_count == 0)
        return false;
    stack[size++] = 0;
    while (size > 0) {
        const BvhNode *node = &bvh->nodes[stack[--size]];
        for (int k = 0; k < BVH_WIDTH; k++) {
            if (!(p.x >= (double)node->low[0][k] && p.x <= (double)node->high[0][k] &&
                  p.y >= (double)node->low[1][k] && p.y <= (double)node->high[1][k] &&
                  p.z >= (double)node->low[2][k] && p.z <= (double)node->high[2][k]))
                continue;
            uint32_t child = node->child[k];
            if (!(child & BVH_LEAF)) {
                assert(size < BVH_STACK);
                stack[size++] = child;
            } else if (visit(context, child & ~BVH_LEAF)) {
                return true;
            }
        }
    }
    return false;
}
