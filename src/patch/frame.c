// SPDX-License-Identifier: MIT
// The affine frame of a piece; see piece.h.
//
// Rows of the frame are the dual of the columns (Su, Sv, n) at the piece's middle, with a, b in
// [-1,1] for parameters and n of unit length. The piece is taken there as a Bézier patch, so its QI
// net and bound are those of the frame's own coordinates: z is measured across the piece, where it
// is thin, whatever the directions of the axes.
#include "patch/piece.h"

#include "patch/quasi.h"

#include <float.h>
#include <string.h>

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

// Bounds of each coordinate of a Bézier patch: the hull's and the QI net's, whichever is less.
static Box tight_box(const Bezier *s) {
    Bezier net;
    quasi_net(s, &net);
    Vec3 e = quasi_deviation_axes(s);
    Box hull = bezier_bounds(s), thick = bezier_bounds(&net);
    return (Box){vec_max(hull.low, vec_sub(thick.low, e)),
                 vec_min(hull.high, vec_add(thick.high, e))};
}

// Box of the differences of neighbours along u or v.
static Box slopes(const Bezier *s, int along_u) {
    int row = s->dv + 1, step = along_u ? row : 1;
    Box box = box_empty();
    for (int i = 0; i + along_u <= s->du; i++) {
        for (int j = 0; j + 1 - along_u <= s->dv; j++)
            box = box_extend(box, vec_sub(s->p[i * row + j + step], s->p[i * row + j]));
    }
    return box;
}

static double size_of(double low, double high) { return larger(fabs(low), fabs(high)); }

// Two points of the piece differ by A da + B db, A and B means of the tangents, which lie in the
// boxes of the control points' slopes. They are on one ray along q only if (A x B) . q = 0. With
// bounds N of the coordinates of A x B that is impossible when |qz| min Nz > |qx| Nx + |qy| Ny.
static void steepness(const Bezier *local, Vec3 error, double steep[2]) {
    Box a = slopes(local, 1), b = slopes(local, 0);
    // Twice the points' error; and what PIECE_MARGIN adds (see bound_up in piece.c).
    for (int k = 0; k < 2; k++) {
        Box *box = k ? &a : &b;
        Vec3 most = vec_max(vec_neg(box->low), box->high);
        Vec3 more = vec_madd(vec_scale(error, 2.0), 0x1p-12,
                             vec3(fabs(most.x), fabs(most.y), fabs(most.z)));
        box->low = vec_sub(box->low, more);
        box->high = vec_add(box->high, more);
    }
    steep[0] = steep[1] = INFINITY;
    if (!(a.low.x > 0.0 && b.low.y > 0.0))
        return;
    double ay = size_of(a.low.y, a.high.y), az = size_of(a.low.z, a.high.z);
    double bx = size_of(b.low.x, b.high.x), bz = size_of(b.low.z, b.high.z);
    double least = a.low.x * b.low.y - ay * bx;
    if (!(least > 0.0))
        return;
    steep[0] = (ay * bz + az * b.high.y) / least * (1.0 + 0x1p-40);
    steep[1] = (az * bx + a.high.x * bz) / least * (1.0 + 0x1p-40);
}

static float to_float(double x) { return fabs(x) < (double)FLT_MAX ? (float)x : 0.0f; }
static float up(double x) {
    return x < 0.5 * (double)FLT_MAX ? nextafterf((float)x, INFINITY) : INFINITY;
}

// The rest of a - x and b - y: a Bézier patch again.
static void parameter_rest(const Bezier *local, double error, int axis, double *shift,
                           float *rest) {
    Bezier s;
    bezier_copy(&s, local);
    int row = s.dv + 1;
    for (int i = 0; i <= s.du; i++) {
        for (int j = 0; j <= s.dv; j++) {
            double t = axis == 0 ? 2.0 * i / s.du - 1.0 : 2.0 * j / s.dv - 1.0;
            s.p[i * row + j].x = t - vec_get(local->p[i * row + j], axis);
        }
    }
    Box box = tight_box(&s);
    *shift = 0.5 * (box.low.x + box.high.x);
    // Rounding: of the points and of a few sums of numbers about 1.
    *rest = up((0.5 * (box.high.x - box.low.x) + error) * (1.0 + 0x1p-20) + 0x1p-20 * fabs(*shift) +
               0x1p-45);
}

static void set_poly(Piece *piece, int i, int j, const PieceFrame *frame, Vec3 c) {
    for (int k = 0; k < 3; k++)
        piece->poly[j][i][k] = to_float(vec_get(c, k) / frame->half[k]);
}

// Powers of a in [-1,1] about the middle, from Bernstein coefficients.
static void cubic_powers(const Vec3 b[4], Vec3 out[4]) {
    Vec3 ends = vec_add(b[0], b[3]), inner = vec_add(b[1], b[2]);
    Vec3 ends_by = vec_sub(b[3], b[0]), inner_by = vec_sub(b[2], b[1]);
    out[0] = vec_scale(vec_madd(ends, 3.0, inner), 0.125);
    out[1] = vec_scale(vec_add(ends_by, inner_by), 0.375);
    out[2] = vec_scale(vec_sub(ends, inner), 0.375);
    out[3] = vec_scale(vec_madd(ends_by, -3.0, inner_by), 0.125);
}

static void cubic_poly(const Bezier *local, const PieceFrame *frame, Piece *piece) {
    Vec3 rows[4][4]; // [row of points][power of b]
    for (int i = 0; i < 4; i++)
        cubic_powers(&local->p[4 * i], rows[i]);
    for (int j = 0; j < 4; j++) {
        Vec3 column[4] = {rows[0][j], rows[1][j], rows[2][j], rows[3][j]}, powers[4];
        cubic_powers(column, powers);
        if (j == 0)
            powers[0] = vec_sub(powers[0], frame->middle);
        for (int i = 0; i < 4; i++)
            set_poly(piece, i, j, frame, powers[i]);
    }
}

static void taylor_poly(const Bezier *local, const PieceFrame *frame, Piece *piece) {
    BezierJet jet;
    bezier_eval2(local, 0.5, 0.5, &jet);
    memset(piece->poly, 0, sizeof piece->poly);
    set_poly(piece, 0, 0, frame, vec_sub(jet.s, frame->middle));
    set_poly(piece, 1, 0, frame, vec_scale(jet.su, 0.5));
    set_poly(piece, 0, 1, frame, vec_scale(jet.sv, 0.5));
    set_poly(piece, 2, 0, frame, vec_scale(jet.suu, 0.125));
    set_poly(piece, 1, 1, frame, vec_scale(jet.suv, 0.25));
    set_poly(piece, 0, 2, frame, vec_scale(jet.svv, 0.125));
}

void frame_make(const Bezier *part, double error, PieceFrame *frame, Piece *piece) {
    BezierJet jet;
    bezier_eval2(part, 0.5, 0.5, &jet);
    Vec3 axes[3];
    frame->regular = dual_axes(vec_scale(jet.su, 0.5), vec_scale(jet.sv, 0.5), axes);
    if (!frame->regular) {
        int last = bezier_count(part) - 1;
        any_axes(vec_sub(part->p[last], part->p[0]),
                 vec_sub(part->p[last - part->dv], part->p[part->dv]), axes);
    }

    // The piece in the frame, about its middle. Rounding: the points' own, 2^-52 of their distance
    // to the patch's center (error is more than that), and a few ulps of the piece's size.
    Bezier local = {.du = part->du, .dv = part->dv};
    double reach = 0.0;
    for (int k = 0; k < bezier_count(part); k++) {
        Vec3 d = vec_sub(part->p[k], jet.s);
        reach = larger(reach, length1(d));
        local.p[k] = vec3(vec_dot(axes[0], d), vec_dot(axes[1], d), vec_dot(axes[2], d));
    }
    double wide = 4.0 * error + 0x1p-48 * reach;
    Vec3 slack = vec3(length1(axes[0]) * wide, length1(axes[1]) * wide, length1(axes[2]) * wide);
    Box box = tight_box(&local);
    box.low = vec_sub(box.low, slack);
    box.high = vec_add(box.high, slack);

    frame->middle = vec_scale(vec_add(box.low, box.high), 0.5);
    for (int k = 0; k < 3; k++) {
        double low = vec_get(box.low, k), high = vec_get(box.high, k);
        double half = larger(0.5 * (high - low), FRAME_LEAST), middle = 0.5 * (low + high);
        Vec3 row = vec_scale(axes[k], 1.0 / half);
        frame->half[k] = half;
        frame->row[k][0] = row.x;
        frame->row[k][1] = row.y;
        frame->row[k][2] = row.z;
        frame->shift[k] = -vec_dot(row, jet.s) - middle / half;
    }
    frame->steep[0] = frame->steep[1] = INFINITY;
    piece->rest_a = piece->rest_b = INFINITY;
    if (!frame->regular)
        return;
    steepness(&local, slack, frame->steep);
    frame->steep[0] *= frame->half[0] / frame->half[2];
    frame->steep[1] *= frame->half[1] / frame->half[2];
    double shift_a, shift_b;
    parameter_rest(&local, slack.x, 0, &shift_a, &piece->rest_a);
    parameter_rest(&local, slack.y, 1, &shift_b, &piece->rest_b);
    // a = half x + middle + the rest's middle.
    piece->shift_a = (float)(shift_a + 0.5 * (box.low.x + box.high.x));
    piece->shift_b = (float)(shift_b + 0.5 * (box.low.y + box.high.y));
    if (part->du == 3 && part->dv == 3)
        cubic_poly(&local, frame, piece);
    else
        taylor_poly(&local, frame, piece);
}

// Rounding of the test in kernel/leaf.h. Let w = 2^-24, L = |row| as the sum of absolute values, R
// the reach, and the ray o + s q with |o|, |s| <= R. Stored rows and shifts are off by 1 w of
// themselves, o and the direction by 1 w and 2 w, sums of three products by 4 w. With |shift| <=
// L R + 1 a coordinate of the origin in the frame errs by 8 L R w + 2 (L R + 1) w <= 10 L R w + 2
// w, one of the direction by 7 L w, so over the way s by 7 L R w more; products and sums of the
// comparisons act as if the origin were off by 6 w (L R + 1). Together below 24 L R w + 8 w. The
// box is made larger by 32 L R w + 16 w beyond what makes it hold the piece, and L R 32 w on top
// leave room for the ray's own error E, since R >= 2^-19: 2^-38 L >= L E for E <= 2^-38.
void frame_to_lane(const PieceFrame *frame, const Tree *tree, Vec3 patch_center, double reach,
                   Block *block, int lane, Piece *piece) {
    const double w = 0x1p-24;
    double lengths[3], inflate[3];
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
        for (int i = 0; i < 16; i++)
            piece->poly[i / 4][i % 4][k] *= (float)grow;
    }
    bool usable = frame->regular && inflate[0] > 0.0 && inflate[1] > 0.0 && inflate[2] > 0.0;
    double sx = usable ? frame->steep[0] * inflate[2] / inflate[0] : INFINITY;
    double sy = usable ? frame->steep[1] * inflate[2] / inflate[1] : INFINITY;
    block->steep[0][lane] = up(sx * (1.0 + 0x1p-20));
    block->steep[1][lane] = up(sy * (1.0 + 0x1p-20));
    // The direction's coordinates err by 7 L w, the sum by 4 w of itself: in the factor above.
    block->steep[2][lane] =
        usable ? up(8.0 * w * (lengths[2] + sx * lengths[0] + sy * lengths[1])) : INFINITY;
    if (!usable) {
        piece->rest_a = piece->rest_b = INFINITY;
        return;
    }
    piece->scale_a = (float)(frame->half[0] / inflate[0]);
    piece->scale_b = (float)(frame->half[1] / inflate[1]);
    // Those two, the shifts and the products with them are rounded to float.
    piece->rest_a =
        up((double)piece->rest_a + 0x1p-20 * (double)(piece->scale_a + fabsf(piece->shift_a)));
    piece->rest_b =
        up((double)piece->rest_b + 0x1p-20 * (double)(piece->scale_b + fabsf(piece->shift_b)));
}
