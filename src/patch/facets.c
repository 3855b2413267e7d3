// SPDX-License-Identifier: MIT
// POV-Ray's way with a patch (facts measured against POV-Ray 3.7.0.10, see tests/test_facets.c).
//
// A patch is halved in both parameters, u_steps and v_steps times or until it is flat; what is left
// is two triangles between the four corners. The triangles of a patch are tested in the order in
// which the recursion meets them. Here the recursion is stored as a list of nodes in that order,
// each with a box and the place behind its subtree, so that a ray goes through the list from front
// to back and jumps over what it misses: exactly the triangles that all tests would have found, in
// the same order.
//
// The list would outgrow the memory for many patches with many steps (65,536 leaves a patch at 8
// steps). It therefore stops at a depth at which it holds at most MAX_CELLS cells, and keeps the
// net of what is not finished there; rays that come by halve that net again, by the same code.
#include "patch/facets.h"

#include "base/array.h"
#include "patch/bernstein.h"
#include "patch/tree.h"

#include <assert.h>
#include <float.h>
#include <string.h>

#ifdef HOSTILE
enum { MAX_CELLS = 50 };
#else
enum { MAX_CELLS = 1 << 19 }; // 100 MB as quads, 260 MB as nets
#endif

enum {
    MAX_POINTS = 17 * 17,
    // More would be 2^64 triangles. POV-Ray knows no limit and does not come back.
    MAX_STEPS = 32,
};
// POV-Ray's constants.
#define TINY 1e-10     // squared sine, area, direction cosine below which nothing is computed
#define MIN_DEPTH 1e-5 // nearer hits are none

// A piece of a patch: its net, its place in the parameters, how often it was halved.
typedef struct {
    double u0, u1, v0, v1;
    int depth;
    Vec3 p[MAX_POINTS];
} Piece;

// Corners in the order (u0,v0) (u0,v1) (u1,v1) (u1,v0).
typedef struct {
    Vec3 corner[4];
    double u0, u1, v0, v1;
} Quad;

typedef struct {
    Box box;
    uint32_t end;  // the node behind the subtree
    uint32_t what; // inner node: NO_LEAF; a quad's number; with the bit UNFINISHED a net's
} Node;
#define NO_LEAF UINT32_MAX
#define UNFINISHED 0x80000000u

typedef struct {
    double u0, u1, v0, v1;
    int depth;
    size_t points; // in the nets
} Net;

struct Facets {
    const PatchDef *defs;
    uint32_t *first; // patch i owns nodes[first[i] .. first[i + 1])
    Node *nodes;
    Quad *quads;
    Net *nets;
    Vec3 *net_points;
    Tree tree; // over the patches
};

static Vec3 half_way(Vec3 a, Vec3 b) { return vec_scale(vec_add(a, b), 0.5); }

// Halves one row of n + 1 points, `step` apart: low becomes the first half, high the second. For
// cubics these are POV-Ray's six midpoints.
static void halve_row(int n, int step, const Vec3 *from, Vec3 *low, Vec3 *high) {
    Vec3 row[17];
    for (int i = 0; i <= n; i++)
        row[i] = from[i * step];
    for (int k = 0; k <= n; k++) {
        low[k * step] = row[0];
        high[(n - k) * step] = row[n - k];
        for (int i = 0; i < n - k; i++)
            row[i] = half_way(row[i], row[i + 1]);
    }
}

static void halve_u(const PatchDef *def, const Piece *from, Piece *low, Piece *high) {
    int columns = (int)def->degree_v + 1;
    for (int j = 0; j < columns; j++)
        halve_row((int)def->degree_u, columns, &from->p[j], &low->p[j], &high->p[j]);
    double middle = 0.5 * (from->u0 + from->u1);
    low->u0 = from->u0;
    low->u1 = high->u0 = middle;
    high->u1 = from->u1;
    low->v0 = high->v0 = from->v0;
    low->v1 = high->v1 = from->v1;
    low->depth = high->depth = from->depth + 1;
}

static void halve_v(const PatchDef *def, const Piece *from, Piece *low, Piece *high) {
    int columns = (int)def->degree_v + 1;
    for (int i = 0; i <= (int)def->degree_u; i++)
        halve_row((int)def->degree_v, 1, &from->p[i * columns], &low->p[i * columns],
                  &high->p[i * columns]);
    double middle = 0.5 * (from->v0 + from->v1);
    low->v0 = from->v0;
    low->v1 = high->v0 = middle;
    high->v1 = from->v1;
    low->u0 = high->u0 = from->u0;
    low->u1 = high->u1 = from->u1;
    low->depth = high->depth = from->depth + 1;
}

static Vec3 corner_of(const PatchDef *def, const Vec3 *net, int u, int v) {
    return net[(u ? (int)def->degree_u * ((int)def->degree_v + 1) : 0) +
               (v ? (int)def->degree_v : 0)];
}

// Do all points of the net lie within flatness of the plane of three corners? POV-Ray picks the
// corners so that collapsed edges do not spoil the plane; without a plane the answer is no.
static bool is_flat(const PatchDef *def, const Vec3 *net) {
    if (!(def->flatness > 0.0))
        return false;
    Vec3 a = corner_of(def, net, 0, 0), b = corner_of(def, net, 0, 1);
    Vec3 c = corner_of(def, net, 1, 0);
    if (vec_length(vec_sub(a, b)) < TINY) {
        b = corner_of(def, net, 1, 1);
        if (vec_length(vec_sub(a, b)) < TINY)
            return false;
    }
    if (vec_length(vec_sub(b, c)) < TINY)
        return false;
    Vec3 ab = vec_sub(a, b), cb = vec_sub(c, b), n = vec_cross(ab, cb);
    double square = vec_dot(n, n);
    if (square <= TINY * vec_dot(ab, ab) * vec_dot(cb, cb))
        return false;
    n = vec_scale(n, 1.0 / sqrt(square));
    double offset = vec_dot(n, a), largest = 0.0;
    for (int i = 0; i < (int)((def->degree_u + 1) * (def->degree_v + 1)); i++)
        largest = fmax(largest, fabs(vec_dot(n, net[i]) - offset));
    return largest < def->flatness;
}

static int clamp_steps(int steps) { return steps < 0 ? 0 : steps > MAX_STEPS ? MAX_STEPS : steps; }

// Which parameters the recursion halves at this piece; neither: it is a leaf.
typedef struct {
    bool u, v;
} Halving;

static Halving halving_of(const PatchDef *def, const Piece *piece) {
    Halving h = {piece->depth < clamp_steps(def->u_steps),
                 piece->depth < clamp_steps(def->v_steps)};
    if ((h.u || h.v) && is_flat(def, piece->p))
        h.u = h.v = false;
    return h;
}

// Hands the children of a piece to visit in POV-Ray's order: u low before u high, in each v low
// before v high.
typedef void (*PieceVisit)(void *context, const PatchDef *def, const Piece *piece);
static void visit_children(const PatchDef *def, const Piece *piece, Halving h, PieceVisit visit,
                           void *context) {
    Piece half[2], quarter[2];
    if (!h.u || !h.v) {
        if (h.u)
            halve_u(def, piece, &half[0], &half[1]);
        else
            halve_v(def, piece, &half[0], &half[1]);
        visit(context, def, &half[0]);
        visit(context, def, &half[1]);
        return;
    }
    halve_u(def, piece, &half[0], &half[1]);
    for (int i = 0; i < 2; i++) {
        halve_v(def, &half[i], &quarter[0], &quarter[1]);
        for (int k = 0; k < 2; k++) {
            quarter[k].depth = piece->depth + 1;
            visit(context, def, &quarter[k]);
        }
    }
}

static void whole_patch(const PatchDef *def, Piece *out) {
    out->u0 = out->v0 = 0.0;
    out->u1 = out->v1 = 1.0;
    out->depth = 0;
    memcpy(out->p, def->points, (def->degree_u + 1) * (def->degree_v + 1) * sizeof(Vec3));
}

// The box of everything that a ray may hit in the piece. The triangles lie in the hull of the net,
// but a hit may be accepted a little outside its triangle: the barycentrics come from an inverse
// whose relative error is about 2^-52 over the sine of the triangle's corner, which is above 1e-5,
// so they are off by less than 1e-9; and the hit point, of the size of the points, by a few
// 2^-53 of it. What the ray's own size adds is added by the ray.
static Box piece_box(const PatchDef *def, const Vec3 *net) {
    Box box = box_empty();
    for (uint32_t i = 0; i < (def->degree_u + 1) * (def->degree_v + 1); i++)
        box = box_extend(box, net[i]);
    double size = 0.0, place = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double low = vec_get(box.low, axis), high = vec_get(box.high, axis);
        size = fmax(size, high - low);
        place = fmax(place, fmax(fabs(low), fabs(high)));
    }
    double pad = 1e-9 * size + 1e-14 * place;
    Vec3 grow = vec3(pad, pad, pad);
    return (Box){vec_sub(box.low, grow), vec_add(box.high, grow)};
}

static Quad piece_quad(const PatchDef *def, const Piece *piece) {
    return (Quad){{corner_of(def, piece->p, 0, 0), corner_of(def, piece->p, 0, 1),
                   corner_of(def, piece->p, 1, 1), corner_of(def, piece->p, 1, 0)},
                  piece->u0,
                  piece->u1,
                  piece->v0,
                  piece->v1};
}

// ---- Preparation

typedef struct {
    int max_depth;
    size_t cells;    // leaves and unfinished pieces so far
    bool unfinished; // some piece went on below max_depth
    ARRAY(Node) nodes;
    ARRAY(Quad) quads;
    ARRAY(Net) nets;
    ARRAY(Vec3) net_points;
} Builder;

static void count_piece(void *context, const PatchDef *def, const Piece *piece) {
    Builder *b = context;
    Halving h = halving_of(def, piece);
    if ((h.u || h.v) && piece->depth < b->max_depth && b->cells <= MAX_CELLS) {
        visit_children(def, piece, h, count_piece, b);
        return;
    }
    b->cells++;
    b->unfinished |= h.u || h.v;
}

// The greatest depth at which all patches together have at most MAX_CELLS cells.
static int choose_depth(const PatchDef *defs, size_t count) {
    for (int depth = 0;; depth++) {
        Builder b = {.max_depth = depth + 1};
        for (size_t i = 0; i < count && b.cells <= MAX_CELLS; i++) {
            Piece piece;
            whole_patch(&defs[i], &piece);
            count_piece(&b, &defs[i], &piece);
        }
        if (b.cells > MAX_CELLS)
            return depth;
        if (!b.unfinished)
            return depth + 1;
    }
}

static void store_piece(void *context, const PatchDef *def, const Piece *piece) {
    Builder *b = context;
    size_t at = b->nodes.count;
    array_push(&b->nodes, ((Node){piece_box(def, piece->p), 0, NO_LEAF}));
    Halving h = halving_of(def, piece);
    if (!h.u && !h.v) {
        b->nodes.items[at].what = (uint32_t)b->quads.count;
        array_push(&b->quads, piece_quad(def, piece));
    } else if (piece->depth < b->max_depth) {
        visit_children(def, piece, h, store_piece, b);
    } else {
        b->nodes.items[at].what = UNFINISHED | (uint32_t)b->nets.count;
        array_push(&b->nets, ((Net){piece->u0, piece->u1, piece->v0, piece->v1, piece->depth,
                                    b->net_points.count}));
        for (uint32_t i = 0; i < (def->degree_u + 1) * (def->degree_v + 1); i++)
            array_push(&b->net_points, piece->p[i]);
    }
    b->nodes.items[at].end = (uint32_t)b->nodes.count;
}

Facets *facets_create(Arena *arena, const PatchDef *defs, size_t count) {
    Facets *f = ARENA_NEW(arena, Facets);
    f->defs = defs;
    f->first = ARENA_ARRAY(arena, uint32_t, count + 1);
    Builder b = {.max_depth = choose_depth(defs, count)};
    ARRAY(Box) boxes = {0};
    for (size_t i = 0; i < count; i++) {
        Piece piece;
        whole_patch(&defs[i], &piece);
        store_piece(&b, &defs[i], &piece);
        f->first[i + 1] = (uint32_t)b.nodes.count;
        array_push(&boxes, b.nodes.items[f->first[i]].box);
    }
    f->nodes = arena_copy(arena, b.nodes.items, b.nodes.count * sizeof(Node));
    f->quads = arena_copy(arena, b.quads.items, b.quads.count * sizeof(Quad));
    f->nets = arena_copy(arena, b.nets.items, b.nets.count * sizeof(Net));
    f->net_points = arena_copy(arena, b.net_points.items, b.net_points.count * sizeof(Vec3));
    array_free(&b.nodes);
    array_free(&b.quads);
    array_free(&b.nets);
    array_free(&b.net_points);
    tree_build(arena, boxes.items, (uint32_t)count, 1, &f->tree);
    array_free(&boxes);
    return f;
}

// ---- Rays

typedef struct {
    double t, a, b; // depth and the weights of the second and third corner
    Vec2 uv[3];     // of the triangle's corners
    uint32_t patch;
} TriangleHit;

typedef struct {
    const Facets *facets;
    Query *query;
    TriangleHit best;
    Vec3 inverse; // 1 / dir
    double pad;   // rounding that the ray's own size brings
    double t_min; // POV-Ray's and the caller's limit
    uint32_t patch;
} Walk;

static inline Vec3 normal_of(const Vec3 *points, int nu, int nv, Vec2 at) {
    double wu[17], du[17], wv[17], dv[17];
    bernstein(nu, at.u, wu, du);
    bernstein(nv, at.v, wv, dv);
    Vec3 su = vec3(0, 0, 0), sv = vec3(0, 0, 0);
    for (int i = 0; i <= nu; i++) {
        for (int j = 0; j <= nv; j++, points++) {
            su = vec_madd(su, du[i] * wv[j], *points);
            sv = vec_madd(sv, wu[i] * dv[j], *points);
        }
    }
    Vec3 n = vec_cross(su, sv);
    double square = vec_dot(n, n);
    if (square <= TINY * vec_dot(su, su) * vec_dot(sv, sv))
        return vec3(1, 0, 0);
    return vec_scale(n, 1.0 / sqrt(square));
}

// The unit normal of the patch, or x where an edge has collapsed, as POV-Ray has it.
static Vec3 true_normal(const PatchDef *def, Vec2 at) {
    if (def->degree_u == 3 && def->degree_v == 3)
        return normal_of(def->points, 3, 3, at); // a copy with loops of known length
    return normal_of(def->points, (int)def->degree_u, (int)def->degree_v, at);
}

static PatchHit finish_hit(const Facets *f, const TriangleHit *hit) {
    const PatchDef *def = &f->defs[hit->patch];
    double r = 1.0 - hit->a - hit->b;
    Vec3 n = vec_scale(true_normal(def, hit->uv[0]), r);
    n = vec_madd(n, hit->a, true_normal(def, hit->uv[1]));
    n = vec_madd(n, hit->b, true_normal(def, hit->uv[2]));
    double square = vec_dot(n, n);
    n = square > TINY ? vec_scale(n, 1.0 / sqrt(square)) : vec3(1, 0, 0);
    return (PatchHit){.t = hit->t,
                      .u = r * hit->uv[0].u + hit->a * hit->uv[1].u + hit->b * hit->uv[2].u,
                      .v = r * hit->uv[0].v + hit->a * hit->uv[1].v + hit->b * hit->uv[2].v,
                      .normal = n,
                      .bound = 0.0,
                      .id = def->id};
}

static void take_triangle(Walk *walk, const TriangleHit *hit) {
    Query *query = walk->query;
    if (hit->t < walk->t_min || hit->t > query->t_max)
        return;
    if (hit->t == query->t_max) {
        bool wins = query->kind == QUERY_NEAREST && query->found && hit->patch <= walk->best.patch;
        if (!wins)
            return;
    }
    switch (query->kind) {
    case QUERY_NEAREST:
        query->found = true;
        query->t_max = hit->t;
        walk->best = *hit;
        break;
    case QUERY_ANY:
        query->found = true;
        break;
    case QUERY_ALL: {
        PatchHit full = finish_hit(walk->facets, hit);
        query_take(query, &full);
        break;
    }
    }
}

// The rows p1 - p0, p2 - p0 and the normal form a matrix whose inverse turns a point into depth and
// weights. The order of operations is the one that gives POV-Ray's bits.
static void test_triangle(Walk *walk, const Vec3 p[3], const Vec2 uv[3]) {
    walk->query->stats.steps++;
    Vec3 x = vec_sub(p[1], p[0]), y = vec_sub(p[2], p[0]), z = vec_cross(x, y);
    double square = vec_dot(z, z);
    if (square <= TINY * vec_dot(x, x) * vec_dot(y, y))
        return;
    z = vec_scale(z, 1.0 / sqrt(square));
    double det = x.x * y.y * z.z + x.y * y.z * z.x + x.z * y.x * z.y - x.z * y.y * z.x -
                 x.x * y.z * z.y - x.y * y.x * z.z;
    if (fabs(det) < TINY)
        return;
    det = 1.0 / det;
    // The columns of the inverse.
    Vec3 to_a = vec3((y.y * z.z - y.z * z.y) * det, (y.z * z.x - y.x * z.z) * det,
                     (y.x * z.y - y.y * z.x) * det);
    Vec3 to_b = vec3((x.z * z.y - x.y * z.z) * det, (x.x * z.z - x.z * z.x) * det,
                     (x.y * z.x - x.x * z.y) * det);
    Vec3 to_n = vec3((x.y * y.z - x.z * y.y) * det, (x.z * y.x - x.x * y.z) * det,
                     (x.x * y.y - x.y * y.x) * det);
    const Ray *ray = &walk->query->ray;
    double q = vec_dot(ray->dir, to_n);
    if (fabs(q) < TINY)
        return;
    TriangleHit hit = {.t = vec_dot(vec_sub(p[0], ray->org), to_n) / q,
                       .uv = {uv[0], uv[1], uv[2]},
                       .patch = walk->patch};
    if (!(hit.t >= MIN_DEPTH))
        return;
    Vec3 at = vec_sub(vec_madd(ray->org, hit.t, ray->dir), p[0]);
    hit.a = vec_dot(at, to_a);
    hit.b = vec_dot(at, to_b);
    if (hit.a < 0.0 || hit.b < 0.0 || hit.a + hit.b > 1.0)
        return;
    take_triangle(walk, &hit);
}

static void test_quad(Walk *walk, const Quad *q) {
    const Vec2 uv[4] = {{q->u0, q->v0}, {q->u0, q->v1}, {q->u1, q->v1}, {q->u1, q->v0}};
    test_triangle(walk, q->corner, uv);
    const Vec3 p[3] = {q->corner[0], q->corner[2], q->corner[3]};
    const Vec2 uv_other[3] = {uv[0], uv[2], uv[3]};
    test_triangle(walk, p, uv_other);
}

static inline void clip(double low, double high, double o, double inverse, double *near,
                        double *far) {
    double a = (low - o) * inverse, b = (high - o) * inverse;
    double from = a < b ? a : b, to = a < b ? b : a;
    *near = from > *near ? from : *near;
    *far = to < *far ? to : *far;
}

// Conservative: the box is padded by more than the roundings here.
static inline bool meets_box(const Walk *walk, const Box *box) {
    const Vec3 o = walk->query->ray.org, inverse = walk->inverse;
    const double pad = walk->pad;
    double near = walk->t_min, far = walk->query->t_max;
    clip(box->low.x - pad, box->high.x + pad, o.x, inverse.x, &near, &far);
    clip(box->low.y - pad, box->high.y + pad, o.y, inverse.y, &near, &far);
    clip(box->low.z - pad, box->high.z + pad, o.z, inverse.z, &near, &far);
    return near <= far;
}

// What the list does not hold: the recursion itself.
static void test_piece(void *context, const PatchDef *def, const Piece *piece) {
    Walk *walk = context;
    Box box = piece_box(def, piece->p);
    if (query_done(walk->query) || !meets_box(walk, &box))
        return;
    Halving h = halving_of(def, piece);
    if (h.u || h.v) {
        visit_children(def, piece, h, test_piece, walk);
        return;
    }
    Quad quad = piece_quad(def, piece);
    test_quad(walk, &quad);
}

static void test_net(Walk *walk, const PatchDef *def, const Net *net) {
    Piece piece = {.u0 = net->u0, .u1 = net->u1, .v0 = net->v0, .v1 = net->v1, .depth = net->depth};
    memcpy(piece.p, walk->facets->net_points + net->points,
           (def->degree_u + 1) * (def->degree_v + 1) * sizeof(Vec3));
    visit_children(def, &piece, halving_of(def, &piece), test_piece, walk);
}

static bool test_patch(Walk *walk, uint32_t patch) {
    const Facets *f = walk->facets;
    const PatchDef *def = &f->defs[patch];
    if (!(def->mask & walk->query->mask))
        return true;
    walk->patch = patch;
    walk->query->stats.patch_tests++;
    for (uint32_t i = f->first[patch]; i < f->first[patch + 1];) {
        const Node *node = &f->nodes[i];
        if (!meets_box(walk, &node->box)) {
            i = node->end;
            continue;
        }
        if (node->what == NO_LEAF) {
            // Its children follow.
        } else if (node->what & UNFINISHED) {
            test_net(walk, def, &f->nets[node->what & ~UNFINISHED]);
        } else {
            test_quad(walk, &f->quads[node->what]);
        }
        if (query_done(walk->query))
            return false;
        i++;
    }
    return true;
}

static bool visit_leaf(void *context, uint32_t leaf, TreeRay *ray) {
    Walk *walk = context;
    const Tree *tree = &walk->facets->tree;
    for (uint32_t i = tree->leaf_first[leaf]; i < tree->leaf_first[leaf + 1]; i++) {
        if (!test_patch(walk, tree->order[i]))
            return false;
    }
    tree_ray_cut(ray, walk->query->t_max);
    return true;
}

// 1 / x without infinities, so that 0 x infinity does not arise.
static double invert(double x) { return 1.0 / (fabs(x) < 1e-300 ? copysign(1e-300, x) : x); }

void facets_query(const Facets *f, Query *query) {
    Vec3 o = query->ray.org, d = query->ray.dir;
    Walk walk = {.facets = f,
                 .query = query,
                 .inverse = vec3(invert(d.x), invert(d.y), invert(d.z)),
                 .pad = 1e-14 * fmax(fabs(o.x), fmax(fabs(o.y), fabs(o.z))),
                 .t_min = fmax(query->t_min, MIN_DEPTH)};
    TreeRay ray;
    if (!tree_ray_begin(&f->tree, &query->ray, walk.t_min, query->t_max, &ray))
        return;
    tree_walk(&f->tree, &ray, visit_leaf, &walk);
    if (query->kind == QUERY_NEAREST && query->found)
        query->best = finish_hit(f, &walk.best);
}
