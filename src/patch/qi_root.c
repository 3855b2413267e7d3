// SPDX-License-Identifier: MIT
// Points and roots of a patch in the ray's frame. See qi_root.h.
#include "patch/qi_root.h"

#include "base/lanes.h"

#include <float.h>
#include <stddef.h>

enum { LINE = BEZIER_MAX_DEGREE + 1 };

typedef struct {
    double x, y, z, xu, yu, xv, yv;
    double w; // the weight
} Point;

// Bernstein polynomials and their derivatives at t.
static inline void basis(int d, double t, double *value, double *slope) {
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

static inline Point eval_net(const QiNet *n, int du, int dv, double u, double v, bool rational) {
    double wu[LINE], su[LINE], wv[LINE], sv[LINE], sum = 0.0;
    basis(du, u, wu, su);
    basis(dv, v, wv, sv);
    Lanes2 both[LINE]; // value and slope side by side
    for (int j = 0; j <= dv; j++)
        both[j] = (Lanes2){wv[j], sv[j]};
    Lanes2 px = {0.0}, py = {0.0};
    Point p = {.w = 1.0};
    for (int i = 0; i <= du; i++) {
        const double *x = n->x + i * (dv + 1), *y = n->y + i * (dv + 1), *z = n->z + i * (dv + 1);
        Lanes2 rx = {0.0}, ry = {0.0};
        double rz = 0.0;
        for (int j = 0; j <= dv; j++) {
            rx += x[j] * both[j];
            ry += y[j] * both[j];
            rz += z[j] * wv[j];
        }
        px += rx * wu[i];
        py += ry * wu[i];
        p.z += rz * wu[i];
        p.xu += rx[0] * su[i];
        p.yu += ry[0] * su[i];
        double row = 0.0;
        for (int j = 0; rational && j <= dv; j++)
            row += n->w[i * (dv + 1) + j] * wv[j];
        sum += row * wu[i];
    }
    p.x = px[0], p.xv = px[1];
    p.y = py[0], p.yv = py[1];
    if (rational)
        p.w = sum;
    return p;
}

// All divided by the weight: x, y and z are the point's, the derivatives those of (x w, y w) / w.
// Newton's step towards x w = y w = 0 is the same with or without that factor.
static Point eval_rational(const QiTarget *q, double u, double v) {
    Point p = eval_net(&q->whole, q->du, q->dv, u, v, true);
    return (Point){p.x / p.w,  p.y / p.w,  p.z / p.w,  p.xu / p.w,
                   p.yu / p.w, p.xv / p.w, p.yv / p.w, p.w};
}

static Point eval(const QiTarget *q, double u, double v) {
    if (q->rational)
        return eval_rational(q, u, v);
    if (q->du == 3 && q->dv == 3)
        return eval_net(&q->whole, 3, 3, u, v, false);
    return eval_net(&q->whole, q->du, q->dv, u, v, false);
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

// ---- Hits ----

static bool in_range(const QiTarget *q, double z) {
    double t = qi_frame_t(&q->frame, z);
    return t >= q->list.t_min && t < q->list.t_max;
}

static void add_found(QiTarget *q, Point p, double u, double v, BezierRect rect, int sign) {
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
static double off_ray(const QiTarget *q, Point p) {
    return fabs(p.x) * q->weight_x + fabs(p.y) * q->weight_y;
}

// Unequal weights let a rational patch run 1e6 times its size per unit of u: then the last bit of
// the parameters moves the point by more than rounding does. The hit's bound says so.
static bool on_ray(const QiTarget *q, Point p, double slacks) {
    double x = slacks * q->frame.slack_x, y = slacks * q->frame.slack_y;
    if (q->rational) {
        x += 0.25 * slacks * DBL_EPSILON * (fabs(p.xu) + fabs(p.xv));
        y += 0.25 * slacks * DBL_EPSILON * (fabs(p.yu) + fabs(p.yv));
    }
    return fabs(p.x) <= x && fabs(p.y) <= y;
}

// With one parameter fixed, by how much the other brings (x, y) nearest to 0, in units of rounding;
// (xp, yp) are the derivatives along that other.
static double make_up(const QiTarget *q, double x, double y, double xp, double yp) {
    x *= q->unit_x, xp *= q->unit_x, y *= q->unit_y, yp *= q->unit_y;
    double square = xp * xp + yp * yp;
    return square > 0.0 ? -(x * xp + y * yp) / square : 0.0;
}

// Newton's step from p, held inside rect. Where one parameter stops at a side the other makes up
// for it: of a ribbon the parameter across may be known to 1e-6 only, and a root that is nearer to
// the side than that would leave the one along it as wrong, which rounding does not explain.
static void step_inside(const QiTarget *q, BezierRect rect, Point p, double *u, double *v) {
    double det = p.xu * p.yv - p.xv * p.yu, u0 = *u, v0 = *v;
    double nu = u0 - (p.yv * p.x - p.xv * p.y) / det, nv = v0 - (p.xu * p.y - p.yu * p.x) / det;
    if (nu < rect.u0 || nu > rect.u1) {
        double du = clamp(nu, rect.u0, rect.u1) - u0;
        nu = u0 + du;
        nv = v0 + make_up(q, p.x + p.xu * du, p.y + p.yu * du, p.xv, p.yv);
    }
    if (nv < rect.v0 || nv > rect.v1) {
        double dv = clamp(nv, rect.v0, rect.v1) - v0;
        nv = v0 + dv;
        nu = u0 + make_up(q, p.x + p.xv * dv, p.y + p.yv * dv, p.xu, p.yu);
    }
    *u = clamp(nu, rect.u0, rect.u1);
    *v = clamp(nv, rect.v0, rect.v1);
}

// Where the tangents are nearly parallel, rounding lets Newton's step err along both, by far more
// than across them, and what bends on that way can be 1e4 times its rounding off the ray again: the
// steps would wander for ever. So once p is on the ray but for a way along the larger tangent,
// which is well known, only that parameter moves. False: that is not so.
static bool step_along(const QiTarget *q, BezierRect rect, Point p, double *u, double *v) {
    double x = p.x * q->unit_x, xu = p.xu * q->unit_x, xv = p.xv * q->unit_x;
    double y = p.y * q->unit_y, yu = p.yu * q->unit_y, yv = p.yv * q->unit_y;
    double uu = xu * xu + yu * yu, vv = xv * xv + yv * yv, most = uu >= vv ? uu : vv;
    double across = uu >= vv ? xu * y - yu * x : xv * y - yv * x, within = 0.5 * QI_ROOT_SLACKS;
    if (!(across * across <= within * within * most) || on_ray(q, p, QI_ROOT_SLACKS))
        return false;
    if (uu >= vv)
        *u = clamp(*u - (x * xu + y * yu) / uu, rect.u0, rect.u1);
    else
        *v = clamp(*v - (x * xv + y * yv) / vv, rect.v0, rect.v1);
    return true;
}

bool qi_root_sharpen(QiTarget *q, BezierRect rect, double error_u, double error_v, QiPoint *at) {
    double u = 0.5 * (rect.u0 + rect.u1), v = 0.5 * (rect.v0 + rect.v1);
    Point p = eval(q, u, v);
    // Below an ulp of 1 a polynomial moves by less than its slacks, a rational patch by any length.
    double last = q->rational ? 0.0 : DBL_EPSILON;
    // At 2/3 a step throughout, 96 steps would still take any start to 2^-53 of the piece.
    for (int n = 0; n < 96; n++) {
        double nu = u, nv = v;
        // Three steps of Newton's come as near as they can, as a rule. (Where the larger tangent's
        // parameter is at its side already the other has to make up for it.)
        if (n < 3 || !step_along(q, rect, p, &nu, &nv) || (nu == u && nv == v))
            step_inside(q, rect, p, &nu, &nv);
        if (!(fabs(nu - u) + fabs(nv - v) > last)) // no step left, or no number
            break;
        Point next = eval(q, nu, nv);
        q->newton++;
        if (on_ray(q, p, QI_ROOT_SLACKS) && off_ray(q, next) >= off_ray(q, p))
            break; // as near as rounding lets it come
        u = nu, v = nv, p = next;
        if (on_ray(q, p, 0.0625))
            break;
    }
    if (!on_ray(q, p, QI_ROOT_SLACKS)) {
        *at = (QiPoint){u, v, p.x * p.w, p.y * p.w, p.w};
        return false;
    }
    double det = p.xu * p.yv - p.xv * p.yu;
    add_found(q, p, u, v, (BezierRect){u - error_u, u + error_u, v - error_v, v + error_v},
              det > 0.0 ? 1 : -1);
    return true;
}

// A few damped least-squares steps towards the ray inside rect: they find a double or multiple root
// too, or a point of a whole curve of them. Keeps what is nearer to the ray and in range.
static Point sharpen_any(QiTarget *q, BezierRect rect, Point p, double *u, double *v) {
    double wx = q->weight_x, wy = q->weight_y;
    // Where all of a curve lies on the ray, steps would only follow the rounding along it.
    for (int n = 0; n < 8 && !on_ray(q, p, QI_ROOT_SLACKS); n++) {
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

// It starts from the nearest corner whose depth is in range; where the corners lie on both sides of
// t_min, from a point between two of them that is.
bool qi_root_settle(QiTarget *q, BezierRect r) {
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

bool qi_root_settle_at(QiTarget *q, BezierRect r, double u, double v) {
    Point p = eval(q, u, v);
    if (!in_range(q, p.z))
        return false;
    p = sharpen_any(q, r, p, &u, &v);
    add_found(q, p, u, v, r, 0);
    return true;
}

bool qi_root_in_range(const QiTarget *q, double z) { return in_range(q, z); }

// Where a form that grows from one point of parameters to another is 0 within `slack`; it is <= 0
// at `low` and >= 0 at `high`, up to rounding. By false position with the Illinois rule (an end
// that stays twice counts half), and a bisection every fourth step for what bends too much for
// that.
static Point zero_between(const QiTarget *q, QiForm f, double slack, const double low[2],
                          const double high[2], double at[2]) {
    Point p = eval(q, low[0], low[1]), top = eval(q, high[0], high[1]);
    double a = 0.0, b = 1.0, fa = f.bx * p.x + f.by * p.y, fb = f.bx * top.x + f.by * top.y;
    int side = 0;
    for (int n = 1; b - a > DBL_EPSILON; n++) {
        double mid =
            n % 4 == 0 || !(fa < 0.0 && fb > 0.0) ? 0.5 * (a + b) : a + (b - a) * (fa / (fa - fb));
        at[0] = low[0] + mid * (high[0] - low[0]);
        at[1] = low[1] + mid * (high[1] - low[1]);
        p = eval(q, at[0], at[1]);
        double here = f.bx * p.x + f.by * p.y;
        if (fabs(here) <= slack)
            break;
        if (here < 0.0) {
            fb = side < 0 ? 0.5 * fb : fb;
            a = mid, fa = here, side = -1;
        } else {
            fa = side > 0 ? 0.5 * fa : fa;
            b = mid, fb = here, side = 1;
        }
    }
    return p;
}

bool qi_root_settle_curve(QiTarget *q, BezierRect r, QiForm f, double slack) {
    double lu = f.au > 0.0 ? r.u0 : r.u1, hu = f.au > 0.0 ? r.u1 : r.u0;
    double lv = f.av > 0.0 ? r.v0 : r.v1, hv = f.av > 0.0 ? r.v1 : r.v0;
    const double least[2] = {lu, lv}, most[2] = {hu, hv}, sides[2][2] = {{hu, lv}, {lu, hv}};
    Point p = eval(q, lu, lv), top = eval(q, hu, hv);
    if (f.bx * p.x + f.by * p.y > slack || f.bx * top.x + f.by * top.y < -slack)
        return true; // nowhere
    double at[2] = {lu, lv}, ends[2][2];
    bool found = false, early[2];
    for (int k = 0; k < 2; k++) {
        Point side = eval(q, sides[k][0], sides[k][1]);
        bool beyond = f.bx * side.x + f.by * side.y >= 0.0;
        Point end =
            zero_between(q, f, slack, beyond ? least : sides[k], beyond ? sides[k] : most, ends[k]);
        early[k] = qi_frame_t(&q->frame, end.z) < q->list.t_min;
        if (in_range(q, end.z) && (!found || end.z < p.z)) {
            found = true;
            p = end, at[0] = ends[k][0], at[1] = ends[k][1];
        }
    }
    if (early[0] != early[1]) {
        double a = 0.0, b = 1.0; // b: the end that is not early
        for (int n = 0; n < 53; n++) {
            double mid = 0.5 * (a + b), from = early[0] ? mid : 1.0 - mid;
            double v = ends[0][1] + from * (ends[1][1] - ends[0][1]), spot[2];
            const double low[2] = {lu, v}, high[2] = {hu, v};
            Point next = zero_between(q, f, slack, low, high, spot);
            bool is_early = qi_frame_t(&q->frame, next.z) < q->list.t_min;
            *(is_early ? &a : &b) = mid;
            if (!is_early && in_range(q, next.z)) {
                found = true;
                p = next, at[0] = spot[0], at[1] = spot[1];
            }
        }
    }
    if (!found || !(p.x * p.x + p.y * p.y <= q->frame.tolerance * q->frame.tolerance))
        return false;
    add_found(q, p, at[0], at[1], r, 0);
    return true;
}

double qi_root_off(const QiTarget *q, double u, double v) { return off_ray(q, eval(q, u, v)); }

// A coordinate below a thousand times its own rounding keeps that size: it must not look important.
static double weight_of(double side, double slack) {
    double size = fmax(side, 1024.0 * slack);
    return size > DBL_MIN ? 1.0 / size : 1.0;
}

bool qi_target_init(QiTarget *q, const Bezier *patch, const double *weights, const Ray *ray) {
    Bezier framed;
    if (!qi_frame_init(&q->frame, weights ? FRAME_SKEW_RATIONAL : FRAME_SKEW, patch, ray, &framed))
        return false;
    q->du = patch->du;
    q->dv = patch->dv;
    q->rational = weights != NULL;
    int exponent = 0;
    double most = 0.0;
    for (int k = 0; q->rational && k < bezier_count(patch); k++)
        most = fmax(most, weights[k]);
    frexp(most, &exponent);
    for (int k = 0; k < bezier_count(patch); k++) {
        double w = q->rational ? ldexp(weights[k], -exponent) : 1.0;
        q->whole.x[k] = framed.p[k].x * w;
        q->whole.y[k] = framed.p[k].y * w;
        q->whole.z[k] = framed.p[k].z * w;
        if (q->rational)
            q->whole.w[k] = w;
    }
    q->weight_x = weight_of(q->frame.side_x, q->frame.slack_x);
    q->weight_y = weight_of(q->frame.side_y, q->frame.slack_y);
    q->unit_x = q->frame.slack_x > DBL_MIN ? 1.0 / q->frame.slack_x : 1.0;
    q->unit_y = q->frame.slack_y > DBL_MIN ? 1.0 / q->frame.slack_y : 1.0;
    return true;
}

bool qi_target_ask(QiTarget *q, const QiQuery *query, QiMode mode, QiFound *found, int capacity) {
    if (!qi_frame_ask(&q->frame, query))
        return false;
    q->list = (QiList){mode, query->t_min, query->t_max, 0, capacity, found};
    q->newton = 0;
    return true;
}
