// SPDX-License-Identifier: MIT
// Does a surface stay near a ray? Not proved as crossings are: long double, and no bounds of its
// rounding.
#include "ray_oracle_set.h"

#include <stdlib.h>

// ---- Near the ray

enum { NEAR_DEPTH = 160, NEAR_BUDGET = 8000 };

// Points of a part less the ray's origin, each times the weight, and the weights.
typedef struct {
    Real p[4][ORACLE_POINTS];
} Strip;

// The same as the ray sees them, without the weight: two ways across, and depth.
enum { ACROSS, OTHER, DEPTH_T, SEEN };
typedef struct {
    Real p[SEEN][ORACLE_POINTS];
} Seen;

// A frame across the ray, and along it.
typedef struct {
    Real e1[3], e2[3], w[3], length;
} Frame;

typedef struct {
    int nu, nv;
    bool rational;
    Real reach;  // lateral
    Real t0, t1; // of one step of depth
    Real dir[3];
    Frame frame;
    // What no point within reach at these depths can leave: P - org, and (P - org) x dir. Where the
    // patch is much longer along one axis than along another, and the ray askew, only these tell
    // places along it from places across.
    Real low[3], high[3], cross[3];
} Tube;

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

static Tube tube_of(const Ray *ray, const Frame *f, Real t0, Real t1, Real reach) {
    Tube tube = {.reach = reach, .t0 = t0, .t1 = t1, .frame = *f};
    for (int axis = 0; axis < 3; axis++)
        tube.dir[axis] = vec_get(ray->dir, axis);
    for (int axis = 0; axis < 3; axis++) {
        const Real *d = tube.dir;
        Real a = t0 * d[axis], b = t1 * d[axis];
        tube.low[axis] = (a < b ? a : b) - reach;
        tube.high[axis] = (a < b ? b : a) + reach;
        tube.cross[axis] = reach * (fabsl(d[(axis + 1) % 3]) + fabsl(d[(axis + 2) % 3]));
    }
    return tube;
}

typedef struct {
    Real low, high;
} Span;

static Span span_of(const Real *p, int count) {
    Span s = {p[0], p[0]};
    for (int k = 1; k < count; k++) {
        s.low = p[k] < s.low ? p[k] : s.low;
        s.high = p[k] > s.high ? p[k] : s.high;
    }
    return s;
}

static Real larger(Real a, Real b) { return a > b ? a : b; }

// Which direction is longer, depth counted as far as it exceeds its step?
static bool longer_in_u(const Tube *tube, const Seen *seen) {
    int nu = tube->nu, nv = tube->nv, count = (nu + 1) * (nv + 1);
    Real size[2] = {0, 0};
    for (int c = ACROSS; c <= DEPTH_T; c++) {
        const Real *p = seen->p[c];
        Real scale = c < DEPTH_T ? 1 : tube->reach / (tube->t1 - tube->t0);
        for (int k = 0; k < count; k++) {
            if (k > nv)
                size[0] = larger(size[0], scale * nu * fabsl(p[k] - p[k - nv - 1]));
            if (k % (nv + 1))
                size[1] = larger(size[1], scale * nv * fabsl(p[k] - p[k - 1]));
        }
    }
    return size[0] >= size[1];
}

typedef enum { PART_OFF, PART_WITHIN, PART_OPEN } Part;

// Can none of the points be within reach at these depths?
static bool outside(const Tube *tube, Real q[3][ORACLE_POINTS], int count) {
    for (int axis = 0; axis < 3; axis++) {
        Span s = span_of(q[axis], count);
        if (s.low > tube->high[axis] || s.high < tube->low[axis])
            return true;
    }
    for (int axis = 0; axis < 3; axis++) {
        int a = (axis + 1) % 3, b = (axis + 2) % 3;
        Real r[ORACLE_POINTS] = {0};
        for (int k = 0; k < count; k++)
            r[k] = q[a][k] * tube->dir[b] - q[b][k] * tube->dir[a];
        Span s = span_of(r, count);
        if (s.low > tube->cross[axis] || s.high < -tube->cross[axis])
            return true;
    }
    return false;
}

// Do all points lie on one side of the tube along the longer of the mean differences of opposite
// sides? So a sheet that the ray looks along need not be cut as small as it is distant.
static bool aside(const Tube *tube, const Seen *seen) {
    int nu = tube->nu, nv = tube->nv, count = (nu + 1) * (nv + 1);
    const Real *x = seen->p[ACROSS], *y = seen->p[OTHER];
    Real ux = 0, uy = 0, vx = 0, vy = 0, r[ORACLE_POINTS] = {0};
    for (int j = 0; j <= nv; j++)
        ux += x[nu * (nv + 1) + j] - x[j], uy += y[nu * (nv + 1) + j] - y[j];
    for (int i = 0; i < count; i += nv + 1)
        vx += x[i + nv] - x[i], vy += y[i + nv] - y[i];
    bool first = (fabsl(ux) + fabsl(uy)) * (nu + 1) >= (fabsl(vx) + fabsl(vy)) * (nv + 1);
    Real gx = first ? ux : vx, gy = first ? uy : vy, reach = tube->reach * hypotl(gx, gy);
    for (int k = 0; k < count; k++)
        r[k] = gx * y[k] - gy * x[k];
    Span s = span_of(r, count);
    return s.low > reach || s.high < -reach;
}

// Is the strip within reach of the ray, at a depth within half a step of the tube's?
static Part judge_strip(const Tube *tube, const Strip *strip, Seen *seen) {
    int count = (tube->nu + 1) * (tube->nv + 1);
    Real q[3][ORACLE_POINTS];
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < count; k++)
            q[axis][k] = tube->rational ? strip->p[axis][k] / strip->p[3][k] : strip->p[axis][k];
    if (outside(tube, q, count))
        return PART_OFF;
    const Frame *f = &tube->frame;
    for (int k = 0; k < count; k++) {
        const Real p[3] = {q[0][k], q[1][k], q[2][k]};
        seen->p[ACROSS][k] = along(p, f->e1);
        seen->p[OTHER][k] = along(p, f->e2);
        seen->p[DEPTH_T][k] = along(p, f->w) / f->length;
    }
    Span x = span_of(seen->p[ACROSS], count), y = span_of(seen->p[OTHER], count);
    Span t = span_of(seen->p[DEPTH_T], count);
    Real reach = tube->reach;
    if (x.low > reach || x.high < -reach || y.low > reach || y.high < -reach || t.low > tube->t1 ||
        t.high < tube->t0 || aside(tube, seen))
        return PART_OFF;
    bool inside = hypotl(larger(-x.low, x.high), larger(-y.low, y.high)) <= reach;
    bool level = t.high - t.low <= 0.5L * (tube->t1 - tube->t0);
    if (inside && level)
        return PART_WITHIN;
    bool small = x.high - x.low <= 0.125L * reach && y.high - y.low <= 0.125L * reach;
    return level && small ? PART_OFF : PART_OPEN;
}

// Has strips[0] a part that is? Of each halved one both halves are looked at, one after the other;
// there is room for NEAR_DEPTH + 2.
static bool enters(const Tube *tube, Strip *strips) {
    int nu = tube->nu, nv = tube->nv, count = (nu + 1) * (nv + 1), top = 1, budget = NEAR_BUDGET;
    Seen seen;
    while (top > 0 && budget-- > 0) {
        Strip *s = &strips[top - 1];
        Part part = judge_strip(tube, s, &seen);
        if (part == PART_WITHIN)
            return true;
        if (part == PART_OFF || top > NEAR_DEPTH) {
            top--;
            continue;
        }
        bool along_u = longer_in_u(tube, &seen);
        for (int c = 0; c < (tube->rational ? 4 : 3); c++) {
            Real *p = s->p[c], *b = strips[top].p[c];
            for (int k = 0; along_u && k <= nv; k++)
                oracle_halve_line(p + k, b + k, nu, nv + 1);
            for (int k = 0; !along_u && k < count; k += nv + 1)
                oracle_halve_line(p + k, b + k, nv, 1);
        }
        top++;
    }
    return false;
}

// Control points of the part [a,b] of a curve: the blossom of a and b, k times b. In place.
static void restrict_line(Real *p, int step, int n, Real a, Real b) {
    Real by_a[ORACLE_SIDE], row[ORACLE_SIDE];
    for (int i = 0; i <= n; i++)
        by_a[i] = p[i * step];
    for (int k = n; k >= 0; k--) {
        for (int i = 0; i <= k; i++)
            row[i] = by_a[i];
        for (int level = k; level > 0; level--)
            for (int i = 0; i < level; i++)
                row[i] += b * (row[i + 1] - row[i]);
        p[k * step] = row[0];
        for (int i = 0; i < k; i++)
            by_a[i] += a * (by_a[i + 1] - by_a[i]);
    }
}

static void lay_along(const PatchDef *def, const OracleLeaf *leaf, const Ray *ray, Tube *tube,
                      Strip *s) {
    int nu = (int)def->degree_u, nv = (int)def->degree_v;
    tube->nu = nu, tube->nv = nv;
    tube->rational = def->weights != NULL;
    for (int c = 0; c < (tube->rational ? 4 : 3); c++) {
        Real *p = s->p[c];
        for (int k = 0; k < (nu + 1) * (nv + 1); k++) {
            p[k] = c < 3 ? (Real)vec_get(def->points[k], c) - vec_get(ray->org, c) : 1;
            if (tube->rational)
                p[k] *= def->weights[k];
        }
        for (int j = 0; j <= nv; j++)
            restrict_line(p + j, nv + 1, nu, leaf->u, leaf->u + leaf->wu);
        for (int i = 0; i <= nu; i++)
            restrict_line(p + i * (nv + 1), 1, nv, leaf->v, leaf->v + leaf->wv);
    }
}

// Does any of the patches?
static bool near_at(const RayOracleSet *set, const Ray *ray, Tube *tube, Strip *strips) {
    OracleWalk walk;
    const OracleLeaf *leaf;
    int patch;
    double t0 = nextafter((double)tube->t0, -INFINITY), t1 = nextafter((double)tube->t1, INFINITY);
    oracle_walk_begin(&walk, set, ray, t0, t1, (double)tube->reach);
    while (oracle_walk_next(&walk, &patch, &leaf)) {
        lay_along(&set->defs[patch], leaf, ray, tube, &strips[0]);
        if (enters(tube, strips))
            return true;
    }
    return false;
}

bool ray_oracle_near(const RayOracleSet *set, const Ray *ray, double t0, double t1, double reach) {
    enum { STEPS = 16 };
    if (!(t0 < t1))
        return true;
    Frame f = frame_of(ray);
    // 3 MB at the highest degrees: too much for the stack of a thread.
    Strip *strips = malloc((NEAR_DEPTH + 2) * sizeof *strips);
    bool all = strips != NULL;
    Real step = ((Real)t1 - (Real)t0) / STEPS, pad = reach / f.length;
    for (int n = 0; all && n < STEPS; n++) {
        int at = 7 * (n + 1) % STEPS; // not in order: where it fails, it fails far from the ends
        Tube tube = tube_of(ray, &f, t0 + at * step - pad, t0 + (at + 1) * step + pad, (Real)reach);
        all = near_at(set, ray, &tube, strips);
    }
    free(strips);
    return all;
}

// ---- Along the patch

// Moves (u,v) towards the ray by the shortest way, as far as the larger tangent across it leads, in
// so many steps.
// Returns what is left of the distance, and how far along the ray that is.
static Real approach(const PatchDef *def, const Ray *ray, const Frame *f, int steps, Real at[2],
                     Real *depth) {
    Real off = 0;
    for (int step = 0; step <= steps; step++) {
        Real s[3][3], q[3], su[3], sv[3];
        oracle_jet_less(def, ray->org, at[0], at[1], true, s);
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

// One step of (u,v) towards the point nearest to ray's at depth t. Returns the distance before it.
static Real step_to(const PatchDef *def, const Ray *ray, Real t, Real at[2]) {
    Real s[3][3], q[3], su[3], sv[3];
    oracle_jet_less(def, ray->org, at[0], at[1], true, s);
    for (int axis = 0; axis < 3; axis++) {
        q[axis] = s[axis][0] - t * vec_get(ray->dir, axis);
        su[axis] = s[axis][1], sv[axis] = s[axis][2];
    }
    // Along the longer tangent, and along what of the other is across it: on ribbons products of
    // the tangents would lose all digits.
    Real off = sqrtl(along(q, q));
    int first = along(su, su) >= along(sv, sv) ? 0 : 1;
    const Real *a = first == 0 ? su : sv, *b = first == 0 ? sv : su;
    Real length = sqrtl(along(a, a)), e[3], across[3];
    if (!(length > 0))
        return off;
    for (int axis = 0; axis < 3; axis++)
        e[axis] = a[axis] / length;
    Real share = along(e, b);
    for (int axis = 0; axis < 3; axis++)
        across[axis] = b[axis] - share * e[axis];
    Real square = along(across, across), y = square > 0 ? along(across, q) / square : 0;
    Real x = (along(e, q) - share * y) / length;
    at[first] = fminl(fmaxl(at[first] - x, 0), 1);
    at[1 - first] = fminl(fmaxl(at[1 - first] - y, 0), 1);
    return off;
}

bool ray_oracle_along(const PatchDef *def, const Ray *ray, const double from[2], double t1,
                      double reach) {
    enum { STEPS = 32, TRIES = 24 };
    Real at[2] = {from[0], from[1]};
    for (int n = 0; n <= STEPS; n++) {
        bool close = false;
        for (int k = 0; !close && k < TRIES; k++)
            close = step_to(def, ray, (Real)t1 * n / STEPS, at) <= reach;
        if (!close)
            return false;
    }
    return true;
}
