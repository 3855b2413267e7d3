// SPDX-License-Identifier: MIT
// Let P be the pole, of one side or of two that meet, and Q_k the piece's other control points less
// P: S - P is a sum of the Q_k with weights w_k >= 0. If a direction n across the ray, |n| = 1 in
// units of rounding, has n . Q_k > 0 for all k and well above rounding, then a point of the piece
// on the ray has n . (S - P) <= 2, twice the rounding by which P may miss the ray, and therefore
//     |S - P| <= sum w_k |Q_k| <= 2 max_k (|Q_k| / n . Q_k).
// If that is within the tolerance the piece has nothing that the tolerance could tell from P.
//
// A ray that passes beside a pole, however near: of a form f whose values are c at the pole u = 0
// and f_ij at the other control points,
//     f(S(u,v)) = c + u s,   s within the span of d (f_ij - c) / i,
// since u is the sum of i/d times the Bernstein polynomials. Where all s have one sign that gives u
// within a constant factor at once; the linear bounds come down to it step by step.
#include "patch/qi_pole.h"

typedef struct {
    double x, y;
} Flat;

static double cross(Flat a, Flat b) { return a.x * b.y - a.y * b.x; }

// The points of side k of a net: first index, step, number.
static void side_of(int du, int dv, int side, int *first, int *step, int *count) {
    int row = dv + 1;
    *first = side == 1 ? du * row : side == 3 ? dv : 0;
    *step = side < 2 ? 1 : row;
    *count = side < 2 ? row : du + 1;
}

unsigned qi_collapsed(const QiTarget *q) {
    unsigned sides = 0;
    for (int side = 0; !q->rational && side < 4; side++) {
        int first, step, count, k = 1;
        side_of(q->du, q->dv, side, &first, &step, &count);
        const double *x = q->whole.x + first, *y = q->whole.y + first;
        while (k < count && fabs(x[k * step] - x[0]) <= 2.0 * q->frame.slack_x &&
               fabs(y[k * step] - y[0]) <= 2.0 * q->frame.slack_y)
            k++;
        if (k == count)
            sides |= 1u << side;
    }
    return sides;
}

static unsigned touched_by(BezierRect rect) {
    return (unsigned)(rect.u0 == 0.0) | (unsigned)(rect.u1 == 1.0) << 1 |
           (unsigned)(rect.v0 == 0.0) << 2 | (unsigned)(rect.v1 == 1.0) << 3;
}

// The distance from the side at which c + distance s can be 0, s in a span; r: rounding.
static bool clip_distance(double c, Span s, double r, bool from_high, Span *p) {
    if (s.high < 0.0) {
        c = -c;
        s = (Span){-s.high, -s.low};
    }
    if (!(s.low > 0.0))
        return true;
    if (r < c)
        return false;
    double least = (-c - r) / s.high * (1.0 - 0x1p-40), most = (r - c) / s.low * (1.0 + 0x1p-40);
    if (from_high) {
        p->low = larger(p->low, 1.0 - most - DBL_EPSILON);
        p->high = p->high < 1.0 - least + DBL_EPSILON ? p->high : 1.0 - least + DBL_EPSILON;
    } else {
        p->low = larger(p->low, least);
        p->high = p->high < most ? p->high : most;
    }
    return p->low <= p->high;
}

bool qi_pole_clip(const QiTarget *q, unsigned collapsed, const QiNet *net, BezierRect rect,
                  QiForm form, double slack, Span *u, Span *v) {
    unsigned sides = collapsed & touched_by(rect);
    int du = q->du, dv = q->dv, row = dv + 1;
    for (int side = 0; side < 4; side++) {
        if (!(sides >> side & 1))
            continue;
        int pole = side == 1 ? du * row : side == 3 ? dv : 0, d = side < 2 ? du : dv;
        double c = form.bx * net->x[pole] + form.by * net->y[pole];
        Span s = {INFINITY, -INFINITY};
        for (int i = 0; i <= du; i++) {
            for (int j = 0; j <= dv; j++) {
                int away = side == 0 ? i : side == 1 ? du - i : side == 2 ? j : dv - j;
                int k = i * row + j;
                if (away == 0)
                    continue;
                double rise = (form.bx * net->x[k] + form.by * net->y[k] - c) * d / away;
                s.low = rise < s.low ? rise : s.low;
                s.high = larger(s.high, rise);
            }
        }
        // 1 slack for S, 4 for points of the side that differ from c, 2 for s.
        if (!clip_distance(c, s, 8.0 * slack, side & 1, side < 2 ? u : v))
            return false;
    }
    return true;
}

unsigned qi_poles(const QiTarget *q) {
    unsigned poles = 0;
    for (int side = 0; !q->rational && side < 4; side++) {
        int first, step, count, k = 0;
        side_of(q->du, q->dv, side, &first, &step, &count);
        const double *x = q->whole.x + first, *y = q->whole.y + first, *z = q->whole.z + first;
        while (k < count && fabs(x[k * step]) <= q->frame.slack_x &&
               fabs(y[k * step]) <= q->frame.slack_y &&
               fabs(z[k * step] - z[0]) <= 2.0 * q->frame.slack_z)
            k++;
        if (k == count)
            poles |= 1u << side;
    }
    return poles;
}

// The middle direction of the points that are not on the side; false if they are not all to one
// side of any line through the pole.
static bool middle_of(const Flat *p, int count, Flat *n) {
    Flat low = p[0], high = p[0];
    for (int k = 1; k < count; k++) {
        double from_low = cross(low, p[k]), from_high = cross(high, p[k]);
        if (from_low >= 0.0 && from_high <= 0.0)
            continue;
        if (from_low > 0.0)
            high = p[k];
        else if (from_high < 0.0)
            low = p[k];
        else
            return false;
    }
    double a = hypot(low.x, low.y), b = hypot(high.x, high.y);
    *n = (Flat){low.x / a + high.x / b, low.y / a + high.y / b};
    double length = hypot(n->x, n->y);
    *n = (Flat){n->x / length, n->y / length};
    return isfinite(n->x + n->y);
}

// Does the control point (i, j) lie on one of the sides?
static bool on_sides(const QiTarget *q, unsigned sides, int i, int j) {
    unsigned on = (unsigned)(i == 0) | (unsigned)(i == q->du) << 1 | (unsigned)(j == 0) << 2 |
                  (unsigned)(j == q->dv) << 3;
    return (on & sides) != 0;
}

// Is all that is on the ray within the tolerance of the pole that these sides are?
static bool alone(const QiTarget *q, const QiNet *net, unsigned sides, int pole) {
    Flat p[BEZIER_MAX_POINTS], n;
    double far[BEZIER_MAX_POINTS]; // |Q_k|, in space
    int row = q->dv + 1, count = 0;
    for (int k = 0; k < (q->du + 1) * row; k++) {
        double x = net->x[k] - net->x[pole], y = net->y[k] - net->y[pole];
        double z = net->z[k] - net->z[pole];
        if (on_sides(q, sides, k / row, k % row)) {
            if (!(fabs(z) <= 4.0 * q->frame.slack_z)) // two poles, one behind the other
                return false;
            continue;
        }
        far[count] = fabs(x) + fabs(y) + q->frame.stretch * fabs(z);
        p[count++] = (Flat){x * q->unit_x, y * q->unit_y};
    }
    if (count == 0 || !middle_of(p, count, &n))
        return false;
    for (int k = 0; k < count; k++) {
        // Q_k errs by 2 in each coordinate, less than 3 along n.
        double along = n.x * p[k].x + n.y * p[k].y - 3.0;
        if (!(along * q->frame.tolerance >= 2.0 * far[k] && along > 0.0))
            return false;
    }
    return true;
}

bool qi_pole_settle(QiTarget *q, unsigned poles, const QiNet *net, BezierRect rect) {
    unsigned sides = poles & touched_by(rect);
    if (!sides)
        return false;
    // A point of one of the sides, and its index in the net.
    double u = sides & 1 ? 0.0 : sides & 2 ? 1.0 : 0.5 * (rect.u0 + rect.u1);
    double v = sides & 4 ? 0.0 : sides & 8 ? 1.0 : 0.5 * (rect.v0 + rect.v1);
    int pole = (sides & 2 ? q->du * (q->dv + 1) : 0) + (sides & 8 ? q->dv : 0);
    if (!alone(q, net, sides, pole))
        return false;
    // Where two sides are that point each piece at either finds it, and no rectangle but the corner
    // holds points of both sides alone: one that holds more would take in the crossings beside it.
    const BezierRect nowhere = {2.0, 2.0, 2.0, 2.0};
    double slack = 4.0 * q->frame.slack_z, low = net->z[pole] - slack, high = net->z[pole] + slack;
    if (qi_list_has(&q->list, &q->frame, low, high, q->frame.tolerance, nowhere))
        return true;
    BezierRect at = {sides & 3 ? u : rect.u0, sides & 3 ? u : rect.u1, sides & 12 ? v : rect.v0,
                     sides & 12 ? v : rect.v1};
    qi_root_settle_at(q, at, u, v);
    return true;
}
