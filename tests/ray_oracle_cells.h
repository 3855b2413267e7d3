// SPDX-License-Identifier: MIT
// The search of ray_oracle.c, written once for two kinds of numbers. Included twice, with
//   REAL, UNIT   the cells' numbers, and the rounding of one operation relative to its result
//   WIDE, WIDE_UNIT  the numbers in which the ray is projected
//   NAME(x)      the name with the kind's suffix
//
// In the plane across the ray S = (x, y), and roots are x = y = 0. Cells are halved; each carries a
// bound of the rounding of its coefficients (ex, ey). With J the mean Jacobian over a cell, local
// parameters (p,q) in [0,1]^2 and the Lipschitz constant L of the remainder F(p,q) - (p,q), where
// F = J^-1 (x, y):
//   no root      the coefficients have one sign, or -remainder misses [0,1], or |F| at the middle
//   is
//                more than (1 + L)/2;
//   one at most  L < 1, also over the cell enlarged by MARGIN to each side, over which a polynomial
//                of degree n grows by (1 + 2 MARGIN)^n at most;
//   one          (L < 1 and) |F| <= (1 - L) r at a point whose box of radius r lies in the enlarged
//                cell: q -> q - F(q) maps that box into itself (Brouwer).
// What can be shown neither way at the size of the rounding stays open.

typedef struct {
    REAL x[POINTS], y[POINTS];
    REAL u, v, wu, wv; // the cell is [u, u + wu] x [v, v + wv]: halvings, so exact
    REAL ex, ey;
} NAME(Cell);

typedef struct {
    NAME(Cell) cells[DEPTH + 2];
    REAL z[POINTS], w[POINTS]; // t of the control points, times their weights; the weights
    REAL ez, slope_u, slope_v; // rounding of t; bounds of |dt/du| and |dt/dv|
    NAME(Cell) whole;
} NAME(Work);

static _Thread_local NAME(Work) NAME(work);

static inline REAL NAME(abs)(REAL a) { return a < 0 ? -a : a; }
static inline REAL NAME(max)(REAL a, REAL b) { return a > b ? a : b; }

static inline REAL NAME(most)(const REAL *p, int count) {
    REAL most = 0;
    for (int k = 0; k < count; k++)
        most = NAME(max)(most, NAME(abs)(p[k]));
    return most;
}

static inline bool NAME(one_sign)(const REAL *p, int count, REAL error) {
    REAL low = p[0], high = p[0];
    for (int k = 1; k < count; k++) {
        low = p[k] < low ? p[k] : low;
        high = p[k] > high ? p[k] : high;
    }
    return low > error || high < -error;
}

static inline void NAME(halve_line)(REAL *low, REAL *high, const REAL *from, int n, int step) {
    REAL row[SIDE];
    for (int i = 0; i <= n; i++)
        row[i] = from[i * step];
    for (int k = 0; k <= n; k++) {
        low[k * step] = row[0];
        high[(n - k) * step] = row[n - k];
        for (int i = 0; i < n - k; i++)
            row[i] = (REAL)0.5 * (row[i] + row[i + 1]);
    }
}

// An average errs by UNIT of its value, and there are n levels of them.
static inline void NAME(halve)(int nu, int nv, const NAME(Cell) * from, bool along_u,
                               NAME(Cell) * low, NAME(Cell) * high) {
    int count = (nu + 1) * (nv + 1), n = along_u ? nu : nv;
    const REAL *p[2] = {from->x, from->y};
    REAL *a[2] = {low->x, low->y}, *b[2] = {high->x, high->y};
    for (int c = 0; c < 2; c++) {
        if (along_u) {
            for (int j = 0; j <= nv; j++)
                NAME(halve_line)(a[c] + j, b[c] + j, p[c] + j, nu, nv + 1);
        } else {
            for (int i = 0; i < count; i += nv + 1)
                NAME(halve_line)(a[c] + i, b[c] + i, p[c] + i, nv, 1);
        }
    }
    REAL ex = from->ex + n * UNIT * NAME(most)(from->x, count);
    REAL ey = from->ey + n * UNIT * NAME(most)(from->y, count);
    REAL u = from->u, v = from->v;
    REAL wu = along_u ? (REAL)0.5 * from->wu : from->wu;
    REAL wv = along_u ? from->wv : (REAL)0.5 * from->wv;
    low->u = u, low->v = v;
    high->u = along_u ? u + wu : u, high->v = along_u ? v : v + wv;
    low->wu = high->wu = wu;
    low->wv = high->wv = wv;
    low->ex = high->ex = ex;
    low->ey = high->ey = ey;
}

static inline REAL NAME(curve)(const REAL *p, int step, int n, REAL t, REAL *slope) {
    REAL row[SIDE];
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
    REAL row[SIDE] = {0}, slope[SIDE] = {0}, none;
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

// F's rows: bx x + by y.
typedef struct {
    REAL ax, ay, bx, by;
    REAL ea, eb; // error of either, coefficients and arithmetic
    REAL lipschitz;
} NAME(Map);

// Span and Lipschitz constant of one remainder.
static inline void NAME(remainder)(int nu, int nv, const REAL *x, const REAL *y, REAL fx, REAL fy,
                                   bool along_u, REAL span[2], REAL *lipschitz) {
    REAL r[POINTS], du = 0, dv = 0;
    r[0] = 0;
    for (int i = 0; i <= nu; i++) {
        for (int j = 0; j <= nv; j++) {
            int k = i * (nv + 1) + j;
            REAL linear = along_u ? (REAL)i / nu : (REAL)j / nv;
            r[k] = fx * x[k] + fy * y[k] - linear;
        }
    }
    span[0] = span[1] = r[0];
    for (int k = 1; k < (nu + 1) * (nv + 1); k++) {
        span[0] = r[k] < span[0] ? r[k] : span[0];
        span[1] = r[k] > span[1] ? r[k] : span[1];
    }
    for (int k = nv + 1; k < (nu + 1) * (nv + 1); k++)
        du = NAME(max)(du, NAME(abs)(r[k] - r[k - nv - 1]));
    for (int i = 0; i <= nu; i++)
        for (int j = 1; j <= nv; j++)
            dv = NAME(max)(dv, NAME(abs)(r[i * (nv + 1) + j] - r[i * (nv + 1) + j - 1]));
    *lipschitz = nu * du + nv * dv;
}

// Do all points lie on one side of the line through the origin along the longer of two directions?
static inline bool NAME(aside)(const NAME(Cell) * c, int count, REAL xu, REAL yu, REAL xv,
                               REAL yv) {
    bool first = NAME(abs)(xu) + NAME(abs)(yu) >= NAME(abs)(xv) + NAME(abs)(yv);
    REAL gx = first ? xu : xv, gy = first ? yu : yv, r[POINTS];
    r[0] = 0;
    for (int k = 0; k < count; k++)
        r[k] = gx * c->y[k] - gy * c->x[k];
    REAL error = NAME(abs)(gx) * (c->ey + 4 * UNIT * NAME(most)(c->y, count)) +
                 NAME(abs)(gy) * (c->ex + 4 * UNIT * NAME(most)(c->x, count));
    return NAME(one_sign)(r, count, error);
}

// False: no root in the cell. map->lipschitz is above 1 when J is no help.
static inline bool NAME(reduce)(int nu, int nv, const NAME(Cell) * c, NAME(Map) * map) {
    int count = (nu + 1) * (nv + 1);
    REAL xu, xv, yu, yv, mx = NAME(most)(c->x, count), my = NAME(most)(c->y, count);
    *map = (NAME(Map)){.lipschitz = 9};
    NAME(trends)(nu, nv, c->x, &xu, &xv);
    NAME(trends)(nu, nv, c->y, &yu, &yv);
    if (NAME(aside)(c, count, xu, yu, xv, yv))
        return false;
    REAL det = xu * yv - xv * yu, scale = NAME(abs)(xu * yv) + NAME(abs)(xv * yu);
    if (!(NAME(abs)(det) > 64 * UNIT * scale))
        return true;
    map->ax = yv / det, map->ay = -xv / det, map->bx = -yu / det, map->by = xu / det;
    REAL tx = c->ex + 4 * UNIT * mx, ty = c->ey + 4 * UNIT * my;
    map->ea = NAME(abs)(map->ax) * tx + NAME(abs)(map->ay) * ty + 4 * UNIT;
    map->eb = NAME(abs)(map->bx) * tx + NAME(abs)(map->by) * ty + 4 * UNIT;
    REAL span[2], lipschitz[2];
    NAME(remainder)(nu, nv, c->x, c->y, map->ax, map->ay, true, span, &lipschitz[0]);
    if (-span[1] - map->ea > 1 || -span[0] + map->ea < 0)
        return false;
    NAME(remainder)(nu, nv, c->x, c->y, map->bx, map->by, false, span, &lipschitz[1]);
    if (-span[1] - map->eb > 1 || -span[0] + map->eb < 0)
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

static void NAME(add)(Task *task, REAL u, REAL v, REAL ru, REAL rv, RayOracleKind kind) {
    REAL tu, tv, t = NAME(surface)(task->nu, task->nv, NAME(work).z, u, v, &tu, &tv);
    if (task->def->weights)
        t /= NAME(surface)(task->nu, task->nv, NAME(work).w, u, v, &tu, &tv);
    REAL dt = NAME(work).ez + NAME(work).slope_u * ru + NAME(work).slope_v * rv;
    add_item(task, (double)t, (double)dt, (double)u, (double)v, (double)ru, (double)rv, kind);
}

// Control points of the part [a,b] of a curve: the blossom of a and b, k times b. In place.
static inline void NAME(restrict_line)(REAL *p, int step, int n, REAL a, REAL b) {
    REAL out[SIDE];
    for (int k = 0; k <= n; k++) {
        REAL row[SIDE];
        for (int i = 0; i <= n; i++)
            row[i] = p[i * step];
        for (int level = n; level > 0; level--) {
            REAL t = level > k ? a : b;
            for (int i = 0; i < level; i++)
                row[i] = (1 - t) * row[i] + t * row[i + 1];
        }
        out[k] = row[0];
    }
    for (int k = 0; k <= n; k++)
        p[k * step] = out[k];
}

// One level of that errs by 3 UNIT of the largest value: 4 (nu + nv) UNIT in all.
static void NAME(restrict)(int nu, int nv, REAL *p, REAL u, REAL wu, REAL v, REAL wv) {
    for (int j = 0; j <= nv; j++)
        NAME(restrict_line)(p + j, nv + 1, nu, u, u + wu);
    for (int i = 0; i <= nu; i++)
        NAME(restrict_line)(p + i * (nv + 1), 1, nv, v, v + wv);
}

// The depths of all of the cell, so that what lies behind an answer need not be decided.
static void NAME(leave_open)(Task *task, const NAME(Cell) * c) {
    const REAL half = (REAL)0.5;
    REAL z[POINTS], w[POINTS], low = 0, high = 0;
    int nu = task->nu, nv = task->nv, count = (nu + 1) * (nv + 1);
    memcpy(z, NAME(work).z, sizeof z[0] * (size_t)count);
    memcpy(w, NAME(work).w, sizeof w[0] * (size_t)count);
    NAME(restrict)(nu, nv, z, c->u, c->wu, c->v, c->wv);
    if (task->def->weights)
        NAME(restrict)(nu, nv, w, c->u, c->wu, c->v, c->wv);
    for (int k = 0; k < count; k++) {
        REAL t = task->def->weights ? z[k] / w[k] : z[k];
        low = k == 0 || t < low ? t : low;
        high = k == 0 || t > high ? t : high;
    }
    note_cell(task, (double)c->u, (double)c->v, (double)c->wu, (double)c->wv);
    add_item(task, (double)(half * (low + high)), (double)(half * (high - low) + NAME(work).ez),
             (double)(c->u + half * c->wu), (double)(c->v + half * c->wv), (double)c->wu,
             (double)c->wv, ROOT_OPEN);
}

// A cell with L small: its root, if it has one, or none. False: not decided.
static inline bool NAME(settle)(Task *task, int nu, int nv, const NAME(Cell) * c,
                                const NAME(Map) * map) {
    REAL wide = map->lipschitz * (REAL)task->growth;
    if (!(wide < (REAL)0.75))
        return false;
    REAL p = (REAL)0.5, q = (REAL)0.5, xu, xv, yu, yv;
    REAL x = NAME(surface)(nu, nv, c->x, p, q, &xu, &xv);
    REAL y = NAME(surface)(nu, nv, c->y, p, q, &yu, &yv);
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
        x = NAME(surface)(nu, nv, c->x, p, q, &xu, &xv);
        y = NAME(surface)(nu, nv, c->y, p, q, &yu, &yv);
    }
    REAL r = best / (1 - wide) * (REAL)1.001;
    if (!(bp - r >= low && bp + r <= high && bq - r >= low && bq + r <= high))
        return false;
    REAL u = c->u + bp * c->wu, v = c->v + bq * c->wv; // rounded once or twice, below 4 UNIT
    REAL ru = r * c->wu + 4 * UNIT * (NAME(abs)(c->u) + c->wu);
    REAL rv = r * c->wv + 4 * UNIT * (NAME(abs)(c->v) + c->wv);
    if (u + ru < 0 || u - ru > 1 || v + rv < 0 || v - rv > 1)
        return true; // proved to lie outside
    bool inside = u - ru >= 0 && u + ru <= 1 && v - rv >= 0 && v + rv <= 1;
    if (!inside)
        note_cell(task, (double)c->u, (double)c->v, (double)c->wu, (double)c->wv);
    NAME(add)(task, u, v, ru, rv, inside ? ROOT_CERTAIN : ROOT_BORDER);
    return true;
}

// In which direction is the cell longer, as the ray sees it? So a collapsed edge is not cut into
// slices that all contain it.
static inline bool NAME(longer_in_u)(int nu, int nv, const NAME(Cell) * c) {
    REAL along_u = 0, along_v = 0;
    const REAL *coordinate[2] = {c->x, c->y};
    for (int n = 0; n < 2; n++) {
        const REAL *p = coordinate[n];
        for (int k = nv + 1; k < (nu + 1) * (nv + 1); k++)
            along_u = NAME(max)(along_u, NAME(abs)(p[k] - p[k - nv - 1]) * nu);
        for (int i = 0; i <= nu; i++)
            for (int k = i * (nv + 1); k < i * (nv + 1) + nv; k++)
                along_v = NAME(max)(along_v, NAME(abs)(p[k + 1] - p[k]) * nv);
    }
    return along_u >= along_v;
}

static inline void NAME(search)(Task *task, int nu, int nv, int budget, int depth_limit) {
    NAME(Cell) *stack = NAME(work).cells;
    int top = 1, count = (nu + 1) * (nv + 1);
    while (top > 0) {
        NAME(Cell) *c = &stack[top - 1];
        if (NAME(one_sign)(c->x, count, c->ex) || NAME(one_sign)(c->y, count, c->ey)) {
            top--;
            continue;
        }
        NAME(Map) map;
        if (!NAME(reduce)(nu, nv, c, &map) || NAME(settle)(task, nu, nv, c, &map)) {
            top--;
            continue;
        }
        bool least = NAME(most)(c->x, count) <= 4 * c->ex && NAME(most)(c->y, count) <= 4 * c->ey;
        if (least || top >= depth_limit || --budget < 0) {
            NAME(leave_open)(task, c);
            top--;
            continue;
        }
        NAME(Cell) from;
        bool along_u = NAME(longer_in_u)(nu, nv, c);
        memcpy(from.x, c->x, sizeof c->x[0] * (size_t)count);
        memcpy(from.y, c->y, sizeof c->y[0] * (size_t)count);
        from.u = c->u, from.v = c->v, from.wu = c->wu, from.wv = c->wv;
        from.ex = c->ex, from.ey = c->ey;
        NAME(halve)(nu, nv, &from, along_u, &stack[top], &stack[top - 1]);
        top++;
    }
}

static inline WIDE NAME(wide_abs)(WIDE a) { return a < 0 ? -a : a; }

// Scales by a power of two to at most 1 in size and rounds. Returns the error of the results;
// `error` is that of p.
static REAL NAME(scale)(const WIDE *p, WIDE error, int count, REAL *out) {
    WIDE most = 0;
    int exponent;
    for (int k = 0; k < count; k++)
        most = NAME(wide_abs)(p[k]) > most ? NAME(wide_abs)(p[k]) : most;
    if (!(most > 0))
        most = 1;
    frexpl((long double)most, &exponent);
    WIDE scale = ldexpl(1.0L, -exponent);
    for (int k = 0; k < count; k++)
        out[k] = (REAL)(p[k] * scale);
    // Conversion errs by UNIT of values up to 1; 1.001 covers its own rounding.
    return (REAL)(error * scale) * (REAL)1.001 + UNIT;
}

static void NAME(project)(const Task *task) {
    const PatchDef *def = task->def;
    int count = (task->nu + 1) * (task->nv + 1), k = 0;
    const Ray *ray = task->ray;
    for (int axis = 1; axis < 3; axis++)
        if (fabs(vec_get(ray->dir, axis)) > fabs(vec_get(ray->dir, k)))
            k = axis;
    int a = (k + 1) % 3, b = (k + 2) % 3;
    WIDE da = vec_get(ray->dir, a), db = vec_get(ray->dir, b), dk = vec_get(ray->dir, k);
    WIDE x[POINTS], y[POINTS], ex = 0, ey = 0, far = 0, most = 0, least = INFINITY;
    for (int n = 0; n < count; n++) {
        Vec3 p = def->points[n];
        WIDE qa = (WIDE)vec_get(p, a) - vec_get(ray->org, a);
        WIDE qb = (WIDE)vec_get(p, b) - vec_get(ray->org, b);
        WIDE qk = (WIDE)vec_get(p, k) - vec_get(ray->org, k);
        WIDE px = qa * dk, py = qb * dk, sx = qk * da, sy = qk * db;
        x[n] = px - sx;
        y[n] = py - sy;
        // Each term errs by 2 units (difference, product), their difference by 1 more, and one more
        // is the weight's.
        WIDE w = def->weights ? def->weights[n] : 1.0;
        WIDE tx = 4 * WIDE_UNIT * w * (NAME(wide_abs)(px) + NAME(wide_abs)(sx));
        WIDE ty = 4 * WIDE_UNIT * w * (NAME(wide_abs)(py) + NAME(wide_abs)(sy));
        x[n] *= w;
        y[n] *= w;
        ex = tx > ex ? tx : ex;
        ey = ty > ey ? ty : ey;
        NAME(work).z[n] = (REAL)(w * qk / dk);
        NAME(work).w[n] = (REAL)w;
        far = NAME(wide_abs)(qk / dk) > far ? NAME(wide_abs)(qk / dk) : far;
        most = w > most ? w : most;
        least = w < least ? w : least;
    }
    NAME(Cell) *whole = &NAME(work).cells[0];
    whole->ex = NAME(scale)(x, ex, count, whole->x);
    whole->ey = NAME(scale)(y, ey, count, whole->y);
    whole->u = whole->v = 0;
    whole->wu = whole->wv = 1;
    // t = N / W, N = sum w t B: |N'| and |W'| come from differences, |t| <= far.
    const REAL *z = NAME(work).z, *w = NAME(work).w;
    REAL ratio = (REAL)(most / least), su = 0, sv = 0, wu = 0, wv = 0;
    NAME(work).ez = 16 * (task->nu + task->nv) * UNIT * (REAL)far * ratio;
    for (int n = task->nv + 1; n < count; n++) {
        su = NAME(max)(su, NAME(abs)(z[n] - z[n - task->nv - 1]));
        wu = NAME(max)(wu, NAME(abs)(w[n] - w[n - task->nv - 1]));
    }
    for (int n = 1; n < count; n++) {
        if (n % (task->nv + 1) == 0)
            continue;
        sv = NAME(max)(sv, NAME(abs)(z[n] - z[n - 1]));
        wv = NAME(max)(wv, NAME(abs)(w[n] - w[n - 1]));
    }
    NAME(work).slope_u = task->nu * (su + (REAL)far * wu) / (REAL)least;
    NAME(work).slope_v = task->nv * (sv + (REAL)far * wv) / (REAL)least;
}

static void NAME(search_first)(Task *task, int budget, int depth_limit) {
    if (task->nu == 3 && task->nv == 3)
        NAME(search)(task, 3, 3, budget, depth_limit);
    else
        NAME(search)(task, task->nu, task->nv, budget, depth_limit);
}

static void NAME(find)(Task *task, int budget, int depth_limit) {
    NAME(project)(task);
    NAME(search_first)(task, budget, depth_limit);
}

// Only in some cells, that another search left open.
static inline void NAME(find_in)(Task *task, const OpenCell *cells, int count, int budget,
                                 int depth_limit) {
    int nu = task->nu, nv = task->nv, points = (nu + 1) * (nv + 1);
    NAME(project)(task);
    NAME(Cell) *c = &NAME(work).cells[0], *whole = &NAME(work).whole;
    *whole = *c;
    for (int n = 0; n < count; n++) {
        *c = *whole;
        c->u = cells[n].u, c->v = cells[n].v, c->wu = cells[n].wu, c->wv = cells[n].wv;
        NAME(restrict)(nu, nv, c->x, c->u, c->wu, c->v, c->wv);
        NAME(restrict)(nu, nv, c->y, c->u, c->wu, c->v, c->wv);
        c->ex += 4 * (nu + nv) * UNIT * NAME(most)(whole->x, points);
        c->ey += 4 * (nu + nv) * UNIT * NAME(most)(whole->y, points);
        NAME(search_first)(task, budget, depth_limit);
    }
}
