// SPDX-License-Identifier: MIT
// Roots of S(u,v) = org + s d in a rectangle X of half sizes hu, hv about (u0,v0).
//
// Let R = org - S, m1 = d x Sv, m2 = Su x d and det = Su . m1, all at the middle. Taylor says
//     S(u,v) = S + a Su + b Sv + rest,  |rest| <= rho = (Muu hu^2 + 2 Muv hu hv + Mvv hv^2) / 2
// for a = u - u0, b = v - v0, so every root in X has a in (R . m1 +- rho |m1|) / det, b in
// (R . m2 +- rho |m2|) / det. An interval that misses X proves that there is no root; else X
// shrinks to it, quadratically.
//
// There is one root at most when no two points of X can lie on one ray along d. The difference of
// two points is A a + B b with A, B averages of Su, Sv over X, which differ from those at the
// middle by at most alpha = Muu hu + Muv hv and beta = Muv hu + Mvv hv. If both points lie on the
// ray, det(A, B, d) = 0; but that determinant differs from det by no more than
// alpha |m1| + beta |m2| + alpha beta. (The contraction test of Krawczyk needs the same quantities
// and asks for the same order of smallness.)
//
// Once a root is known to be single, newton.h sharpens it; the residual at the end, with the same
// Taylor rest, is the hit's certificate.
//
// Where singleness cannot be shown (silhouettes, folds, collapsed edges) qi_reduce_* decides.
#ifndef KERNEL_SEARCH_H
#define KERNEL_SEARCH_H

#include "kernel/newton.h"

enum {
    SEARCH_STEPS = 12, // of an X that shrinks; a single root takes one or two
    SEARCH_CUTS = 24,  // looks where it is cut in half
    SEARCH_DEPTH = 8,  // cuts, one in the other
    SEARCH_NETS = 256, // of qi, for one piece: more have only rays that lie in the surface
};

// The surface about one point, as the ray sees it.
typedef struct {
    double u, v;
    Vec3 su, sv, r; // r = org - S
    Vec3 m1, m2;
    double det, nu, nv; // nu = r . m1, nv = r . m2
} Point;

static inline void look(const PatchRay *ray, double u, double v, Point *p) {
    Vec3 out[3];
    eval_patch(ray->patch, u, v, out);
    p->u = u;
    p->v = v;
    p->su = out[1];
    p->sv = out[2];
    p->r = vec_sub(ray->org, out[0]);
    p->m1 = vec_cross(ray->dir, out[2]);
    p->m2 = vec_cross(out[1], ray->dir);
    p->det = vec_dot(out[1], p->m1);
    p->nu = vec_dot(p->r, p->m1);
    p->nv = vec_dot(p->r, p->m2);
}

// What rounding does to det. Cross products err by 4 u of the product of the lengths in each
// coordinate (dir is off by 2 u), dot products by 3 u more: under 16 u in all. The derivatives err
// by 2 x degree <= 32 times the rounding of S in each coordinate.
static const double U16 = 0x1p-49;
static inline double slope_error(const PatchRay *ray) { return 64.0 * ray->patch->rounding; }
static inline double det_error(const PatchRay *ray, const Point *p) {
    double lu = length1(p->su), lv = length1(p->sv);
    return U16 * lu * lv + slope_error(ray) * (lu + lv);
}

// Bounds over the whole of X, of half sizes hu, hv.
typedef struct {
    double det_error;
    double wu, wv;     // uncertainty of nu, nv
    bool single;       // at most one root in X
    double by_u, by_v; // how much of what stands against that comes from X's size in u, v
    bool blind;        // rounding hides more of X than it bends: smaller parts are as blind
} Bounds;

static inline Bounds bound(const PatchRay *ray, const Piece *piece, const Point *p, double hu,
                           double hv) {
    double muu = (double)piece->muu, muv = (double)piece->muv, mvv = (double)piece->mvv;
    double bend = 0.5 * (muu * hu * hu + mvv * hv * hv) + muv * hu * hv, rest = bend + ray->error;
    double l1 = vec_length(p->m1), l2 = vec_length(p->m2), lr = length1(p->r);
    double slope = slope_error(ray);
    double alpha = muu * hu + muv * hv + slope, beta = muv * hu + mvv * hv + slope;
    Bounds b = {.blind = bend < ray->error,
                .det_error = det_error(ray, p),
                .wu = rest * l1 + U16 * lr * length1(p->sv),
                .wv = rest * l2 + U16 * lr * length1(p->su)};
    b.by_u = hu * (muu * l1 + muv * l2);
    b.by_v = hv * (muv * l1 + mvv * l2);
    b.single = fabs(p->det) - b.det_error > alpha * l1 + beta * l2 + alpha * beta;
    return b;
}

// A span about 0.
typedef struct {
    double low, high;
} Span;

// The part of [-h, h] that holds all a with det a in n +- w; empty if low > high. A tiny det clips
// nothing.
static inline Span solve(double n, double w, double det, double error, double h) {
    double steep = fabs(det) - error;
    if (fabs(n) - w > (fabs(det) + error) * h)
        return (Span){1.0, 0.0};
    if (!(steep > error))
        return (Span){-h, h};
    double middle = n / det;
    double width = (w + error * fabs(middle)) / steep * (1.0 + 0x1p-40);
    return (Span){larger(-h, middle - width), smaller(h, middle + width)};
}

// ---- What cannot be shown single

typedef struct {
    Walk *walk;
    bool go_on;
} Fallback;

static void take_qi(void *context, const QiHit *hit) {
    Fallback *f = context;
    const PatchRay *ray = &f->walk->ray;
    if (!f->go_on || !walk_in_range(f->walk, hit->t))
        return;
    Root root = {.hit = {hit->t, hit->u, hit->v, hit->normal, hit->bound, ray->patch->id}};
    Point p;
    look(ray, hit->u, hit->v, &p);
    double lu = vec_length(p.su), lv = vec_length(p.sv);
    // Flatter than this the two sides of a fold are one as far as the bound can tell.
    if (p.det * p.det > lu * lv * hit->bound * (lu + lv))
        root_set_errors(&root, p.m1, p.m2, p.det);
    f->go_on = walk_take(f->walk, &root);
}

// A ray in the surface meets many pieces, each with more hits than anyone wants: once some have
// been found the one with the smallest t has to do, of each.
static bool search_qi(Walk *walk, const Piece *piece, BezierRect rect) {
    const PatchRay *ray = &walk->ray;
    Query *query = walk->query;
    const PatchDef *def = ray->patch->def;
    Bezier patch;
    bezier_init(&patch, (int)def->degree_u, (int)def->degree_v, def->points);
    // The whole range, whatever has been found in other pieces, and a little more: should it end on
    // a pole the search would go down to the last bit.
    double t_max = walk->t_limit + 16.0 * ray->patch->tolerance * ray->t_per_s;
    QiQuery ask = {query->ray, query->t_min, t_max, ray->patch->tolerance, rect, NULL};
    QiFourth fourth = {piece_rect(piece), NULL};
    if (walk->accel->fourth && qi_local_pays(patch.du, patch.dv)) {
        fourth.most = walk->accel->fourth[piece->fourth].most;
        ask.fourth = &fourth;
    }
    QiStats stats = {0};
    QiHit hit;
    Fallback f = {walk, true};
    if (!walk->has_qi)
        qi_search_init(&walk->qi, &patch, NULL, &query->ray);
    walk->has_qi = true;
    if (query->kind == QUERY_ALL && walk->endless <= 4 * SEARCH_NETS)
        qi_search_all(&walk->qi, &patch, NULL, &ask, &stats, take_qi, &f);
    else if (qi_search_nearest(&walk->qi, &patch, NULL, &ask, &stats, &hit))
        take_qi(&f, &hit);
    if (stats.steps > SEARCH_NETS)
        walk->endless += stats.steps;
    query->stats.steps += stats.steps;
    query->stats.newton += stats.newton;
    return f.go_on;
}

// What to do with a rectangle that has been looked at.
typedef enum { PART_DONE, PART_SHRUNK, PART_STUCK, PART_BLIND, PART_STOP } Part;

// A look at *rect: it shrinks to where roots may be, and the only root is taken. home: the part of
// the piece that *rect shrank from, which Newton does not leave. *across_u: were it to be cut, so.
static inline Part look_at(Walk *walk, const Piece *piece, BezierRect home, BezierRect *rect,
                           bool *across_u) {
    const PatchRay *ray = &walk->ray;
    // The rectangle's corners and its middle are rounded: half sizes that surely hold it.
    double hu = 0.5 * (rect->u1 - rect->u0) * (1.0 + 0x1p-50) + 0x1p-53;
    double hv = 0.5 * (rect->v1 - rect->v0) * (1.0 + 0x1p-50) + 0x1p-53;
    Point p;
    walk->query->stats.newton++;
    look(ray, 0.5 * (rect->u0 + rect->u1), 0.5 * (rect->v0 + rect->v1), &p);
    Bounds of = bound(ray, piece, &p, hu, hv);
    Span a = solve(p.nu, of.wu, p.det, of.det_error, hu);
    Span b = solve(p.nv, of.wv, p.det, of.det_error, hv);
    if (a.low > a.high || b.low > b.high)
        return PART_DONE;
    if (of.single) {
        double u = clamp(p.u + clamp(p.nu / p.det, a.low, a.high), home.u0, home.u1);
        double v = clamp(p.v + clamp(p.nv / p.det, b.low, b.high), home.v0, home.v1);
        Newton done = newton_sharpen(walk, piece, home, u, v);
        if (done != NEWTON_LOST)
            return done == NEWTON_TAKEN ? PART_DONE : PART_STOP;
    }
    *across_u = of.by_u > of.by_v;
    double kept = (a.high - a.low) * (b.high - b.low) / (4.0 * hu * hv);
    *rect = (BezierRect){clamp(p.u + a.low - 0x1p-53, rect->u0, rect->u1),
                         clamp(p.u + a.high + 0x1p-53, rect->u0, rect->u1),
                         clamp(p.v + b.low - 0x1p-53, rect->v0, rect->v1),
                         clamp(p.v + b.high + 0x1p-53, rect->v0, rect->v1)};
    return kept < 0.5 ? PART_SHRUNK : of.blind ? PART_BLIND : PART_STUCK;
}

static inline BezierRect rect_union(BezierRect a, BezierRect b) {
    return (BezierRect){smaller(a.u0, b.u0), larger(a.u1, b.u1), smaller(a.v0, b.v0),
                        larger(a.v1, b.v1)};
}

// Finds every crossing in rect, a part of the piece's rectangle, and gives it to walk_take; false
// to end the walk. Crossings outside the patch by little more than rounding are taken too, with
// (u,v) on the patch's edge; crossings on the edge of rect may be found by the neighbour as well.
// What does not shrink is cut in half, which is cheaper than to ask qi; but of all crossings qi
// tells those apart that are close to each other.
static bool search_rect(Walk *walk, const Piece *piece, BezierRect rect) {
    // A look at a patch of high degree costs more than qi's step.
    const bool cuts = walk->query->kind != QUERY_ALL && walk->ray.patch->cubic;
    struct {
        BezierRect home, rect;
    } parts[SEARCH_DEPTH + 1];
    int count = 1;
    parts[0].home = piece_rect(piece);
    parts[0].rect = rect;
    for (int step = 0; step < (cuts ? SEARCH_CUTS : SEARCH_STEPS); step++) {
        BezierRect at = parts[count - 1].rect;
        bool across_u;
        Part part = look_at(walk, piece, parts[count - 1].home, &at, &across_u);
        if (part == PART_STOP)
            return false;
        if (part == PART_DONE && --count == 0)
            return true;
        if (part == PART_DONE)
            continue;
        parts[count - 1].rect = at;
        if (part == PART_SHRUNK)
            continue;
        if (!cuts || part == PART_BLIND || count > SEARCH_DEPTH)
            break;
        BezierRect low = at, high = at;
        if (across_u)
            low.u1 = high.u0 = 0.5 * (at.u0 + at.u1);
        else
            low.v1 = high.v0 = 0.5 * (at.v0 + at.v1);
        parts[count - 1].home = parts[count - 1].rect = high;
        parts[count].home = parts[count].rect = low;
        count++;
    }
    // One search for all that is left.
    rect = parts[0].rect;
    for (int i = 1; i < count; i++)
        rect = rect_union(rect, parts[i].rect);
    return search_qi(walk, piece, rect);
}

#endif
