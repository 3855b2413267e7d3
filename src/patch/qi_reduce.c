// SPDX-License-Identifier: MIT
// The QI bounds used to read the parameters off, instead of testing squares.
//
// In the ray's skew frame S(u,v) = (x, y, z) meets the ray where x = y = 0. A linear map of (x, y)
// makes both close to a parameter of the piece: with J the piece's mean Jacobian and A its inverse,
//     A (x, y) = (u + r(u,v), v + s(u,v)),
// r and s small. Each remainder is a Bézier function, and lies within its QI net +- eps, so a root
// has u in -[r], v in -[s]. The remainder shrinks with the square of the piece, so pieces shrink
// quadratically, and an interval that misses the piece proves that the ray misses it.
//
// Single roots: with L = |dr/du| + |dr/dv| (and for s; bounds from the control points, largest of
// both) two roots p, q of the piece have |p - q| <= L |p - q| in the larger coordinate, so L < 1
// leaves at most one. From L <= 1/4 on, Newton held inside the piece cannot fail: the inverse of a
// Jacobian times J is at most 1/(1 - L), two Jacobians differ by 2 L at most, so a step multiplies
// the error by 2 L / (1 - L) = 2/3 or less, and quadratically less as it goes on. It ends on the
// root, or, when the piece has none, on a residual that rounding does not explain: a proved miss.
// Between 1/4 and 1 Newton is tried as well: what it finds is the only root, if it fails nothing
// is proved and the reduction goes on.
//
// Where J is singular (collapsed edges, silhouettes, rays in the surface) the map is a rotation to
// the direction of the larger tangent and the one across, after x and y were measured in units of
// their own rounding; both coordinates are tested, and clip what they can. (The units matter where
// the precisions differ: of a ribbon 1e10 times longer than wide, seen from its length away, one
// coordinate is exact to 1e-14 of its size and the other to 1e-6. Mixed size by size, the first
// would be known no better than the second, and a curve along which the second vanishes within its
// rounding would have to be covered by 1e6 pieces.) What does not shrink is halved, across the
// direction that is longer as the ray sees it. A piece wholly within the tolerance of the ray is
// one hit, and so is a curve of a piece on which one coordinate vanishes while the other is nothing
// but rounding: a tangent ray, or one that lies in the surface.
#include "patch/qi.h"

#include "patch/qi_pole.h"
#include "patch/qi_root.h"
#include "patch/quasi.h"

#include <assert.h>
#include <float.h>
#include <stddef.h>

enum { LINE = BEZIER_MAX_DEGREE + 1, POINTS = BEZIER_MAX_POINTS };
// Halving stops at parameter widths of 2^-49, where a piece spans less than 16 ulps.
enum { HALVINGS = 49, STACK = 2 * HALVINGS + 2 };
static const double LEAST_WIDTH = 0x1p-49;
// As many nets look for what rounding can tell; only then is the tolerance made use of. So a ribbon
// that is narrower than the tolerance is not hit beside it, and of two crossings nearer to each
// other than that the first is found.
static const uint64_t PATIENCE = 96;
// L from which on Newton cannot fail, and from which on it is tried.
static const double CERTAIN_SLOPE = 0.25, LIKELY_SLOPE = 0.75;

typedef struct {
    QiTarget target;
    unsigned poles; // qi_poles()
    uint64_t steps, work_limit;
} Search;

typedef struct {
    double low, high;
} Span;

// The remainder's QI bounds, and L of the intro.
typedef struct {
    Span span;
    double slope;
} Remainder;

// ---- Pieces ----

// Weights of the control points in the control points of the part [a,b]: those of the k-th are the
// coefficients of ((1-a) + a x)^(d-k) ((1-b) + b x)^k. All are >= 0, so relative errors stay
// relative. Weight i of point k is w[k * step_k + i * step_i].
static inline void restriction(double *w, int step_k, int step_i, int d, double a, double b) {
    double at_a[LINE], row[LINE];
    at_a[0] = 1.0;
    for (int k = d; k >= 0; k--) {
        for (int i = 0; i <= d - k; i++)
            row[i] = at_a[i];
        for (int n = d - k + 1; n <= d; n++) { // n: degree reached
            row[n] = row[n - 1] * b;
            for (int i = n - 1; i > 0; i--)
                row[i] = row[i] * (1.0 - b) + row[i - 1] * b;
            row[0] *= 1.0 - b;
        }
        for (int i = 0; i <= d; i++)
            w[k * step_k + i * step_i] = row[i];
        if (k > 0) {
            int n = d - k + 1;
            at_a[n] = at_a[n - 1] * a;
            for (int i = n - 1; i > 0; i--)
                at_a[i] = at_a[i] * (1.0 - a) + at_a[i - 1] * a;
            at_a[0] *= 1.0 - a;
        }
    }
}

// out = wu p wv; the inner loops run along rows, so that they vectorise.
static inline void restrict_axis(const double *p, const double *wu, const double *wv, int du,
                                 int dv, double *restrict out) {
    double half[POINTS];
    int nu = du + 1, nv = dv + 1;
    for (int k = 0; k < nu; k++) {
        for (int j = 0; j < nv; j++) {
            double sum = wu[k * nu] * p[j];
            for (int i = 1; i < nu; i++)
                sum += wu[k * nu + i] * p[i * nv + j];
            half[k * nv + j] = sum;
        }
    }
    for (int k = 0; k < nu; k++) {
        for (int m = 0; m < nv; m++) {
            double sum = half[k * nv] * wv[m];
            for (int j = 1; j < nv; j++)
                sum += half[k * nv + j] * wv[j * nv + m];
            out[k * nv + m] = sum;
        }
    }
}

static inline Span span_of(const double *p, int count) {
    Span s = {p[0], p[0]};
    for (int k = 1; k < count; k++) {
        s.low = p[k] < s.low ? p[k] : s.low;
        s.high = p[k] > s.high ? p[k] : s.high;
    }
    return s;
}

// Mean difference between opposite sides.
static inline double trend_u(const double *p, int du, int dv) {
    double sum = 0.0;
    for (int j = 0; j <= dv; j++)
        sum += p[du * (dv + 1) + j] - p[j];
    return sum / (dv + 1);
}

static inline double trend_v(const double *p, int du, int dv) {
    double sum = 0.0;
    for (int i = 0; i <= du; i++)
        sum += p[i * (dv + 1) + dv] - p[i * (dv + 1)];
    return sum / (du + 1);
}

// ---- Bounds ----

static inline double larger(double a, double b) { return a > b ? a : b; }

static inline double largest(const double *a, int count) {
    double most = a[0];
    for (int k = 1; k < count; k++)
        most = larger(most, a[k]);
    return most;
}

// Largest absolute second differences, and slopes of the control points, along both directions.
// Maxima are kept by column, so that the inner loops vectorise.
static inline void differences(const double *r, int du, int dv, double second[2], double slope[2]) {
    int row = dv + 1;
    double first[LINE], before[LINE], most[LINE], most2[LINE];
    most[0] = most2[0] = 0.0; // for gcc, which does not know that dv >= 1
    for (int j = 0; j <= dv; j++) {
        before[j] = r[row + j] - r[j];
        most[j] = fabs(before[j]);
        most2[j] = 0.0;
    }
    for (int i = 1; i < du; i++) {
        const double *c = r + i * row;
        for (int j = 0; j <= dv; j++) {
            double here = c[row + j] - c[j];
            most[j] = larger(most[j], fabs(here));
            most2[j] = larger(most2[j], fabs(here - before[j]));
            before[j] = here;
        }
    }
    second[0] = largest(most2, dv + 1);
    slope[0] = du * largest(most, dv + 1);

    for (int j = 0; j < dv; j++)
        most[j] = most2[j] = 0.0;
    for (int i = 0; i <= du; i++) {
        const double *c = r + i * row;
        for (int j = 0; j < dv; j++) {
            first[j] = c[j + 1] - c[j];
            most[j] = larger(most[j], fabs(first[j]));
        }
        for (int j = 1; j < dv; j++)
            most2[j] = larger(most2[j], fabs(first[j] - first[j - 1]));
    }
    second[1] = largest(most2, dv);
    slope[1] = dv * largest(most, dv);
}

// Span of the net M r M^T.
static inline Span quasi_span(const double *r, int du, int dv) {
    int row = dv + 1;
    double low[LINE], high[LINE], c[LINE], q[LINE];
    for (int i = 0; i <= du; i++) {
        const double *here = r + i * row;
        for (int j = 0; j <= dv; j++)
            c[j] = i == 0 || i == du ? here[j]
                                     : 0.25 * (here[j - row] + 2.0 * here[j] + here[j + row]);
        q[0] = c[0];
        q[dv] = c[dv];
        for (int j = 1; j < dv; j++)
            q[j] = 0.25 * (c[j - 1] + 2.0 * c[j] + c[j + 1]);
        for (int j = 0; j <= dv; j++) {
            low[j] = i == 0 || q[j] < low[j] ? q[j] : low[j];
            high[j] = i == 0 || q[j] > high[j] ? q[j] : high[j];
        }
    }
    Span a = span_of(low, row), b = span_of(high, row);
    return (Span){a.low, b.high};
}

static inline Remainder bound_remainder(const QiNet *p, int du, int dv, QiForm f, double zu,
                                        double zv, const QiFrame *frame) {
    double r[POINTS], second[2], slope[2], base_v[LINE];
    for (int j = 0; j <= dv; j++)
        base_v[j] = f.av * ((double)j / dv);
    for (int i = 0; i <= du; i++) {
        double base = f.au * ((double)i / du);
        for (int j = 0; j <= dv; j++) {
            int k = i * (dv + 1) + j;
            r[k] = f.bx * p->x[k] + f.by * p->y[k] - (base + base_v[j]);
        }
    }
    differences(r, du, dv, second, slope);
    Span s = quasi_span(r, du, dv);
    // Rounding: that of the coordinates, and of the parameters' share.
    double eps = zu * second[0] + zv * second[1] + fabs(f.bx) * frame->slack_x +
                 fabs(f.by) * frame->slack_y + 16.0 * DBL_EPSILON * (fabs(f.au) + fabs(f.av));
    return (Remainder){{s.low - eps, s.high + eps}, slope[0] + slope[1]};
}

// Solves a p + b q + r = 0 for p: p in [0,1] already narrowed to *p, q in *q, r in its span.
// False when no p is left. A product with 0 is 0 here, since q is finite.
static bool clip(double a, double b, Span r, Span q, Span *p) {
    double low = -r.high - larger(b * q.low, b * q.high);
    double high = -r.low - (b * q.low < b * q.high ? b * q.low : b * q.high);
    if (a < 0.0) {
        double swap = -low;
        low = -high, high = swap, a = -a;
    }
    // a p in [low, high]: multiplied out, so that a tiny a only fails to clip.
    if (p->low * a > high || p->high * a < low)
        return false;
    if (p->low * a < low)
        p->low = low / a;
    if (p->high * a > high)
        p->high = high / a;
    return true;
}

// The part of [low,high] that a local span leaves, rounded outwards by some ulps of 1.
static void narrow(double *low, double *high, Span part) {
    const double ulps = 2.0 * DBL_EPSILON;
    double from = *low, to = *high, width = to - from;
    *low = fmin(fmax(from + width * part.low - ulps, from), to);
    *high = fmax(fmin(from + width * part.high + ulps, to), *low);
}

// ---- Rational pieces ----
//
// Where x = y = 0 the projected x w = y w = 0 as well, and these are Bézier functions: the bounds
// read parameters off them. Distances and depths are those of the control points themselves, whose
// hull holds the piece since weights are positive.

// Scales the piece's weights to at most 1, so that the rounding of x w is no more than that of x,
// and turns z into depths.
static void scale_rational(QiNet *p, int count) {
    double scale = 1.0 / largest(p->w, count);
    for (int k = 0; k < count; k++) {
        p->x[k] *= scale;
        p->y[k] *= scale;
        p->z[k] /= p->w[k];
        p->w[k] *= scale;
    }
}

static bool within_rational(const QiNet *p, int count, double radius) {
    for (int k = 0; k < count; k++) {
        double x = p->x[k] / p->w[k], y = p->y[k] / p->w[k];
        if (!(x * x + y * y <= radius * radius))
            return false;
    }
    return true;
}

// ---- One step ----

typedef enum { STEP_DONE, STEP_AGAIN, STEP_HALVE } Step;

// What a step leaves of its piece, and how to halve it.
typedef struct {
    BezierRect rect;
    bool along_u, low_first;
} Rest;

// Rounding of a form's value.
static double form_slack(QiForm f, const QiFrame *frame) {
    return fabs(f.bx) * frame->slack_x + fabs(f.by) * frame->slack_y;
}

// A (x, y), after x and y were brought to one size. False: the mean Jacobian does not allow it, or
// rounding would hide where in the piece a root is (a ribbon may be thinner than that all over).
static inline bool regular_forms(const QiTarget *q, double xu, double yu, double xv, double yv,
                                 QiForm forms[2]) {
    double wx = q->weight_x, wy = q->weight_y;
    xu *= wx, xv *= wx, yu *= wy, yv *= wy;
    double det = xu * yv - xv * yu;
    double uu = xu * xu + yu * yu, vv = xv * xv + yv * yv;
    // Tangents at less than about 3 degrees to each other: A would stretch the remainder 20 times.
    if (!(det * det > 0.0025 * uu * vv && isfinite(1.0 / det)))
        return false;
    forms[0] = (QiForm){yv / det * wx, -xv / det * wy, 1.0, 0.0};
    forms[1] = (QiForm){-yu / det * wx, xu / det * wy, 0.0, 1.0};
    return form_slack(forms[0], &q->frame) <= 0.5 && form_slack(forms[1], &q->frame) <= 0.5;
}

// The rotation of x and y in units of their rounding.
static inline void singular_forms(const QiTarget *q, double xu, double yu, double xv, double yv,
                                  QiForm forms[2]) {
    double wx = q->unit_x, wy = q->unit_y;
    xu *= wx, xv *= wx, yu *= wy, yv *= wy;
    double uu = xu * xu + yu * yu, vv = xv * xv + yv * yv;
    double gx = uu >= vv ? xu : xv, gy = uu >= vv ? yu : yv, length = sqrt(larger(uu, vv));
    if (!(length > 0.0))
        gx = length = 1.0, gy = 0.0;
    gx /= length;
    gy /= length;
    forms[0] = (QiForm){gx * wx, gy * wy, gx * xu + gy * yu, gx * xv + gy * yv};
    forms[1] = (QiForm){-gy * wx, gx * wy, gx * yu - gy * xu, gx * yv - gy * xv};
}

static inline bool within(const QiNet *p, int count, double radius) {
    for (int k = 0; k < count; k++)
        if (!(p->x[k] * p->x[k] + p->y[k] * p->y[k] <= radius * radius))
            return false;
    return true;
}

// Is the form's value nowhere on the piece above `most`?
static inline bool weak_form(const QiNet *p, int count, QiForm f, double most) {
    for (int k = 0; k < count; k++)
        if (!(fabs(f.bx * p->x[k] + f.by * p->y[k]) <= most))
            return false;
    return true;
}

// Longest difference of neighbours, in the larger coordinate by weight.
static inline void lengths(const QiTarget *q, const QiNet *p, int du, int dv, double *along_u,
                           double *along_v) {
    double none[2], x[2], y[2];
    differences(p->x, du, dv, none, x);
    differences(p->y, du, dv, none, y);
    *along_u = larger(x[0] * q->weight_x, y[0] * q->weight_y);
    *along_v = larger(x[1] * q->weight_x, y[1] * q->weight_y);
}

// Which half is met first? Where J is singular the first form vanishes along a curve of the piece,
// and depth counts along that curve: a ray in the surface must be followed from its near end.
static inline bool nearer_low(bool along_u, bool regular, QiForm f, double zu, double zv) {
    if (along_u)
        return regular || f.av == 0.0 ? zu >= 0.0 : (zu * f.av - zv * f.au) * f.av >= 0.0;
    return regular || f.au == 0.0 ? zv >= 0.0 : (zv * f.au - zu * f.av) * f.au >= 0.0;
}

// One piece on its way through a step.
typedef struct {
    BezierRect rect, left; // before and after the step
    QiNet net;
    QiForm forms[2];
    Remainder bounds[2];
    Span u, v;    // what the bounds leave, in the piece's own parameters
    bool regular; // forms are A (x, y)
} Piece;

// Restricts the patch, reads the parameters off. False: the ray misses the piece, or meets it only
// at depths that do not count.
static inline bool reduce_piece(Search *q, int du, int dv, Piece *p) {
    const QiTarget *target = &q->target;
    const BezierRect r = p->rect;
    double wu[LINE * LINE], wv[LINE * LINE];
    q->steps++;
    restriction(wu, du + 1, 1, du, r.u0, r.u1);
    restriction(wv, 1, dv + 1, dv, r.v0, r.v1);
    restrict_axis(target->whole.x, wu, wv, du, dv, p->net.x);
    restrict_axis(target->whole.y, wu, wv, du, dv, p->net.y);
    if (target->rational) {
        restrict_axis(target->whole.z, wu, wv, du, dv, p->net.z);
        restrict_axis(target->whole.w, wu, wv, du, dv, p->net.w);
        scale_rational(&p->net, (du + 1) * (dv + 1));
    }
    double xu = trend_u(p->net.x, du, dv), yu = trend_u(p->net.y, du, dv);
    double xv = trend_v(p->net.x, du, dv), yv = trend_v(p->net.y, du, dv);
    p->regular = regular_forms(target, xu, yu, xv, yv, p->forms);
    if (!p->regular)
        singular_forms(target, xu, yu, xv, yv, p->forms);

    double zu = quasi_z_infinity(du), zv = quasi_z_infinity(dv);
    p->u = p->v = (Span){0.0, 1.0};
    for (int k = 0; k < 2; k++) {
        QiForm f = p->forms[k];
        p->bounds[k] = bound_remainder(&p->net, du, dv, f, zu, zv, &target->frame);
        if (!clip(f.au, f.av, p->bounds[k].span, p->v, &p->u) ||
            !clip(f.av, f.au, p->bounds[k].span, p->u, &p->v))
            return false;
    }
    if (!target->rational)
        restrict_axis(target->whole.z, wu, wv, du, dv, p->net.z);
    Span depth = span_of(p->net.z, (du + 1) * (dv + 1));
    if (depth.high + target->frame.slack_z < target->frame.z_low ||
        depth.low - target->frame.slack_z > qi_list_z_high(&target->list, &target->frame))
        return false;

    p->left = r;
    narrow(&p->left.u0, &p->left.u1, p->u);
    narrow(&p->left.v0, &p->left.v1, p->v);
    return true;
}

// Is there one root at most, and was it found or proved absent?
static bool finish_single(Search *q, const Piece *p) {
    double slope = larger(p->bounds[0].slope, p->bounds[1].slope);
    if (!p->regular || slope > LIKELY_SLOPE)
        return false;
    // Twice the rounding that Newton may leave, times 1 / (1 - L).
    double times = 2.0 * QI_ROOT_SLACKS / (1.0 - slope);
    double error_u = times * form_slack(p->forms[0], &q->target.frame) * (p->rect.u1 - p->rect.u0);
    double error_v = times * form_slack(p->forms[1], &q->target.frame) * (p->rect.v1 - p->rect.v0);
    return qi_root_sharpen(&q->target, p->left, error_u, error_v) || slope <= CERTAIN_SLOPE;
}

// The depths of the control points of a rational piece: its own depths are means of them.
static void divide_weights(const QiTarget *target, const double *wu, const double *wv, double *z) {
    double w[POINTS];
    restrict_axis(target->whole.w, wu, wv, target->du, target->dv, w);
    for (int k = 0; k < (target->du + 1) * (target->dv + 1); k++)
        z[k] /= w[k];
}

// The point of a piece with the smallest depth in range, within the tolerance, by branch and bound:
// all of the piece is on the ray, so only depth counts. False: none was met.
static bool first_depth(Search *q, BezierRect rect, double at[2]) {
    enum { FIRST_STEPS = 400 };
    const QiTarget *target = &q->target;
    const QiFrame *frame = &target->frame;
    int du = target->du, dv = target->dv, row = dv + 1, count = 0;
    double best = qi_list_z_high(&target->list, frame), enough = frame->tolerance / frame->stretch;
    bool found = false;
    BezierRect stack[STACK];
    stack[count++] = rect;
    for (int n = 0; count > 0 && n < FIRST_STEPS; n++) {
        BezierRect r = stack[--count];
        double wu[LINE * LINE], wv[LINE * LINE], z[POINTS], second[2], slope[2];
        q->steps++;
        restriction(wu, du + 1, 1, du, r.u0, r.u1);
        restriction(wv, 1, dv + 1, dv, r.v0, r.v1);
        restrict_axis(target->whole.z, wu, wv, du, dv, z);
        if (target->rational)
            divide_weights(target, wu, wv, z);
        Span depth = span_of(z, (du + 1) * row);
        if (depth.high < frame->z_low || larger(depth.low, frame->z_low) >= best - enough)
            continue;
        for (int k = 0; k < 4; k++) {
            double here = z[(k & 2 ? du * row : 0) + (k & 1 ? dv : 0)];
            if (here < best && qi_root_in_range(target, here - frame->slack_z)) {
                found = true;
                best = here;
                at[0] = k & 2 ? r.u1 : r.u0;
                at[1] = k & 1 ? r.v1 : r.v0;
            }
        }
        // A piece that ends where the range begins has nothing better below.
        if (depth.high - larger(depth.low, frame->z_low) <= enough || count + 2 > STACK)
            continue;
        differences(z, du, dv, second, slope);
        BezierRect half[2] = {r, r};
        bool along_u = slope[0] >= slope[1];
        if (along_u)
            half[0].u1 = half[1].u0 = 0.5 * (r.u0 + r.u1);
        else
            half[0].v1 = half[1].v0 = 0.5 * (r.v0 + r.v1);
        bool low_first = (along_u ? trend_u(z, du, dv) : trend_v(z, du, dv)) >= 0.0;
        stack[count++] = half[low_first ? 1 : 0];
        stack[count++] = half[low_first ? 0 : 1];
    }
    return found;
}

// Pieces of a singular J in which the ray is as good as in the surface.
static inline bool finish_singular(Search *q, int count, const Piece *p, bool least) {
    const QiFrame *frame = &q->target.frame;
    const QiForm *f = p->forms;
    if (!p->regular && p->bounds[0].slope < fmin(fabs(f[0].au), fabs(f[0].av)) &&
        weak_form(&p->net, count, f[1], 16.0 * form_slack(f[1], frame)) &&
        qi_root_settle_curve(&q->target, p->left, f[0], form_slack(f[0], frame)))
        return true;
    double radius = q->steps <= PATIENCE ? frame->least_tolerance : frame->tolerance;
    bool near = q->target.rational ? within_rational(&p->net, count, radius)
                                   : within(&p->net, count, radius);
    if (!least && !near)
        return false;
    Span depth = span_of(p->net.z, count);
    if (least || (depth.high - depth.low) * frame->stretch <= radius) {
        // One place, as far as the tolerance can tell: it is in range, or it is not. (A range may
        // begin on a pole.)
        qi_root_settle(&q->target, p->left);
        return true;
    }
    double at[2];
    if (!first_depth(q, p->rect, at) || !qi_root_settle_at(&q->target, p->rect, at[0], at[1]))
        qi_root_settle(&q->target, p->rect);
    return true;
}

static inline Step step_of(Search *q, BezierRect rect, int du, int dv, Rest *rest) {
    Piece p;
    p.rect = rect;
    if (!reduce_piece(q, du, dv, &p))
        return STEP_DONE;
    rest->rect = p.left;
    if ((q->poles && qi_pole_settle(&q->target, q->poles, &p.net, rect)) || finish_single(q, &p))
        return STEP_DONE;

    double width_u = p.left.u1 - p.left.u0, width_v = p.left.v1 - p.left.v0;
    bool least_u = width_u <= LEAST_WIDTH, least_v = width_v <= LEAST_WIDTH;
    bool least = least_u && least_v;
    // A width at its least counts as not shrinking, so that each such step halves what can shrink.
    double kept_u = least_u ? 1.0 : width_u / (rect.u1 - rect.u0);
    double kept_v = least_v ? 1.0 : width_v / (rect.v1 - rect.v0);
    if (!least && kept_u * kept_v <= 0.5)
        return STEP_AGAIN;
    if (finish_singular(q, (du + 1) * (dv + 1), &p, least))
        return STEP_DONE;

    double along_u, along_v;
    lengths(&q->target, &p.net, du, dv, &along_u, &along_v);
    along_u *= p.u.high - p.u.low;
    along_v *= p.v.high - p.v.low;
    rest->along_u = least_v || (!least_u && along_u >= along_v);
    rest->low_first = nearer_low(rest->along_u, p.regular, p.forms[0], trend_u(p.net.z, du, dv),
                                 trend_v(p.net.z, du, dv));
    return STEP_HALVE;
}

// The bicubic case gets its own copy, with loops of known length.
static Step step_bicubic(Search *q, BezierRect r, Rest *rest) { return step_of(q, r, 3, 3, rest); }
static Step step_any(Search *q, BezierRect r, Rest *rest) {
    return step_of(q, r, q->target.du, q->target.dv, rest);
}

// Beyond the work limit: only the half whose middle is nearer to the ray is followed.
static bool first_half_nearer(const Search *q, const BezierRect half[2]) {
    double off[2];
    for (int k = 0; k < 2; k++) {
        off[k] = qi_root_off(&q->target, 0.5 * (half[k].u0 + half[k].u1),
                             0.5 * (half[k].v0 + half[k].v1));
    }
    return off[0] <= off[1];
}

static void search(Search *q, BezierRect rect) {
    BezierRect stack[STACK];
    int count = 0;
    stack[count++] = rect;
    while (count > 0 && !qi_list_done(&q->target.list)) {
        Rest rest = {stack[--count], false, false};
        Step step;
        do {
            step = q->target.du == 3 && q->target.dv == 3 ? step_bicubic(q, rest.rect, &rest)
                                                          : step_any(q, rest.rect, &rest);
        } while (step == STEP_AGAIN);
        if (step == STEP_DONE)
            continue;
        // Depth first, so at most one half waits per level, and a level halves one width.
        BezierRect half[2] = {rest.rect, rest.rect};
        if (rest.along_u)
            half[0].u1 = half[1].u0 = 0.5 * (rest.rect.u0 + rest.rect.u1);
        else
            half[0].v1 = half[1].v0 = 0.5 * (rest.rect.v0 + rest.rect.v1);
        int first = rest.low_first ? 0 : 1;
        if (q->steps > q->work_limit) {
            stack[count++] = half[first_half_nearer(q, half) ? 0 : 1];
            continue;
        }
        assert(count + 2 <= STACK);
        stack[count++] = half[1 - first];
        stack[count++] = half[first];
    }
}

static int intersect(const Bezier *patch, const double *weights, const QiQuery *query, QiMode mode,
                     QiStats *stats, QiSink sink, void *context) {
    QiFound found[QI_MAX_HITS];
    Search q;
    if (!qi_target_init(&q.target, patch, weights, query, mode, found,
                        mode == QI_ALL ? QI_MAX_HITS : 1))
        return 0;
    q.poles = qi_poles(&q.target);
    q.steps = 0;
    q.work_limit = (uint64_t)qi_work_limit(patch);
    search(&q, query->rect);
    if (stats) {
        stats->steps += q.steps;
        stats->newton += q.target.newton;
        stats->limited += q.steps > q.work_limit;
    }
    return qi_list_report(&q.target.list, patch, weights, &q.target.frame, query->ray.dir, stats,
                          sink, context);
}

int qi_reduce_all(const Bezier *patch, const QiQuery *query, QiStats *stats, QiSink sink,
                  void *context) {
    return intersect(patch, NULL, query, QI_ALL, stats, sink, context);
}

static void take_hit(void *context, const QiHit *hit) { *(QiHit *)context = *hit; }

bool qi_reduce_nearest(const Bezier *patch, const QiQuery *query, QiStats *stats, QiHit *hit) {
    return intersect(patch, NULL, query, QI_NEAREST, stats, take_hit, hit) > 0;
}

bool qi_reduce_any(const Bezier *patch, const QiQuery *query, QiStats *stats) {
    return intersect(patch, NULL, query, QI_ANY, stats, NULL, NULL) > 0;
}

int qi_rational_all(const Bezier *patch, const double *weights, const QiQuery *query,
                    QiStats *stats, QiSink sink, void *context) {
    return intersect(patch, weights, query, QI_ALL, stats, sink, context);
}

bool qi_rational_nearest(const Bezier *patch, const double *weights, const QiQuery *query,
                         QiStats *stats, QiHit *hit) {
    return intersect(patch, weights, query, QI_NEAREST, stats, take_hit, hit) > 0;
}
