// SPDX-License-Identifier: MIT
#include "ray_oracle_set.h"

#include <stdlib.h>

enum {
    CUBIC_LEVELS = 3,   // of a patch's tree: 4^levels leaves
    HIGH_LEVELS = 2,    // of degrees above 4
    MANY_LEVELS = 1,    // where there are more than
    MANY = 256,         // patches
    VERY_MANY = 100000, // and of so many none is cut
};

// Control points of a part, x, y, z and weights as in OracleLeaf, not rounded to double yet: each
// level of halving errs by 2^-64 of the largest in size. Averages of positive weights keep their
// relative accuracy, so point = net / weight does as well.
typedef struct {
    int nu, nv;
    bool rational;
    Real p[4][ORACLE_POINTS];
} Net;

// ---- Nets

static int count_of(const Net *net) { return (net->nu + 1) * (net->nv + 1); }

static Real power_above(Real most) {
    int exponent;
    frexpl(most > 0 ? most : 1, &exponent);
    return ldexpl(1.0L, exponent);
}

static void net_of(const PatchDef *def, OraclePatch *patch, Net *net) {
    net->nu = (int)def->degree_u;
    net->nv = (int)def->degree_v;
    net->rational = def->weights != NULL;
    int count = count_of(net);
    Real most = 0, heaviest = 0;
    patch->def = def;
    patch->corner = def->points[0];
    for (int k = 0; k < count; k++) {
        for (int axis = 0; axis < 3; axis++) {
            Real r = (Real)vec_get(def->points[k], axis) - vec_get(patch->corner, axis);
            net->p[axis][k] = r;
            most = fabsl(r) > most ? fabsl(r) : most;
        }
        if (def->weights)
            heaviest = def->weights[k] > heaviest ? def->weights[k] : heaviest;
    }
    patch->scale = power_above(most);
    patch->inverse = 1.0L / patch->scale;
    Real weight = def->weights ? 1.0L / power_above(heaviest) : 1.0L;
    for (int k = 0; k < count; k++) {
        Real w = def->weights ? weight * def->weights[k] : 1.0L;
        net->p[3][k] = w;
        for (int axis = 0; axis < 3; axis++)
            net->p[axis][k] *= patch->inverse * w;
    }
}

// The first half stays in `low`.
static void halve(Net *low, Net *high, bool along_u) {
    int nu = low->nu, nv = low->nv;
    high->nu = nu, high->nv = nv, high->rational = low->rational;
    for (int c = 0; c < 4; c++) {
        for (int j = 0; along_u && j <= nv; j++)
            oracle_halve_line(low->p[c] + j, high->p[c] + j, nu, nv + 1);
        for (int i = 0; !along_u && i <= nu; i++)
            oracle_halve_line(low->p[c] + i * (nv + 1), high->p[c] + i * (nv + 1), nv, 1);
    }
}

static void leaf_of(const Net *net, OracleLeaf *leaf) {
    int count = count_of(net);
    for (int axis = 0; axis < 4; axis++) {
        double most = 0.0;
        for (int k = 0; k < count; k++) {
            double x = (double)net->p[axis][k];
            if (axis < 3 || net->rational)
                leaf->net[axis * count + k] = x;
            most = fabs(x) > most ? fabs(x) : most;
        }
        *(axis < 3 ? &leaf->most[axis] : &leaf->most_weight) = most;
    }
}

void oracle_patch_whole(const PatchDef *def, OraclePatch *patch, OracleLeaf *leaf, double *net) {
    Net whole;
    net_of(def, patch, &whole);
    *leaf = (OracleLeaf){.wu = 1.0, .wv = 1.0, .net = net};
    leaf_of(&whole, leaf);
}

// ---- Boxes

static double down(Real x) { return nextafter((double)x, -INFINITY); }

static double up(Real x) { return nextafter((double)x, INFINITY); }

static void box_of(const OraclePatch *patch, const Net *net, OracleNode *node, int lane) {
    for (int axis = 0; axis < 3; axis++) {
        Real low = INFINITY, high = -INFINITY;
        for (int k = 0; k < count_of(net); k++) {
            Real x = net->p[axis][k] / net->p[3][k];
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        // The sum is rounded to 2^-64 of itself, less than the step to the next double.
        Real c = vec_get(patch->corner, axis), error = ORACLE_NET_ERROR * patch->scale;
        node->low[axis][lane] = down(c + (low * patch->scale - error));
        node->high[axis][lane] = up(c + (high * patch->scale + error));
    }
}

static void box_over(OracleNode *node, int lane, const OracleNode *from) {
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < 4; k++) {
            if (from->child[k] == ORACLE_NOTHING)
                continue;
            low = fmin(low, from->low[axis][k]);
            high = fmax(high, from->high[axis][k]);
        }
        node->low[axis][lane] = low;
        node->high[axis][lane] = high;
    }
}

static const OracleNode NO_NODE = {
    .child = {ORACLE_NOTHING, ORACLE_NOTHING, ORACLE_NOTHING, ORACLE_NOTHING}};

// ---- One patch

typedef struct {
    RayOracleSet *set;
    Arena *arena;
    int patch;
    double *nets; // room for those of this patch's leaves
} Cutter;

// Which direction is longer in space? So a part at a side that is a point is not cut into slices
// that all contain it, nor a ribbon along its length.
static bool longer_in_u(const Net *net) {
    int nu = net->nu, nv = net->nv;
    Real along_u = 0, along_v = 0;
    for (int axis = 0; axis < 3; axis++) {
        const Real *p = net->p[axis];
        for (int i = 0; i <= nu; i++) {
            for (int j = 0; j <= nv; j++) {
                int k = i * (nv + 1) + j;
                Real du = i > 0 ? nu * fabsl(p[k] - p[k - nv - 1]) : 0;
                Real dv = j > 0 ? nv * fabsl(p[k] - p[k - 1]) : 0;
                along_u = du > along_u ? du : along_u;
                along_v = dv > along_v ? dv : along_v;
            }
        }
    }
    return along_u >= along_v;
}

typedef struct {
    double u, v, wu, wv;
} Rect;

static void halve_both(Net *low, Net *high, Rect *first, Rect *second) {
    bool along_u = longer_in_u(low);
    halve(low, high, along_u);
    *(along_u ? &first->wu : &first->wv) *= 0.5;
    *second = *first;
    if (along_u)
        second->u += first->wu;
    else
        second->v += first->wv;
}

static void add_leaf(Cutter *cutter, const Net *net, OracleNode *node, int lane, Rect rect) {
    RayOracleSet *set = cutter->set;
    OracleLeaf *leaf = &set->leaves[set->leaf_count];
    *leaf =
        (OracleLeaf){.u = rect.u, .v = rect.v, .wu = rect.wu, .wv = rect.wv, .net = cutter->nets};
    leaf_of(net, leaf);
    cutter->nets += (net->rational ? 4 : 3) * count_of(net);
    box_of(&set->patches[cutter->patch], net, node, lane);
    node->child[lane] = ~set->leaf_count++;
}

// Cuts the part into four, and so on for `levels` in all. Returns the node over it. The part is
// lost.
static int32_t cut(Cutter *cutter, Net *part, int levels, Rect rect) {
    RayOracleSet *set = cutter->set;
    int32_t own = set->node_count++;
    OracleNode *node = &set->nodes[own];
    *node = NO_NODE;
    node->patch = cutter->patch;
    Net other[3], *quarter[4] = {part, &other[0], &other[1], &other[2]};
    Rect rects[4] = {rect};
    halve_both(quarter[0], quarter[2], &rects[0], &rects[2]);
    halve_both(quarter[0], quarter[1], &rects[0], &rects[1]);
    halve_both(quarter[2], quarter[3], &rects[2], &rects[3]);
    for (int k = 0; k < 4; k++) {
        if (levels > 1) {
            node->child[k] = cut(cutter, quarter[k], levels - 1, rects[k]);
            box_over(node, k, &set->nodes[node->child[k]]);
        } else {
            add_leaf(cutter, quarter[k], node, k, rects[k]);
        }
    }
    return own;
}

static int32_t leave_whole(Cutter *cutter, const Net *net) {
    RayOracleSet *set = cutter->set;
    int32_t own = set->node_count++;
    set->nodes[own] = NO_NODE;
    set->nodes[own].patch = cutter->patch;
    add_leaf(cutter, net, &set->nodes[own], 0, (Rect){0.0, 0.0, 1.0, 1.0});
    return own;
}

static int levels_of(const RayOracleSet *set, const PatchDef *def) {
    if (set->count > MANY)
        return set->count > VERY_MANY ? 0 : MANY_LEVELS;
    return def->degree_u > 4 || def->degree_v > 4 ? HIGH_LEVELS : CUBIC_LEVELS;
}

static int32_t cut_patch(RayOracleSet *set, Arena *arena, int patch) {
    const PatchDef *def = &set->defs[patch];
    Net net;
    net_of(def, &set->patches[patch], &net);
    int levels = levels_of(set, def);
    size_t leaves = (size_t)1 << 2 * levels, axes = net.rational ? 4 : 3;
    Cutter cutter = {set, arena, patch,
                     ARENA_ARRAY(arena, double, leaves *axes *(size_t)count_of(&net))};
    if (levels == 0)
        return leave_whole(&cutter, &net);
    return cut(&cutter, &net, levels, (Rect){0.0, 0.0, 1.0, 1.0});
}

// ---- All

typedef struct {
    int32_t node;
    double middle[3];
} Place;

static int by_axis(const void *a, const void *b, void *context) {
    int axis = *(const int *)context;
    double x = ((const Place *)a)->middle[axis], y = ((const Place *)b)->middle[axis];
    return x < y ? -1 : x > y;
}

// Sorted along the longest axis of the places.
static void sort(Place *places, int count) {
    int axis = 0;
    double longest = -1.0;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int n = 0; n < count; n++) {
            low = fmin(low, places[n].middle[k]);
            high = fmax(high, places[n].middle[k]);
        }
        if (0.5 * high - 0.5 * low > longest)
            axis = k, longest = 0.5 * high - 0.5 * low;
    }
    qsort_r(places, (size_t)count, sizeof *places, by_axis, &axis);
}

static int32_t tree_over(RayOracleSet *set, Place *places, int count) {
    if (count == 1)
        return places[0].node;
    int32_t own = set->node_count++;
    OracleNode *node = &set->nodes[own];
    *node = NO_NODE;
    node->patch = -1;
    sort(places, count);
    int half = count / 2;
    if (count > 4) {
        sort(places, half);
        sort(places + half, count - half);
    }
    int first[5] = {0, half / 2, half, half + (count - half) / 2, count};
    for (int k = 0; k < 4; k++) {
        if (first[k + 1] == first[k])
            continue;
        node->child[k] = tree_over(set, places + first[k], first[k + 1] - first[k]);
        box_over(node, k, &set->nodes[node->child[k]]);
    }
    return own;
}

static Place place_of(const RayOracleSet *set, int32_t root) {
    OracleNode whole = NO_NODE;
    box_over(&whole, 0, &set->nodes[root]);
    Place place = {.node = root};
    for (int k = 0; k < 3; k++)
        place.middle[k] = 0.5 * whole.low[k][0] + 0.5 * whole.high[k][0];
    return place;
}

RayOracleSet *ray_oracle_prepare(Arena *arena, const PatchDef *defs, int count) {
    RayOracleSet *set = ARENA_NEW(arena, RayOracleSet);
    set->defs = defs;
    set->count = count;
    size_t leaves = 0, nodes = (size_t)count;
    for (int n = 0; n < count; n++) {
        size_t own = (size_t)1 << 2 * levels_of(set, &defs[n]);
        leaves += own;
        nodes += own > 1 ? own / 3 : 1;
    }
    set->patches = ARENA_ARRAY(arena, OraclePatch, (size_t)count);
    set->nodes = ARENA_ARRAY(arena, OracleNode, nodes);
    set->leaves = ARENA_ARRAY(arena, OracleLeaf, leaves);
    Place *places = ARENA_ARRAY(arena, Place, (size_t)count);
    for (int n = 0; n < count; n++)
        places[n] = place_of(set, cut_patch(set, arena, n));
    set->root = tree_over(set, places, count);
    return set;
}

// ---- Walking

enum { WAY_UP, WAY_DOWN, WAY_ACROSS, WAY_UNKNOWN };

// The direction is scaled to a largest component of [1/2, 1), and depths with it: so all but the
// smallest directions have inverses.
void oracle_walk_begin(OracleWalk *walk, const RayOracleSet *set, const Ray *ray, double t0,
                       double t1, double reach) {
    double most = fmax(fabs(ray->dir.x), fmax(fabs(ray->dir.y), fabs(ray->dir.z)));
    int exponent;
    frexp(most, &exponent);
    walk->set = set;
    walk->reach = reach;
    walk->t0 = t0, walk->t1 = t1;
    if (isfinite(t0))
        walk->t0 = ldexp(t0, exponent), walk->t0 -= 0x1p-50 * fabs(walk->t0) + 0x1p-1070;
    if (isfinite(t1))
        walk->t1 = ldexp(t1, exponent), walk->t1 += 0x1p-50 * fabs(walk->t1) + 0x1p-1070;
    for (int axis = 0; axis < 3; axis++) {
        double d = vec_get(ray->dir, axis), scaled = ldexp(d, -exponent);
        walk->org[axis] = vec_get(ray->org, axis);
        walk->inverse[axis] = 1.0 / scaled;
        walk->way[axis] = scaled > 0x1p-1000    ? WAY_UP
                          : scaled < -0x1p-1000 ? WAY_DOWN
                          : d == 0.0            ? WAY_ACROSS
                                                : WAY_UNKNOWN;
    }
    walk->top = 0;
    walk->stack[walk->top++] = set->root;
}

// Which of the four boxes, as bits. Differences, products and inverse err by less than 2^-51 in
// all. Comparisons with what is no number (infinite less infinite) never leave a box out.
static unsigned boxes_met(const OracleWalk *walk, const OracleNode *node) {
    double near[4], far[4];
    bool off[4] = {false, false, false, false};
    for (int k = 0; k < 4; k++)
        near[k] = walk->t0, far[k] = walk->t1;
    for (int axis = 0; axis < 3; axis++) {
        double o = walk->org[axis], s = walk->inverse[axis], pad = walk->reach;
        const double *low = node->low[axis], *high = node->high[axis];
        if (walk->way[axis] == WAY_ACROSS)
            for (int k = 0; k < 4; k++)
                off[k] |= o < low[k] - pad || o > high[k] + pad;
        if (walk->way[axis] >= WAY_ACROSS)
            continue;
        const double *from = walk->way[axis] == WAY_UP ? low : high;
        const double *to = walk->way[axis] == WAY_UP ? high : low;
        if (walk->way[axis] == WAY_DOWN)
            pad = -pad;
        for (int k = 0; k < 4; k++) {
            double a = (from[k] - pad - o) * s, b = (to[k] + pad - o) * s;
            a -= 0x1p-50 * fabs(a) + 0x1p-1070;
            b += 0x1p-50 * fabs(b) + 0x1p-1070;
            near[k] = a > near[k] ? a : near[k];
            far[k] = b < far[k] ? b : far[k];
        }
    }
    unsigned met = 0;
    for (int k = 0; k < 4; k++)
        if (node->child[k] != ORACLE_NOTHING && !off[k] && !(near[k] > far[k]))
            met |= 1u << k;
    return met;
}

bool oracle_walk_next(OracleWalk *walk, int *patch, const OracleLeaf **leaf) {
    const RayOracleSet *set = walk->set;
    while (walk->top > 0) {
        int32_t at = walk->stack[--walk->top];
        if (at < 0) { // below it lies the patch
            *patch = walk->stack[--walk->top];
            *leaf = &set->leaves[~at];
            return true;
        }
        const OracleNode *node = &set->nodes[at];
        unsigned met = boxes_met(walk, node);
        for (int k = 0; k < 4; k++) {
            if (!(met >> k & 1))
                continue;
            if (node->child[k] < 0)
                walk->stack[walk->top++] = node->patch;
            walk->stack[walk->top++] = node->child[k];
        }
    }
    return false;
}
