// SPDX-License-Identifier: MIT
#include "tests/csg_oracle.h"

#include "base/diag.h"
#include "tests/csg_shape.h"

#include <math.h>
#include <stdlib.h>

// What CSG_ORACLE_SCENE says, and POV-Ray's own limits: a hit nearer than the first is ignored, one
// nearer than the second throws no shadow; less than BAILOUT is not followed.
#define BACKGROUND 0.25L
#define AMBIENT 0.4L
#define DIFFUSE 0.6L
#define LEAST_DEPTH 1e-4L
#define SHADOW_DEPTH 1e-3L
#define BAILOUT (1.0L / 255.0L)
static const Point EYE = {0, 0, -8}, LIGHT = {5, 7, -9};

const char CSG_ORACLE_SCENE[] =
    "#version 3.7; global_settings { assumed_gamma 1 max_trace_level 100 }\n"
    "#default { finish { ambient 0.4 diffuse 0.6 } }\n"
    "camera { location <0, 0, -8> direction 1.5*z up y right 4/3*x }\n"
    "background { rgb 0.25 } light_source { <5, 7, -9>, 1 }\n";

// A node of the tree with what it has from those around it.
typedef struct Node {
    const CsgTree *tree;
    struct Node *parent, *first, *next, *clips;
    int flips; // inversions of it and around it
    SolidShape shape;
    const double *color;
} Node;

typedef struct {
    long double t;
    const Node *node;
    Point normal;
} Found;

enum { MAX_FOUND = 4096 };

struct CsgOracle {
    Arena *arena;
    Node *root;
    Node **leaves; // those that can be seen
    size_t leaf_count;
    Found found[MAX_FOUND];
    size_t found_count;
};

// ---- the tree -------------------------------------------------------------------------------

static bool is_group(const Node *node) { return node->tree->kind >= TREE_UNION; }

static size_t count_nodes(const CsgTree *tree) {
    size_t count = 1;
    for (const CsgTree *child = tree->first; child; child = child->next)
        count += count_nodes(child);
    return count;
}

// Trees that clip have no parent and are not seen.
static Node *make_node(CsgOracle *oracle, const CsgTree *tree, Node *parent, const Place *around,
                       int flips, bool seen) {
    Node *node = ARENA_NEW(oracle->arena, Node);
    Place place = csg_place_within(tree, around);
    node->tree = tree;
    node->parent = parent;
    node->flips = flips + tree->inverse;
    node->color = tree->textured || !parent ? tree->color : parent->color;
    Node **end = &node->clips;
    for (const CsgTree *clip = tree->clips; clip; clip = clip->next, end = &(*end)->next)
        *end = make_node(oracle, clip, NULL, &place, 0, false);
    end = &node->first;
    for (const CsgTree *child = tree->first; child; child = child->next, end = &(*end)->next) {
        bool cuts = tree->kind == TREE_DIFFERENCE && child != tree->first;
        *end = make_node(oracle, child, node, &place, node->flips + cuts, seen);
    }
    if (is_group(node))
        return node;
    node->shape = csg_solid_shape(tree, &place, oracle->arena);
    if (seen)
        oracle->leaves[oracle->leaf_count++] = node;
    return node;
}

CsgOracle *csg_oracle_create(const CsgTree *tree, Arena *arena) {
    CsgOracle *oracle = ARENA_NEW(arena, CsgOracle);
    Place none = csg_place_none();
    oracle->arena = arena;
    oracle->leaves = ARENA_ARRAY(arena, Node *, count_nodes(tree));
    oracle->root = make_node(oracle, tree, NULL, &none, 0, true);
    return oracle;
}

// ---- membership -----------------------------------------------------------------------------

// What an inverted union or merge is: the intersection of the inverses; and the other way round.
static bool joins_all(const Node *node) {
    bool all = node->tree->kind >= TREE_INTERSECTION;
    return all == (node->flips % 2 == 0);
}

// An inverted union has lost its inner walls, also when it is inverted once more.
static bool keeps_walls(const Node *node) {
    return node->tree->kind == TREE_UNION && node->flips == 0;
}

static bool inside(const Node *node, Point p);

static bool inside_clips(const Node *node, Point p) {
    for (const Node *clip = node->clips; clip; clip = clip->next)
        if (!inside(clip, p))
            return false;
    return true;
}

// A patch has no inside, inverted or not.
static bool inside(const Node *node, Point p) {
    if (!inside_clips(node, p))
        return false;
    if (!is_group(node))
        return node->tree->kind != TREE_PATCH &&
               csg_solid_inside(&node->shape, p) == (node->flips % 2 == 0);
    bool all = joins_all(node);
    for (const Node *child = node->first; child; child = child->next)
        if (inside(child, p) != all)
            return !all;
    return all;
}

// Is p, on the surface of the leaf, on the surface of the whole?
static bool is_seen(const Node *leaf, Point p) {
    const Node *own = leaf;
    if (!inside_clips(leaf, p))
        return false;
    for (const Node *tree = leaf->parent; tree; own = tree, tree = tree->parent) {
        bool all = joins_all(tree);
        for (const Node *child = tree->first; child && !keeps_walls(tree); child = child->next)
            if (child != own && inside(child, p) != all)
                return false;
        if (!inside_clips(tree, p))
            return false;
    }
    return true;
}

// ---- rays -----------------------------------------------------------------------------------

static int by_depth(const void *a, const void *b) {
    long double ta = ((const Found *)a)->t, tb = ((const Found *)b)->t;
    return (ta > tb) - (ta < tb);
}

static Point at(Point org, long double t, Point dir) {
    return csg_point_add(org, csg_point_scale(dir, t));
}

static void find_hits(CsgOracle *oracle, Point org, Point dir, long double least) {
    SolidRoot roots[SOLID_MAX_ROOTS];
    oracle->found_count = 0;
    for (size_t i = 0; i < oracle->leaf_count; i++) {
        const Node *leaf = oracle->leaves[i];
        int count = csg_solid_roots(&leaf->shape, org, dir, roots);
        for (int k = 0; k < count; k++) {
            if (!(roots[k].t > least) || !is_seen(leaf, at(org, roots[k].t, dir)))
                continue;
            if (oracle->found_count == MAX_FOUND)
                die("more hits than the oracle has room for");
            oracle->found[oracle->found_count++] = (Found){roots[k].t, leaf, roots[k].normal};
        }
    }
    qsort(oracle->found, oracle->found_count, sizeof *oracle->found, by_depth);
}

// How much of the light arrives at p.
static long double lit(CsgOracle *oracle, Point p) {
    Point way = csg_point_sub(LIGHT, p);
    long double distance = sqrtl(csg_point_dot(way, way)), through = 1;
    find_hits(oracle, p, csg_point_scale(way, 1 / distance), SHADOW_DEPTH);
    for (size_t i = 0; i < oracle->found_count; i++)
        if (oracle->found[i].t < distance - SHADOW_DEPTH)
            through *= oracle->found[i].node->color[3];
    return through;
}

void csg_oracle_pixel(CsgOracle *oracle, int x, int y, int width, int height, double rgb[3]) {
    Point dir = {((x + 0.5L) / width - 0.5L) * 4 / 3, 0.5L - (y + 0.5L) / height, 1.5L};
    Point from = EYE;
    dir = csg_point_unit(dir);
    long double through = 1, sum[3] = {0, 0, 0};
    while (through >= BAILOUT) {
        find_hits(oracle, from, dir, LEAST_DEPTH);
        if (oracle->found_count == 0)
            break;
        Found hit = oracle->found[0];
        Point p = at(from, hit.t, dir), to_light = csg_point_unit(csg_point_sub(LIGHT, p));
        const double *color = hit.node->color;
        bool turned = csg_point_dot(hit.normal, dir) > 0;
        long double cosine = csg_point_dot(hit.normal, to_light) * (turned ? -1 : 1);
        long double light = AMBIENT;
        if (cosine > 0)
            light += DIFFUSE * cosine * lit(oracle, p);
        for (int i = 0; i < 3; i++)
            sum[i] += through * (1 - color[3]) * light * color[i];
        through *= color[3];
        from = p;
    }
    for (int i = 0; i < 3; i++)
        rgb[i] = (double)(sum[i] + (through >= BAILOUT ? through * BACKGROUND : 0));
}
