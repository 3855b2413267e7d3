// SPDX-License-Identifier: MIT
// Does a surface stay near a ray? Not proved as crossings are: long double, and no bounds of its
// rounding.
#include "ray_oracle_set.h"

#include <stdlib.h>

// ---- Near the ray

// Coordinates of a strip, each times the weight, and the weight. CROSS: (P - org) x dir, AXIS: P -
// org. Where the patch is much longer along one axis than along another, and the ray askew, only
// these tell places along it from places across.
enum { ACROSS, OTHER, DEPTH_T, CROSS, AXIS = CROSS + 3, PLACES = AXIS + 3, WEIGHT = PLACES, STRIP };

typedef struct {
    Real p[STRIP][ORACLE_POINTS];
} Strip;

typedef struct {
    int nu, nv;
    Real reach;                     // lateral
    Real t0, t1;                    // of one step of depth
    Real low[PLACES], high[PLACES]; // what no point within reach at these depths can leave
} Tube;

static void halve_line(Real *low, Real *high, const Real *from, int n, int step) {
    Real row[ORACLE_SIDE];
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
        Real p[ORACLE_POINTS] = {0};
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

enum { NEAR_DEPTH = 160, NEAR_BUDGET = 8000 };

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
