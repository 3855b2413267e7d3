// SPDX-License-Identifier: MIT
// In the ray's frame S = (x, y, z) and roots are x = y = 0. A cell whose control points have all
// x or all y of one sign holds none; a cell over which the Jacobian, taken with independent
// intervals for its four entries, cannot vanish holds one at most, and Newton tells. All others are
// halved.
#include "ray_oracle.h"

enum { SIDE = 17, POINTS = SIDE * SIDE, DEPTH = 90, BUDGET = 20000 };

typedef long double Real;

typedef struct {
    Real p[3][POINTS];
    Real u0, u1, v0, v1;
} Cell;

typedef struct {
    const PatchDef *def;
    Cell whole;
    Real length; // of dir
    Real noise;  // a coordinate below this is zero
    Real size;   // of the patch
    double t_min, t_max;
    int work;
    RayOracle *out;
} Task;

static void casteljau(Real *low, Real *high, const Real *from, int n, int step) {
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

static void halve(const PatchDef *def, const Cell *from, bool across_u, Cell *low, Cell *high) {
    int nu = (int)def->degree_u, nv = (int)def->degree_v;
    for (int axis = 0; axis < 3; axis++) {
        const Real *p = from->p[axis];
        Real *a = low->p[axis], *b = high->p[axis];
        if (across_u) {
            for (int j = 0; j <= nv; j++)
                casteljau(a + j, b + j, p + j, nu, nv + 1);
        } else {
            for (int i = 0; i < (nu + 1) * (nv + 1); i += nv + 1)
                casteljau(a + i, b + i, p + i, nv, 1);
        }
    }
    low->u0 = high->u0 = from->u0;
    low->u1 = high->u1 = from->u1;
    low->v0 = high->v0 = from->v0;
    low->v1 = high->v1 = from->v1;
    if (across_u)
        low->u1 = high->u0 = (from->u0 + from->u1) / 2;
    else
        low->v1 = high->v0 = (from->v0 + from->v1) / 2;
}

static Real curve(const Real *p, int n, Real t, Real *slope) {
    Real row[SIDE];
    for (int i = 0; i <= n; i++)
        row[i] = p[i];
    for (int k = n; k > 0; k--) {
        if (k == 1)
            *slope = n * (row[1] - row[0]);
        for (int i = 0; i < k; i++)
            row[i] += t * (row[i + 1] - row[i]);
    }
    return row[0];
}

// Value and both derivatives of one coordinate.
static void surface(const PatchDef *def, const Real *p, Real u, Real v, Real out[3]) {
    int nu = (int)def->degree_u, nv = (int)def->degree_v;
    Real row[SIDE], slope[SIDE], none;
    for (int i = 0; i <= nu; i++)
        row[i] = curve(p + i * (nv + 1), nv, v, &slope[i]);
    out[0] = curve(row, nu, u, &out[1]);
    out[2] = curve(slope, nu, u, &none);
}

typedef struct {
    Real low, high;
} Span;

static Span span_of(const Real *p, int count) {
    Span s = {p[0], p[0]};
    for (int i = 1; i < count; i++) {
        s.low = p[i] < s.low ? p[i] : s.low;
        s.high = p[i] > s.high ? p[i] : s.high;
    }
    return s;
}

static Span slope_span(const PatchDef *def, const Real *p, bool along_u) {
    int nu = (int)def->degree_u, nv = (int)def->degree_v, row = nv + 1, count = 0;
    Real d[POINTS];
    for (int i = 0; i <= nu - along_u; i++) {
        for (int j = 0; j <= nv - !along_u; j++)
            d[count++] = p[i * row + j + (along_u ? row : 1)] - p[i * row + j];
    }
    return span_of(d, count);
}

static Span product(Span a, Span b) {
    const Real p[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    return span_of(p, 4);
}

static bool regular(const PatchDef *def, const Cell *c) {
    Span xu = slope_span(def, c->p[0], true), xv = slope_span(def, c->p[0], false);
    Span yu = slope_span(def, c->p[1], true), yv = slope_span(def, c->p[1], false);
    Span a = product(xu, yv), b = product(xv, yu);
    return a.low > b.high || a.high < b.low;
}

static void add_root(Task *task, Real u, Real v) {
    RayOracle *out = task->out;
    Real x[3], y[3], z[3];
    surface(task->def, task->whole.p[0], u, v, x);
    surface(task->def, task->whole.p[1], u, v, y);
    surface(task->def, task->whole.p[2], u, v, z);
    double t = (double)(z[0] / task->length);
    Real near = 1e-8L * task->size / task->length;
    out->doubtful |= fabsl(t - task->t_min) < near || fabsl(t - task->t_max) < near;
    if (!(t >= task->t_min && t < task->t_max))
        return;
    Real edge = fminl(fminl(u, 1 - u), fminl(v, 1 - v));
    out->doubtful |= edge < 1e-8L;
    for (int i = 0; i < out->count; i++) {
        if (fabsl(out->root[i].u - u) < 1e-12L && fabsl(out->root[i].v - v) < 1e-12L)
            return; // from the cell beside
        out->doubtful |= fabsl(out->root[i].t - t) < near;
    }
    if (out->count == RAY_ORACLE_ROOTS) {
        out->doubtful = true;
        return;
    }
    Real n[3] = {y[1] * z[2] - z[1] * y[2], z[1] * x[2] - x[1] * z[2], x[1] * y[2] - y[1] * x[2]};
    Real sine = fabsl(n[2]) / sqrtl(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    out->root[out->count++] = (RayOracleRoot){t, (double)u, (double)v, (double)sine};
}

// Newton about the cell, which has a regular Jacobian. True: decided.
static bool polish(Task *task, const Cell *c) {
    Real u = (c->u0 + c->u1) / 2, v = (c->v0 + c->v1) / 2;
    Real wu = c->u1 - c->u0, wv = c->v1 - c->v0, x[3], y[3];
    for (int step = 0; step < 50; step++) {
        surface(task->def, task->whole.p[0], u, v, x);
        surface(task->def, task->whole.p[1], u, v, y);
        Real det = x[1] * y[2] - x[2] * y[1];
        Real du = (y[2] * x[0] - x[2] * y[0]) / det, dv = (x[1] * y[0] - y[1] * x[0]) / det;
        u -= du;
        v -= dv;
        if (!(u >= c->u0 - wu && u <= c->u1 + wu && v >= c->v0 - wv && v <= c->v1 + wv))
            return false;
        if (fabsl(du) + fabsl(dv) < 1e-18L)
            break;
    }
    surface(task->def, task->whole.p[0], u, v, x);
    surface(task->def, task->whole.p[1], u, v, y);
    if (fabsl(x[0]) > task->noise || fabsl(y[0]) > task->noise)
        return false;
    const Real tiny = 1e-13L; // on the border both cells may have it, add_root sees that
    if (u < c->u0 - tiny || u > c->u1 + tiny || v < c->v0 - tiny || v > c->v1 + tiny)
        return false; // another cell's; this one goes on until its points say so
    add_root(task, u, v);
    return true;
}

// As the ray sees it; so a collapsed edge is not cut into slices that all contain it.
static bool longer_in_u(const PatchDef *def, const Cell *c) {
    Real length[2] = {0, 0};
    for (int axis = 0; axis < 2; axis++) {
        for (int along_u = 0; along_u < 2; along_u++) {
            Span s = slope_span(def, c->p[axis], along_u);
            Real n = along_u ? def->degree_u : def->degree_v;
            length[along_u] = fmaxl(length[along_u], n * fmaxl(-s.low, s.high));
        }
    }
    return length[1] >= length[0];
}

// Do all points lie on one side of the line through the origin along (dx, dy)?
static bool aside(const Task *task, const Cell *c, int count, Real dx, Real dy) {
    Real length = sqrtl(dx * dx + dy * dy), off[POINTS];
    if (!(length > 0))
        return false;
    for (int i = 0; i < count; i++)
        off[i] = (c->p[0][i] * dy - c->p[1][i] * dx) / length;
    Span s = span_of(off, count);
    return s.low > task->noise || s.high < -task->noise;
}

// Tried: both axes, and along the diagonals of the cell, which suits one seen edge-on.
static bool misses(const Task *task, const Cell *c) {
    int nu = (int)task->def->degree_u, nv = (int)task->def->degree_v, count = (nu + 1) * (nv + 1);
    const Real *x = c->p[0], *y = c->p[1];
    int a = count - 1, b = nv, d = nu * (nv + 1);
    return aside(task, c, count, 1, 0) || aside(task, c, count, 0, 1) ||
           aside(task, c, count, x[a] - x[0], y[a] - y[0]) ||
           aside(task, c, count, x[b] - x[d], y[b] - y[d]);
}

static void search(Task *task, const Cell *c, int depth) {
    int count = (int)((task->def->degree_u + 1) * (task->def->degree_v + 1));
    if (misses(task, c))
        return;
    Span z = span_of(c->p[2], count);
    Real near = 1e-8L * task->size;
    if (z.high < task->t_min * task->length - near || z.low > task->t_max * task->length + near)
        return;
    if (regular(task->def, c) && polish(task, c))
        return;
    if (depth == DEPTH || ++task->work > BUDGET) {
        task->out->doubtful = true;
        return;
    }
    Cell half[2];
    halve(task->def, c, longer_in_u(task->def, c), &half[0], &half[1]);
    search(task, &half[0], depth + 1);
    search(task, &half[1], depth + 1);
}

void ray_oracle(RayOracle *oracle, const PatchDef *def, const Ray *ray, double t_min,
                double t_max) {
    Task task;
    task.def = def;
    task.t_min = t_min;
    task.t_max = t_max;
    task.out = oracle;
    task.work = 0;
    const Real d[3] = {ray->dir.x, ray->dir.y, ray->dir.z};
    task.length = sqrtl(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    // Axes: w along the ray, e1 across it and the axis it is farthest from, e2 across both.
    Real w[3], e1[3], e2[3];
    for (int i = 0; i < 3; i++)
        w[i] = d[i] / task.length;
    int least = fabsl(w[0]) <= fabsl(w[1]) ? 0 : 1;
    least = fabsl(w[2]) < fabsl(w[least]) ? 2 : least;
    int next = (least + 1) % 3, last = (least + 2) % 3;
    Real n = sqrtl(w[next] * w[next] + w[last] * w[last]);
    e1[least] = 0;
    e1[next] = -w[last] / n;
    e1[last] = w[next] / n;
    for (int i = 0; i < 3; i++)
        e2[i] = w[(i + 1) % 3] * e1[(i + 2) % 3] - w[(i + 2) % 3] * e1[(i + 1) % 3];
    Cell *c = &task.whole;
    c->u0 = c->v0 = 0;
    c->u1 = c->v1 = 1;
    Real far = 0;
    task.size = 0;
    for (uint32_t k = 0; k < (def->degree_u + 1) * (def->degree_v + 1); k++) {
        Vec3 q = def->points[k];
        const Real p[3] = {(Real)q.x - ray->org.x, (Real)q.y - ray->org.y, (Real)q.z - ray->org.z};
        for (int axis = 0; axis < 3; axis++) {
            const Real *e = axis == 0 ? e1 : axis == 1 ? e2 : w;
            c->p[axis][k] = p[0] * e[0] + p[1] * e[1] + p[2] * e[2];
            far = fmaxl(far, fabsl(p[axis]));
            task.size =
                fmaxl(task.size, fabsl((Real)vec_get(q, axis) - vec_get(def->points[0], axis)));
        }
    }
    task.noise = far * 4e-18L;
    search(&task, c, 0);
}

void ray_oracle_jet(const PatchDef *def, double u, double v, Vec3 out[3]) {
    Real s[3][3];
    for (int axis = 0; axis < 3; axis++) {
        Real p[POINTS];
        for (uint32_t k = 0; k < (def->degree_u + 1) * (def->degree_v + 1); k++)
            p[k] = vec_get(def->points[k], axis);
        surface(def, p, u, v, s[axis]);
    }
    for (int k = 0; k < 3; k++)
        out[k] = vec3((double)s[0][k], (double)s[1][k], (double)s[2][k]);
}

double ray_oracle_residual(const PatchDef *def, const Ray *ray, double t, double u, double v) {
    Real square = 0;
    for (int axis = 0; axis < 3; axis++) {
        Real p[POINTS], s[3];
        for (uint32_t k = 0; k < (def->degree_u + 1) * (def->degree_v + 1); k++)
            p[k] = (Real)vec_get(def->points[k], axis) - vec_get(ray->org, axis);
        surface(def, p, u, v, s);
        Real off = (Real)t * vec_get(ray->dir, axis) - s[0];
        square += off * off;
    }
    return (double)sqrtl(square);
}
