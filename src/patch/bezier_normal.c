// SPDX-License-Identifier: MIT
// The unit normal of a patch, everywhere: where the two tangents fail to span a plane it is the
// limit from inside. Three attempts, each only when the one before is lost in its own rounding:
//   1. the product of the tangents by Bernstein polynomials;
//   2. the same from the nets of differences: equal control points give differences of exactly 0,
//      so the tangents keep their relative accuracy up to a collapsed edge;
//   3. the Taylor series of the product, along the diagonal into the patch.
#include "patch/bezier.h"

#include "patch/bernstein.h"

#include <float.h>

enum { LINE = BEZIER_MAX_DEGREE + 1, ORDERS = 2 * BEZIER_MAX_DEGREE };

// A product of vectors that err by ea and eb errs by at most this.
static double product_error(Vec3 a, double ea, Vec3 b, double eb) {
    return vec_length(a) * eb + vec_length(b) * ea + ea * eb;
}

// Scales without overflow or underflow of the squares. a is finite and not zero.
static Vec3 unit(Vec3 a) {
    double most = fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
    return vec_normalize(vec_scale(a, 1.0 / most));
}

// Value at t of a line of n + 1 vectors, and of the line of their lengths. Both are used up.
static void reduce(Vec3 *c, double *length, int n, double t) {
    for (; n > 0; n--) {
        for (int i = 0; i < n; i++) {
            c[i] = t <= 0.5 ? vec_madd(c[i], t, vec_sub(c[i + 1], c[i]))
                            : vec_madd(c[i + 1], 1.0 - t, vec_sub(c[i], c[i + 1]));
            length[i] = (1.0 - t) * length[i] + t * length[i + 1];
        }
    }
}

// Tangent along u (step_u = 1) or v (step_v = 1) from the net of differences, and *scale, the
// same mean of the differences' lengths: the tangent errs by a few ulps of that.
static Vec3 tangent(const Bezier *s, int step_u, int step_v, double u, double v, double *scale) {
    Vec3 line[LINE], c[LINE];
    double length[LINE], lengths[LINE];
    int du = s->du - step_u, dv = s->dv - step_v;
    for (int j = 0; j <= dv; j++) {
        for (int i = 0; i <= du; i++) {
            c[i] = vec_sub(bezier_at(s, i + step_u, j + step_v), bezier_at(s, i, j));
            lengths[i] = vec_length(c[i]);
        }
        reduce(c, lengths, du, u);
        line[j] = c[0];
        length[j] = lengths[0];
    }
    reduce(line, length, dv, v);
    int degree = step_u ? s->du : s->dv;
    *scale = degree * length[0];
    return vec_scale(line[0], (double)degree);
}

// Both tangents. With h half an ulp, M the largest coordinate and d the degree, weights err by 3 d
// h of themselves and slopes of weights by 2 d (3 d - 1) h in all; with the sums' own roundings the
// tangents err by less than 2 d (4 (du + dv) + 3) h M: 4 d bezier_rounding() have room for that.
static void tangents(const Bezier *s, double u, double v, Vec3 *su, Vec3 *sv) {
    double wu[LINE], slope_u[LINE], wv[LINE], slope_v[LINE];
    bernstein(s->du, u, wu, slope_u);
    bernstein(s->dv, v, wv, slope_v);
    *su = *sv = vec3(0.0, 0.0, 0.0);
    for (int i = 0; i <= s->du; i++) {
        Vec3 row = vec3(0.0, 0.0, 0.0), slope = row;
        for (int j = 0; j <= s->dv; j++) {
            row = vec_madd(row, wv[j], bezier_at(s, i, j));
            slope = vec_madd(slope, slope_v[j], bezier_at(s, i, j));
        }
        *su = vec_madd(*su, slope_u[i], row);
        *sv = vec_madd(*sv, wu[i], slope);
    }
}

// The patch seen from (u,v) as its corner (0,0), towards the farther sides. The sign tells whether
// the product of tangents changed its direction.
static double corner_patch(const Bezier *s, double u, double v, Bezier *out) {
    double sign = 1.0;
    bool flip_u = u > 0.5, flip_v = v > 0.5;
    BezierRect r = {flip_u ? 0.0 : u, flip_u ? u : 1.0, flip_v ? 0.0 : v, flip_v ? v : 1.0};
    Bezier part;
    bezier_restrict(s, r, &part);
    out->du = s->du;
    out->dv = s->dv;
    for (int i = 0; i <= s->du; i++)
        for (int j = 0; j <= s->dv; j++)
            out->p[i * (s->dv + 1) + j] =
                bezier_at(&part, flip_u ? s->du - i : i, flip_v ? s->dv - j : j);
    if (flip_u)
        sign = -sign;
    return flip_v ? -sign : sign;
}

typedef struct {
    Vec3 su[ORDERS], sv[ORDERS];   // coefficients of t^k of the tangents at (t,t)
    double eu[ORDERS], ev[ORDERS]; // how much they may err
    int count;
} Series;

// Coefficients c_ij = C(du,i) C(dv,j) D^i D^j P_00 of the monomials, gathered along the diagonal.
static void tangent_series(Bezier *s, double rounding, Series *out) {
    int row = s->dv + 1;
    for (int level = 1; level <= s->du; level++)
        for (int i = s->du; i >= level; i--)
            for (int j = 0; j <= s->dv; j++)
                s->p[i * row + j] = vec_sub(s->p[i * row + j], s->p[(i - 1) * row + j]);
    for (int level = 1; level <= s->dv; level++)
        for (int j = s->dv; j >= level; j--)
            for (int i = 0; i <= s->du; i++)
                s->p[i * row + j] = vec_sub(s->p[i * row + j], s->p[i * row + j - 1]);

    out->count = s->du + s->dv;
    for (int k = 0; k < out->count; k++) {
        out->su[k] = out->sv[k] = vec3(0.0, 0.0, 0.0);
        out->eu[k] = out->ev[k] = 0.0;
    }
    double choose_u = 1.0;
    for (int i = 0; i <= s->du; i++) {
        double choose = choose_u;
        for (int j = 0; j <= s->dv; j++) {
            int k = i + j - 1;
            if (k >= 0) {
                // A difference of order n errs by 2^n roundings of a point, in three coordinates.
                Vec3 c = vec_scale(s->p[i * row + j], choose);
                double error = 2.0 * choose * ldexp(rounding, i + j);
                out->su[k] = vec_madd(out->su[k], (double)i, c);
                out->sv[k] = vec_madd(out->sv[k], (double)j, c);
                out->eu[k] += i * error;
                out->ev[k] += j * error;
            }
            choose = choose * (s->dv - j) / (j + 1);
        }
        choose_u = choose_u * (s->du - i) / (i + 1);
    }
}

// First coefficient of su x sv that rounding cannot explain.
static bool first_term(const Series *t, Vec3 *normal) {
    for (int k = 0; k < 2 * t->count - 1; k++) {
        Vec3 sum = vec3(0.0, 0.0, 0.0);
        double error = 0.0;
        for (int a = k < t->count ? 0 : k - t->count + 1; a <= k && a < t->count; a++) {
            sum = vec_add(sum, vec_cross(t->su[a], t->sv[k - a]));
            error += product_error(t->su[a], t->eu[a], t->sv[k - a], t->ev[k - a]);
        }
        if (vec_length(sum) > 2.0 * error) {
            *normal = sum;
            return true;
        }
    }
    return false;
}

// No plane to be normal to: turn `facing` across the direction of the curve, if there is one.
static Vec3 facing_normal(const Series *t, Vec3 facing) {
    if (!(vec_length(facing) > 0.0))
        facing = vec3(0.0, 0.0, 1.0);
    facing = unit(facing);
    for (int k = 0; k < t->count; k++) {
        bool has_u = vec_length(t->su[k]) > 2.0 * t->eu[k];
        bool has_v = vec_length(t->sv[k]) > 2.0 * t->ev[k];
        if (!has_u && !has_v)
            continue;
        bool use_u = has_u && (!has_v || vec_length(t->su[k]) >= vec_length(t->sv[k]));
        Vec3 along = unit(use_u ? t->su[k] : t->sv[k]);
        Vec3 across = vec_madd(facing, -vec_dot(facing, along), along);
        if (vec_length(across) > 1e-8) // below, the rounding of unit vectors decides: any will do
            return unit(across);
        Vec3 axis = fabs(along.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        return unit(vec_cross(along, axis));
    }
    return facing;
}

Vec3 bezier_normal(const Bezier *patch, double u, double v, Vec3 facing) {
    // Scale to about unit size, by a power of two so that no bit changes: no product may leave the
    // range of numbers. In two factors, since one alone could leave it.
    Bezier s;
    Box box = bezier_bounds(patch);
    Vec3 extent = vec_sub(box.high, box.low);
    int exponent;
    frexp(fmax(extent.x, fmax(extent.y, extent.z)), &exponent);
    double half = ldexp(1.0, -exponent / 2), rest = ldexp(1.0, -exponent - -exponent / 2);
    s.du = patch->du;
    s.dv = patch->dv;
    for (int k = 0; k < bezier_count(patch); k++)
        s.p[k] = vec_scale(vec_scale(patch->p[k], half), rest);
    double rounding = bezier_rounding(&s);

    Vec3 su, sv;
    tangents(&s, u, v, &su, &sv);
    Vec3 n = vec_cross(su, sv);
    // The factor 2^36 leaves the direction 10 digits or more; the next attempt does better.
    double loss = product_error(su, 4.0 * s.du * rounding, sv, 4.0 * s.dv * rounding);
    if (vec_length(n) > 0x1p36 * loss)
        return unit(n);

    double scale_u, scale_v;
    su = tangent(&s, 1, 0, u, v, &scale_u);
    sv = tangent(&s, 0, 1, u, v, &scale_v);
    n = vec_cross(su, sv);
    double ulps = 4.0 * (s.du + s.dv) * DBL_EPSILON;
    if (vec_length(n) > 0x1p6 * product_error(su, ulps * scale_u, sv, ulps * scale_v))
        return unit(n);

    Bezier corner;
    Series series;
    double sign = corner_patch(&s, u, v, &corner);
    tangent_series(&corner, rounding, &series);
    if (first_term(&series, &n))
        return unit(vec_scale(n, sign));
    return facing_normal(&series, facing);
}
