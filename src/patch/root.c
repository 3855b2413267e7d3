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
// Where that cannot be shown (silhouettes, folds, collapsed edges) qi_reduce_* decides.
#include "patch/root.h"

#include "patch/qi.h"

#include <float.h>

// A unique root takes two or three steps; X that does not shrink is not worth more.
enum { MAX_STEPS = 12, FINISH_STEPS = 4 };
static const double NORMAL_ERROR = 1e-9; // a sine; pictures have 16 bits

// u = 2^-53. org: the difference to the center 1 u of its size A, the shift along the ray 1 u of
// the same size, the sum 1 u: 3 A per coordinate, 6 A in length; t_base + s t_per_s: 2 u of the
// distance, below 4 A. S: piece_rounding() per coordinate, below 2 of it in length.
void patch_ray_init(PatchRay *out, const AccelPatch *patch, const Ray *ray) {
    out->patch = patch;
    double largest = fmax(fabs(ray->dir.x), fmax(fabs(ray->dir.y), fabs(ray->dir.z)));
    Vec3 dir = vec_scale(ray->dir, 1.0 / largest);
    double length = vec_length(dir);
    out->dir = vec_scale(dir, 1.0 / length);
    out->t_per_s = 1.0 / (length * largest);
    Vec3 away = vec_sub(ray->org, patch->center);
    double shift = -vec_dot(away, out->dir);
    out->t_base = shift * out->t_per_s;
    out->org = vec_madd(away, shift, out->dir);
    double size = fabs(away.x) + fabs(away.y) + fabs(away.z);
    out->error = 12.0 * 0x1p-53 * size + 2.0 * piece_rounding(patch);
}

// X and what is known about it at its middle.
typedef struct {
    double u, v, hu, hv;
    Vec3 s, su, sv, r; // r = org - s
    Vec3 m1, m2;
    double l1, l2, det;
    double rest;      // bound of the quadratic rest over X, and of all rounding of r
    double det_error; // rounding of det
    double nu, nv;    // r . m1, r . m2
    double wu, wv;    // their uncertainty
    bool single;      // at most one root in X
} Cell;

static void cell_look(const PatchRay *ray, const Piece *piece, Cell *c) {
    Vec3 out[3];
    piece_eval(ray->patch, c->u, c->v, out);
    c->s = out[0];
    c->su = out[1];
    c->sv = out[2];
    c->r = vec_sub(ray->org, c->s);
    c->m1 = vec_cross(ray->dir, c->sv);
    c->m2 = vec_cross(c->su, ray->dir);
    c->det = vec_dot(c->su, c->m1);
    c->l1 = vec_length(c->m1);
    c->l2 = vec_length(c->m2);
    c->nu = vec_dot(c->r, c->m1);
    c->nv = vec_dot(c->r, c->m2);
    double lu = vec_length(c->su), lv = vec_length(c->sv), lr = vec_length(c->r);
    double muu = (double)piece->muu, muv = (double)piece->muv, mvv = (double)piece->mvv;
    c->rest = 0.5 * (muu * c->hu * c->hu + mvv * c->hv * c->hv) + muv * c->hu * c->hv + ray->error;
    // Cross products err by 4 u of the product of the lengths in each coordinate (dir is off by
    // 2 u), dot products by 3 u more: under 16 u in all. The derivatives by 2 x degree <= 32 times
    // the rounding of S, in each coordinate.
    const double u16 = 0x1p-49;
    double slope = 64.0 * piece_rounding(ray->patch);
    c->wu = c->rest * c->l1 + u16 * lr * lv;
    c->wv = c->rest * c->l2 + u16 * lr * lu;
    c->det_error = u16 * lu * lv + slope * (lu + lv);
    double alpha = muu * c->hu + muv * c->hv + slope, beta = muv * c->hu + mvv * c->hv + slope;
    c->single = fabs(c->det) - c->det_error > alpha * c->l1 + beta * c->l2 + alpha * beta;
}

// A span about 0.
typedef struct {
    double low, high;
} Span;

// The part of [-h, h] that holds all a with det a in n +- w; empty if low > high. A tiny det clips
// nothing.
static Span solve(double n, double w, double det, double det_error, double h) {
    Span all = {-h, h};
    double steep = fabs(det) - det_error;
    if (fabs(n) - w > (fabs(det) + det_error) * h)
        return (Span){1.0, 0.0};
    if (!(steep > det_error))
        return all;
    double middle = n / det;
    double width = (w + det_error * fabs(middle)) / steep * (1.0 + 0x1p-40);
    return (Span){fmax(-h, middle - width), fmin(h, middle + width)};
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

static bool in_range(const Query *query, double t) { return t >= query->t_min && t < query->t_max; }

// The hit at the middle plus (a,b): its own position, normal and bound.
static void make_root(const PatchRay *ray, const Piece *piece, const Cell *c, double a, double b,
                      Root *root) {
    Vec3 off = vec_sub(vec_sub(c->r, vec_scale(c->su, a)), vec_scale(c->sv, b));
    double s = -vec_dot(off, ray->dir);
    double rest = 0.5 * ((double)piece->muu * a * a + (double)piece->mvv * b * b) +
                  (double)piece->muv * fabs(a * b);
    root->hit = (PatchHit){.t = ray->t_base + s * ray->t_per_s,
                           .u = clamp(c->u + a, 0.0, 1.0),
                           .v = clamp(c->v + b, 0.0, 1.0),
                           .bound = vec_length(vec_madd(off, s, ray->dir)) + rest + ray->error,
                           .id = ray->patch->def->id};
    double steep = fabs(c->det);
    root->error_u = root->hit.bound * c->l1 / steep;
    root->error_v = root->hit.bound * c->l2 / steep;
    root->sign = c->det > 0.0 ? 1 : -1;
}

// ---- What cannot be shown single

typedef struct {
    const PatchRay *ray;
    RootTake take;
    void *context;
    bool go_on;
} Fallback;

static void take_qi(void *context, const QiHit *hit) {
    Fallback *f = context;
    if (!f->go_on)
        return;
    const PatchRay *ray = f->ray;
    Root root = {.hit = {hit->t, hit->u, hit->v, hit->normal, hit->bound, ray->patch->def->id}};
    Vec3 out[3];
    piece_eval(ray->patch, hit->u, hit->v, out);
    Vec3 m1 = vec_cross(ray->dir, out[2]), m2 = vec_cross(out[1], ray->dir);
    double det = vec_dot(out[1], m1), lu = vec_length(out[1]), lv = vec_length(out[2]);
    // Flatter than this the two sides of a fold are one as far as the bound can tell.
    if (det * det > lu * lv * hit->bound * (lu + lv)) {
        root.sign = det > 0.0 ? 1 : -1;
        root.error_u = 2.0 * hit->bound * vec_length(m1) / fabs(det);
        root.error_v = 2.0 * hit->bound * vec_length(m2) / fabs(det);
    }
    f->go_on = f->take(f->context, &root);
}

static bool search_qi(const PatchRay *ray, BezierRect rect, Query *query, RootTake take,
                      void *context) {
    const PatchDef *def = ray->patch->def;
    Bezier patch;
    bezier_init(&patch, (int)def->degree_u, (int)def->degree_v, def->points);
    QiQuery ask = {query->ray, query->t_min, query->t_max, ray->patch->tolerance, rect};
    QiStats stats = {0};
    QiHit hit;
    Fallback f = {ray, take, context, true};
    if (query->kind == QUERY_ALL)
        qi_reduce_all(&patch, &ask, &stats, take_qi, &f);
    else if (qi_reduce_nearest(&patch, &ask, &stats, &hit))
        take_qi(&f, &hit);
    query->stats.steps += stats.steps;
    query->stats.newton += stats.newton;
    return f.go_on;
}

// ---- The search

// The root is as good as the tolerance asks, its t within slack: look at the point itself, for its
// normal, and take the correction that this gives for nothing.
static bool finish(const PatchRay *ray, const Piece *piece, const Root *rough, double slack,
                   Query *query, RootTake take, void *context) {
    // Out of the limits whatever the last digits say?
    if (rough->hit.t - slack >= query->t_max || rough->hit.t + slack < query->t_min)
        return true;
    const BezierRect *rect = &piece->rect;
    Cell c = {.u = rough->hit.u, .v = rough->hit.v};
    Root root, middle;
    for (int step = 0; step < FINISH_STEPS; step++) {
        query->stats.newton++;
        cell_look(ray, piece, &c);
        double a = 0.0, b = 0.0;
        if (fabs(c.det) > 2.0 * c.det_error) {
            a = clamp(c.nu / c.det, rect->u0 - c.u, rect->u1 - c.u);
            b = clamp(c.nv / c.det, rect->v0 - c.v, rect->v1 - c.v);
        }
        make_root(ray, piece, &c, a, b, &root);
        make_root(ray, piece, &c, 0.0, 0.0, &middle);
        if (!(root.hit.bound <= middle.hit.bound)) {
            root = middle; // no better: the ray passes outside the patch
            break;
        }
        // Does the correction turn the normal? Then look there.
        double turn_u = (double)piece->muu * fabs(a) + (double)piece->muv * fabs(b);
        double turn_v = (double)piece->muv * fabs(a) + (double)piece->mvv * fabs(b);
        double turn = turn_u * vec_length(c.sv) + turn_v * vec_length(c.su);
        if (turn <= NORMAL_ERROR * vec_length(vec_cross(c.su, c.sv)))
            break;
        c.u = root.hit.u;
        c.v = root.hit.v;
    }
    if (!in_range(query, root.hit.t))
        return true;
    root.hit.normal = vec_normalize(vec_cross(c.su, c.sv));
    return take(context, &root);
}

bool root_search(const PatchRay *ray, const Piece *piece, BezierRect rect, Query *query,
                 RootTake take, void *context) {
    // What rounding leaves is as good as can be had.
    const double tolerance = fmax(ray->patch->tolerance, 2.0 * ray->error);
    bool single = false;
    for (int step = 0; step < MAX_STEPS; step++) {
        Cell c = {.u = 0.5 * (rect.u0 + rect.u1), .v = 0.5 * (rect.v0 + rect.v1)};
        // The rectangle's corners and its middle are rounded: half sizes that surely hold it.
        c.hu = (0.5 * (rect.u1 - rect.u0)) * (1.0 + 0x1p-50) + 0x1p-53;
        c.hv = (0.5 * (rect.v1 - rect.v0)) * (1.0 + 0x1p-50) + 0x1p-53;
        query->stats.newton++;
        cell_look(ray, piece, &c);
        Span a = solve(c.nu, c.wu, c.det, c.det_error, c.hu);
        Span b = solve(c.nv, c.wv, c.det, c.det_error, c.hv);
        if (a.low > a.high || b.low > b.high)
            return true;
        single |= c.single;
        if (single && fabs(c.det) > 2.0 * c.det_error) {
            Root root;
            make_root(ray, piece, &c, clamp(c.nu / c.det, a.low, a.high),
                      clamp(c.nv / c.det, b.low, b.high), &root);
            if (root.hit.bound <= tolerance) {
                double slack = root.hit.bound + 2.0 * vec_length(c.su) * root.error_u +
                               2.0 * vec_length(c.sv) * root.error_v;
                return finish(ray, piece, &root, slack * ray->t_per_s, query, take, context);
            }
        }
        double kept = (a.high - a.low) * (b.high - b.low) / (4.0 * c.hu * c.hv);
        rect = (BezierRect){clamp(c.u + a.low - 0x1p-53, rect.u0, rect.u1),
                            clamp(c.u + a.high + 0x1p-53, rect.u0, rect.u1),
                            clamp(c.v + b.low - 0x1p-53, rect.v0, rect.v1),
                            clamp(c.v + b.high + 0x1p-53, rect.v0, rect.v1)};
        if (!(kept < 0.5))
            break;
    }
    return search_qi(ray, rect, query, take, context);
}
