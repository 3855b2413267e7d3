// SPDX-License-Identifier: MIT
// Builds tree.h: top down by the surface area heuristic over bins (Wald 2007), eight children a
// node by splitting the largest child again and again.
#include "patch/tree.h"

#include "base/array.h"

#include <assert.h>
#include <string.h>

enum { BINS = 16 };
#ifdef HOSTILE
enum { SERIAL = 20 };
#else
enum { SERIAL = 20000 }; // a range of no more is not worth another thread
#endif

typedef struct {
    Box box;              // of the members
    uint32_t first, last; // order[first .. last)
    bool final;           // not worth splitting
} Range;

typedef struct {
    const Box *boxes;
    uint32_t *order;
    uint32_t leaf_size;
    Tree *tree;
    ARRAY(TreeNode) nodes;
    ARRAY(uint32_t) leaf_first;
} Builder;

static double half_area(const Box *box) {
    Vec3 d = vec_sub(box->high, box->low);
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

static double middle(const Box *box, int axis) {
    return 0.5 * vec_get(box->low, axis) + 0.5 * vec_get(box->high, axis);
}

static Range make_range(const Builder *b, uint32_t first, uint32_t last) {
    Range range = {box_empty(), first, last, last - first <= 1};
    for (uint32_t i = first; i < last; i++)
        range.box = box_union(range.box, b->boxes[b->order[i]]);
    return range;
}

// What a leaf of n boxes costs: tested leaf_size at a time.
static double leaf_cost(const Builder *b, uint32_t n) {
    return (double)((n + b->leaf_size - 1) / b->leaf_size);
}

typedef struct {
    int axis; // -1: none
    int bin;  // the first bin of the right side
    double low, scale, cost;
} Split;

static int bin_of(const Split *split, double x) {
    int bin = (int)((x - split->low) * split->scale);
    return bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
}

// The best plane across one axis, if it is better than *best.
static void try_axis(const Builder *b, const Range *range, int axis, Split *best) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = range->first; i < range->last; i++) {
        double x = middle(&b->boxes[b->order[i]], axis);
        low = x < low ? x : low;
        high = x > high ? x : high;
    }
    Split split = {axis, 0, low, BINS / (high - low), 0.0};
    if (!(high > low) || !isfinite(split.scale))
        return;
    Box box[BINS], right[BINS];
    uint32_t count[BINS] = {0}, right_count[BINS];
    for (int i = 0; i < BINS; i++)
        box[i] = box_empty();
    for (uint32_t i = range->first; i < range->last; i++) {
        const Box *item = &b->boxes[b->order[i]];
        int bin = bin_of(&split, middle(item, axis));
        box[bin] = box_union(box[bin], *item);
        count[bin]++;
    }
    Box sum = box_empty();
    uint32_t n = 0;
    for (int i = BINS - 1; i > 0; i--) {
        sum = box_union(sum, box[i]);
        n += count[i];
        right[i] = sum;
        right_count[i] = n;
    }
    sum = box_empty();
    n = 0;
    for (int i = 1; i < BINS; i++) {
        sum = box_union(sum, box[i - 1]);
        n += count[i - 1];
        if (n == 0 || right_count[i] == 0)
            continue;
        split.cost =
            half_area(&sum) * leaf_cost(b, n) + half_area(&right[i]) * leaf_cost(b, right_count[i]);
        split.bin = i;
        if (best->axis < 0 || split.cost < best->cost)
            *best = split;
    }
}

// Moves the members of the left side to the front; returns where the right side begins.
static uint32_t partition(const Builder *b, const Range *range, const Split *split) {
    uint32_t left = range->first, right = range->last;
    while (left < right) {
        uint32_t item = b->order[left];
        if (bin_of(split, middle(&b->boxes[item], split->axis)) < split->bin) {
            left++;
        } else {
            b->order[left] = b->order[--right];
            b->order[right] = item;
        }
    }
    return left;
}

// Cuts a range in two; false if it had better stay whole. Many boxes in one place, or a depth that
// nears the limit, are cut in the middle of the list.
static bool cut(const Builder *b, const Range *range, int depth, Range *left, Range *right) {
    uint32_t n = range->last - range->first, at = range->first + n / 2;
    if (n <= 1)
        return false;
    Split best = {.axis = -1};
    if (depth < TREE_MAX_DEPTH / 2) {
        for (int axis = 0; axis < 3; axis++)
            try_axis(b, range, axis, &best);
    }
    if (n <= b->leaf_size) {
        // A node's test costs about as much as a leaf's.
        double whole = half_area(&range->box);
        if (best.axis < 0 || best.cost + 0.5 * whole >= whole)
            return false;
    }
    if (best.axis >= 0)
        at = partition(b, range, &best);
    *left = make_range(b, range->first, at);
    *right = make_range(b, at, range->last);
    return true;
}

static void set_child(TreeNode *node, int i, const Tree *tree, const Box *box, uint32_t child) {
    for (int axis = 0; axis < 3; axis++) {
        double c = vec_get(tree->center, axis);
        node->low[axis][i] = (float)((vec_get(box->low, axis) - c) * tree->scale) - TREE_PAD;
        node->high[axis][i] = (float)((vec_get(box->high, axis) - c) * tree->scale) + TREE_PAD;
    }
    node->child[i] = child;
}

static uint32_t make_leaf(Builder *b, const Range *range) {
    array_push(&b->leaf_first, range->first);
    return TREE_LEAF | (uint32_t)(b->leaf_first.count - 1);
}

// Into the order of their members, so that leaves are made in that order too.
static void sort_parts(Range *part, int count) {
    for (int i = 1; i < count; i++) {
        Range moved = part[i];
        int at = i;
        for (; at > 0 && part[at - 1].first > moved.first; at--)
            part[at] = part[at - 1];
        part[at] = moved;
    }
}

// Splits a range into up to TREE_WIDTH parts, the largest first; returns their number.
static int split_range(const Builder *b, const Range *range, int depth, Range part[TREE_WIDTH]) {
    Range left, right;
    int count = 1;
    part[0] = *range;
    while (count < TREE_WIDTH) {
        // Split the largest part that can be split.
        int largest = -1;
        for (int i = 0; i < count; i++) {
            if (!part[i].final &&
                (largest < 0 || half_area(&part[i].box) > half_area(&part[largest].box)))
                largest = i;
        }
        if (largest < 0)
            break;
        if (cut(b, &part[largest], depth, &left, &right)) {
            part[largest] = left;
            part[count++] = right;
        } else {
            part[largest].final = true;
        }
    }
    return count;
}

static TreeNode empty_node(void) {
    TreeNode node;
    memset(&node, 0, sizeof node);
    for (int i = 0; i < TREE_WIDTH; i++) {
        for (int axis = 0; axis < 3; axis++) {
            node.low[axis][i] = 4.0f; // a ray is cut to where |x| < 4, so this box is never met
            node.high[axis][i] = -4.0f;
        }
        node.child[i] = TREE_NONE;
    }
    return node;
}

static uint32_t make_node(Builder *b, const Range *range, int depth);

static uint32_t make_child(Builder *b, const Range *part, int depth) {
    return part->final ? make_leaf(b, part) : make_node(b, part, depth);
}

// Appends what another builder made of some part; returns its root in this one.
static uint32_t append(Builder *b, const Builder *from, uint32_t root) {
    uint32_t nodes = (uint32_t)b->nodes.count, leaves = (uint32_t)b->leaf_first.count;
    for (size_t i = 0; i < from->nodes.count; i++) {
        TreeNode node = from->nodes.items[i];
        for (int k = 0; k < TREE_WIDTH; k++) {
            if (node.child[k] != TREE_NONE)
                node.child[k] += node.child[k] & TREE_LEAF ? leaves : nodes;
        }
        array_push(&b->nodes, node);
    }
    for (size_t i = 0; i < from->leaf_first.count; i++)
        array_push(&b->leaf_first, from->leaf_first.items[i]);
    return root + (root & TREE_LEAF ? leaves : nodes);
}

// The parts of a large range, each by a task of its own. The result is what one thread would make.
static void make_parts(Builder *b, const Range *part, int count, int depth, uint32_t *roots) {
    Builder sub[TREE_WIDTH];
    uint32_t root[TREE_WIDTH];
    for (int i = 0; i < count; i++) {
        sub[i] = *b;
        memset(&sub[i].nodes, 0, sizeof sub[i].nodes);
        memset(&sub[i].leaf_first, 0, sizeof sub[i].leaf_first);
#pragma omp task shared(sub, root) firstprivate(i)
        root[i] = make_child(&sub[i], &part[i], depth + 1);
    }
#pragma omp taskwait
    for (int i = 0; i < count; i++) {
        roots[i] = append(b, &sub[i], root[i]);
        array_free(&sub[i].nodes);
        array_free(&sub[i].leaf_first);
    }
}

static uint32_t make_node(Builder *b, const Range *range, int depth) {
    assert(depth < TREE_MAX_DEPTH);
    Range part[TREE_WIDTH];
    int count = split_range(b, range, depth, part);
    if (count == 1)
        return make_leaf(b, range);
    sort_parts(part, count);
    array_push(&b->nodes, empty_node());
    uint32_t node = (uint32_t)(b->nodes.count - 1), roots[TREE_WIDTH];
    if (range->last - range->first > SERIAL) {
        make_parts(b, part, count, depth, roots);
    } else {
        for (int i = 0; i < count; i++)
            roots[i] = make_child(b, &part[i], depth + 1);
    }
    for (int i = 0; i < count; i++)
        set_child(&b->nodes.items[node], i, b->tree, &part[i].box, roots[i]);
    return node;
}

// A power of two that brings the tree into [-1,1]^3. The size is not taken below what double can
// tell apart at that place.
static double tree_scale(const Box *bounds, Vec3 center) {
    Vec3 half = vec_sub(bounds->high, center), half2 = vec_sub(center, bounds->low);
    double size = 0x1p-1000, place = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        size = fmax(size, fmax(vec_get(half, axis), vec_get(half2, axis)));
        place = fmax(place, fabs(vec_get(center, axis)));
    }
    int exponent;
    frexp(fmax(size, place * 0x1p-30), &exponent);
    return ldexp(1.0, -exponent);
}

void tree_build(Arena *arena, const Box *boxes, uint32_t count, uint32_t leaf_size, Tree *tree) {
    *tree = (Tree){.root = TREE_NONE, .bounds = box_empty(), .scale = 1.0};
    tree->order = ARENA_ARRAY(arena, uint32_t, count);
    for (uint32_t i = 0; i < count; i++)
        tree->order[i] = i;
    Builder b = {.boxes = boxes, .order = tree->order, .leaf_size = leaf_size, .tree = tree};
    if (count > 0) {
        Range all = make_range(&b, 0, count);
        tree->bounds = all.box;
        tree->center = vec3(middle(&all.box, 0), middle(&all.box, 1), middle(&all.box, 2));
        tree->scale = tree_scale(&all.box, tree->center);
        Vec3 half = vec_scale(
            vec_max(vec_sub(all.box.high, tree->center), vec_sub(tree->center, all.box.low)),
            tree->scale);
        tree->half = vec_add(
            half, vec3(4.0 * (double)TREE_PAD, 4.0 * (double)TREE_PAD, 4.0 * (double)TREE_PAD));
#pragma omp parallel if (count > SERIAL)
#pragma omp single
        tree->root = make_node(&b, &all, 0);
    }
    tree->node_count = (uint32_t)b.nodes.count;
    tree->leaf_count = (uint32_t)b.leaf_first.count;
    array_push(&b.leaf_first, count);
    tree->nodes = arena_copy(arena, b.nodes.items, b.nodes.count * sizeof(TreeNode));
    tree->leaf_first = arena_copy(arena, b.leaf_first.items, b.leaf_first.count * sizeof(uint32_t));
    array_free(&b.nodes);
    array_free(&b.leaf_first);
}

// Roundings, in units u = 2^-24 of tree space, where everything is below 1 (start: below 1 + 2^-17)
// and s below 4. With X = start + s d a point of the true box, plane `low`, d > 0: the stored low
// is off by at most u, start by u and by the error E <= 2 u of the shift in double, their
// difference by 2 u; the inverse of the rounded direction is off by 2 u of its value and the
// product by one more, that is 3 u x 2. Together under 12 u = 12/16 of TREE_PAD, so the computed
// entry never comes after the true one. Likewise for the exit. Replacing a direction component
// below 2^-60 by 2^-60 moves X by less than 2^-57.
static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

bool tree_ray_begin(const Tree *tree, const Ray *ray, double t_min, double t_max, TreeRay *out) {
    Vec3 dir = ray->dir;
    double largest = larger(fabs(dir.x), larger(fabs(dir.y), fabs(dir.z)));
    if (tree->root == TREE_NONE || !(largest > 0.0) || !isfinite(largest) || !(t_min < t_max))
        return false;
    // Squares of very large or small lengths would not fit.
    double power = 1.0;
    if (largest < 0x1p-500 || largest > 0x1p500) {
        power = largest;
        dir = vec_scale(dir, 1.0 / largest);
    }
    double length = vec_length(dir);
    out->unit = vec_scale(dir, 1.0 / length);
    out->s_per_t = length * power * tree->scale;
    const double grown = 1.0 + 4.0 * (double)TREE_PAD;
    double entry = t_min < 0.0 ? -INFINITY : 0.0, exit = INFINITY, reach = 0.0, inverse[3];
    for (int axis = 0; axis < 3; axis++) {
        double d = vec_get(out->unit, axis);
        if (fabs(d) < 0x1p-60)
            d = copysign(0x1p-60, d);
        double o = (vec_get(ray->org, axis) - vec_get(tree->center, axis)) * tree->scale;
        inverse[axis] = 1.0 / d;
        double a = (-grown - o) * inverse[axis], b = (grown - o) * inverse[axis];
        entry = larger(entry, smaller(a, b));
        exit = smaller(exit, larger(a, b));
        reach = larger(reach, fabs(o));
        out->dir[axis] = d;
        out->origin[axis] = o;
    }
    // The error of the shift: two roundings each of origin, entry x dir and their sum; and dir's
    // own rounding (four) over the way that is left.
    out->error = (reach + fabs(entry) + 4.0) * 0x1p-50;
    out->far = !(out->error < 0x1p-23);
    out->s_base = 0.0;
    out->s_min = -4.0f;
    out->s_max = 4.0f;
    if (out->far)
        return true;
    if (entry > exit)
        return false;
    out->s_base = entry;
    double s_min = t_min * out->s_per_t - entry - (double)TREE_PAD;
    out->s_min = (float)(s_min > -4.0 ? s_min : -4.0);
    tree_ray_cut(out, t_max);
    for (int axis = 0; axis < 3; axis++) {
        out->origin[axis] += entry * out->dir[axis];
        out->start[axis] = (float)out->origin[axis];
        out->inverse[axis] = (float)inverse[axis];
    }
    return out->s_min <= out->s_max;
}
