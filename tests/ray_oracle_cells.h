// SPDX-License-Identifier: MIT
// The search of ray_oracle.c, written once for two kinds of numbers. Included twice, with
//   REAL, UNIT   the cells' numbers, and the rounding of one operation relative to its result
//   WIDE, WIDE_UNIT  those in which the place in the patch is told
//   NAME(x)      the name with the kind's suffix
//
// In the plane across the ray S = (x, y), and roots are x = y = 0. Cells of a place (a part of the
// patch, parameters [0,1]^2) are halved; each carries a bound of the rounding of its coefficients
// (ex, ey). With J the mean Jacobian over a cell, local parameters (p,q) in [0,1]^2 and the
// Lipschitz constant L of the remainder F(p,q) - (p,q), where F = J^-1 (x, y):
//   no root      the coefficients have one sign, or -remainder misses [0,1], or |F| at the middle
//                is more than (1 + L)/2;
//   one at most  L < 1, also over the cell enlarged by MARGIN to each side, over which a polynomial
//                of degree n grows by (1 + 2 MARGIN)^n at most;
//   one          (L < 1 and) |F| <= (1 - L) r at a point whose box of radius r lies in the enlarged
//                cell: q -> q - F(q) maps that box into itself (Brouwer).
// What can be shown neither way at the size of the rounding stays open.

typedef struct {
    REAL p[4][ORACLE_POINTS]; // x, y, z: depth, times the weights, and the weights (rational only)
    REAL u, v, wu, wv;        // the cell is [u, u + wu] x [v, v + wv]: halvings, so exact
    REAL ex, ey, ez;          // of x, of y, of z for each unit of the weight
} NAME(Cell);

typedef struct {
    REAL low, high, most;
} NAME(Span);

static inline REAL NAME(abs)(REAL a) { return a < 0 ? -a : a; }
static inline REAL NAME(max)(REAL a, REAL b) { return a > b ? a : b; }
static inline REAL NAME(min)(REAL a, REAL b) { return a < b ? a : b; }

static inline NAME(Span) NAME(span_of)(const REAL *p, int count) {
    // Four at a time, so that none waits for the one before.
    REAL low[4], high[4];
    for (int n = 0; n < 4; n++)
        low[n] = high[n] = p[n];
    for (int k = 4; k < count; k++) {
        low[k % 4] = NAME(min)(p[k], low[k % 4]);
        high[k % 4] = NAME(max)(p[k], high[k % 4]);
    }
    NAME(Span)
    s = {NAME(min)(NAME(min)(low[0], low[1]), NAME(min)(low[2], low[3])),
         NAME(max)(NAME(max)(high[0], high[1]), NAME(max)(high[2], high[3])), 0};
    s.most = NAME(max)(NAME(abs)(s.low), NAME(abs)(s.high));
    return s;
}

static inline bool NAME(one_sign)(const NAME(Span) * s, REAL error) {
    return s->low > error || s->high < -error;
}

static inline void NAME(halve_line)(REAL *low, REAL *high, int n, int step) {
    REAL row[ORACLE_SIDE];
    for (int i = 0; i <= n; i++)
        row[i] = low[i * step];
    for (int k = 0; k <= n; k++) {
        low[k * step] = row[0];
        high[(n - k) * step] = row[n - k];
        for (int i = 0; i < n - k; i++)
            row[i] = (REAL)0.5 * (row[i] + row[i + 1]);
    }
}

// An average errs by UNIT of its value, and there are n levels of them. One half replaces the cell,
// the other goes to `high`.
static inline void NAME(halve)(const Task *task, int nu, int nv, bool along_u, const REAL most[3],
                               NAME(Cell) * cell, NAME(Cell) * high) {
    int n = along_u ? nu : nv, count = (nu + 1) * (nv + 1);
    for (int c = 0; c < (task->def->weights ? 4 : 3); c++) {
        for (int j = 0; along_u && j <= nv; j++)
            NAME(halve_line)(cell->p[c] + j, high->p[c] + j, nu, nv + 1);
        for (int i = 0; !along_u && i < count; i += nv + 1)
            NAME(halve_line)(cell->p[c] + i, high->p[c] + i, nv, 1);
    }
    high->ex = cell->ex += n * UNIT * most[0];
    high->ey = cell->ey += n * UNIT * most[1];
    high->ez = cell->ez += n * UNIT * most[2];
    *(along_u ? &cell->wu : &cell->wv) *= (REAL)0.5;
    high->wu = cell->wu, high->wv = cell->wv;
    high->u = along_u ? cell->u + cell->wu : cell->u;
    high->v = along_u ? cell->v : cell->v + cell->wv;
}

static inline REAL NAME(curve)(const REAL *p, int step, int n, REAL t, REAL *slope) {
    REAL row[ORACLE_SIDE];
    row[0] = p[0];
    *slope = 0;
    for (int i = 1; i <= n; i++)
        row[i] = p[i * step];
    for (int k = n; k > 0; k--) {
        if (k == 1)
            *slope = n * (row[1] - row[0]);
        for (int i = 0; i < k; i++)
            row[i] += t * (row[i + 1] - row[i]);
    }
    return row[0];
}

// Value and both derivatives of one coordinate. The value errs by 3 UNIT max|p| a level, times
// (1 + 2 |t|) each when t lies outside of [0,1] a little: 8 (nu + nv) UNIT max|p| covers it.
static inline REAL NAME(surface)(int nu, int nv, const REAL *p, REAL u, REAL v, REAL *pu,
                                 REAL *pv) {
    REAL row[ORACLE_SIDE] = {0}, slope[ORACLE_SIDE] = {0}, none;
    for (int i = 0; i <= nu; i++)
        row[i] = NAME(curve)(p + i * (nv + 1), 1, nv, v, &slope[i]);
    *pv = NAME(curve)(slope, 1, nu, u, &none);
    return NAME(curve)(row, 1, nu, u, pu);
}

// Mean differences of opposite sides.
static inline void NAME(trends)(int nu, int nv, const REAL *p, REAL *pu, REAL *pv) {
    REAL a = 0, b = 0;
    for (int j = 0; j <= nv; j++)
        a += p[nu * (nv + 1) + j] - p[j];
    for (int i = 0; i <= nu; i++)
        b += p[i * (nv + 1) + nv] - p[i * (nv + 1)];
    *pu = a / (nv + 1);
    *pv = b / (nu + 1);
}

// The longest step between neighbours, along u and along v.
static inline void NAME(steps)(int nu, int nv, const REAL *p, REAL *along_u, REAL *along_v) {
    REAL du = 0, dv = 0;
    for (int k = nv + 1; k < (nu + 1) * (nv + 1); k++)
        du = NAME(max)(NAME(abs)(p[k] - p[k - nv - 1]), du);
    for (int i = 0; i <= nu; i++)
        for (int k = i * (nv + 1); k < i * (nv + 1) + nv; k++)
            dv = NAME(max)(NAME(abs)(p[k + 1] - p[k]), dv);
    *along_u = du, *along_v = dv;
}

// F's rows: bx x + by y.
typedef struct {
    REAL ax, ay, bx, by;
    REAL ea, eb; // error of either, coefficients and arithmetic
    REAL lipschitz;
    bool hidden; // which side of the line the cell lies on is a matter of rounding only
} NAME(Map);

// Span and Lipschitz constant of one remainder.
static inline NAME(Span) NAME(remainder)(int nu, int nv, const NAME(Cell) * c, REAL fx, REAL fy,
                                         bool along_u, REAL *lipschitz) {
    REAL r[ORACLE_POINTS], du, dv;
    const REAL *x = c->p[0], *y = c->p[1];
    r[0] = 0;
    for (int i = 0; i <= nu; i++) {
        for (int j = 0; j <= nv; j++) {
            int k = i * (nv + 1) + j;
            REAL linear = along_u ? (REAL)i / nu : (REAL)j / nv;
            r[k] = fx * x[k] + fy * y[k] - linear;
        }
    }
    NAME(steps)(nu, nv, r, &du, &dv);
    *lipschitz = nu * du + nv * dv;
    return NAME(span_of)(r, (nu + 1) * (nv + 1));
}

// Do all points lie on one side of the line through the origin along the longer of two directions?
static inline bool NAME(aside)(const NAME(Cell) * c, int count, const REAL most[3],
                               const REAL trend[4], NAME(Map) * map) {
    REAL xu = trend[0], xv = trend[1], yu = trend[2], yv = trend[3], r[ORACLE_POINTS];
    bool first = NAME(abs)(xu) + NAME(abs)(yu) >= NAME(abs)(xv) + NAME(abs)(yv);
    REAL gx = first ? xu : xv, gy = first ? yu : yv;
    r[0] = 0;
    for (int k = 0; k < count; k++)
        r[k] = gx * c->p[1][k] - gy * c->p[0][k];
    REAL error =
        NAME(abs)(gx) * (c->ey + 4 * UNIT * most[1]) + NAME(abs)(gy) * (c->ex + 4 * UNIT * most[0]);
    NAME(Span) s = NAME(span_of)(r, count);
    map->hidden = error > 0 && s.most <= 4 * error;
    return NAME(one_sign)(&s, error);
}

// False: no root in the cell. map->lipschitz is above 1 when J is no help.
static inline bool NAME(reduce)(int nu, int nv, const NAME(Cell) * c, const REAL most[3],
                                NAME(Map) * map) {
    int count = (nu + 1) * (nv + 1);
    REAL trend[4];
    map->lipschitz = 9;
    NAME(trends)(nu, nv, c->p[0], &trend[0], &trend[1]);
    NAME(trends)(nu, nv, c->p[1], &trend[2], &trend[3]);
    if (NAME(aside)(c, count, most, trend, map))
        return false;
    REAL xu = trend[0], xv = trend[1], yu = trend[2], yv = trend[3];
    REAL det = xu * yv - xv * yu, scale = NAME(abs)(xu * yv) + NAME(abs)(xv * yu);
    if (!(NAME(abs)(det) > 64 * UNIT * scale))
        return true;
    map->ax = yv / det, map->ay = -xv / det, map->bx = -yu / det, map->by = xu / det;
    REAL tx = c->ex + 4 * UNIT * most[0], ty = c->ey + 4 * UNIT * most[1];
    map->ea = NAME(abs)(map->ax) * tx + NAME(abs)(map->ay) * ty + 4 * UNIT;
    map->eb = NAME(abs)(map->bx) * tx + NAME(abs)(map->by) * ty + 4 * UNIT;
    REAL lipschitz[2];
    NAME(Span) a = NAME(remainder)(nu, nv, c, map->ax, map->ay, true, &lipschitz[0]);
    if (-a.high - map->ea > 1 || -a.low + map->ea < 0)
        return false;
    NAME(Span) b = NAME(remainder)(nu, nv, c, map->bx, map->by, false, &lipschitz[1]);
    if (-b.high - map->eb > 1 || -b.low + map->eb < 0)
        return false;
    map->lipschitz =
        NAME(max)(lipschitz[0], lipschitz[1]) + 2 * (nu + nv) * NAME(max)(map->ea, map->eb);
    return true;
}

// |F| at a point, with its error.
static inline REAL NAME(residual)(int nu, int nv, const NAME(Map) * map, REAL x, REAL y) {
    REAL a = NAME(abs)(map->ax * x + map->ay * y), b = NAME(abs)(map->bx * x + map->by * y);
    int times = 1 + 2 * (nu + nv); // ea counts 4 UNIT of the coefficients: 8 (nu + nv) as well
    return NAME(max)(a + times * map->ea, b + times * map->eb);
}

// ---- Depths

// The largest size of a depth. Weights are positive.
static inline REAL NAME(farthest)(const Task *task, int count, const NAME(Cell) * c) {
    REAL far = 0;
    if (!task->def->weights)
        return NAME(span_of)(c->p[2], count).most;
    for (int k = 0; k < count; k++)
        far = NAME(max)(NAME(abs)(c->p[2][k] / c->p[3][k]), far);
    return far;
}

// Depth (z / weight) at a point of the cell, and its error when the point is uncertain by (rp, rq).
// With N = sum (z - depth weight) B, which is 0 at the point, and W = sum weight B, it is off by
// N / W elsewhere; their slopes come from differences, over the cell enlarged by MARGIN.
static REAL NAME(depth)(const Task *task, const NAME(Cell) * c, REAL p, REAL q, REAL rp, REAL rq,
                        REAL *error) {
    int nu = task->nu, nv = task->nv, count = (nu + 1) * (nv + 1);
    REAL off[ORACLE_POINTS], du, dv, w = 1, least = 1, far = NAME(farthest)(task, count, c);
    REAL z = NAME(surface)(nu, nv, c->p[2], p, q, &du, &dv);
    if (task->def->weights) {
        w = NAME(surface)(nu, nv, c->p[3], p, q, &du, &dv);
        z /= w;
        NAME(steps)(nu, nv, c->p[3], &du, &dv);
        least = w - (REAL)task->growth * (nu * du * rp + nv * dv * rq);
        least = NAME(max)(least, NAME(span_of)(c->p[3], count).low / 2);
    }
    off[0] = 0;
    for (int k = 0; k < count; k++)
        off[k] = c->p[2][k] - z * (task->def->weights ? c->p[3][k] : 1);
    NAME(steps)(nu, nv, off, &du, &dv);
    *error = (REAL)task->growth * (nu * du * rp + nv * dv * rq) / least +
             2 * (c->ez + 16 * (nu + nv) * UNIT * far);
    return z;
}

static void NAME(add)(Task *task, WIDE u, WIDE v, WIDE ru, WIDE rv, REAL z, REAL ez,
                      RayOracleKind kind) {
    const Place *at = &task->place;
    long double t = (at->base + (long double)z) * at->unit;
    long double dt = fabsl((long double)ez * at->unit) + 0x1p-62L * fabsl(at->base * at->unit);
    add_item(task, (double)t, (double)dt, (double)u, (double)v, (double)ru, (double)rv, kind);
}

// Is it all at depths that were not asked for?
static inline bool NAME(elsewhere)(const Task *task, int count, const NAME(Cell) * c) {
    const Place *at = &task->place;
    REAL low = (REAL)at->z_low, high = (REAL)at->z_high, more = 0, less = 0;
    const REAL *z = c->p[2], *w = c->p[3];
    if (!task->def->weights) {
        NAME(Span) s = NAME(span_of)(z, count);
        return s.low - c->ez > high || s.high + c->ez < low;
    }
    for (int k = 0; k < count; k++) {
        more += !(z[k] - c->ez * w[k] > high * w[k] + 4 * UNIT * NAME(abs)(high * w[k]));
        less += !(z[k] + c->ez * w[k] < low * w[k] - 4 * UNIT * NAME(abs)(low * w[k]));
    }
    return more == 0 || less == 0;
}

// With the depths of all of the cell, so that what lies behind an answer need not be decided.
static void NAME(leave_open)(Task *task, const NAME(Cell) * c) {
    const REAL half = (REAL)0.5;
    const Place *at = &task->place;
    REAL low = 0, high = 0;
    int count = (task->nu + 1) * (task->nv + 1);
    for (int k = 0; k < count; k++) {
        REAL w = task->def->weights ? c->p[3][k] : 1, z = c->p[2][k] / w;
        low = k == 0 || z < low ? z : low;
        high = k == 0 || z > high ? z : high;
    }
    note_cell(task, (double)c->u, (double)c->v, (double)c->wu, (double)c->wv);
    if (task->last)
        NAME(add)
    (task, at->u + at->wu * (WIDE)(c->u + half * c->wu),
     at->v + at->wv * (WIDE)(c->v + half * c->wv), at->wu * (WIDE)c->wu, at->wv * (WIDE)c->wv,
     half * (low + high), half * (high - low) + c->ez, ROOT_OPEN);
}

// ---- The search

// A root within r of (p,q) in the cell.
static void NAME(settled)(Task *task, const NAME(Cell) * c, REAL p, REAL q, REAL r) {
    const Place *at = &task->place;
    WIDE u = at->u + at->wu * (WIDE)(c->u + p * c->wu),
         v = at->v + at->wv * (WIDE)(c->v + q * c->wv);
    // Each is rounded once or twice.
    WIDE ru =
        at->wu * (WIDE)(r * c->wu + 4 * UNIT * (c->u + c->wu)) + 4 * WIDE_UNIT * (at->u + at->wu);
    WIDE rv =
        at->wv * (WIDE)(r * c->wv + 4 * UNIT * (c->v + c->wv)) + 4 * WIDE_UNIT * (at->v + at->wv);
    if (u + ru < 0 || u - ru > 1 || v + rv < 0 || v - rv > 1)
        return; // proved to lie outside
    REAL ez, z = NAME(depth)(task, c, p, q, r, r, &ez);
    if (at->bounded && (z - ez > at->z_high || z + ez < at->z_low))
        return;
    bool inside = u - ru >= 0 && u + ru <= 1 && v - rv >= 0 && v + rv <= 1;
    if (!inside)
        note_cell(task, (double)c->u, (double)c->v, (double)c->wu, (double)c->wv);
    if (inside || task->last)
        NAME(add)(task, u, v, ru, rv, z, ez, inside ? ROOT_CERTAIN : ROOT_BORDER);
}

// A cell with L small: its root, if it has one, or none. False: not decided.
static inline bool NAME(settle)(Task *task, int nu, int nv, const NAME(Cell) * c,
                                const NAME(Map) * map) {
    REAL wide = map->lipschitz * (REAL)task->growth;
    if (!(wide < (REAL)0.75))
        return false;
    REAL p = (REAL)0.5, q = (REAL)0.5, xu, xv, yu, yv;
    REAL x = NAME(surface)(nu, nv, c->p[0], p, q, &xu, &xv);
    REAL y = NAME(surface)(nu, nv, c->p[1], p, q, &yu, &yv);
    REAL off =
        NAME(max)(NAME(abs)(map->ax * x + map->ay * y), NAME(abs)(map->bx * x + map->by * y));
    REAL error = (1 + 2 * (nu + nv)) * NAME(max)(map->ea, map->eb);
    if (off - error > (REAL)0.5 * (1 + map->lipschitz))
        return true;
    const REAL low = -(REAL)MARGIN, high = 1 + (REAL)MARGIN;
    REAL best = 9, bp = p, bq = q;
    for (int step = 0; step < 12; step++) {
        REAL here = NAME(residual)(nu, nv, map, x, y);
        if (here < best)
            best = here, bp = p, bq = q;
        else if (step > 3)
            break;
        if (here <= 2 * error)
            break;
        REAL det = xu * yv - xv * yu;
        p -= (yv * x - xv * y) / det;
        q -= (xu * y - yu * x) / det;
        if (!(p > 2 * low && p < 1 - 2 * low && q > 2 * low && q < 1 - 2 * low))
            break;
        x = NAME(surface)(nu, nv, c->p[0], p, q, &xu, &xv);
        y = NAME(surface)(nu, nv, c->p[1], p, q, &yu, &yv);
    }
    REAL r = best / (1 - wide) * (REAL)1.001;
    if (!(bp - r >= low && bp + r <= high && bq - r >= low && bq + r <= high))
        return false;
    NAME(settled)(task, c, bp, bq, r);
    return true;
}

// In which direction is the cell longer, as the ray sees it? So a collapsed edge is not cut into
// slices that all contain it.
static inline bool NAME(longer_in_u)(int nu, int nv, const NAME(Cell) * c) {
    REAL xu, xv, yu, yv;
    NAME(steps)(nu, nv, c->p[0], &xu, &xv);
    NAME(steps)(nu, nv, c->p[1], &yu, &yv);
    return NAME(max)(xu, yu) * nu >= NAME(max)(xv, yv) * nv;
}

// Of the cell at the bottom of the stack, which has room for depth_limit cells.
static inline void NAME(search)(Task *task, int nu, int nv, NAME(Cell) * stack, int depth_limit) {
    int top = 1, count = (nu + 1) * (nv + 1);
    while (top > 0) {
        NAME(Cell) *c = &stack[top - 1];
        NAME(Map) map;
        NAME(Span) x = NAME(span_of)(c->p[0], count), y = NAME(span_of)(c->p[1], count);
        REAL most[3] = {x.most, y.most, 0};
        if (NAME(one_sign)(&x, c->ex) || NAME(one_sign)(&y, c->ey) ||
            (task->place.bounded && NAME(elsewhere)(task, count, c)) ||
            !NAME(reduce)(nu, nv, c, most, &map) || NAME(settle)(task, nu, nv, c, &map)) {
            top--;
            continue;
        }
        bool least = (x.most <= 4 * c->ex && y.most <= 4 * c->ey) || (map.hidden && !task->last);
        if (least || top >= depth_limit || --task->budget < 0) {
            NAME(leave_open)(task, c);
            top--;
            continue;
        }
        most[2] = NAME(farthest)(task, count, c);
        NAME(halve)(task, nu, nv, NAME(longer_in_u)(nu, nv, c), most, c, &stack[top]);
        top++;
    }
}

static void NAME(search_first)(Task *task, NAME(Cell) * stack, int depth_limit) {
    if (task->nu == 3 && task->nv == 3)
        NAME(search)(task, 3, 3, stack, depth_limit);
    else
        NAME(search)(task, task->nu, task->nv, stack, depth_limit);
}
