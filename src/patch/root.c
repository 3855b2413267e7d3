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
// Once a root is known to be single, Newton steps sharpen it; the residual at the end, with the
// same Taylor rest, is the hit's certificate.
//
// Where singleness cannot be shown (silhouettes, folds, collapsed edges) qi_reduce_* decides.
#include "patch/root.h"

#include "patch/qi.h"

enum {
    MAX_STEPS = 12,    // of an X that shrinks; a single root takes one or two
    SHARPEN_STEPS = 6, // two, as a rule
};
// Of the normal, a sine: pictures have 16 bits.
static const double NORMAL_ERROR = 1e-6;

static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }
static inline double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}
static inline double length1(Vec3 a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

// The surface about one point, as the ray sees it.
typedef struct {
    double u, v;
    Vec3 su, sv, r; // r = org - S
    Vec3 m1, m2;
    double det, nu, nv; // nu = r . m1, nv = r . m2
} Point;

static inline void look(const PatchRay *ray, double u, double v, Point *p) {
    Vec3 out[3];
    piece_eval(ray->patch, u, v, out);
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
    double wu, wv; // uncertainty of nu, nv
    bool single;   // at most one root in X
} Bounds;

static inline Bounds bound(const PatchRay *ray, const Piece *piece, const Point *p, double hu,
                           double hv) {
    double muu = (double)piece->muu, muv = (double)piece->muv, mvv = (double)piece->mvv;
    double rest = 0.5 * (muu * hu * hu + mvv * hv * hv) + muv * hu * hv + ray->error;
    double l1 = vec_length(p->m1), l2 = vec_length(p->m2), lr = length1(p->r);
    double slope = slope_error(ray);
    double alpha = muu * hu + muv * hv + slope, beta = muv * hu + mvv * hv + slope;
    Bounds b = {.det_error = det_error(ray, p),
                .wu = rest * l1 + U16 * lr * length1(p->sv),
                .wv = rest * l2 + U16 * lr * length1(p->su)};
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
    const PatchRay *ray;
    const Query *query;
    RootTake take;
    void *context;
    bool go_on;
} Fallback;

static void take_qi(void *context, const QiHit *hit) {
    Fallback *f = context;
    if (!f->go_on || !query_in_range(f->query, hit->t))
        return;
    Root root = {.hit = {hit->t, hit->u, hit->v, hit->normal, hit->bound, f->ray->patch->def->id}};
    Point p;
    look(f->ray, hit->u, hit->v, &p);
    double lu = vec_length(p.su), lv = vec_length(p.sv);
    // Flatter than this the two sides of a fold are one as far as the bound can tell.
    if (p.det * p.det > lu * lv * hit->bound * (lu + lv))
        root_set_errors(&root, p.m1, p.m2, p.det);
    f->go_on = f->take(f->context, &root);
}

static bool search_qi(const PatchRay *ray, BezierRect rect, Query *query, RootTake take,
                      void *context) {
    const PatchDef *def = ray->patch->def;
    Bezier patch;
    bezier_init(&patch, (int)def->degree_u, (int)def->degree_v, def->points);
    // A little beyond t_max, so that the range does not end on a pole that a neighbour has reported
    // just now: there the search would go down to the last bit.
    double t_max = query->t_max + 16.0 * ray->patch->tolerance * ray->t_per_s;
    QiQuery ask = {query->ray, query->t_min, t_max, ray->patch->tolerance, rect};
    QiStats stats = {0};
    QiHit hit;
    Fallback f = {ray, query, take, context, true};
    if (query->kind == QUERY_ALL)
        qi_reduce_all(&patch, &ask, &stats, take_qi, &f);
    else if (qi_reduce_nearest(&patch, &ask, &stats, &hit))
        take_qi(&f, &hit);
    query->stats.steps += stats.steps;
    query->stats.newton += stats.newton;
    return f.go_on;
}

// ---- A single root

typedef enum { SHARPEN_NO, SHARPEN_TAKEN, SHARPEN_STOP } Sharpened;

// From a point near the only root of X to that root. The last correction needs no new look: its
// Taylor rest is part of the bound. SHARPEN_NO: there is none as near as the tolerance asks.
static Sharpened sharpen(const PatchRay *ray, const Piece *piece, double u, double v, Query *query,
                         RootTake take, void *context) {
    // Up to a hair outside of the piece, where its bounds still hold: then neighbours agree.
    const BezierRect *rect = &piece->rect;
    double hair_u = PIECE_MARGIN * (rect->u1 - rect->u0),
           hair_v = PIECE_MARGIN * (rect->v1 - rect->v0);
    const double u0 = larger(rect->u0 - hair_u, 0.0), u1 = smaller(rect->u1 + hair_u, 1.0);
    const double v0 = larger(rect->v0 - hair_v, 0.0), v1 = smaller(rect->v1 + hair_v, 1.0);
    const double muu = (double)piece->muu, muv = (double)piece->muv, mvv = (double)piece->mvv;
    // What rounding leaves is as good as can be had.
    const double tolerance = larger(ray->patch->tolerance, 2.0 * ray->error);
    for (int step = 0; step < SHARPEN_STEPS; step++) {
        query->stats.newton++;
        Point p;
        look(ray, u, v, &p);
        double steep = 1.0 / p.det;
        double a = clamp(p.nu * steep, u0 - u, u1 - u);
        double b = clamp(p.nv * steep, v0 - v, v1 - v);
        if (!(fabs(p.det) > 0.0)) // also NaN
            return SHARPEN_NO;
        double turn_u = muu * fabs(a) + muv * fabs(b), turn_v = muv * fabs(a) + mvv * fabs(b);
        double rest = 0.5 * (turn_u * fabs(a) + turn_v * fabs(b));
        Vec3 off = vec_sub(vec_sub(p.r, vec_scale(p.su, a)), vec_scale(p.sv, b));
        double s = -vec_dot(off, ray->dir);
        Vec3 across = vec_madd(off, s, ray->dir), n = vec_cross(p.su, p.sv);
        double distance = vec_length(across) + rest + ray->error, area = vec_length(n);
        // Does the correction turn the normal? Then look there. Where it goes nowhere (a ray beside
        // the patch's edge) the turn is 0.
        double turn = turn_u * length1(p.sv) + turn_v * length1(p.su);
        u = clamp(u + a, u0, u1);
        v = clamp(v + b, v0, v1);
        if (!(distance <= tolerance && turn <= NORMAL_ERROR * area))
            continue;
        Root root = {.hit = {.t = ray->t_base + s * ray->t_per_s,
                             .u = u,
                             .v = v,
                             .normal = vec_scale(n, 1.0 / area),
                             .bound = distance,
                             .id = ray->patch->def->id}};
        if (!query_in_range(query, root.hit.t))
            return SHARPEN_TAKEN;
        if (query->kind == QUERY_ALL)
            root_set_errors(&root, p.m1, p.m2, p.det);
        return take(context, &root) ? SHARPEN_TAKEN : SHARPEN_STOP;
    }
    return SHARPEN_NO;
}

bool root_search(const PatchRay *ray, const Piece *piece, BezierRect rect, Query *query,
                 RootTake take, void *context) {
    for (int step = 0; step < MAX_STEPS; step++) {
        // The rectangle's corners and its middle are rounded: half sizes that surely hold it.
        double hu = 0.5 * (rect.u1 - rect.u0) * (1.0 + 0x1p-50) + 0x1p-53;
        double hv = 0.5 * (rect.v1 - rect.v0) * (1.0 + 0x1p-50) + 0x1p-53;
        Point p;
        query->stats.newton++;
        look(ray, 0.5 * (rect.u0 + rect.u1), 0.5 * (rect.v0 + rect.v1), &p);
        Bounds of = bound(ray, piece, &p, hu, hv);
        Span a = solve(p.nu, of.wu, p.det, of.det_error, hu);
        Span b = solve(p.nv, of.wv, p.det, of.det_error, hv);
        if (a.low > a.high || b.low > b.high)
            return true;
        if (of.single) {
            const BezierRect *r = &piece->rect;
            double u = clamp(p.u + clamp(p.nu / p.det, a.low, a.high), r->u0, r->u1);
            double v = clamp(p.v + clamp(p.nv / p.det, b.low, b.high), r->v0, r->v1);
            Sharpened done = sharpen(ray, piece, u, v, query, take, context);
            if (done != SHARPEN_NO)
                return done == SHARPEN_TAKEN;
        }
        double kept = (a.high - a.low) * (b.high - b.low) / (4.0 * hu * hv);
        rect = (BezierRect){clamp(p.u + a.low - 0x1p-53, rect.u0, rect.u1),
                            clamp(p.u + a.high + 0x1p-53, rect.u0, rect.u1),
                            clamp(p.v + b.low - 0x1p-53, rect.v0, rect.v1),
                            clamp(p.v + b.high + 0x1p-53, rect.v0, rect.v1)};
        if (!(kept < 0.5))
            break;
    }
    return search_qi(ray, rect, query, take, context);
}
