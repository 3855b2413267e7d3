// SPDX-License-Identifier: MIT
// Double first, from the leaves of ray_oracle_set.h that the ray meets. What rounding hides there
// is a small part of the patch; that part is placed with 106 bits (ray_oracle_fine.h) and searched
// in double again, whose rounding is now relative to the part's size; and so on until 106 bits are
// used up. Only then the cells themselves are halved in __float128.
#include "ray_oracle.h"

#include "ray_oracle_fine.h"
#include "ray_oracle_set.h"

enum {
    QUICK_DEPTH = 44,  // halvings of one cell
    EXACT_DEPTH = 120, // __float128 has 113 bits
    QUICK_BUDGET = 200,
    FINE_BUDGET = 1000,
    FINE_PARTS = 200, // of one patch
    FINE_LEVELS = 5,  // of parts in parts: each is 2^-25 as large, or no better
    EXACT_BUDGET = 1000,
    EXACT_PARTS = 64,
    OPEN_CELLS = 64,
};
#define MARGIN 0x1p-6

// A cell that was left open, or has a root that may lie outside of the patch.
typedef struct {
    double u, v, wu, wv;
} OpenCell;

// A part of the patch in which a search goes on with parameters of its own, [0,1]^2.
typedef struct {
    Real u, v, wu, wv;    // where it lies
    Real base, unit;      // t is (base + z / weight) unit
    double z_low, z_high; // of the depths that were asked for
    bool bounded;         // there are others
} Place;

// The ray, with its direction scaled by a power of two so that the largest component, k, is in
// [1/2, 1).
typedef struct {
    int k, a, b;
    double dir[3];
    Real length; // t in lengths of dir, times this, is t
} View;

typedef struct {
    const PatchDef *def;
    const Ray *ray;
    const View *view;
    const RayOracleRange *range;
    RayOraclePrecision precision;
    int nu, nv;
    double growth; // (1 + 2 MARGIN)^(nu + nv)
    RayOracle *out;
    int patch, first; // first item of this patch in out
    Place place;
    bool last; // what this search leaves open is added to out
    int budget;
    OpenCell cells[OPEN_CELLS];
    int cell_count; // may exceed OPEN_CELLS: then not all are noted
    int fine_parts, exact_parts;
    Real fine_unit; // of depths, in the fine search
    bool projected; // for the exact search
} Task;

// ---- Items

static bool overlap(double a, double ra, double b, double rb) { return fabs(a - b) <= ra + rb; }

// The middle and half size of the hull of two spans.
static void join(double *a, double *ra, double b, double rb) {
    double low = fmin(*a - *ra, b - rb), high = fmax(*a + *ra, b + rb);
    *a = 0.5 * low + 0.5 * high;
    *ra = (0.5 * high - 0.5 * low) * (1.0 + 0x1p-50);
}

static void join_items(RayOracleRoot *to, const RayOracleRoot *from) {
    join(&to->t, &to->dt, from->t, from->dt);
    join(&to->u, &to->du, from->u, from->du);
    join(&to->v, &to->dv, from->v, from->dv);
}

// A root found in two cells is one; open cells that touch become one.
static void add_root(Task *task, RayOracleRoot item) {
    RayOracle *out = task->out;
    for (int i = task->first; i < out->count; i++) {
        RayOracleRoot *other = &out->root[i];
        if (!overlap(other->u, other->du, item.u, item.du) ||
            !overlap(other->v, other->dv, item.v, item.dv) ||
            (other->kind == ROOT_OPEN) != (item.kind == ROOT_OPEN))
            continue;
        if (item.kind == ROOT_OPEN) {
            join_items(other, &item);
        } else if (item.kind == ROOT_CERTAIN && other->kind == ROOT_BORDER) {
            *other = item;
            out->open--;
        }
        return;
    }
    if (out->count == RAY_ORACLE_ROOTS) { // the last takes what finds no room
        RayOracleRoot *last = &out->root[out->count - 1];
        out->open += last->kind == ROOT_CERTAIN;
        last->kind = ROOT_OPEN;
        join_items(last, &item);
        return;
    }
    out->open += item.kind != ROOT_CERTAIN;
    out->root[out->count++] = item;
}

static void add_item(Task *task, double t, double dt, double u, double v, double du, double dv,
                     RayOracleKind kind) {
    // Rounding to double, if it came from more.
    dt += 0x1p-52 * fabs(t);
    add_root(task, (RayOracleRoot){.kind = kind,
                                   .patch = task->patch,
                                   .t = t,
                                   .u = u,
                                   .v = v,
                                   .dt = dt,
                                   .du = du,
                                   .dv = dv,
                                   .sine = -1.0});
}

static void note_cell(Task *task, double u, double v, double wu, double wv) {
    if (task->cell_count++ < OPEN_CELLS)
        task->cells[task->cell_count - 1] = (OpenCell){u, v, wu, wv};
}

// ---- The searches

#define REAL double
#define UNIT 0x1p-53
#define WIDE long double
#define WIDE_UNIT 0x1p-64L
#define NAME(x) quick_##x
#include "ray_oracle_cells.h"
#undef REAL
#undef UNIT
#undef WIDE
#undef WIDE_UNIT
#undef NAME

#define REAL __float128
#define UNIT ((__float128)0x1p-113)
#define WIDE __float128
#define WIDE_UNIT ((__float128)0x1p-113)
#define NAME(x) exact_##x
#include "ray_oracle_cells.h"

static _Thread_local quick_Cell quick_cells[QUICK_DEPTH];
static _Thread_local exact_Cell exact_cells[EXACT_DEPTH];
// The whole patch, projected.
static _Thread_local exact_Cell exact_whole;

// Scales by a power of two to at most 1 in size. Returns the error, which was `error`, of the
// results.
static __float128 scale_exactly(__float128 *p, int count, __float128 error) {
    int exponent;
    __float128 most = exact_span_of(p, count).most;
    frexpl(most > 0 ? (long double)most : 1.0L, &exponent);
    __float128 scale = ldexpl(1.0L, -exponent);
    for (int k = 0; k < count; k++)
        p[k] *= scale;
    return error * scale;
}

static void project_exactly(const Task *task) {
    const PatchDef *def = task->def;
    const View *view = task->view;
    exact_Cell *c = &exact_whole;
    int count = (task->nu + 1) * (task->nv + 1), k = view->k;
    __float128 d[3], error[2] = {0, 0};
    for (int axis = 0; axis < 3; axis++)
        d[axis] = vec_get(task->ray->dir, axis);
    for (int n = 0; n < count; n++) {
        __float128 q[3], w = def->weights ? def->weights[n] : 1.0;
        for (int axis = 0; axis < 3; axis++)
            q[axis] = (__float128)vec_get(def->points[n], axis) - vec_get(task->ray->org, axis);
        for (int m = 0; m < 2; m++) {
            int axis = m == 0 ? view->a : view->b;
            __float128 p = q[axis] * d[k], s = q[k] * d[axis];
            c->p[m][n] = w * (p - s);
            // Each term errs by 2 units (difference, product), their difference by 1 more, and one
            // more is the weight's.
            __float128 off = 4 * 0x1p-113 * w * (exact_abs(p) + exact_abs(s));
            error[m] = exact_max(off, error[m]);
        }
        c->p[2][n] = w * q[k] / d[k];
        c->p[3][n] = w;
    }
    c->ex = scale_exactly(c->p[0], count, error[0]);
    c->ey = scale_exactly(c->p[1], count, error[1]);
    c->ez = 3 * (__float128)0x1p-113 * exact_farthest(task, count, c);
}

// Control points of the part [a,b] of a curve: the blossom of a and b, k times b. In place.
static void restrict_line(__float128 *p, int step, int n, __float128 a, __float128 b) {
    __float128 out[ORACLE_SIDE];
    for (int k = 0; k <= n; k++) {
        __float128 row[ORACLE_SIDE];
        for (int i = 0; i <= n; i++)
            row[i] = p[i * step];
        for (int level = n; level > 0; level--) {
            __float128 t = level > k ? a : b;
            for (int i = 0; i < level; i++)
                row[i] = (1 - t) * row[i] + t * row[i + 1];
        }
        out[k] = row[0];
    }
    for (int k = 0; k <= n; k++)
        p[k * step] = out[k];
}

// One level errs by 3 UNIT of the largest value: 4 (nu + nv) UNIT in all.
static __float128 restrict_exactly(const Task *task, __float128 *p, const exact_Cell *c) {
    int nu = task->nu, nv = task->nv;
    __float128 most = exact_span_of(p, (nu + 1) * (nv + 1)).most;
    for (int j = 0; j <= nv; j++)
        restrict_line(p + j, nv + 1, nu, c->u, c->u + c->wu);
    for (int i = 0; i <= nu; i++)
        restrict_line(p + i * (nv + 1), 1, nv, c->v, c->v + c->wv);
    return 4 * (nu + nv) * (__float128)0x1p-113 * most;
}

static View view_of(const Ray *ray) {
    View v = {.k = 0};
    int exponent;
    for (int axis = 1; axis < 3; axis++)
        if (fabs(vec_get(ray->dir, axis)) > fabs(vec_get(ray->dir, v.k)))
            v.k = axis;
    v.a = (v.k + 1) % 3, v.b = (v.k + 2) % 3;
    frexp(vec_get(ray->dir, v.k), &exponent);
    for (int axis = 0; axis < 3; axis++)
        v.dir[axis] = ldexp(vec_get(ray->dir, axis), -exponent);
    v.length = ldexpl(1.0L, -exponent);
    return v;
}

// The depths asked for as z of a place that has base and unit. Rounding makes them more.
static void set_range(Task *task) {
    Place *at = &task->place;
    Real a = task->range->t0 / at->unit, b = task->range->t1 / at->unit;
    Real low = a < b ? a : b, high = a < b ? b : a;
    low -= 0x1p-60L * fabsl(low) + 0x1p-60L * fabsl(at->base);
    high += 0x1p-60L * fabsl(high) + 0x1p-60L * fabsl(at->base);
    at->z_low = nextafter((double)(low - at->base), -INFINITY);
    at->z_high = nextafter((double)(high - at->base), INFINITY);
    at->bounded = isfinite(at->z_low) || isfinite(at->z_high);
}

// ---- Quick: the leaves

// A patch's corner across the ray, and in depth, in units of its scale.
typedef struct {
    Real x, y, z;
    double ex, ey;
} Corner;

// False: the patch lies too far aside for any crossing, since its points are within 2 scales of the
// corner across the ray.
static bool corner_of(const View *view, const OraclePatch *patch, const Ray *ray, Corner *c) {
    Real q[3];
    for (int axis = 0; axis < 3; axis++)
        q[axis] = ((Real)vec_get(patch->corner, axis) - vec_get(ray->org, axis)) * patch->inverse;
    Real dk = view->dir[view->k], da = view->dir[view->a], db = view->dir[view->b];
    Real px = q[view->a] * dk, sx = q[view->k] * da, py = q[view->b] * dk, sy = q[view->k] * db;
    Real ex = 4 * 0x1p-64L * (fabsl(px) + fabsl(sx)), ey = 4 * 0x1p-64L * (fabsl(py) + fabsl(sy));
    c->x = px - sx, c->y = py - sy, c->z = q[view->k];
    c->ex = (double)ex, c->ey = (double)ey;
    return !(fabsl(c->x) - ex > 2.25L) && !(fabsl(c->y) - ey > 2.25L);
}

// One coordinate across the ray: corner x weight + (net_a d_k - net_k d_a). Returns its error.
static double lay_across(const Task *task, const OracleLeaf *leaf, int axis, double corner,
                         double error, double *out) {
    const View *view = task->view;
    int count = (task->nu + 1) * (task->nv + 1);
    const double *p = leaf->net + axis * count, *q = leaf->net + view->k * count;
    double dk = view->dir[view->k], d = view->dir[axis];
    if (task->def->weights) {
        const double *w = leaf->net + 3 * count;
        for (int n = 0; n < count; n++)
            out[n] = corner * w[n] + (p[n] * dk - q[n] * d);
    } else {
        for (int n = 0; n < count; n++)
            out[n] = corner + (p[n] * dk - q[n] * d);
    }
    // Units of the net's size: its own rounding, product, difference, sum; of the corner's: its own
    // rounding, the weight's, product, sum.
    double net = leaf->most[axis] * fabs(dk) + leaf->most[view->k] * fabs(d);
    double most = fabs(corner) * leaf->most_weight;
    return 1.001 * 0x1p-53 * (4.0 * net + 4.0 * most) + 2.0 * ORACLE_NET_ERROR +
           error * leaf->most_weight;
}

static void search_leaf(Task *task, const Corner *corner, const OracleLeaf *leaf) {
    int count = (task->nu + 1) * (task->nv + 1);
    const View *view = task->view;
    quick_Cell *c = &quick_cells[0];
    c->ex = lay_across(task, leaf, view->a, (double)corner->x, corner->ex, c->p[0]);
    quick_Span x = quick_span_of(c->p[0], count);
    if (quick_one_sign(&x, c->ex))
        return;
    c->ey = lay_across(task, leaf, view->b, (double)corner->y, corner->ey, c->p[1]);
    memcpy(c->p[2], leaf->net + view->k * count, sizeof(double) * (size_t)count);
    if (task->def->weights)
        memcpy(c->p[3], leaf->net + 3 * count, sizeof(double) * (size_t)count);
    double far = task->def->weights ? 1.0 : leaf->most[view->k];
    c->ez = 1.001 * 0x1p-53 * far + ORACLE_NET_ERROR;
    c->u = c->v = 0.0;
    c->wu = c->wv = 1.0;
    task->place.u = leaf->u, task->place.v = leaf->v;
    task->place.wu = leaf->wu, task->place.wv = leaf->wv;
    int noted = task->cell_count;
    quick_search_first(task, quick_cells, QUICK_DEPTH);
    // As cells of the patch: still exact.
    for (int n = noted; n < task->cell_count && n < OPEN_CELLS; n++) {
        OpenCell *cell = &task->cells[n];
        *cell = (OpenCell){leaf->u + leaf->wu * cell->u, leaf->v + leaf->wv * cell->v,
                           leaf->wu * cell->wu, leaf->wv * cell->wv};
    }
}

// ---- Fine: small parts

// Where a part lies, exactly.
typedef struct {
    __float128 u, v, wu, wv;
} Part;

static Part part_of(const Part *whole, const OpenCell *cell) {
    return (Part){whole->u + whole->wu * cell->u, whole->v + whole->wv * cell->v,
                  whole->wu * cell->wu, whole->wv * cell->wv};
}

static double fine_weight(const PatchDef *def, int n, int exponent) {
    return def->weights ? ldexp(def->weights[n], -exponent) : 1.0;
}

static double fine_size(Fine a) { return fabs(a.h); }

// The whole patch, scaled to at most 1. Returns the unit of depths.
static Real project_finely(const Task *task, FineNet *net) {
    const PatchDef *def = task->def;
    const View *view = task->view;
    const int axes[3] = {view->a, view->b, view->k};
    int count = (task->nu + 1) * (task->nv + 1), exponent, heaviest = 0;
    double most = 0.0, weight = 0.0;
    for (int n = 0; n < count; n++) {
        for (int c = 0; c < 3; c++) {
            Fine q = fine_sum(vec_get(def->points[n], axes[c]), -vec_get(task->ray->org, axes[c]));
            net->grid[c].h[n] = q.h, net->grid[c].l[n] = q.l;
            most = fmax(most, fabs(q.h));
        }
        weight = def->weights ? fmax(weight, def->weights[n]) : 1.0;
    }
    frexp(most, &exponent);
    if (def->weights)
        frexp(weight, &heaviest);
    // Denormal numbers lose their last bits here.
    net->error[0] = net->error[1] = net->error[2] = 0x1p-1000;
    double dk = view->dir[view->k];
    for (int n = 0; n < count; n++) {
        Fine q[3];
        double w = fine_weight(def, n, heaviest);
        for (int c = 0; c < 3; c++) {
            const FineGrid *g = &net->grid[c];
            q[c] = fine_times((Fine){ldexp(g->h[n], -exponent), ldexp(g->l[n], -exponent)}, w);
        }
        for (int c = 0; c < 2; c++) {
            Fine p = fine_times(q[c], dk), s = fine_times(q[2], view->dir[axes[c]]);
            Fine x = fine_sub(p, s);
            net->grid[c].h[n] = x.h, net->grid[c].l[n] = x.l;
            net->error[c] = fmax(net->error[c], FINE_UNIT * (fine_size(p) + fine_size(s)));
        }
        net->grid[2].h[n] = q[2].h, net->grid[2].l[n] = q[2].l;
        net->grid[3].h[n] = w, net->grid[3].l[n] = 0.0;
    }
    net->error[2] += FINE_UNIT;
    return ldexpl(1.0L, exponent) * view->length / (Real)dk;
}

static void restrict_finely(const Task *task, const FineNet *from, const OpenCell *cell,
                            FineNet *to) {
    int nu = task->nu, nv = task->nv, count = (nu + 1) * (nv + 1);
    FineGrid across;
    for (int c = 0; c < (task->def->weights ? 4 : 3); c++) {
        fine_restrict(&from->grid[c], nu, nv + 1, cell->u, cell->u + cell->wu, &across);
        fine_restrict(&across, nv, nu + 1, cell->v, cell->v + cell->wv, &to->grid[c]);
        if (c < 3)
            to->error[c] =
                from->error[c] + (nu + nv) * FINE_UNIT * fine_most(&from->grid[c], count);
    }
}

// The whole place as a cell in double: x and y scaled to at most 1, z less what it is at a corner.
// False: the fine numbers err so much that nothing can be told in it.
static bool cell_of_net(Task *task, const FineNet *net, quick_Cell *cell) {
    int count = (task->nu + 1) * (task->nv + 1);
    double error[2];
    for (int c = 0; c < 2; c++) {
        double most = fine_most(&net->grid[c], count);
        int exponent = -900;
        if (most > 0x1p-900)
            frexp(most, &exponent);
        double scale = ldexp(1.0, -exponent);
        for (int n = 0; n < count; n++)
            cell->p[c][n] = net->grid[c].h[n] * scale;
        error[c] = net->error[c] * scale;
    }
    cell->ex = 1.001 * (error[0] + 0x1p-53), cell->ey = 1.001 * (error[1] + 0x1p-53);
    const FineGrid *z = &net->grid[2], *w = &net->grid[3];
    double corner = task->def->weights ? z->h[0] / w->h[0] : z->h[0];
    task->place.base = corner;
    double least = 1.0, error_z = net->error[2] + FINE_UNIT * (fine_most(z, count) + fabs(corner));
    for (int n = 0; n < count; n++) {
        Fine weight = {1.0, 0.0};
        if (task->def->weights)
            weight = (Fine){w->h[n], w->l[n]};
        Fine off = fine_sub((Fine){z->h[n], z->l[n]}, fine_times(weight, corner));
        cell->p[2][n] = off.h;
        cell->p[3][n] = weight.h;
        least = fmin(least, weight.h);
    }
    cell->ez = error_z / least + 1.001 * 0x1p-53 * quick_farthest(task, count, cell);
    cell->u = cell->v = 0.0;
    cell->wu = cell->wv = 1.0;
    set_range(task);
    return error[0] < 0x1p-12 && error[1] < 0x1p-12;
}

// Open cells that touch become one part, unless it is much larger than they are.
static int join_cells(OpenCell *cells, int count) {
    for (int i = 0; i < count; i++) {
        for (int j = i + 1; j < count; j++) {
            OpenCell *a = &cells[i], *b = &cells[j];
            double u0 = fmin(a->u, b->u), u1 = fmax(a->u + a->wu, b->u + b->wu);
            double v0 = fmin(a->v, b->v), v1 = fmax(a->v + a->wv, b->v + b->wv);
            if (u1 - u0 > a->wu + b->wu || v1 - v0 > a->wv + b->wv ||
                u1 - u0 > 4.0 * fmin(a->wu, b->wu) || v1 - v0 > 4.0 * fmin(a->wv, b->wv))
                continue;
            *a = (OpenCell){u0, v0, u1 - u0, v1 - v0};
            *b = cells[--count];
            j = i; // all others once more
        }
    }
    return count;
}

static void search_exactly(Task *task, const Part *part) {
    if (!task->projected)
        project_exactly(task);
    task->projected = true;
    exact_Cell *c = &exact_cells[0];
    size_t size = sizeof c->p[0][0] * (size_t)((task->nu + 1) * (task->nv + 1));
    for (int m = 0; m < 4; m++)
        memcpy(c->p[m], exact_whole.p[m], size);
    c->u = part->u, c->v = part->v, c->wu = part->wu, c->wv = part->wv;
    c->ex = exact_whole.ex + restrict_exactly(task, c->p[0], c);
    c->ey = exact_whole.ey + restrict_exactly(task, c->p[1], c);
    restrict_exactly(task, c->p[2], c);
    if (task->def->weights)
        restrict_exactly(task, c->p[3], c);
    // Averages of positive weights keep their accuracy.
    int degrees = task->nu + task->nv;
    c->ez =
        exact_whole.ez + 8 * degrees * (__float128)0x1p-113 *
                             exact_farthest(task, (task->nu + 1) * (task->nv + 1), &exact_whole);
    task->place = (Place){.wu = 1.0L, .wv = 1.0L, .unit = 1.0L};
    set_range(task);
    task->last = true;
    task->budget = task->exact_parts++ < EXACT_PARTS ? EXACT_BUDGET : 0;
    exact_search_first(task, exact_cells, EXACT_DEPTH);
    task->last = false;
}

// The part at hand is beyond the fine numbers.
static void leave_part(Task *task, const Part *part) {
    if (task->precision == ORACLE_EXACT) {
        search_exactly(task, part);
        return;
    }
    task->last = true;
    quick_leave_open(task, &quick_cells[0]);
    task->last = false;
}

// Cells of the part that net tells.
static void search_finely(Task *task, const FineNet *net, const Part *part, OpenCell *cells,
                          int count, int level) {
    count = join_cells(cells, count);
    for (int n = 0; n < count; n++) {
        FineNet own;
        Part where = part_of(part, &cells[n]);
        restrict_finely(task, net, &cells[n], &own);
        task->place = (Place){.u = (Real)where.u,
                              .v = (Real)where.v,
                              .wu = (Real)where.wu,
                              .wv = (Real)where.wv,
                              .unit = task->fine_unit};
        if (!cell_of_net(task, &own, &quick_cells[0]) || level == FINE_LEVELS ||
            task->fine_parts++ >= FINE_PARTS) {
            leave_part(task, &where);
            continue;
        }
        task->cell_count = 0;
        task->budget = FINE_BUDGET;
        quick_search_first(task, quick_cells, QUICK_DEPTH);
        if (task->cell_count > OPEN_CELLS) {
            cell_of_net(task, &own, &quick_cells[0]);
            leave_part(task, &where);
        } else if (task->cell_count > 0) {
            OpenCell open[OPEN_CELLS];
            memcpy(open, task->cells, sizeof open);
            search_finely(task, &own, &where, open, task->cell_count, level + 1);
        }
    }
}

// What the quick search has left open.
static void search_open(Task *task) {
    if (task->cell_count == 0 || task->precision == ORACLE_QUICK)
        return;
    FineNet net;
    OpenCell open[OPEN_CELLS] = {{.wu = 1.0, .wv = 1.0}};
    const Part whole = {.wu = 1, .wv = 1};
    int count = task->cell_count <= OPEN_CELLS ? task->cell_count : 1;
    if (task->cell_count <= OPEN_CELLS)
        memcpy(open, task->cells, sizeof open);
    task->fine_unit = project_finely(task, &net);
    search_finely(task, &net, &whole, open, count, 0);
}

// ---- Patches

// False: the patch lies aside.
static bool begin(Task *task, const OraclePatch *patch, int number, Corner *corner) {
    const View *view = task->view;
    task->def = patch->def;
    task->nu = (int)patch->def->degree_u;
    task->nv = (int)patch->def->degree_v;
    task->growth = 1.0;
    for (int n = 0; n < task->nu + task->nv; n++)
        task->growth *= 1.0 + 2.0 * MARGIN;
    task->patch = number;
    task->first = task->out->count;
    task->cell_count = task->fine_parts = task->exact_parts = 0;
    task->projected = false;
    task->last = task->precision == ORACLE_QUICK;
    task->budget = QUICK_BUDGET;
    if (!corner_of(view, patch, task->ray, corner))
        return false;
    task->place.base = corner->z;
    task->place.unit = patch->scale * view->length / (Real)view->dir[view->k];
    set_range(task);
    return true;
}

void ray_oracle_search(RayOracle *oracle, const RayOracleSet *set, const Ray *ray,
                       RayOracleRange range, RayOraclePrecision precision) {
    View view = view_of(ray);
    Task task;
    Corner corner;
    OracleWalk walk;
    const OracleLeaf *leaf;
    int patch, current = -1;
    bool met = false;
    task.ray = ray, task.view = &view, task.range = &range, task.out = oracle;
    task.precision = precision;
    task.cell_count = 0;
    oracle_walk_begin(&walk, set, ray, range.t0, range.t1, 0.0);
    while (oracle_walk_next(&walk, &patch, &leaf)) {
        if (patch != current) {
            search_open(&task);
            met = begin(&task, &set->patches[patch], patch, &corner);
            current = patch;
        }
        if (met)
            search_leaf(&task, &corner, leaf);
    }
    search_open(&task);
}

void ray_oracle_find(RayOracle *oracle, const PatchDef *def, const Ray *ray,
                     RayOraclePrecision precision) {
    const RayOracleRange range = {-INFINITY, INFINITY};
    View view = view_of(ray);
    Task task;
    Corner corner;
    OraclePatch patch;
    OracleLeaf whole;
    double net[4 * ORACLE_POINTS];
    oracle_patch_whole(def, &patch, &whole, net);
    task.ray = ray, task.view = &view, task.range = &range, task.out = oracle;
    task.precision = precision;
    if (!begin(&task, &patch, 0, &corner))
        return;
    search_leaf(&task, &corner, &whole);
    search_open(&task);
    for (int k = task.first; k < oracle->count; k++)
        ray_oracle_sine(&oracle->root[k], def, ray);
}

double ray_oracle_sine(RayOracleRoot *root, const PatchDef *def, const Ray *ray) {
    if (root->sine >= 0.0)
        return root->sine;
    root->sine = 0.0;
    if (root->kind == ROOT_OPEN)
        return 0.0;
    Vec3 s[3];
    ray_oracle_jet(def, fmin(fmax(root->u, 0.0), 1.0), fmin(fmax(root->v, 0.0), 1.0), s);
    const long double a[3] = {s[1].x, s[1].y, s[1].z}, b[3] = {s[2].x, s[2].y, s[2].z};
    const long double d[3] = {ray->dir.x, ray->dir.y, ray->dir.z};
    long double across = 0, n2 = 0, d2 = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        long double n = a[i] * b[j] - a[j] * b[i];
        across += n * d[k];
        n2 += n * n;
        d2 += d[k] * d[k];
    }
    if (n2 > 0)
        root->sine = (double)(fabsl(across) / sqrtl(n2 * d2));
    return root->sine;
}

void ray_oracle(RayOracle *oracle, const PatchDef *def, const Ray *ray, double t_min,
                double t_max) {
    RayOracle all = {.count = 0};
    ray_oracle_find(&all, def, ray, ORACLE_QUICK);
    if (all.open) {
        all.count = all.open = 0;
        ray_oracle_find(&all, def, ray, ORACLE_EXACT);
    }
    Box box = box_empty();
    for (uint32_t k = 0; k < (def->degree_u + 1) * (def->degree_v + 1); k++)
        box = box_extend(box, def->points[k]);
    Vec3 d = vec_sub(box.high, box.low);
    double near =
        1e-8 * fmax(d.x, fmax(d.y, d.z)) / hypot(ray->dir.x, hypot(ray->dir.y, ray->dir.z));
    for (int k = 0; k < all.count; k++) {
        const RayOracleRoot *root = &all.root[k];
        double wide = near + root->dt;
        oracle->doubtful |= fabs(root->t - t_min) < wide || fabs(root->t - t_max) < wide;
        if (!(root->t >= t_min && root->t < t_max))
            continue;
        double edge = fmin(fmin(root->u, 1.0 - root->u), fmin(root->v, 1.0 - root->v));
        oracle->doubtful |= root->kind != ROOT_CERTAIN || edge < 1e-8;
        for (int i = 0; i < oracle->count; i++)
            oracle->doubtful |= fabs(oracle->root[i].t - root->t) < near;
        if (root->kind == ROOT_CERTAIN && oracle->count < RAY_ORACLE_ROOTS)
            oracle->root[oracle->count++] = *root;
    }
}
