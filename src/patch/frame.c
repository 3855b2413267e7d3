// SPDX-License-Identifier: MIT
// The affine frame of a piece; see piece.h.
//
// Rows of the frame are the dual of the columns (Su, Sv, n) at the piece's middle, with a, b in
// [-1,1] for parameters and n of unit length. The piece is taken there as a Bézier patch, so its QI
// net and bound are those of the frame's own coordinates: z is measured across the piece, where it
// is thin, whatever the directions of the axes.
#include "patch/piece.h"

#include "base/lanes.h"
#include "patch/quasi.h"

#include <float.h>

// Tangents at a smaller angle than this (a sine) are not used to measure by.
static const double LEAST_SINE = 0x1p-10;

static double larger(double a, double b) { return a > b ? a : b; }

// Scales without over- or underflow; false for a vector that has no direction.
static bool unit(Vec3 a, Vec3 *out) {
    double most = larger(fabs(a.x), larger(fabs(a.y), fabs(a.z)));
    if (!(most > DBL_MIN) || !isfinite(most))
        return false;
    *out = vec_normalize(vec_scale(a, 1.0 / most));
    return true;
}

// Some rectangular frame: along the longer of the two, as near to the other as may be.
static void any_axes(Vec3 a, Vec3 b, Vec3 axes[3]) {
    if (!(vec_dot(a, a) >= vec_dot(b, b))) {
        Vec3 swap = a;
        a = b, b = swap;
    }
    if (!unit(a, &axes[0]))
        axes[0] = vec3(1.0, 0.0, 0.0);
    Vec3 rest = vec_madd(b, -vec_dot(b, axes[0]), axes[0]);
    if (!(vec_length(rest) > 0x1p-20 * vec_length(b)) || !unit(rest, &axes[1])) {
        Vec3 other = fabs(axes[0].x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        axes[1] = vec_normalize(vec_cross(axes[0], other));
    }
    axes[2] = vec_normalize(vec_cross(axes[0], axes[1]));
}

// The rows for columns su, sv and the normal. False if they are too near to one line.
static bool dual_axes(Vec3 su, Vec3 sv, Vec3 axes[3]) {
    double lu = vec_length(su), lv = vec_length(sv);
    // Squares and quotients must stay in range.
    if (!(lu > 1e-70 && lv > 1e-70 && lu < 1e70 && lv < 1e70))
        return false;
    Vec3 n = vec_cross(su, sv);
    double area = vec_length(n);
    if (!(area > LEAST_SINE * lu * lv))
        return false;
    n = vec_scale(n, 1.0 / area);
    axes[0] = vec_scale(vec_cross(sv, n), 1.0 / area);
    axes[1] = vec_scale(vec_cross(n, su), 1.0 / area);
    axes[2] = n;
    return true;
}

static double length1(Vec3 a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

// One coordinate of a piece: its Bézier coefficients, index i * (dv + 1) + j.
typedef struct {
    double c[BEZIER_MAX_POINTS];
} Coordinate;

typedef struct {
    double low, high;
} Span;

static inline Span span_join(Span a, double x) {
    return (Span){x < a.low ? x : a.low, x > a.high ? x : a.high};
}

// Two numbers' lanes, joined to a span.
typedef struct {
    Lanes2 low, high;
} Span2;

static inline Span2 span2_join(Span2 a, Lanes2 x) {
    return (Span2){lanes2_min(x, a.low), lanes2_max(x, a.high)};
}

static inline Span span2_both(Span2 a) {
    return (Span){a.low[0] < a.low[1] ? a.low[0] : a.low[1], larger(a.high[0], a.high[1])};
}

// tight_span() of a cubic one, a row as its two halves: the same sums, two at a time.
static Span tight_cubic(const double *c, int along) {
    Lanes2 low[4], high[4], net_low[4], net_high[4];
    for (int i = 0; i < 4; i++) {
        low[i] = net_low[i] = lanes2_load(c + 4 * i);
        high[i] = net_high[i] = lanes2_load(c + 4 * i + 2);
    }
    Lanes2 most_u = {0.0, 0.0}, most_v = most_u;
    for (int i = 1; i < 3; i++) {
        Lanes2 s = (low[i + 1] - low[i]) - (low[i] - low[i - 1]);
        Lanes2 t = (high[i + 1] - high[i]) - (high[i] - high[i - 1]);
        most_u = lanes2_max(lanes2_max(most_u, lanes2_abs(s)), lanes2_abs(t));
        net_low[i] += 0.25 * s;
        net_high[i] += 0.25 * t;
    }
    Span2 hull = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}}, net = hull;
    for (int i = 0; i < 4; i++) {
        // The outer two numbers of the row, and the inner two.
        Lanes2 outer = {low[i][0], high[i][1]}, inner = {low[i][1], high[i][0]};
        most_v = lanes2_max(most_v, lanes2_abs((high[i] - inner) - (inner - low[i])));
        Lanes2 net_outer = {net_low[i][0], net_high[i][1]};
        Lanes2 net_inner = {net_low[i][1], net_high[i][0]};
        net_inner += 0.25 * ((net_high[i] - net_inner) - (net_inner - net_low[i]));
        if (along >= 0) {
            double a = 2.0 * i / 3 - 1.0;
            Lanes2 at_outer = {-1.0, 1.0}, at_inner = {2.0 / 3 - 1.0, 4.0 / 3 - 1.0};
            if (along == 0)
                at_outer = at_inner = (Lanes2){a, a};
            outer = at_outer - outer;
            inner = at_inner - inner;
            net_outer = at_outer - net_outer;
            net_inner = at_inner - net_inner;
        }
        hull = span2_join(span2_join(hull, outer), inner);
        net = span2_join(span2_join(net, net_outer), net_inner);
    }
    Span h = span2_both(hull), n = span2_both(net);
    double z = quasi_z_infinity(3);
    double e = z * larger(most_u[0], most_u[1]) + z * larger(most_v[0], most_v[1]);
    return (Span){larger(h.low, n.low - e), -larger(-h.high, -n.high - e)};
}

// Bounds of a - c, for a rising from -1 to 1 along u (along = 0) or v (1), or of c itself (-1): the
// hull's and the QI net's, whichever is less. The net of a linear function is that function, and
// its second differences are 0.
static Span tight_span(const Coordinate *coordinate, int du, int dv, int along) {
    const double *c = coordinate->c;
    if (du == 3 && dv == 3)
        return tight_cubic(c, along);
    int row = dv + 1;
    Span hull = {INFINITY, -INFINITY}, net = hull;
    double most_u = 0.0, most_v = 0.0;
    for (int i = 0; i <= du; i++) {
        double middle[BEZIER_MAX_DEGREE + 1];
        for (int j = 0; j <= dv; j++) {
            const double *at = c + i * row + j;
            middle[j] = at[0];
            if (i > 0 && i < du) {
                double second = (at[row] - at[0]) - (at[0] - at[-row]);
                most_u = larger(most_u, fabs(second));
                middle[j] += 0.25 * second;
            }
        }
        for (int j = 0; j <= dv; j++) {
            double q = middle[j], x = c[i * row + j], linear = 0.0;
            if (j > 0 && j < dv) {
                const double *at = c + i * row + j;
                most_v = larger(most_v, fabs((at[1] - at[0]) - (at[0] - at[-1])));
                q += 0.25 * ((middle[j + 1] - middle[j]) - (middle[j] - middle[j - 1]));
            }
            if (along >= 0) {
                linear = along == 0 ? 2.0 * i / du - 1.0 : 2.0 * j / dv - 1.0;
                q = linear - q;
                x = linear - x;
            }
            net = span_join(net, q);
            hull = span_join(hull, x);
        }
    }
    double e = quasi_z_infinity(du) * most_u + quasi_z_infinity(dv) * most_v;
    return (Span){larger(hull.low, net.low - e), -larger(-hull.high, -net.high - e)};
}

// Span of the differences of neighbours along u or v.
static Span slopes(const Coordinate *c, int du, int dv, int along_u) {
    int row = dv + 1, step = along_u ? row : 1;
    Span span = {INFINITY, -INFINITY};
    for (int i = 0; i + along_u <= du; i++) {
        for (int j = 0; j + 1 - along_u <= dv; j++)
            span = span_join(span, c->c[i * row + j + step] - c->c[i * row + j]);
    }
    return span;
}

static double size_of(Span s) { return larger(fabs(s.low), fabs(s.high)); }

// Two points of the piece differ by A da + B db, A and B means of the tangents, which lie in the
// boxes of the control points' slopes. They are on one ray along q only if (A x B) . q = 0. With
// bounds N of the coordinates of A x B that is impossible when |qz| min Nz > |qx| Nx + |qy| Ny.
static void steepness(const Coordinate local[3], int du, int dv, Vec3 error, double steep[2]) {
    Span a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = slopes(&local[k], du, dv, 1);
        b[k] = slopes(&local[k], du, dv, 0);
        // Twice the points' error; and what PIECE_MARGIN adds (see bound_up in piece.c).
        double more_a = 2.0 * vec_get(error, k) + 0x1p-12 * size_of(a[k]);
        double more_b = 2.0 * vec_get(error, k) + 0x1p-12 * size_of(b[k]);
        a[k] = (Span){a[k].low - more_a, a[k].high + more_a};
        b[k] = (Span){b[k].low - more_b, b[k].high + more_b};
    }
    steep[0] = steep[1] = INFINITY;
    if (!(a[0].low > 0.0 && b[1].low > 0.0))
        return;
    double ay = size_of(a[1]), az = size_of(a[2]), bx = size_of(b[0]), bz = size_of(b[2]);
    double least = a[0].low * b[1].low - ay * bx;
    if (!(least > 0.0))
        return;
    steep[0] = (ay * bz + az * b[1].high) / least * (1.0 + 0x1p-40);
    steep[1] = (az * bx + a[0].high * bz) / least * (1.0 + 0x1p-40);
}

static float to_float(double x) { return fabs(x) < (double)FLT_MAX ? (float)x : 0.0f; }
static float up(double x) {
    return x < 0.5 * (double)FLT_MAX ? nextafterf((float)x, INFINITY) : INFINITY;
}

// S and its tangents at the middle, by the weights of its degree there.
static void middle_of(const Bezier *s, Vec3 out[3]) {
    BezierJet jet;
    if (s->du != 3 || s->dv != 3) {
        out[0] = bezier_eval1(s, 0.5, 0.5, &jet.su, &jet.sv);
        out[1] = jet.su;
        out[2] = jet.sv;
        return;
    }
    static const double value[4] = {0.125, 0.375, 0.375, 0.125};
    static const double slope[4] = {-0.75, -0.75, 0.75, 0.75};
    out[0] = out[1] = out[2] = vec3(0.0, 0.0, 0.0);
    for (int i = 0; i < 4; i++) {
        Vec3 row = vec3(0.0, 0.0, 0.0), along = row;
        for (int j = 0; j < 4; j++) {
            row = vec_madd(row, value[j], s->p[4 * i + j]);
            along = vec_madd(along, slope[j], s->p[4 * i + j]);
        }
        out[0] = vec_madd(out[0], value[i], row);
        out[1] = vec_madd(out[1], slope[i], row);
        out[2] = vec_madd(out[2], value[i], along);
    }
}

// The piece in the direction of an axis, about `from`.
static void to_local(const Bezier *part, Vec3 axis, Vec3 from, Coordinate *local) {
    for (int k = 0; k < bezier_count(part); k++)
        local->c[k] = vec_dot(axis, vec_sub(part->p[k], from));
}

// Returns whether they are regular. *wide: rounding in space: the points' own, 2^-52 of their
// distance to the patch's center (error is more than that), and a few ulps of the piece's size.
static bool axes_of(const Bezier *part, double error, Vec3 *from, Vec3 axes[3], double *wide) {
    Vec3 at[3];
    middle_of(part, at);
    bool regular = dual_axes(vec_scale(at[1], 0.5), vec_scale(at[2], 0.5), axes);
    if (!regular) {
        int last = bezier_count(part) - 1;
        any_axes(vec_sub(part->p[last], part->p[0]),
                 vec_sub(part->p[last - part->dv], part->p[part->dv]), axes);
    }
    double reach = 0.0;
    for (int k = 0; k < bezier_count(part); k++)
        reach = larger(reach, length1(vec_sub(part->p[k], at[0])));
    *from = at[0];
    *wide = 4.0 * error + 0x1p-48 * reach;
    return regular;
}

// What is left of a when the box's x (or y) is taken away: a bound, and its middle.
static double rest_of(const Bezier *part, const Coordinate *local, double slack, int along,
                      double *shift) {
    Span rest = tight_span(local, part->du, part->dv, along);
    *shift = 0.5 * (rest.low + rest.high);
    // Rounding: of the points, and of a few sums of numbers about 1.
    return (0.5 * (rest.high - rest.low) + slack) * (1.0 + 0x1p-20) + 0x1p-20 * fabs(*shift) +
           0x1p-45;
}

void frame_weigh(const Bezier *part, double error, FrameWeight *weight) {
    weight->part = part;
    weight->regular = axes_of(part, error, &weight->from, weight->axes, &weight->wide);
    Coordinate local;
    to_local(part, weight->axes[2], weight->from, &local);
    double slack = length1(weight->axes[2]) * weight->wide;
    Span span = tight_span(&local, part->du, part->dv, -1);
    double low = span.low - slack, high = span.high + slack;
    weight->half = larger(0.5 * (high - low), FRAME_LEAST);
}

double frame_unevenness(const FrameWeight *weight, double goal) {
    double most = 0.0, shift;
    for (int k = 0; k < 2; k++) {
        double slack = length1(weight->axes[k]) * weight->wide;
        // Rounding's part doubles with a cut.
        if (slack > 0.5 * goal)
            continue;
        Coordinate local;
        to_local(weight->part, weight->axes[k], weight->from, &local);
        most = larger(most, rest_of(weight->part, &local, slack, k, &shift));
    }
    return most;
}

void frame_measure(const Bezier *part, double error, PieceFrame *frame) {
    Vec3 from, axes[3];
    double wide;
    frame->regular = axes_of(part, error, &from, axes, &wide);
    Coordinate local[3];
    Vec3 slack = vec3(length1(axes[0]) * wide, length1(axes[1]) * wide, length1(axes[2]) * wide);

    double middle[3];
    for (int k = 0; k < 3; k++) {
        to_local(part, axes[k], from, &local[k]);
        Span span = tight_span(&local[k], part->du, part->dv, -1);
        double low = span.low - vec_get(slack, k), high = span.high + vec_get(slack, k);
        double half = larger(0.5 * (high - low), FRAME_LEAST);
        middle[k] = 0.5 * (low + high);
        Vec3 row = vec_scale(axes[k], 1.0 / half);
        frame->half[k] = half;
        frame->row[k][0] = row.x;
        frame->row[k][1] = row.y;
        frame->row[k][2] = row.z;
        frame->shift[k] = -vec_dot(row, from) - middle[k] / half;
    }
    for (int k = 0; k < 2; k++) {
        frame->steep[k] = frame->rest[k] = INFINITY;
        frame->rest_shift[k] = 0.0;
    }
    if (!frame->regular)
        return;
    steepness(local, part->du, part->dv, slack, frame->steep);
    for (int k = 0; k < 2; k++) {
        frame->steep[k] *= frame->half[k] / frame->half[2];
        // a = half x + middle + the rest's middle, with the rest of a less x.
        double shift;
        frame->rest[k] = rest_of(part, &local[k], vec_get(slack, k), k, &shift);
        frame->rest_shift[k] = shift + middle[k];
    }
}

Box frame_box(const Bezier *part, double error) {
    Coordinate c[3];
    double low[3], high[3];
    for (int k = 0; k < bezier_count(part); k++) {
        c[0].c[k] = part->p[k].x;
        c[1].c[k] = part->p[k].y;
        c[2].c[k] = part->p[k].z;
    }
    for (int k = 0; k < 3; k++) {
        Span span = tight_span(&c[k], part->du, part->dv, -1);
        low[k] = span.low - error;
        high[k] = span.high + error;
    }
    return (Box){{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

// Powers of a in [-1,1] about the middle, from Bernstein coefficients `step` apart.
static void cubic_powers(const double *b, int step, double *out) {
    double ends = b[0] + b[3 * step], inner = b[step] + b[2 * step];
    double ends_by = b[3 * step] - b[0], inner_by = b[2 * step] - b[step];
    out[0] = 0.125 * (ends + 3.0 * inner);
    out[step] = 0.375 * (ends_by + inner_by);
    out[2 * step] = 0.375 * (ends - inner);
    out[3 * step] = 0.125 * (ends_by - 3.0 * inner_by);
}

static void cubic_poly(const Bezier *part, const PieceFrame *frame, Piece *piece) {
    for (int k = 0; k < 3; k++) {
        double c[16], rows[16], powers[16];
        const double *r = frame->row[k];
        for (int i = 0; i < 16; i++)
            c[i] =
                (r[0] * part->p[i].x + r[1] * part->p[i].y + r[2] * part->p[i].z) + frame->shift[k];
        for (int i = 0; i < 4; i++)
            cubic_powers(c + 4 * i, 1, rows + 4 * i);
        for (int j = 0; j < 4; j++)
            cubic_powers(rows + j, 4, powers + j);
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                piece->poly[j][i][k] = to_float(powers[4 * i + j]);
    }
}

static void taylor_poly(const Bezier *part, const PieceFrame *frame, Piece *piece) {
    BezierJet jet;
    bezier_eval2(part, 0.5, 0.5, &jet);
    for (int i = 0; i < 48; i++)
        piece->poly[i / 12][i / 3 % 4][i % 3] = 0.0f;
    for (int k = 0; k < 3; k++) {
        Vec3 row = vec3(frame->row[k][0], frame->row[k][1], frame->row[k][2]);
        piece->poly[0][0][k] = to_float(vec_dot(row, jet.s) + frame->shift[k]);
        piece->poly[0][1][k] = to_float(0.5 * vec_dot(row, jet.su));
        piece->poly[1][0][k] = to_float(0.5 * vec_dot(row, jet.sv));
        piece->poly[0][2][k] = to_float(0.125 * vec_dot(row, jet.suu));
        piece->poly[1][1][k] = to_float(0.25 * vec_dot(row, jet.suv));
        piece->poly[2][0][k] = to_float(0.125 * vec_dot(row, jet.svv));
    }
}

// Rounding of the test in kernel/leaf.h. Let w = 2^-24, L = |row| as the sum of absolute values, R
// the reach, and the ray o + s q with |o|, |s| <= R. Stored rows and shifts are off by 1 w of
// themselves, o and the direction by 1 w and 2 w, sums of three products by 4 w. With |shift| <=
// L R + 1 a coordinate of the origin in the frame errs by 8 L R w + 2 (L R + 1) w <= 10 L R w + 2
// w, one of the direction by 7 L w, so over the way s by 7 L R w more; products and sums of the
// comparisons act as if the origin were off by 6 w (L R + 1). Together below 24 L R w + 8 w. The
// box is made larger by 32 L R w + 16 w beyond what makes it hold the piece, and L R 32 w on top
// leave room for the ray's own error E, since R >= 2^-19: 2^-38 L >= L E for E <= 2^-38.
void frame_to_lane(const PieceFrame *frame, const Bezier *part, const Tree *tree, Vec3 patch_center,
                   double reach, Block *block, int lane, Piece *piece) {
    if (part->du == 3 && part->dv == 3)
        cubic_poly(part, frame, piece);
    else
        taylor_poly(part, frame, piece);
    const double w = 0x1p-24;
    double lengths[3], inflate[3], least = 1.0;
    Vec3 place = vec_sub(tree->center, patch_center);
    for (int k = 0; k < 3; k++) {
        const double *row = frame->row[k];
        double length = (fabs(row[0]) + fabs(row[1]) + fabs(row[2])) / tree->scale;
        // The places of tree and patch are rounded to 2^-52 tree units: far below R w.
        double shift = frame->shift[k] + row[0] * place.x + row[1] * place.y + row[2] * place.z;
        for (int axis = 0; axis < 3; axis++)
            shift += row[axis] / tree->scale * (double)block->center[axis];
        double grow = 1.0 / ((1.0 + 64.0 * w * length * reach) * (1.0 + 16.0 * w));
        // A row that float cannot hold is 0: then nothing is cut away in this direction.
        if (!(length * grow < 1e30) || !(fabs(shift) < 1e300))
            grow = shift = 0.0;
        for (int axis = 0; axis < 3; axis++)
            block->axis[k][axis][lane] = (float)(row[axis] / tree->scale * grow);
        block->shift[k][lane] = (float)(shift * grow);
        lengths[k] = grow > 0.0 ? length * grow : 0.0;
        inflate[k] = grow;
        least = grow < least ? grow : least;
        for (int i = 0; i < 16; i++)
            piece->poly[i / 4][i % 4][k] *= (float)grow;
    }
    block->coarse |= least < 0.5 ? 1u << lane : 0u;
    bool usable = frame->regular && inflate[0] > 0.0 && inflate[1] > 0.0 && inflate[2] > 0.0;
    double sx = usable ? frame->steep[0] * inflate[2] / inflate[0] : INFINITY;
    double sy = usable ? frame->steep[1] * inflate[2] / inflate[1] : INFINITY;
    block->steep[0][lane] = up(sx * (1.0 + 0x1p-20));
    block->steep[1][lane] = up(sy * (1.0 + 0x1p-20));
    // The direction's coordinates err by 7 L w, the sum by 4 w of itself: in the factor above.
    block->steep[2][lane] =
        usable ? up(8.0 * w * (lengths[2] + sx * lengths[0] + sy * lengths[1])) : INFINITY;
    piece->rest_a = INFINITY;
    piece->rest_b = INFINITY;
    if (!usable)
        return;
    float scale[2], shift[2];
    for (int k = 0; k < 2; k++) {
        scale[k] = (float)(frame->half[k] / inflate[k]);
        shift[k] = (float)frame->rest_shift[k];
    }
    piece->scale_a = scale[0];
    piece->scale_b = scale[1];
    piece->shift_a = shift[0];
    piece->shift_b = shift[1];
    // Those are rounded to float, and so are the products with them. And a ray's x in the frame
    // errs by what the box was made larger for.
    float rest[2];
    for (int k = 0; k < 2; k++) {
        double off = 64.0 * w * lengths[k] * reach + 16.0 * w;
        rest[k] = up(frame->rest[k] + off * (double)scale[k] +
                     0x1p-20 * (double)(scale[k] + fabsf(shift[k])));
    }
    piece->rest_a = rest[0];
    piece->rest_b = rest[1];
}
