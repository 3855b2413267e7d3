// SPDX-License-Identifier: MIT
// Bézier patches: de Casteljau and blossoms, coordinate by coordinate along lines of the net.
#include "patch/bezier.h"

#include <assert.h>
#include <float.h>
#include <string.h>

enum { LINE = BEZIER_MAX_DEGREE + 1 };

// One level of de Casteljau on n + 1 values at any spacing of t; see the header for the form.
static inline void lerp_level(double *c, int n, double t) {
    if (t < 0.5) {
        for (int i = 0; i < n; i++)
            c[i] = c[i] + t * (c[i + 1] - c[i]);
    } else if (t == 0.5) {
        for (int i = 0; i < n; i++)
            c[i] = 0.5 * c[i] + 0.5 * c[i + 1];
    } else {
        double rest = 1.0 - t;
        for (int i = 0; i < n; i++)
            c[i] = c[i + 1] + rest * (c[i] - c[i + 1]);
    }
}

static inline void lerp_level3(Vec3 *c, int n, double t) {
    if (t < 0.5) {
        for (int i = 0; i < n; i++)
            c[i] = vec_madd(c[i], t, vec_sub(c[i + 1], c[i]));
    } else if (t == 0.5) {
        for (int i = 0; i < n; i++)
            c[i] = vec_add(vec_scale(c[i], 0.5), vec_scale(c[i + 1], 0.5));
    } else {
        double rest = 1.0 - t;
        for (int i = 0; i < n; i++)
            c[i] = vec_madd(c[i + 1], rest, vec_sub(c[i], c[i + 1]));
    }
}

void bezier_init(Bezier *out, int du, int dv, const Vec3 *points) {
    assert(du >= 1 && du <= BEZIER_MAX_DEGREE && dv >= 1 && dv <= BEZIER_MAX_DEGREE);
    out->du = du;
    out->dv = dv;
    for (int k = 0; k < (du + 1) * (dv + 1); k++) {
        assert(vec_is_finite(points[k]));
        out->p[k] = points[k];
    }
}

void bezier_copy(Bezier *out, const Bezier *s) {
    if (out == s)
        return;
    out->du = s->du;
    out->dv = s->dv;
    memcpy(out->p, s->p, sizeof s->p[0] * (size_t)bezier_count(s));
}

// A curve and its first two derivatives at t, from its control points (which are used up).
static void curve_jet(Vec3 *c, int d, double t, Vec3 out[3], int order) {
    for (int n = d; n > 0; n--) {
        if (n == 2 && order >= 2) {
            Vec3 second = vec_sub(vec_sub(c[2], c[1]), vec_sub(c[1], c[0]));
            out[2] = vec_scale(second, (double)(d * (d - 1)));
        }
        if (n == 1 && order >= 1)
            out[1] = vec_scale(vec_sub(c[1], c[0]), (double)d);
        lerp_level3(c, n, t);
    }
    if (d == 1 && order >= 2)
        out[2] = vec3(0.0, 0.0, 0.0);
    out[0] = c[0];
}

// Derivatives up to `order` in total; jet[a][b] is the a-th in u and b-th in v.
static void surface_jet(const Bezier *s, double u, double v, int order, Vec3 jet[3][3]) {
    Vec3 line[3][LINE], c[LINE], out[3];
    for (int j = 0; j <= s->dv; j++) {
        for (int i = 0; i <= s->du; i++)
            c[i] = bezier_at(s, i, j);
        curve_jet(c, s->du, u, out, order);
        for (int a = 0; a <= order; a++)
            line[a][j] = out[a];
    }
    for (int a = 0; a <= order; a++) {
        curve_jet(line[a], s->dv, v, out, order - a);
        for (int b = 0; a + b <= order; b++)
            jet[a][b] = out[b];
    }
}

Vec3 bezier_eval(const Bezier *s, double u, double v) {
    Vec3 jet[3][3];
    surface_jet(s, u, v, 0, jet);
    return jet[0][0];
}

Vec3 bezier_eval1(const Bezier *s, double u, double v, Vec3 *su, Vec3 *sv) {
    Vec3 jet[3][3];
    surface_jet(s, u, v, 1, jet);
    *su = jet[1][0];
    *sv = jet[0][1];
    return jet[0][0];
}

void bezier_eval2(const Bezier *s, double u, double v, BezierJet *out) {
    Vec3 jet[3][3];
    surface_jet(s, u, v, 2, jet);
    *out = (BezierJet){jet[0][0], jet[1][0], jet[0][1], jet[2][0], jet[1][1], jet[0][2]};
}

// Restricts the polynomial with Bernstein coefficients c to [a,b]: new coefficient k is the blossom
// with d - k arguments a and k arguments b. After m levels at a, k = d - m levels at b remain.
static void restrict_line(double *c, int d, double a, double b) {
    double at_a[LINE], at_b[LINE];
    memcpy(at_a, c, sizeof c[0] * (size_t)(d + 1));
    for (int k = d; k >= 0; k--) {
        if (b == 1.0) { // k levels at 1 select the last value
            c[k] = at_a[k];
        } else {
            memcpy(at_b, at_a, sizeof c[0] * (size_t)(k + 1));
            for (int n = k; n > 0; n--)
                lerp_level(at_b, n, b);
            c[k] = at_b[0];
        }
        if (a != 0.0)
            lerp_level(at_a, k, a);
    }
}

// The whole net, given as `coords` interleaved numbers a point.
static void restrict_net(double *p, int coords, int du, int dv, BezierRect r) {
    double line[LINE];
    int row = coords * (dv + 1);
    if (r.u0 != 0.0 || r.u1 != 1.0) {
        for (int k = 0; k < row; k++) {
            for (int i = 0; i <= du; i++)
                line[i] = p[i * row + k];
            restrict_line(line, du, r.u0, r.u1);
            for (int i = 0; i <= du; i++)
                p[i * row + k] = line[i];
        }
    }
    if (r.v0 != 0.0 || r.v1 != 1.0) {
        for (int i = 0; i <= du; i++) {
            for (int k = 0; k < coords; k++) {
                double *first = p + i * row + k;
                for (int j = 0; j <= dv; j++)
                    line[j] = first[j * coords];
                restrict_line(line, dv, r.v0, r.v1);
                for (int j = 0; j <= dv; j++)
                    first[j * coords] = line[j];
            }
        }
    }
}

void bezier_restrict(const Bezier *s, BezierRect r, Bezier *out) {
    bezier_copy(out, s);
    restrict_net(&out->p[0].x, 3, s->du, s->dv, r);
}

void bezier2_restrict(const Bezier2 *s, BezierRect r, Bezier2 *out) {
    if (out != s) {
        out->du = s->du;
        out->dv = s->dv;
        memcpy(out->p, s->p, sizeof s->p[0] * (size_t)((s->du + 1) * (s->dv + 1)));
    }
    restrict_net(&out->p[0].u, 2, s->du, s->dv, r);
}

static void split(const Bezier *s, BezierRect low, BezierRect high, Bezier *out_low,
                  Bezier *out_high) {
    Bezier whole;
    bezier_copy(&whole, s);
    if (out_low)
        bezier_restrict(&whole, low, out_low);
    if (out_high)
        bezier_restrict(&whole, high, out_high);
}

void bezier_split_u(const Bezier *s, double t, Bezier *low, Bezier *high) {
    split(s, (BezierRect){0.0, t, 0.0, 1.0}, (BezierRect){t, 1.0, 0.0, 1.0}, low, high);
}

void bezier_split_v(const Bezier *s, double t, Bezier *low, Bezier *high) {
    split(s, (BezierRect){0.0, 1.0, 0.0, t}, (BezierRect){0.0, 1.0, t, 1.0}, low, high);
}

Box bezier_bounds(const Bezier *s) {
    Box box = box_empty();
    for (int k = 0; k < bezier_count(s); k++)
        box = box_extend(box, s->p[k]);
    return box;
}

double bezier_diameter(const Bezier *s) {
    Box box = bezier_bounds(s);
    return vec_length(vec_sub(box.high, box.low));
}

static double largest_coordinate(const Bezier *s) {
    double most = 0.0;
    for (int k = 0; k < bezier_count(s); k++)
        for (int axis = 0; axis < 3; axis++)
            most = fabs(vec_get(s->p[k], axis)) > most ? fabs(vec_get(s->p[k], axis)) : most;
    return most;
}

double bezier_rounding(const Bezier *s) {
    return (3.0 * (s->du + s->dv) + 8.0) * (0.5 * DBL_EPSILON) * largest_coordinate(s);
}
