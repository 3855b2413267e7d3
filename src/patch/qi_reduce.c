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
// the direction of the larger tangent and the one across; both coordinates are tested, and clip
// what they can. What does not shrink is halved, across the direction that is longer as the ray
// sees it. A piece wholly within the tolerance of the ray is one hit.
#include "patch/qi.h"

#include "patch/qi_frame.h"
#include "patch/quasi.h"

#include <assert.h>
#include <float.h>
#include <stddef.h>

enum { LINE = BEZIER_MAX_DEGREE + 1, POINTS = BEZIER_MAX_POINTS };
// Halving stops at parameter widths of 2^-49, where a piece spans less than 16 ulps.
enum { HALVINGS = 49, STACK = 2 * HALVINGS + 2 };
static const double LEAST_WIDTH = 0x1p-49;
// L from which on Newton cannot fail, and from which on it is tried.
static const double CERTAIN_SLOPE = 0.25, LIKELY_SLOPE = 0.75;

// A patch in the ray's frame, coordinate by coordinate; index i * (dv + 1) + j.
typedef struct {
    double x[POINTS], y[POINTS], z[POINTS];
} Net;

typedef struct {
    QiFrame frame;
    QiList list;
    int du, dv;
    Net whole;
    double weight_x, weight_y; // bring x and y to size 1, unless they are rounding and no more
    uint64_t steps, newton, work_limit;
} Search;

typedef struct {
    double low, high;
} Span;

// A linear function of the projected coordinates, bx x + by y = au u + av v + remainder over the
// piece's own [0,1]^2.
typedef struct {
    double bx, by, au, av;
} Form;

// The remainder's QI bounds, and L of the intro.
typedef struct {
    Span span;
    double slope;
} Remainder;

// ---- Pieces ----

// Row k of w: weights of the control points in the k-th of the part [a,b], the coefficients of
// ((1-a) + a x)^(d-k) ((1-b) + b x)^k. All are >= 0, so relative errors stay relative.
static inline void restriction(double *w, int d, double a, double b) {
    int n = d + 1;
    double at_a[LINE] = {1.0};
    for (int k = d; k >= 0; k--) {
        double *row = w + k * n;
        for (int i = 0; i <= d; i++)
            row[i] = i <= d - k ? at_a[i] : 0.0;
        for (int m = 0; m < k; m++) {
            for (int i = d - k + m + 1; i > 0; i--)
                row[i] = row[i] * (1.0 - b) + row[i - 1] * b;
            row[0] *= 1.0 - b;
        }
        if (k > 0) {
            for (int i = d - k + 1; i > 0; i--)
                at_a[i] = at_a[i] * (1.0 - a) + at_a[i - 1] * a;
            at_a[0] *= 1.0 - a;
        }
    }
}

static inline void restrict_axis(const double *p, const double *wu, const double *wv, int du,
                                 int dv, double *out) {
    double half[POINTS];
    int nu = du + 1, nv = dv + 1;
    for (int k = 0; k < nu; k++) {
        for (int j = 0; j < nv; j++)
            half[k * nv + j] = 0.0;
        for (int i = 0; i < nu; i++)
            for (int j = 0; j < nv; j++)
                half[k * nv + j] += wu[k * nu + i] * p[i * nv + j];
    }
    for (int k = 0; k < nu; k++) {
        for (int m = 0; m < nv; m++) {
            double sum = 0.0;
            for (int j = 0; j < nv; j++)
                sum += half[k * nv + j] * wv[m * nv + j];
            out[k * nv + m] = sum;
        }
    }
}

static inline void restrict_net(const Net *whole, int du, int dv, BezierRect r, Net *out) {
    double wu[LINE * LINE], wv[LINE * LINE];
    restriction(wu, du, r.u0, r.u1);
    restriction(wv, dv, r.v0, r.v1);
    restrict_axis(whole->x, wu, wv, du, dv, out->x);
    restrict_axis(whole->y, wu, wv, du, dv, out->y);
    restrict_axis(whole->z, wu, wv, du, dv, out->z);
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

// Largest absolute second differences, and slopes of the control points, along both directions.
static inline void differences(const double *r, int du, int dv, double second[2], double slope[2]) {
    int row = dv + 1;
    double su = 0.0, sv = 0.0, mu = 0.0, mv = 0.0;
    for (int i = 0; i < du; i++) {
        for (int j = 0; j <= dv; j++) {
            const double *c = r + i * row + j;
            mu = larger(mu, fabs(c[row] - c[0]));
            if (i > 0)
                su = larger(su, fabs((c[row] - c[0]) - (c[0] - c[-row])));
        }
    }
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j < dv; j++) {
            const double *c = r + i * row + j;
            mv = larger(mv, fabs(c[1] - c[0]));
            if (j > 0)
                sv = larger(sv, fabs((c[1] - c[0]) - (c[0] - c[-1])));
        }
    }
    second[0] = su, second[1] = sv;
    slope[0] = du * mu, slope[1] = dv * mv;
}

// Multiplies a net by M from both sides, in place.
static inline void quasi(double *r, int du, int dv) {
    int row = dv + 1;
    double before[LINE];
    for (int j = 0; j < row; j++)
        before[j] = r[j];
    for (int i = 1; i < du; i++) {
        for (int j = 0; j < row; j++) {
            double here = r[i * row + j];
            r[i * row + j] = 0.25 * (before[j] + 2.0 * here + r[(i + 1) * row + j]);
            before[j] = here;
        }
    }
    for (int i = 0; i <= du; i++) {
        double *c = r + i * row, last = c[0];
        for (int j = 1; j < dv; j++) {
            double here = c[j];
            c[j] = 0.25 * (last + 2.0 * here + c[j + 1]);
            last = here;
        }
    }
}

static inline Remainder bound_remainder(const Net *p, int du, int dv, Form f, double zu, double zv,
                                        const QiFrame *frame) {
    double r[POINTS], second[2], slope[2];
    for (int i = 0; i <= du; i++) {
        double base = f.au * ((double)i / du);
        for (int j = 0; j <= dv; j++) {
            int k = i * (dv + 1) + j;
            r[k] = f.bx * p->x[k] + f.by * p->y[k] - base - f.av * ((double)j / dv);
        }
    }
    differences(r, du, dv, second, slope);
    quasi(r, du, dv);
    // Rounding: that of the coordinates, and of the parameters' share.
    double eps = zu * second[0] + zv * second[1] + fabs(f.bx) * frame->slack_x +
                 fabs(f.by) * frame->slack_y + 16.0 * DBL_EPSILON * (fabs(f.au) + fabs(f.av));
    Span s = span_of(r, (du + 1) * (dv + 1));
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

// ---- Points ----

typedef struct {
    double x, y, z, xu, yu, xv, yv;
} Point;

// Bernstein weights and their derivatives at t.
static inline void weights(int d, double t, double *value, double *slope) {
    double low[LINE] = {1.0};
    for (int m = 1; m < d; m++) {
        low[m] = 0.0;
        for (int i = m; i > 0; i--)
            low[i] = low[i] * (1.0 - t) + low[i - 1] * t;
        low[0] *= 1.0 - t;
    }
    for (int i = 0; i <= d; i++) {
        double here = i < d ? low[i] : 0.0, before = i > 0 ? low[i - 1] : 0.0;
        value[i] = here * (1.0 - t) + before * t;
        slope[i] = d * (before - here);
    }
}

static inline Point eval_net(const Net *n, int du, int dv, double u, double v) {
    double wu[LINE], su[LINE], wv[LINE], sv[LINE];
    weights(du, u, wu, su);
    weights(dv, v, wv, sv);
    Point p = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i <= du; i++) {
        const double *x = n->x + i * (dv + 1), *y = n->y + i * (dv + 1), *z = n->z + i * (dv + 1);
        double rx = 0.0, ry = 0.0, rz = 0.0, rxv = 0.0, ryv = 0.0;
        for (int j = 0; j <= dv; j++) {
            rx += x[j] * wv[j];
            ry += y[j] * wv[j];
            rz += z[j] * wv[j];
            rxv += x[j] * sv[j];
            ryv += y[j] * sv[j];
        }
        p.x += rx * wu[i];
        p.y += ry * wu[i];
        p.z += rz * wu[i];
        p.xu += rx * su[i];
        p.yu += ry * su[i];
        p.xv += rxv * wu[i];
        p.yv += ryv * wu[i];
    }
    return p;
}

static Point eval(const Search *q, double u, double v) {
    if (q->du == 3 && q->dv == 3)
        return eval_net(&q->whole, 3, 3, u, v);
    return eval_net(&q->whole, q->du, q->dv, u, v);
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

// ---- Hits ----

static bool in_range(const Search *q, double z) {
    double t = qi_frame_t(&q->frame, z);
    return t >= q->list.t_min && t < q->list.t_max;
}

static void add_found(Search *q, Point p, double u, double v, BezierRect rect, int sign) {
    QiFound found;
    found.t = qi_frame_t(&q->frame, p.z);
    found.z = p.z;
    found.u = u;
    found.v = v;
    found.bound = sqrt(p.x * p.x + p.y * p.y) + q->frame.rounding;
    found.rect = rect;
    found.sign = sign;
    qi_list_add(&q->list, found);
}

// Distance from the ray as the weights measure it.
static double off_ray(const Search *q, Point p) {
    return fabs(p.x) * q->weight_x + fabs(p.y) * q->weight_y;
}

static bool on_ray(const Search *q, Point p, double slacks) {
    return fabs(p.x) <= slacks * q->frame.slack_x && fabs(p.y) <= slacks * q->frame.slack_y;
}

// A root with its rounding, in slacks: what Newton may end on and still be on a root.
static const double ROOT_SLACKS = 4.0;

// The only root that the piece `rect` can have: true if Newton ends on it, and then it is reported.
// error_u, error_v: how far off ROOT_SLACKS can move it, by the forms that proved it single.
static bool sharpen_single(Search *q, BezierRect rect, double error_u, double error_v) {
    double u = 0.5 * (rect.u0 + rect.u1), v = 0.5 * (rect.v0 + rect.v1);
    Point p = eval(q, u, v);
    // At 2/3 a step throughout, 96 steps would still take any start to 2^-53 of the piece.
    for (int n = 0; n < 96; n++) {
        double det = p.xu * p.yv - p.xv * p.yu;
        double nu = clamp(u - (p.yv * p.x - p.xv * p.y) / det, rect.u0, rect.u1);
        double nv = clamp(v - (p.xu * p.y - p.yu * p.x) / det, rect.v0, rect.v1);
        if (!(fabs(nu - u) + fabs(nv - v) > DBL_EPSILON)) // no step left, or no number
            break;
        Point next = eval(q, nu, nv);
        q->newton++;
        if (on_ray(q, p, ROOT_SLACKS) && off_ray(q, next) >= off_ray(q, p))
            break; // as near as rounding lets it come
        u = nu, v = nv, p = next;
        if (on_ray(q, p, 0.0625))
            break;
    }
    if (!on_ray(q, p, ROOT_SLACKS))
        return false;
    double det = p.xu * p.yv - p.xv * p.yu;
    add_found(q, p, u, v, (BezierRect){u - error_u, u + error_u, v - error_v, v + error_v},
              det > 0.0 ? 1 : -1);
    return true;
}

// A few damped least-squares steps towards the ray inside rect: they find a double or multiple root
// too, or a point of a whole curve of them. Keeps what is nearer to the ray and in range.
static Point sharpen_any(Search *q, BezierRect rect, Point p, double *u, double *v) {
    double wx = q->weight_x, wy = q->weight_y;
    for (int n = 0; n < 8; n++) {
        double x = wx * p.x, xu = wx * p.xu, xv = wx * p.xv, y = wy * p.y, yu = wy * p.yu,
               yv = wy * p.yv;
        double a = xu * xu + yu * yu, b = xu * xv + yu * yv, c = xv * xv + yv * yv;
        double gu = xu * x + yu * y, gv = xv * x + yv * y, damp = 1e-12 * (a + c);
        double det = (a + damp) * (c + damp) - b * b;
        double nu = clamp(*u - ((c + damp) * gu - b * gv) / det, rect.u0, rect.u1);
        double nv = clamp(*v - ((a + damp) * gv - b * gu) / det, rect.v0, rect.v1);
        if (!(fabs(nu - *u) + fabs(nv - *v) > DBL_EPSILON))
            break;
        Point next = eval(q, nu, nv);
        q->newton++;
        if (!(off_ray(q, next) < off_ray(q, p)) || !in_range(q, next.z) ||
            !(next.x * next.x + next.y * next.y <= q->frame.tolerance * q->frame.tolerance))
            break;
        *u = nu, *v = nv, p = next;
    }
    return p;
}

// A piece whose every point is within the tolerance of the ray: one hit. It starts from the
// nearest corner whose depth is in range; where the corners lie on both sides of t_min, from a
// point between two of them that is. False: no such point, and the piece is long in depth.
static bool settle(Search *q, BezierRect r) {
    const double us[4] = {r.u0, r.u0, r.u1, r.u1}, vs[4] = {r.v0, r.v1, r.v0, r.v1};
    Point corners[4];
    int best = -1, before = -1, behind = -1;
    for (int k = 0; k < 4; k++) {
        corners[k] = eval(q, us[k], vs[k]);
        double z = corners[k].z;
        if (in_range(q, z))
            best = best < 0 || z < corners[best].z ? k : best;
        else if (qi_frame_t(&q->frame, z) < q->list.t_min)
            before = k;
        else
            behind = k;
    }
    double u = 0.5 * (r.u0 + r.u1), v = 0.5 * (r.v0 + r.v1);
    Point p = eval(q, u, v);
    if (before >= 0 && (best >= 0 || behind >= 0)) {
        // Bisect for the first depth in range between the two.
        int far = best >= 0 ? best : behind;
        double low = 0.0, high = 1.0;
        for (int n = 0; n < 56; n++) {
            double at = 0.5 * (low + high);
            double nu = us[before] + at * (us[far] - us[before]);
            double nv = vs[before] + at * (vs[far] - vs[before]);
            Point next = eval(q, nu, nv);
            bool early = qi_frame_t(&q->frame, next.z) < q->list.t_min;
            if (!early)
                u = nu, v = nv, p = next;
            *(early ? &low : &high) = at;
        }
    } else if (best >= 0) {
        u = us[best], v = vs[best], p = corners[best];
    }
    if (!in_range(q, p.z))
        return false;
    p = sharpen_any(q, r, p, &u, &v);
    add_found(q, p, u, v, r, 0);
    return true;
}

// ---- One step ----

typedef enum { STEP_DONE, STEP_AGAIN, STEP_HALVE } Step;

// What a step leaves of its piece, and how to halve it.
typedef struct {
    BezierRect rect;
    bool along_u, low_first;
} Rest;

// The two forms of a piece: A (x, y) where the mean Jacobian allows it (true), else the rotation,
// both after x and y were brought to one size.
static inline bool choose_forms(const Search *q, double xu, double yu, double xv, double yv,
                                Form forms[2]) {
    double wx = q->weight_x, wy = q->weight_y;
    xu *= wx, xv *= wx, yu *= wy, yv *= wy;
    double det = xu * yv - xv * yu;
    double uu = xu * xu + yu * yu, vv = xv * xv + yv * yv;
    // Tangents at less than about 3 degrees to each other: A would stretch the remainder 20 times.
    if (det * det > 0.0025 * uu * vv && isfinite(1.0 / det)) {
        forms[0] = (Form){yv / det * wx, -xv / det * wy, 1.0, 0.0};
        forms[1] = (Form){-yu / det * wx, xu / det * wy, 0.0, 1.0};
        return true;
    }
    double gx = uu >= vv ? xu : xv, gy = uu >= vv ? yu : yv, length = sqrt(larger(uu, vv));
    if (!(length > 0.0))
        gx = length = 1.0, gy = 0.0;
    gx /= length;
    gy /= length;
    forms[0] = (Form){gx * wx, gy * wy, gx * xu + gy * yu, gx * xv + gy * yv};
    forms[1] = (Form){-gy * wx, gx * wy, gx * yu - gy * xu, gx * yv - gy * xv};
    return false;
}

static inline bool within(const Net *p, int count, double radius) {
    for (int k = 0; k < count; k++)
        if (!(p->x[k] * p->x[k] + p->y[k] * p->y[k] <= radius * radius))
            return false;
    return true;
}

// Longest difference of neighbours, in the larger coordinate by weight.
static inline void lengths(const Search *q, const Net *p, int du, int dv, double *along_u,
                           double *along_v) {
    double none[2], x[2], y[2];
    differences(p->x, du, dv, none, x);
    differences(p->y, du, dv, none, y);
    *along_u = larger(x[0] * q->weight_x, y[0] * q->weight_y);
    *along_v = larger(x[1] * q->weight_x, y[1] * q->weight_y);
}

// Which half is met first? Where J is singular the first form vanishes along a curve of the piece,
// and depth counts along that curve: a ray in the surface must be followed from its near end.
static inline bool nearer_low(bool along_u, bool regular, Form f, double zu, double zv) {
    if (along_u)
        return regular || f.av == 0.0 ? zu >= 0.0 : (zu * f.av - zv * f.au) * f.av >= 0.0;
    return regular || f.au == 0.0 ? zv >= 0.0 : (zv * f.au - zu * f.av) * f.au >= 0.0;
}

static inline Step step_of(Search *q, BezierRect r, int du, int dv, Rest *rest) {
    Net p;
    int count = (du + 1) * (dv + 1);
    q->steps++;
    restrict_net(&q->whole, du, dv, r, &p);
    Span depth = span_of(p.z, count);
    if (depth.high + q->frame.slack_z < q->frame.z_low ||
        depth.low - q->frame.slack_z > qi_list_z_high(&q->list, &q->frame))
        return STEP_DONE;

    Form forms[2];
    Remainder bounds[2];
    bool regular = choose_forms(q, trend_u(p.x, du, dv), trend_u(p.y, du, dv), trend_v(p.x, du, dv),
                                trend_v(p.y, du, dv), forms);
    double zu = quasi_z_infinity(du), zv = quasi_z_infinity(dv);
    Span u = {0.0, 1.0}, v = {0.0, 1.0};
    for (int k = 0; k < 2; k++) {
        bounds[k] = bound_remainder(&p, du, dv, forms[k], zu, zv, &q->frame);
        if (!clip(forms[k].au, forms[k].av, bounds[k].span, v, &u) ||
            !clip(forms[k].av, forms[k].au, bounds[k].span, u, &v))
            return STEP_DONE;
    }
    BezierRect left = r;
    narrow(&left.u0, &left.u1, u);
    narrow(&left.v0, &left.v1, v);
    rest->rect = left;
    double slope = larger(bounds[0].slope, bounds[1].slope);
    if (regular && slope <= LIKELY_SLOPE) {
        double sx = 2.0 * ROOT_SLACKS * q->frame.slack_x, sy = 2.0 * ROOT_SLACKS * q->frame.slack_y;
        double error_u = (fabs(forms[0].bx) * sx + fabs(forms[0].by) * sy) * (r.u1 - r.u0);
        double error_v = (fabs(forms[1].bx) * sx + fabs(forms[1].by) * sy) * (r.v1 - r.v0);
        // Twice the rounding, times 1 / (1 - L).
        double stretch = 1.0 / (1.0 - slope);
        if (sharpen_single(q, left, stretch * error_u, stretch * error_v) || slope <= CERTAIN_SLOPE)
            return STEP_DONE;
    }
    double wu = left.u1 - left.u0, wv = left.v1 - left.v0;
    bool least = wu <= LEAST_WIDTH && wv <= LEAST_WIDTH;
    // A width at its least counts as not shrinking, so that each such step halves what can shrink.
    double kept_u = wu > LEAST_WIDTH ? wu / (r.u1 - r.u0) : 1.0;
    double kept_v = wv > LEAST_WIDTH ? wv / (r.v1 - r.v0) : 1.0;
    if (!least && kept_u * kept_v <= 0.5)
        return STEP_AGAIN;
    if ((within(&p, count, q->frame.tolerance) || least) && (settle(q, left) || least))
        return STEP_DONE;

    double along_u, along_v;
    lengths(q, &p, du, dv, &along_u, &along_v);
    along_u *= u.high - u.low;
    along_v *= v.high - v.low;
    rest->along_u = wv <= LEAST_WIDTH || (wu > LEAST_WIDTH && along_u >= along_v);
    rest->low_first =
        nearer_low(rest->along_u, regular, forms[0], trend_u(p.z, du, dv), trend_v(p.z, du, dv));
    return STEP_HALVE;
}

// The bicubic case gets its own copy, with loops of known length.
static Step step_bicubic(Search *q, BezierRect r, Rest *rest) { return step_of(q, r, 3, 3, rest); }
static Step step_any(Search *q, BezierRect r, Rest *rest) {
    return step_of(q, r, q->du, q->dv, rest);
}

// Beyond the work limit: only the half whose middle is nearer to the ray is followed.
static bool first_half_nearer(const Search *q, const BezierRect half[2]) {
    double off[2];
    for (int k = 0; k < 2; k++) {
        Point p = eval(q, 0.5 * (half[k].u0 + half[k].u1), 0.5 * (half[k].v0 + half[k].v1));
        off[k] = off_ray(q, p);
    }
    return off[0] <= off[1];
}

static void search(Search *q, BezierRect rect) {
    BezierRect stack[STACK];
    int count = 0;
    stack[count++] = rect;
    while (count > 0 && !qi_list_done(&q->list)) {
        Rest rest = {stack[--count], false, false};
        Step step;
        do {
            step = q->du == 3 && q->dv == 3 ? step_bicubic(q, rest.rect, &rest)
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

// A coordinate below a thousand times its own rounding keeps that size: it must not look important.
static double weight_of(double side, double slack) {
    double size = larger(side, 1024.0 * slack);
    return size > DBL_MIN ? 1.0 / size : 1.0;
}

static int intersect(const Bezier *patch, const QiQuery *query, QiMode mode, QiStats *stats,
                     QiSink sink, void *context) {
    QiFound found[QI_MAX_HITS];
    Search q;
    Bezier framed;
    if (!qi_frame_init(&q.frame, FRAME_SKEW, patch, query, &framed))
        return 0;
    q.weight_x = weight_of(q.frame.side_x, q.frame.slack_x);
    q.weight_y = weight_of(q.frame.side_y, q.frame.slack_y);
    q.du = patch->du;
    q.dv = patch->dv;
    for (int k = 0; k < bezier_count(patch); k++) {
        q.whole.x[k] = framed.p[k].x;
        q.whole.y[k] = framed.p[k].y;
        q.whole.z[k] = framed.p[k].z;
    }
    q.list = (QiList){mode, query->t_min, query->t_max, 0, mode == QI_ALL ? QI_MAX_HITS : 1, found};
    q.steps = q.newton = 0;
    q.work_limit = (uint64_t)qi_work_limit(patch);
    search(&q, query->rect);
    if (stats) {
        stats->steps += q.steps;
        stats->newton += q.newton;
        stats->limited += q.steps > q.work_limit;
    }
    return qi_list_report(&q.list, patch, &q.frame, query->ray.dir, stats, sink, context);
}

int qi_reduce_all(const Bezier *patch, const QiQuery *query, QiStats *stats, QiSink sink,
                  void *context) {
    return intersect(patch, query, QI_ALL, stats, sink, context);
}

static void take_hit(void *context, const QiHit *hit) { *(QiHit *)context = *hit; }

bool qi_reduce_nearest(const Bezier *patch, const QiQuery *query, QiStats *stats, QiHit *hit) {
    return intersect(patch, query, QI_NEAREST, stats, take_hit, hit) > 0;
}

bool qi_reduce_any(const Bezier *patch, const QiQuery *query, QiStats *stats) {
    return intersect(patch, query, QI_ANY, stats, NULL, NULL) > 0;
}
