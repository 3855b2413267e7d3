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
// leaves at most one. The inverse of a Jacobian times J is at most 1/(1 - L), two Jacobians differ
// by 2 L at most, so a Newton step multiplies the error by 2 L / (1 - L): below 1 from L < 1/3 on,
// and quadratically less as it goes on. From L <= 3/4 on it is tried. What it ends on is the only
// root. If it ends on none, held at the piece's side or kept off by rounding, that proves nothing
// by itself; but the same L then tells from its last point where a root would be, and unless that
// is outside of the piece the reduction goes on. All of that holds for the forms below as well,
// since it is asked of A (x, y), which is made from them: a root at a small angle is as single as
// any.
//
// Where J is singular (collapsed edges, silhouettes, rays in the surface) the map is a rotation to
// the direction of the larger tangent and the one across, after x and y were measured in units of
// their own rounding; both coordinates are tested, and clip what they can. (The units matter where
// the precisions differ: of a ribbon 1e10 times longer than wide, seen from its length away, one
// coordinate is exact to 1e-14 of its size and the other to 1e-6. Mixed size by size, the first
// would be known no better than the second, and a curve along which the second vanishes within its
// rounding would have to be covered by 1e6 pieces.) Along the curve on which the first vanishes the
// second is taken to be a parabola (qi_bend.h). What does not shrink is halved, across the
// direction that is longer as the ray sees it. A piece wholly within the tolerance of the ray is
// one hit, and so is a curve of a piece on which one coordinate vanishes while the other is nothing
// but rounding: a tangent ray, or one that lies in the surface.
#include "patch/qi_reduce.h"

#include "patch/qi_bend.h"
#include "patch/qi_pole.h"
#include "patch/quasi.h"

#include <assert.h>
#include <float.h>
#include <stddef.h>

// Halving stops at parameter widths of 2^-49, where a piece spans less than 16 ulps.
enum { HALVINGS = 49, STACK = 2 * HALVINGS + 2 };
static const double LEAST_WIDTH = 0x1p-49;
// As many nets look for what rounding can tell; only then is the tolerance made use of. So a ribbon
// that is narrower than the tolerance is not hit beside it, and of two crossings nearer to each
// other than that the first is found.
static const uint64_t PATIENCE = 96;
// L from which on Newton is tried.
static const double LIKELY_SLOPE = 0.75;

typedef QiSearch Search;

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
// and turns z into depths. Returns the factor.
static double scale_rational(QiNet *p, int count) {
    double scale = 1.0 / largest(p->w, count);
    for (int k = 0; k < count; k++) {
        p->x[k] *= scale;
        p->y[k] *= scale;
        p->z[k] /= p->w[k];
        p->w[k] *= scale;
    }
    return scale;
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

typedef enum { STEP_DONE, STEP_AGAIN, STEP_BOTH, STEP_HERE } Step;

// What a step leaves of its piece: one part, or two.
typedef struct {
    BezierRect rect, later;
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
    double scale; // of the weights: net.x is x w scale
    QiForm forms[2];
    Remainder bounds[2];
    Span u, v;    // what the bounds leave, in the piece's own parameters
    bool regular; // forms are A (x, y)
} Piece;

// The part of the piece over two spans.
static inline BezierRect part_of(const Piece *p, Span u, Span v) {
    BezierRect part = p->rect;
    narrow(&part.u0, &part.u1, u);
    narrow(&part.v0, &part.v1, v);
    return part;
}

// Reads the parameters off x and y of the piece's net; frame has the net's rounding. False: the ray
// misses the piece.
static inline bool read_off(const QiTarget *target, const QiFrame *frame, int du, int dv,
                            Piece *p) {
    double xu = trend_u(p->net.x, du, dv), yu = trend_u(p->net.y, du, dv);
    double xv = trend_v(p->net.x, du, dv), yv = trend_v(p->net.y, du, dv);
    p->regular = regular_forms(target, xu, yu, xv, yv, p->forms);
    if (!p->regular)
        singular_forms(target, xu, yu, xv, yv, p->forms);

    double zu = quasi_z_infinity(du), zv = quasi_z_infinity(dv);
    p->u = p->v = (Span){0.0, 1.0};
    for (int k = 0; k < 2; k++) {
        QiForm f = p->forms[k];
        p->bounds[k] = bound_remainder(&p->net, du, dv, f, zu, zv, frame);
        if (!clip(f.au, f.av, p->bounds[k].span, p->v, &p->u) ||
            !clip(f.av, f.au, p->bounds[k].span, p->u, &p->v))
            return false;
    }
    p->left = part_of(p, p->u, p->v);
    return true;
}

// Do any of the piece's depths count, which err by `slack`?
static inline bool depths_count(const QiTarget *target, double slack, const Piece *p, int count) {
    Span depth = span_of(p->net.z, count);
    return depth.high + slack >= target->frame.z_low &&
           depth.low - slack <= qi_list_z_high(&target->list, &target->frame);
}

static bool clip_poles(const Search *q, Piece *p) {
    for (int k = 0; k < 2; k++) {
        QiForm f = p->forms[k];
        if (!qi_pole_clip(&q->target, q->collapsed, &p->net, p->rect, f,
                          form_slack(f, &q->target.frame), &p->u, &p->v))
            return false;
    }
    p->left = part_of(p, p->u, p->v);
    return true;
}

// Restricts the patch, reads the parameters off. False: the ray misses the piece, or meets it only
// at depths that do not count.
static inline bool reduce_piece(Search *q, int du, int dv, Piece *p) {
    const QiTarget *target = &q->target;
    const BezierRect r = p->rect;
    double wu[LINE * LINE], wv[LINE * LINE];
    int count = (du + 1) * (dv + 1);
    q->steps++;
    p->scale = 1.0;
    restriction(wu, du + 1, 1, du, r.u0, r.u1);
    restriction(wv, 1, dv + 1, dv, r.v0, r.v1);
    restrict_axis(target->whole.x, wu, wv, du, dv, p->net.x);
    restrict_axis(target->whole.y, wu, wv, du, dv, p->net.y);
    if (target->rational) {
        restrict_axis(target->whole.z, wu, wv, du, dv, p->net.z);
        restrict_axis(target->whole.w, wu, wv, du, dv, p->net.w);
        p->scale = scale_rational(&p->net, count);
    }
    if (!read_off(target, &target->frame, du, dv, p) || (q->collapsed && !clip_poles(q, p)))
        return false;
    if (!target->rational)
        restrict_axis(target->whole.z, wu, wv, du, dv, p->net.z);
    return depths_count(target, target->frame.slack_z, p, count);
}

// What a piece's forms say of its roots, in units of its own parameters: the linear map A that
// makes (x, y) one of the parameters, L, and the rounding of a root.
typedef struct {
    double ux, uy, vx, vy; // A's rows: u + r = ux x + uy y
    double slope;
    double slack_u, slack_v;
} Contraction;

// A rotation's forms
//     a s + b w + f,  c w + h    (s: the parameter of the larger tangent)
// are divided by their matrix, whatever the angle between the tangents: s + (f - b/c h)/a, w + h/c.
static inline Contraction contraction(const Piece *p, const QiFrame *frame) {
    const QiForm *f = p->forms;
    double slope_0 = p->bounds[0].slope, slope_1 = p->bounds[1].slope;
    double slack_0 = form_slack(f[0], frame), slack_1 = form_slack(f[1], frame);
    if (p->regular)
        return (Contraction){f[0].bx, f[0].by, f[1].bx, f[1].by, larger(slope_0, slope_1),
                             slack_0, slack_1};
    bool along_u = fabs(f[0].au) >= fabs(f[0].av);
    double a = along_u ? f[0].au : f[0].av, b = along_u ? f[0].av : f[0].au;
    double c = along_u ? f[1].av : f[1].au, zero = along_u ? f[1].au : f[1].av;
    slope_1 = (slope_1 + fabs(zero)) / fabs(c);
    slack_1 /= fabs(c);
    slack_0 = (slack_0 + fabs(b) * slack_1) / fabs(a);
    double slope = larger((slope_0 + fabs(b) * slope_1) / fabs(a), slope_1);
    double wx = f[1].bx / c, wy = f[1].by / c;
    double sx = (f[0].bx - b * wx) / a, sy = (f[0].by - b * wy) / a;
    return along_u ? (Contraction){sx, sy, wx, wy, slope, slack_0, slack_1}
                   : (Contraction){wx, wy, sx, sy, slope, slack_1, slack_0};
}

// Is a root of the piece impossible, by one of its points? With d = q - root and A (x, y) = g at q,
// the root's being 0, |g - d| <= L |d| + slack: so |d| <= R = (|g| + slack) / (1 - L), and each
// coordinate of d is within L R + slack of g's.
static bool misses_from(const Piece *p, const Contraction *c, const QiPoint *q) {
    const BezierRect *r = &p->rect, *left = &p->left;
    double x = q->x * p->scale, y = q->y * p->scale;
    double gu = c->ux * x + c->uy * y, gv = c->vx * x + c->vy * y;
    // A's own roundings, of numbers that may cancel.
    double ulps = 8.0 * DBL_EPSILON;
    double slack_u = c->slack_u + ulps * (fabs(c->ux * x) + fabs(c->uy * y));
    double slack_v = c->slack_v + ulps * (fabs(c->vx * x) + fabs(c->vy * y));
    double reach = larger(fabs(gu) + slack_u, fabs(gv) + slack_v) / (1.0 - c->slope);
    double width_u = r->u1 - r->u0, width_v = r->v1 - r->v0;
    double room_u = (c->slope * reach + slack_u) * width_u + ulps;
    double room_v = (c->slope * reach + slack_v) * width_v + ulps;
    double u = q->u - gu * width_u, v = q->v - gv * width_v;
    return u - room_u > left->u1 || u + room_u < left->u0 || v - room_v > left->v1 ||
           v + room_v < left->v0;
}

// Is there one root at most, and was it found or proved absent?
static bool finish_single(Search *q, const Piece *p) {
    Contraction c = contraction(p, &q->target.frame);
    if (!(c.slope <= LIKELY_SLOPE && c.slack_u <= 0.5 && c.slack_v <= 0.5))
        return false;
    // Twice the rounding that Newton may leave, times 1 / (1 - L).
    double times = 2.0 * QI_ROOT_SLACKS / (1.0 - c.slope);
    double error_u = times * c.slack_u * (p->rect.u1 - p->rect.u0);
    double error_v = times * c.slack_v * (p->rect.v1 - p->rect.v0);
    QiPoint last;
    return qi_root_sharpen(&q->target, p->left, error_u, error_v, &last) ||
           misses_from(p, &c, &last);
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

// The depths of a piece's roots, with their rounding. Where a form is 0 the depth is that less any
// multiple of the form: of a ribbon across the ray, say, whose depths are those of a line and
// nothing else. Of a rational piece it is a mean of the depths less that of the form / w.
static Span root_depths(const Search *q, const Piece *p) {
    const QiTarget *target = &q->target;
    const QiForm *f = p->forms;
    int du = target->du, dv = target->dv, count = (du + 1) * (dv + 1);
    double zu = trend_u(p->net.z, du, dv), zv = trend_v(p->net.z, du, dv), times[2] = {zu, zv};
    if (!p->regular) {
        times[0] = fabs(f[0].au) >= fabs(f[0].av) ? zu / f[0].au : zv / f[0].av;
        times[1] = 0.0;
    }
    if (!isfinite(times[0]))
        times[0] = 0.0;
    double bx = times[0] * f[0].bx + times[1] * f[1].bx;
    double by = times[0] * f[0].by + times[1] * f[1].by;
    double z[POINTS] = {p->net.z[0]}, least = 1.0;
    for (int k = 0; k < count; k++) {
        double w = target->rational ? p->net.w[k] : 1.0;
        z[k] = p->net.z[k] - (bx * p->net.x[k] + by * p->net.y[k]) / w;
        least = w < least ? w : least;
    }
    Span depth = span_of(z, count);
    double error = fabs(times[0]) * form_slack(f[0], &target->frame) +
                   fabs(times[1]) * form_slack(f[1], &target->frame);
    double slack = 2.0 * (target->frame.slack_z + error / least);
    return (Span){depth.low - slack, depth.high + slack};
}

// Do any depths count where the first form is 0, by bounds of the second order? Asked of w (z -
// end), which is linear in z for rational pieces too, for both ends of the range.
static bool curve_counts(const Search *q, const Piece *p) {
    const QiTarget *target = &q->target;
    const QiForm f = p->forms[0];
    int du = target->du, dv = target->dv, count = (du + 1) * (dv + 1);
    bool u_grows = fabs(f.au) >= fabs(f.av);
    double a = u_grows ? f.au : f.av, r[POINTS];
    const double ends[2] = {target->frame.z_low, qi_list_z_high(&target->list, &target->frame)};
    for (int side = 0; side < 2; side++) {
        if (!isfinite(ends[side]))
            continue;
        for (int k = 0; k < count; k++)
            r[k] = (p->net.z[k] - ends[side]) * (target->rational ? p->net.w[k] : 1.0);
        double au = trend_u(r, du, dv), av = trend_v(r, du, dv), times = (u_grows ? au : av) / a;
        if (!isfinite(times))
            return true;
        for (int k = 0; k < count; k++)
            r[k] -= times * (f.bx * p->net.x[k] + f.by * p->net.y[k]);
        double slack = 2.0 * (target->frame.slack_z + fabs(times) * form_slack(f, &target->frame));
        Bend h = bend_of_values(r, du, dv, trend_u(r, du, dv), trend_v(r, du, dv), slack,
                                quasi_z_infinity(du), quasi_z_infinity(dv));
        Along along = bend_along(&h, f, p->bounds[0].span, u_grows, u_grows ? p->u : p->v,
                                 u_grows ? p->v : p->u);
        Span value = bend_values(&along, u_grows ? p->v : p->u);
        if (side == 0 ? value.high < 0.0 : value.low > 0.0)
            return false;
    }
    return true;
}

// Pieces whose roots do not count, and those of a singular J in which the ray is as good as in the
// surface.
static inline bool finish_singular(Search *q, int count, const Piece *p, bool least) {
    const QiFrame *frame = &q->target.frame;
    const QiForm *f = p->forms;
    double radius = q->steps <= PATIENCE ? frame->least_tolerance : frame->tolerance;
    Span at = root_depths(q, p);
    if (at.high < frame->z_low || at.low > qi_list_z_high(&q->target.list, frame) ||
        qi_list_no_nearer(&q->target.list, frame, at.low))
        return true;
    if (!p->regular && p->bounds[0].slope < fmin(fabs(f[0].au), fabs(f[0].av)) &&
        weak_form(&p->net, count, f[1], 16.0 * form_slack(f[1], frame)) &&
        (qi_list_has(&q->target.list, frame, at.low, at.high, radius, p->left) ||
         !curve_counts(q, p) ||
         qi_root_settle_curve(&q->target, p->left, f[0], form_slack(f[0], frame))))
        return true;
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
    double spot[2];
    if (!first_depth(q, p->rect, spot) || !qi_root_settle_at(&q->target, p->rect, spot[0], spot[1]))
        qi_root_settle(&q->target, p->rect);
    return true;
}

static inline double width_of(BezierRect r, bool along_u) {
    return along_u ? r.u1 - r.u0 : r.v1 - r.v0;
}

static inline bool is_least(BezierRect r, bool along_u) {
    return width_of(r, along_u) <= LEAST_WIDTH;
}

// A width at its least counts as not shrinking, so that each such step halves what can shrink.
static inline double kept_of(double width, double whole) {
    return width <= LEAST_WIDTH ? 1.0 : width / whole;
}

static inline bool shrank(const Piece *p) {
    const BezierRect *r = &p->rect;
    return kept_of(p->left.u1 - p->left.u0, r->u1 - r->u0) *
               kept_of(p->left.v1 - p->left.v0, r->v1 - r->v0) <=
           0.5;
}

static inline bool nearer(int du, int dv, const Piece *p, bool along_u) {
    return nearer_low(along_u, p->regular, p->forms[0], trend_u(p->net.z, du, dv),
                      trend_v(p->net.z, du, dv));
}

// Clips a piece of a singular J by its bend: STEP_DONE if nothing is left, STEP_BOTH if *rest has
// two parts of at most half the length, else STEP_AGAIN and what is left in p.
static inline Step bend_piece(const QiFrame *frame, int du, int dv, Piece *p, Rest *rest) {
    Span us[2], vs[2];
    int count = bend_clip(&p->net, du, dv, p->forms, p->bounds[0].span, quasi_z_infinity(du),
                          quasi_z_infinity(dv), frame, p->u, p->v, us, vs);
    if (count == 0)
        return STEP_DONE;
    if (count == 1) {
        p->u = us[0], p->v = vs[0];
        p->left = part_of(p, us[0], vs[0]);
        return STEP_AGAIN;
    }
    bool along_u = fabs(p->forms[0].au) < fabs(p->forms[0].av);
    BezierRect low = part_of(p, us[0], vs[0]), high = part_of(p, us[1], vs[1]);
    double half = 0.5 * width_of(p->left, along_u);
    if (width_of(low, along_u) <= half && width_of(high, along_u) <= half) {
        bool low_first = nearer(du, dv, p, along_u);
        *rest = low_first ? (Rest){low, high} : (Rest){high, low};
        return STEP_BOTH;
    }
    p->u = span_hull(us[0], us[1]);
    p->v = span_hull(vs[0], vs[1]);
    p->left = part_of(p, p->u, p->v);
    return STEP_AGAIN;
}

// Halves what is left of a piece, across the direction that is longer as the ray sees it.
static inline void halve_left(const QiTarget *target, int du, int dv, const Piece *p, Rest *rest) {
    double along_u, along_v;
    lengths(target, &p->net, du, dv, &along_u, &along_v);
    along_u *= p->u.high - p->u.low;
    along_v *= p->v.high - p->v.low;
    bool across_u = is_least(p->left, false) || (!is_least(p->left, true) && along_u >= along_v);
    BezierRect half[2] = {p->left, p->left};
    if (across_u)
        half[0].u1 = half[1].u0 = 0.5 * (p->left.u0 + p->left.u1);
    else
        half[0].v1 = half[1].v0 = 0.5 * (p->left.v0 + p->left.v1);
    bool low_first = nearer(du, dv, p, across_u);
    rest->rect = half[low_first ? 0 : 1];
    rest->later = half[low_first ? 1 : 0];
}

static inline Step step_of(Search *q, BezierRect rect, int du, int dv, Rest *rest) {
    Piece p;
    p.rect = rect;
    if (!reduce_piece(q, du, dv, &p))
        return STEP_DONE;
    rest->rect = p.left;
    if ((q->poles && qi_pole_settle(&q->target, q->poles, &p.net, rect)) || finish_single(q, &p))
        return STEP_DONE;
    bool least = is_least(p.left, true) && is_least(p.left, false);
    if (!least && shrank(&p))
        return STEP_AGAIN;
    if (finish_singular(q, (du + 1) * (dv + 1), &p, least))
        return STEP_DONE;
    if (!p.regular) {
        Step step = bend_piece(&q->target.frame, du, dv, &p, rest);
        if (step != STEP_AGAIN)
            return step;
        rest->rect = p.left;
        if (shrank(&p))
            return STEP_AGAIN;
    }

    halve_left(&q->target, du, dv, &p, rest);
    return STEP_BOTH;
}

// The bicubic case gets its own copy, with loops of known length.
static Step step_bicubic(Search *q, BezierRect r, Rest *rest) { return step_of(q, r, 3, 3, rest); }
static Step step_full(Search *q, BezierRect r, Rest *rest) {
    q->full++;
    return step_of(q, r, q->target.du, q->target.dv, rest);
}

// A step by the part's own bicubic, without what needs the true net. STEP_HERE: it did not help.
static Step step_local(Search *q, BezierRect rect, Rest *rest) {
    const QiTarget *target = &q->target;
    QiFrame frame = target->frame;
    Piece p;
    p.rect = rect;
    p.scale = 1.0;
    q->steps++;
    QiLocalPart part;
    qi_local_part(&q->local, rect, &part);
    qi_local_cut(&q->local, &part, 0, p.net.x, &frame.slack_x);
    qi_local_cut(&q->local, &part, 1, p.net.y, &frame.slack_y);
    if (!read_off(target, &frame, 3, 3, &p))
        return STEP_DONE;
    qi_local_cut(&q->local, &part, 2, p.net.z, &frame.slack_z);
    if (!depths_count(target, frame.slack_z, &p, 16))
        return STEP_DONE;
    for (int k = 0; k < 2; k++)
        p.bounds[k].slope += 8.0 * form_slack(p.forms[k], &frame);
    if (finish_single(q, &p))
        return STEP_DONE;
    if (!p.regular && !shrank(&p)) {
        Step step = bend_piece(&frame, 3, 3, &p, rest);
        if (step != STEP_AGAIN)
            return step;
    }
    rest->rect = p.left;
    // The part's own bicubic, or in the end the true net, would do better where the rest makes up a
    // third or half of the remainders; they cost as much as five steps, and as twenty.
    bool blurred = false;
    for (int k = 0; k < 2; k++) {
        const Span *span = &p.bounds[k].span;
        double times = part.whole ? 4.0 : 6.0;
        blurred |= !(span->high - span->low > times * form_slack(p.forms[k], &frame));
    }
    if (blurred && !part.whole)
        qi_local_forget(&q->local);
    if (shrank(&p) || (blurred && !part.whole))
        return STEP_AGAIN;
    if (blurred || (is_least(p.left, true) && is_least(p.left, false)))
        return STEP_HERE;
    halve_left(target, 3, 3, &p, rest);
    return STEP_BOTH;
}

static Step step_any(Search *q, BezierRect r, Rest *rest) {
    if (q->has_local) {
        Step step = step_local(q, r, rest);
        if (step != STEP_HERE)
            return step;
        r = rest->rect;
    }
    return step_full(q, r, rest);
}

static double middle_off(const Search *q, BezierRect r) {
    return qi_root_off(&q->target, 0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1));
}

static void search(Search *q, BezierRect rect) {
    BezierRect stack[STACK];
    int count = 0;
    stack[count++] = rect;
    while (count > 0 && !qi_list_done(&q->target.list, &q->target.frame)) {
        Rest rest = {.rect = stack[--count]};
        Step step;
        do {
            step = q->target.du == 3 && q->target.dv == 3 ? step_bicubic(q, rest.rect, &rest)
                                                          : step_any(q, rest.rect, &rest);
        } while (step == STEP_AGAIN);
        if (step == STEP_DONE)
            continue;
        // Beyond the work limit only the part whose middle is nearer to the ray is followed.
        if (q->steps > q->work_limit) {
            bool first = middle_off(q, rest.rect) <= middle_off(q, rest.later);
            stack[count++] = first ? rest.rect : rest.later;
            continue;
        }
        // Depth first, so at most one part waits per level, and a level halves one width.
        assert(count + 2 <= STACK);
        stack[count++] = rest.later;
        stack[count++] = rest.rect;
    }
}

void qi_search_init(QiSearch *q, const Bezier *patch, const double *weights, const Ray *ray) {
    q->sound = qi_target_init(&q->target, patch, weights, ray);
    if (!q->sound)
        return;
    q->poles = qi_poles(&q->target);
    q->collapsed = qi_collapsed(&q->target);
    q->work_limit = (uint64_t)qi_work_limit(patch);
}

static int ask(QiSearch *q, const Bezier *patch, const double *weights, const QiQuery *query,
               QiMode mode, QiStats *stats, QiSink sink, void *context) {
    QiFound found[QI_MAX_HITS];
    if (!q->sound ||
        !qi_target_ask(&q->target, query, mode, found, mode == QI_ALL ? QI_MAX_HITS : 1))
        return 0;
    q->has_local = qi_local_init(&q->local, &q->target, query->rect, query->fourth);
    q->steps = q->full = 0;
    search(q, query->rect);
    if (stats) {
        stats->steps += q->steps;
        stats->full += q->full;
        stats->newton += q->target.newton;
        stats->limited += q->steps > q->work_limit;
    }
    return qi_list_report(&q->target.list, patch, weights, &q->target.frame, query->ray.dir, stats,
                          sink, context);
}

int qi_search_all(QiSearch *q, const Bezier *patch, const double *weights, const QiQuery *query,
                  QiStats *stats, QiSink sink, void *context) {
    return ask(q, patch, weights, query, QI_ALL, stats, sink, context);
}

static void take_hit(void *context, const QiHit *hit) { *(QiHit *)context = *hit; }

bool qi_search_nearest(QiSearch *q, const Bezier *patch, const double *weights,
                       const QiQuery *query, QiStats *stats, QiHit *hit) {
    return ask(q, patch, weights, query, QI_NEAREST, stats, take_hit, hit) > 0;
}

int qi_reduce_all(const Bezier *patch, const QiQuery *query, QiStats *stats, QiSink sink,
                  void *context) {
    return qi_rational_all(patch, NULL, query, stats, sink, context);
}

bool qi_reduce_nearest(const Bezier *patch, const QiQuery *query, QiStats *stats, QiHit *hit) {
    return qi_rational_nearest(patch, NULL, query, stats, hit);
}

bool qi_reduce_any(const Bezier *patch, const QiQuery *query, QiStats *stats) {
    QiSearch q;
    qi_search_init(&q, patch, NULL, &query->ray);
    return ask(&q, patch, NULL, query, QI_ANY, stats, NULL, NULL) > 0;
}

int qi_rational_all(const Bezier *patch, const double *weights, const QiQuery *query,
                    QiStats *stats, QiSink sink, void *context) {
    QiSearch q;
    qi_search_init(&q, patch, weights, &query->ray);
    return qi_search_all(&q, patch, weights, query, stats, sink, context);
}

bool qi_rational_nearest(const Bezier *patch, const double *weights, const QiQuery *query,
                         QiStats *stats, QiHit *hit) {
    QiSearch q;
    qi_search_init(&q, patch, weights, &query->ray);
    return qi_search_nearest(&q, patch, weights, query, stats, hit);
}
