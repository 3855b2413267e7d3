// SPDX-License-Identifier: MIT
// Where the ray is tangent to a piece, or nearly: bounds of the second order.
//
// There one form f = 0 follows the surface across the ray and is as good as linear, and the other,
// h, hardly changes along it: h has no linear part to clip with, and halving alone would go down to
// the last bit along the curve f = 0. So h is taken to be a parabola along that curve. Let s be the
// parameter in which f grows, w the other one; over the piece
//     f = a s + b w + r = 0, r in a span,      so   s = k w + m + p, |p| <= e, k = -b / a,
//     h = cs s + cw w + css s^2 + csw s w + cww w^2 + rest, rest in a span,
// both remainders by their QI nets, h's being of the third order. Put into h, the first gives
//     A + B w + C w^2 + p D + rest = 0
//     A = (cs + css m) m, B = cw + k (cs + 2 css m) + csw m, C = cww + k (csw + k css),
// where D = cs + css (s + (s - p)) + csw w, the slope of h on the way from s - p to s. So a root
// has A + B w + C w^2 within a span of the third order about 0: none, one or two intervals of w.
// They shrink as the 3/2th power of the piece where the two crossings of a fold are one, and
// quadratically where they are two.
#ifndef PATCH_QI_BEND_H
#define PATCH_QI_BEND_H

#include "patch/qi_bound.h"

// h without its linear part in u and v: uu u^2 + uv u v + vv v^2, and the rest.
typedef struct {
    double u, v, uu, uv, vv;
    Span rest;
} Bend;

// The mean second derivatives over the piece, and what is left. Any other numbers would do. r: the
// values' control points, of which the remainder's are left; au, av their trends; slack their
// rounding.
static inline Bend bend_of_values(double *r, int du, int dv, double au, double av, double slack,
                                  double zu, double zv) {
    double uu = 0.0, vv = 0.0;
    int row = dv + 1, last = du * row;
    // Sums of second differences along a line are differences of its ends' first ones.
    for (int j = 0; du > 1 && j <= dv; j++)
        uu += (r[last + j] - r[last - row + j]) - (r[row + j] - r[j]);
    for (int i = 0; dv > 1 && i <= last; i += row)
        vv += (r[i + dv] - r[i + dv - 1]) - (r[i + 1] - r[i]);
    Bend b;
    b.uu = du > 1 ? 0.5 * uu * du / row : 0.0;
    b.vv = dv > 1 ? 0.5 * vv * dv / (du + 1) : 0.0;
    b.uv = (r[last + dv] - r[last]) - (r[dv] - r[0]);
    b.u = au - b.uu - 0.5 * b.uv;
    b.v = av - b.vv - 0.5 * b.uv;

    // u^2 has the control points i (i-1) / (d (d-1)), u v has i j / (du dv).
    double base[LINE], second[2], slope[2];
    for (int j = 0; j <= dv; j++)
        base[j] =
            b.v * ((double)j / dv) + b.vv * (dv > 1 ? j * (j - 1.0) / (dv * (dv - 1.0)) : 0.0);
    for (int i = 0; i <= du; i++) {
        double here =
            b.u * ((double)i / du) + b.uu * (du > 1 ? i * (i - 1.0) / (du * (du - 1.0)) : 0.0);
        double twist = b.uv * ((double)i / du);
        for (int j = 0; j <= dv; j++)
            r[i * row + j] -= here + base[j] + twist * ((double)j / dv);
    }
    differences(r, du, dv, second, slope);
    Span s = quasi_span(r, du, dv);
    double sizes = fabs(b.u) + fabs(b.v) + fabs(b.uu) + fabs(b.uv) + fabs(b.vv);
    double eps = zu * second[0] + zv * second[1] + slack + 16.0 * DBL_EPSILON * sizes;
    b.rest = (Span){s.low - eps, s.high + eps};
    return b;
}

static inline Bend bend_of(const QiNet *p, int du, int dv, QiForm f, double zu, double zv,
                           const QiFrame *frame) {
    double r[POINTS];
    for (int k = 0; k < (du + 1) * (dv + 1); k++)
        r[k] = f.bx * p->x[k] + f.by * p->y[k];
    double slack = fabs(f.bx) * frame->slack_x + fabs(f.by) * frame->slack_y;
    return bend_of_values(r, du, dv, f.au, f.av, slack, zu, zv);
}

// h along the curve f = 0: within `rest` of zero + one w + two w^2.
typedef struct {
    double zero, one, two;
    Span rest;
} Along;

// f: the form that grows; of: its remainder's span; u_grows: s is u. f.au or f.av is not 0.
static inline Along bend_along(const Bend *h, QiForm f, Span of, bool u_grows, Span s, Span w) {
    double a = u_grows ? f.au : f.av, b = u_grows ? f.av : f.au;
    double cs = u_grows ? h->u : h->v, cw = u_grows ? h->v : h->u;
    double css = u_grows ? h->uu : h->vv, cww = u_grows ? h->vv : h->uu, csw = h->uv;
    double k = -b / a, m = -0.5 * (of.low + of.high) / a;
    // m, k and k w carry a few roundings; |k| <= 1 and s is in [0,1], so |m| < 4 matters only.
    double e = (0.5 * (of.high - of.low) / fabs(a) + 8.0 * DBL_EPSILON) * (1.0 + 0x1p-40);
    double steep = 0.0; // |D| over the spans, which is linear
    for (int n = 0; n < 4; n++)
        steep = larger(steep, fabs(cs + 2.0 * css * (n & 1 ? s.low : s.high) +
                                   csw * (n & 2 ? w.low : w.high)));
    steep += fabs(css) * e;
    double sizes = fabs(cs) + fabs(cw) + fabs(css) + fabs(csw) + fabs(cww);
    double room = steep * e * (1.0 + 0x1p-40) + 256.0 * DBL_EPSILON * (1.0 + m * m) * sizes;
    return (Along){(cs + css * m) * m,
                   cw + k * (cs + 2.0 * css * m) + csw * m,
                   cww + k * (csw + k * css),
                   {h->rest.low - room, h->rest.high + room}};
}

// The values of h there, w in its span.
static inline Span bend_values(const Along *h, Span w) {
    double a = h->zero + (h->one + h->two * w.low) * w.low;
    double b = h->zero + (h->one + h->two * w.high) * w.high;
    Span v = {a < b ? a : b, a < b ? b : a};
    double top = -0.5 * h->one / h->two;
    if (top > w.low && top < w.high) {
        double c = h->zero + 0.5 * h->one * top;
        v = span_hull(v, (Span){c, c});
    }
    return (Span){v.low + h->rest.low, v.high + h->rest.high};
}

// Where in *whole is a + b w + c w^2 within `of`, c >= 0? At most two intervals.
//
// The roots are those of the quadratics whose coefficients are off by a few ulps (half adds equal
// signs, the other root is the quotient of the product), which changes the value by as many ulps of
// |a| + |b| + |c|: `of` has room for that.
static inline int parabola(double a, double b, double c, Span of, Span whole, Span parts[2]) {
    double root = b * b - 4.0 * c * (a - of.high);
    if (root < 0.0)
        return 0;
    double half = -0.5 * (b + copysign(sqrt(root), b));
    double one = half / c, other = (a - of.high) / half;
    if (!(half != 0.0)) { // b = 0 and c (a - of.high) = 0: all, or the vertex alone
        parts[0] = whole;
        return 1;
    }
    double low = larger(whole.low, one < other ? one : other);
    double high = one < other ? other : one;
    high = high < whole.high ? high : whole.high;
    if (low > high)
        return 0;
    parts[0] = (Span){low, high};
    root = b * b - 4.0 * c * (a - of.low);
    if (!(root > 0.0))
        return 1;
    half = -0.5 * (b + copysign(sqrt(root), b));
    one = half / c, other = (a - of.low) / half;
    double from = one < other ? one : other, to = one < other ? other : one;
    if (!(from < high && to > low))
        return 1;
    // Nothing between the two.
    if (from < low) {
        if (to > high)
            return 0;
        parts[0].low = to;
        return 1;
    }
    parts[0].high = from;
    if (to > high)
        return 1;
    parts[1] = (Span){to, high};
    return 2;
}

// Clips a piece of which the linear bounds leave (u, v). f[0] and of: the form that grows, and its
// remainder's span; f[1]: the other. Returns the number of parts, each with a span for u and v.
static inline int bend_clip(const QiNet *p, int du, int dv, const QiForm f[2], Span of, double zu,
                            double zv, const QiFrame *frame, Span u, Span v, Span us[2],
                            Span vs[2]) {
    Bend h = bend_of(p, du, dv, f[1], zu, zv, frame);
    bool u_grows = fabs(f[0].au) >= fabs(f[0].av);
    double a = u_grows ? f[0].au : f[0].av, b = u_grows ? f[0].av : f[0].au;
    us[0] = u, vs[0] = v;
    if (!(a != 0.0))
        return 1;
    Span s = u_grows ? u : v, w = u_grows ? v : u, parts[2];
    Along along = bend_along(&h, f[0], of, u_grows, s, w);
    double zero = along.zero, one = along.one, two = along.two;
    Span value = {-along.rest.high, -along.rest.low};
    if (two < 0.0) {
        zero = -zero, one = -one, two = -two;
        value = (Span){-value.high, -value.low};
    }
    int count = parabola(zero, one, two, value, w, parts), kept = 0;
    for (int n = 0; n < count; n++) {
        Span narrow = s;
        if (!clip(a, b, of, parts[n], &narrow))
            continue;
        us[kept] = u_grows ? narrow : parts[n];
        vs[kept++] = u_grows ? parts[n] : narrow;
    }
    return kept;
}

#endif
