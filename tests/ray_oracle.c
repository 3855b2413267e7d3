// SPDX-License-Identifier: MIT
#include "ray_oracle.h"

#include <stdlib.h>
#include <string.h>

enum {
    SIDE = 17,
    POINTS = SIDE * SIDE,
    DEPTH = 200, // halvings of one cell: __float128 has 113 bits each way
    QUICK_DEPTH = 44,
    QUICK_BUDGET = 200,
    EXACT_BUDGET = 1000,
    NEAR_BUDGET = 8000,
};
#define MARGIN 0x1p-6

// A cell that was left open, or has a root that may lie outside of the patch.
typedef struct {
    double u, v, wu, wv;
} OpenCell;
enum { OPEN_CELLS = 64 };

typedef struct {
    const PatchDef *def;
    const Ray *ray;
    int nu, nv;
    double growth; // (1 + 2 MARGIN)^(nu + nv)
    RayOracle *out;
    int first; // item of this patch in out
    OpenCell cells[OPEN_CELLS];
    int cell_count; // may exceed OPEN_CELLS: then not all are noted
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

static double sine_at(const Task *task, double u, double v) {
    Vec3 s[3];
    ray_oracle_jet(task->def, u, v, s);
    const long double a[3] = {s[1].x, s[1].y, s[1].z}, b[3] = {s[2].x, s[2].y, s[2].z};
    const long double d[3] = {task->ray->dir.x, task->ray->dir.y, task->ray->dir.z};
    long double across = 0, n2 = 0, d2 = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        long double n = a[i] * b[j] - a[j] * b[i];
        across += n * d[k];
        n2 += n * n;
        d2 += d[k] * d[k];
    }
    return n2 > 0 ? (double)(fabsl(across) / sqrtl(n2 * d2)) : 0.0;
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
        if (item.kind != ROOT_OPEN)
            return;
        join_items(other, &item);
        return;
    }
    if (out->count == RAY_ORACLE_ROOTS) { // the last takes what finds no room
        RayOracleRoot *last = &out->root[out->count - 1];
        out->open += last->kind == ROOT_CERTAIN;
        last->kind = ROOT_OPEN;
        join_items(last, &item);
        return;
    }
    if (item.kind != ROOT_OPEN)
        item.sine = sine_at(task, fmin(fmax(item.u, 0.0), 1.0), fmin(fmax(item.v, 0.0), 1.0));
    out->open += item.kind != ROOT_CERTAIN;
    out->root[out->count++] = item;
}

static void add_item(Task *task, double t, double dt, double u, double v, double du, double dv,
                     RayOracleKind kind) {
    // Rounding to double, if it came from more.
    dt += 0x1p-52 * fabs(t);
    add_root(task, (RayOracleRoot){kind, t, u, v, dt, du, dv, 0.0});
}

// ---- The search

// Halvings are exact in double down to 2^-53 of the patch; a smaller cell is widened to that.
static void note_cell(Task *task, double u, double v, double wu, double wv) {
    const double least = 0x1p-48;
    if (task->cell_count++ >= OPEN_CELLS)
        return;
    if (wu < least)
        u = fmax(u - least, 0.0), wu = fmin(3.0 * least, 1.0 - u);
    if (wv < least)
        v = fmax(v - least, 0.0), wv = fmin(3.0 * least, 1.0 - v);
    task->cells[task->cell_count - 1] = (OpenCell){u, v, wu, wv};
}

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

// What the quick search leaves open is searched again, exactly, and only there.
void ray_oracle_find(RayOracle *oracle, const PatchDef *def, const Ray *ray,
                     RayOraclePrecision precision) {
    Task task = {.def = def, .ray = ray, .out = oracle, .first = oracle->count};
    task.nu = (int)def->degree_u;
    task.nv = (int)def->degree_v;
    int open = oracle->open;
    task.growth = pow(1.0 + 2.0 * MARGIN, task.nu + task.nv);
    quick_find(&task, QUICK_BUDGET, QUICK_DEPTH);
    if (precision == ORACLE_QUICK || !task.cell_count)
        return;
    int kept = task.first, noted = task.cell_count;
    for (int k = task.first; noted <= OPEN_CELLS && k < oracle->count; k++)
        if (oracle->root[k].kind == ROOT_CERTAIN)
            oracle->root[kept++] = oracle->root[k];
    oracle->count = kept;
    oracle->open = open;
    OpenCell cells[OPEN_CELLS];
    memcpy(cells, task.cells, sizeof cells);
    if (noted <= OPEN_CELLS)
        exact_find_in(&task, cells, noted, EXACT_BUDGET, DEPTH);
    else
        exact_find(&task, EXACT_BUDGET, DEPTH);
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

// ---- Near the ray

typedef long double Real;

// Coordinates of a strip, each times the weight, and the weight. CROSS: (P - org) x dir, AXIS: P -
// org. Where the patch is much longer along one axis than along another, and the ray askew, only
// these tell places along it from places across.
enum { ACROSS, OTHER, DEPTH_T, CROSS, AXIS = CROSS + 3, PLACES = AXIS + 3, WEIGHT = PLACES, STRIP };

typedef struct {
    Real p[STRIP][POINTS];
} Strip;

typedef struct {
    int nu, nv;
    Real reach;                     // lateral
    Real t0, t1;                    // of one step of depth
    Real low[PLACES], high[PLACES]; // what no point within reach at these depths can leave
} Tube;

static void halve_line(Real *low, Real *high, const Real *from, int n, int step) {
    Real row[SIDE];
    for (int i = 0; i <= n; i++)
        row[i] = from[i * step];
    for (int k = 0; k <= n; k++) {
        low[k * step] = row[0];
        high[(n - k) * step] = row[n - k];
        for (int i = 0; i < n - k; i++)
            row[i] = 0.5L * (row[i] + row[i + 1]);
    }
}

static Real least_of(const Real *p, int count) {
    Real least = p[0];
    for (int k = 1; k < count; k++)
        least = p[k] < least ? p[k] : least;
    return least;
}

static Real most_of(const Real *p, int count) {
    Real most = p[0];
    for (int k = 1; k < count; k++)
        most = p[k] > most ? p[k] : most;
    return most;
}

static Real larger(Real a, Real b) { return a > b ? a : b; }

static Real step_of(const Strip *s, int c, int a, int b) {
    return fabsl(s->p[c][a] / s->p[WEIGHT][a] - s->p[c][b] / s->p[WEIGHT][b]);
}

// Which direction is longer, depth counted as far as it exceeds its step?
static bool longer_in_u(const Tube *tube, const Strip *s) {
    int nu = tube->nu, nv = tube->nv, count = (nu + 1) * (nv + 1);
    Real size[2] = {0, 0};
    for (int c = ACROSS; c <= DEPTH_T; c++) {
        Real scale = c < DEPTH_T ? 1 : tube->reach / (tube->t1 - tube->t0);
        for (int k = 0; k < count; k++) {
            if (k > nv)
                size[0] = larger(size[0], scale * nu * step_of(s, c, k, k - nv - 1));
            if (k % (nv + 1))
                size[1] = larger(size[1], scale * nv * step_of(s, c, k, k - 1));
        }
    }
    return size[0] >= size[1];
}

typedef enum { PART_OFF, PART_WITHIN, PART_OPEN } Part;

// Is the strip within reach of the ray, at a depth within half a step of the tube's?
static Part judge_strip(const Tube *tube, const Strip *s) {
    int count = (tube->nu + 1) * (tube->nv + 1);
    Real low[PLACES], high[PLACES];
    for (int c = 0; c < PLACES; c++) {
        Real p[POINTS] = {0};
        for (int k = 0; k < count; k++)
            p[k] = s->p[c][k] / s->p[WEIGHT][k];
        low[c] = least_of(p, count);
        high[c] = most_of(p, count);
        if (low[c] > tube->high[c] || high[c] < tube->low[c])
            return PART_OFF;
    }
    bool inside = hypotl(larger(-low[0], high[0]), larger(-low[1], high[1])) <= tube->reach;
    bool level = high[2] - low[2] <= 0.5L * (tube->t1 - tube->t0);
    if (inside && level)
        return PART_WITHIN;
    bool small = high[0] - low[0] <= 0.125L * tube->reach;
    return level && small && high[1] - low[1] <= 0.125L * tube->reach ? PART_OFF : PART_OPEN;
}

enum { NEAR_DEPTH = 160 };

// Has strips[0] a part that is? Of each halved one both halves are looked at, one after the other;
// there is room for NEAR_DEPTH + 2.
static bool enters(const Tube *tube, Strip *strips) {
    int nu = tube->nu, nv = tube->nv, count = (nu + 1) * (nv + 1), top = 1, budget = NEAR_BUDGET;
    while (top > 0 && budget-- > 0) {
        Strip *s = &strips[top - 1];
        Part part = judge_strip(tube, s);
        if (part == PART_WITHIN)
            return true;
        if (part == PART_OFF || top > NEAR_DEPTH) {
            top--;
            continue;
        }
        bool along_u = longer_in_u(tube, s);
        for (int c = 0; c < STRIP; c++) {
            // halve_line() has read a line before it writes it.
            Real *p = s->p[c], *b = strips[top].p[c];
            for (int k = 0; along_u && k <= nv; k++)
                halve_line(p + k, b + k, p + k, nu, nv + 1);
            for (int k = 0; !along_u && k < count; k += nv + 1)
                halve_line(p + k, b + k, p + k, nv, 1);
        }
        top++;
    }
    return false;
}

// A frame across the ray, and along it.
typedef struct {
    Real e1[3], e2[3], w[3], length;
} Frame;

static Frame frame_of(const Ray *ray) {
    Frame f;
    const Real d[3] = {ray->dir.x, ray->dir.y, ray->dir.z};
    f.length = sqrtl(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++)
        f.w[i] = d[i] / f.length;
    int least = fabsl(f.w[0]) <= fabsl(f.w[1]) ? 0 : 1;
    least = fabsl(f.w[2]) < fabsl(f.w[least]) ? 2 : least;
    int next = (least + 1) % 3, last = (least + 2) % 3;
    Real n = sqrtl(f.w[next] * f.w[next] + f.w[last] * f.w[last]);
    f.e1[least] = 0;
    f.e1[next] = -f.w[last] / n;
    f.e1[last] = f.w[next] / n;
    for (int i = 0; i < 3; i++)
        f.e2[i] = f.w[(i + 1) % 3] * f.e1[(i + 2) % 3] - f.w[(i + 2) % 3] * f.e1[(i + 1) % 3];
    return f;
}

static Real along(const Real a[3], const Real b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void lay_along(const PatchDef *def, const Ray *ray, const Frame *f, Tube *tube, Strip *s) {
    const Real d[3] = {ray->dir.x, ray->dir.y, ray->dir.z};
    for (uint32_t k = 0; k < (def->degree_u + 1) * (def->degree_v + 1); k++) {
        Real q[3], w = def->weights ? def->weights[k] : 1.0;
        for (int axis = 0; axis < 3; axis++)
            q[axis] = (Real)vec_get(def->points[k], axis) - vec_get(ray->org, axis);
        s->p[ACROSS][k] = w * along(q, f->e1);
        s->p[OTHER][k] = w * along(q, f->e2);
        s->p[DEPTH_T][k] = w * along(q, f->w) / f->length;
        for (int axis = 0; axis < 3; axis++) {
            int a = (axis + 1) % 3, b = (axis + 2) % 3;
            s->p[CROSS + axis][k] = w * (q[a] * d[b] - q[b] * d[a]);
            s->p[AXIS + axis][k] = w * q[axis];
        }
        s->p[WEIGHT][k] = w;
    }
    tube->low[ACROSS] = tube->low[OTHER] = -tube->reach;
    tube->high[ACROSS] = tube->high[OTHER] = tube->reach;
    tube->low[DEPTH_T] = tube->t0;
    tube->high[DEPTH_T] = tube->t1;
    for (int axis = 0; axis < 3; axis++) {
        Real most = tube->reach * (fabsl(d[(axis + 1) % 3]) + fabsl(d[(axis + 2) % 3]));
        tube->low[CROSS + axis] = -most;
        tube->high[CROSS + axis] = most;
        Real a = tube->t0 * d[axis], b = tube->t1 * d[axis];
        tube->low[AXIS + axis] = (a < b ? a : b) - tube->reach;
        tube->high[AXIS + axis] = (a < b ? b : a) + tube->reach;
    }
}

bool ray_oracle_near(const PatchDef *defs, int count, const Ray *ray, double t0, double t1,
                     double reach) {
    enum { STEPS = 16 };
    if (!(t0 < t1))
        return true;
    Frame f = frame_of(ray);
    // 7 MB at the highest degrees: too much for the stack of a thread.
    Strip *strips = malloc((NEAR_DEPTH + 2) * sizeof *strips);
    bool all = strips != NULL;
    Real step = ((Real)t1 - (Real)t0) / STEPS, pad = reach / f.length;
    for (int n = 0; all && n < STEPS; n++) {
        int at = 7 * (n + 1) % STEPS; // not in order: where it fails, it fails far from the ends
        bool found = false;
        for (int k = 0; k < count && !found; k++) {
            Tube tube = {.nu = (int)defs[k].degree_u,
                         .nv = (int)defs[k].degree_v,
                         .reach = reach,
                         .t0 = t0 + at * step - pad,
                         .t1 = t0 + (at + 1) * step + pad};
            lay_along(&defs[k], ray, &f, &tube, &strips[0]);
            found = enters(&tube, strips);
        }
        all = found;
    }
    free(strips);
    return all;
}

// ---- Points

// Bernstein polynomials of degree n, and n times those of degree n - 1, which the differences of
// control points have in the derivative: equal points have the derivative 0 exactly. All terms are
// >= 0 for t in [0,1], so a sum of them keeps its relative accuracy, that of weights too.
static void basis(int n, Real t, Real *value, Real *slope) {
    Real low[SIDE] = {1};
    for (int m = 1; m < n; m++) {
        for (int i = m; i > 0; i--)
            low[i] = (i < m ? low[i] * (1 - t) : 0) + low[i - 1] * t;
        low[0] *= 1 - t;
    }
    for (int i = 0; i <= n; i++) {
        value[i] = (i < n ? low[i] * (1 - t) : 0) + (i > 0 ? low[i - 1] * t : 0);
        slope[i] = i < n ? n * low[i] : 0;
    }
}

typedef struct {
    Real u[SIDE], v[SIDE], slope_u[SIDE], slope_v[SIDE];
} Basis;

// One axis less `from`, times the weights; axis 3: the weights. out[1] and out[2], the derivatives,
// only when asked for.
static void coordinate(const PatchDef *def, const Basis *b, int axis, double from, bool slopes,
                       Real out[3]) {
    int nu = (int)def->degree_u, nv = (int)def->degree_v;
    Real before = 0;
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i <= nu; i++) {
        Real row = 0, slope = 0, last = 0;
        for (int j = 0; j <= nv; j++) {
            int k = i * (nv + 1) + j;
            Real p = axis < 3 ? (Real)vec_get(def->points[k], axis) - from : 1;
            if (def->weights)
                p *= def->weights[k];
            row += b->v[j] * p;
            if (slopes && j > 0)
                slope += b->slope_v[j - 1] * (p - last);
            last = p;
        }
        out[0] += b->u[i] * row;
        if (i > 0)
            out[1] += b->slope_u[i - 1] * (row - before);
        out[2] += b->u[i] * slope;
        before = row;
    }
}

// The point less `from`, and the derivatives if asked for.
static void jet_less(const PatchDef *def, Vec3 from, Real u, Real v, bool slopes, Real s[3][3]) {
    Basis b;
    Real w[3] = {1, 0, 0};
    basis((int)def->degree_u, u, b.u, b.slope_u);
    basis((int)def->degree_v, v, b.v, b.slope_v);
    if (def->weights)
        coordinate(def, &b, 3, 0.0, slopes, w);
    for (int axis = 0; axis < 3; axis++) {
        coordinate(def, &b, axis, vec_get(from, axis), slopes, s[axis]);
        s[axis][0] /= w[0];
        for (int k = 1; k < 3; k++)
            s[axis][k] = (s[axis][k] - s[axis][0] * w[k]) / w[0];
    }
}

void ray_oracle_jet(const PatchDef *def, double u, double v, Vec3 out[3]) {
    Real s[3][3];
    jet_less(def, vec3(0.0, 0.0, 0.0), u, v, true, s);
    for (int k = 0; k < 3; k++)
        out[k] = vec3((double)s[0][k], (double)s[1][k], (double)s[2][k]);
}

double ray_oracle_residual(const PatchDef *def, const Ray *ray, double t, double u, double v) {
    Real s[3][3], square = 0;
    jet_less(def, ray->org, u, v, false, s);
    for (int axis = 0; axis < 3; axis++) {
        Real off = (Real)t * vec_get(ray->dir, axis) - s[axis][0];
        square += off * off;
    }
    return (double)sqrtl(square);
}

// Moves (u,v) towards the ray by the shortest way, as far as the larger tangent across it leads, in
// so many steps.
// Returns what is left of the distance, and how far along the ray that is.
static Real approach(const PatchDef *def, const Ray *ray, const Frame *f, int steps, Real at[2],
                     Real *depth) {
    Real off = 0;
    for (int step = 0; step <= steps; step++) {
        Real s[3][3], q[3], su[3], sv[3];
        jet_less(def, ray->org, at[0], at[1], true, s);
        for (int axis = 0; axis < 3; axis++)
            q[axis] = s[axis][0], su[axis] = s[axis][1], sv[axis] = s[axis][2];
        Real x = along(q, f->e1), y = along(q, f->e2);
        Real xu = along(su, f->e1), yu = along(su, f->e2), xv = along(sv, f->e1),
             yv = along(sv, f->e2);
        off = hypotl(x, y);
        *depth = along(q, f->w);
        // (J J^T + damping)^-1 (x, y)
        Real a = xu * xu + xv * xv, b = xu * yu + xv * yv, c = yu * yu + yv * yv;
        Real damping = 1e-12L * (a + c);
        a += damping, c += damping;
        Real det = a * c - b * b, p = (c * x - b * y) / det, r = (a * y - b * x) / det;
        if (!(det > 0) || step == steps)
            break;
        at[0] = fminl(fmaxl(at[0] - (xu * p + yu * r), 0), 1);
        at[1] = fminl(fmaxl(at[1] - (xv * p + yv * r), 0), 1);
    }
    return off;
}

// The straight way, each place moved towards the ray.
static bool way_within(const PatchDef *def, const Ray *ray, const double from[2],
                       const double to[2], double reach, int steps) {
    enum { PLACES_ON_WAY = 32 };
    Frame f = frame_of(ray);
    Real depth[PLACES_ON_WAY + 1];
    for (int n = 0; n <= PLACES_ON_WAY; n++) {
        Real share = (Real)n / PLACES_ON_WAY;
        Real at[2] = {from[0] + share * ((Real)to[0] - from[0]),
                      from[1] + share * ((Real)to[1] - from[1])};
        if (!(approach(def, ray, &f, steps, at, &depth[n]) <= reach))
            return false;
    }
    // Between two crossings apart all would have come to either, with one step from this to that.
    Real most = fabsl(depth[PLACES_ON_WAY] - depth[0]) / 8 + reach;
    for (int n = 1; n <= PLACES_ON_WAY; n++)
        if (!(fabsl(depth[n] - depth[n - 1]) <= most))
            return false;
    return true;
}

bool ray_oracle_way(const PatchDef *def, const Ray *ray, const double from[2], const double to[2],
                    double reach) {
    return way_within(def, ray, from, to, reach, 0) || way_within(def, ray, from, to, reach, 4);
}
