// SPDX-License-Identifier: MIT
// From control points to cubics (facts: rendering 8): linear ones join the points, quadratic ones
// take the first point, cubic ones the first and the last for the slopes at their ends. Quadratic
// and cubic rings share nothing with the next ring; where they close, their extra points are left.
#include "shape/curve.h"

#include "shape/roots.h"

#include <math.h>
#include <string.h>

// Weights of four neighbouring points in each power of w.
typedef double Weights[4][4];

static const Weights LINEAR = {{1, 0, 0, 0}, {-1, 1, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
static const Weights QUADRATIC = {{0, 1, 0, 0}, {-0.5, 0, 0.5, 0}, {0.5, -1, 0.5, 0}, {0, 0, 0, 0}};
static const Weights CUBIC = {
    {0, 1, 0, 0}, {-0.5, 0, 0.5, 0}, {1, -2.5, 2, -0.5}, {-0.5, 1.5, -1.5, 0.5}};
static const Weights BEZIER = {{1, 0, 0, 0}, {-3, 3, 0, 0}, {3, -6, 3, 0}, {-1, 3, -3, 1}};

typedef struct {
    const Weights *weights;
    uint32_t points;      // that a piece looks at
    uint32_t first, last; // of these, where it starts and ends
    uint32_t step;        // to the next piece
    int degree;
} Kind;

// An arc: start, control, end.
static const Weights ARC = {{1, 0, 0, 0}, {-2, 2, 0, 0}, {1, -2, 1, 0}, {0, 0, 0, 0}};
static const Kind ARC_KIND = {&ARC, 3, 0, 2, 3, 2};

// ORDER outline_type
static const Kind KINDS[] = {
    {&LINEAR, 2, 0, 1, 1, 1},
    {&QUADRATIC, 3, 1, 2, 1, 2},
    {&CUBIC, 4, 1, 2, 1, 3},
    {&BEZIER, 4, 0, 3, 4, 3},
};

Vec2 curve_at(const CurvePiece *piece, double w) {
    return (Vec2){roots_value(piece->u, piece->degree, w), roots_value(piece->v, piece->degree, w)};
}

Vec2 curve_slope(const CurvePiece *piece, double w) {
    return (Vec2){w * (3.0 * piece->u[3] * w + 2.0 * piece->u[2]) + piece->u[1],
                  w * (3.0 * piece->v[3] * w + 2.0 * piece->v[2]) + piece->v[1]};
}

static void extend(CurvePiece *piece, Vec2 p) {
    piece->low = (Vec2){fmin(piece->low.u, p.u), fmin(piece->low.v, p.v)};
    piece->high = (Vec2){fmax(piece->high.u, p.u), fmax(piece->high.v, p.v)};
}

// Where the derivative of c vanishes within 0..1.
static int turns_of(const double *c, int degree, double *turns) {
    const double slope[3] = {c[1], 2.0 * c[2], 3.0 * c[3]};
    return roots_find(slope, degree - 1, 0.0, 1.0, turns);
}

static CurvePiece make_piece(const Kind *kind, const Vec2 *p) {
    CurvePiece piece = {.degree = kind->degree, .start = p[kind->first], .end = p[kind->last]};
    for (int power = 0; power < 4; power++)
        for (uint32_t i = 0; i < kind->points; i++) {
            piece.u[power] += (*kind->weights)[power][i] * p[i].u;
            piece.v[power] += (*kind->weights)[power][i] * p[i].v;
        }
    piece.low = piece.high = piece.start;
    extend(&piece, piece.end);
    double turns[4];
    for (int n = turns_of(piece.u, piece.degree, turns); n > 0; n--)
        extend(&piece, curve_at(&piece, turns[n - 1]));
    for (int n = turns_of(piece.v, piece.degree, turns); n > 0; n--)
        extend(&piece, curve_at(&piece, turns[n - 1]));
    return piece;
}

// POV-Ray's limit below which two points are one.
static bool same_point(Vec2 a, Vec2 b) {
    return fabs(a.u - b.u) < 1e-10 && fabs(a.v - b.v) < 1e-10;
}

static void add_piece(Curve *curve, CurvePiece piece) {
    curve->pieces[curve->count++] = piece;
    curve->low = (Vec2){fmin(curve->low.u, piece.low.u), fmin(curve->low.v, piece.low.v)};
    curve->high = (Vec2){fmax(curve->high.u, piece.high.u), fmax(curve->high.v, piece.high.v)};
}

Curve curve_make(OutlineType type, const Vec2 *points, uint32_t count, bool rings, Arena *arena) {
    const Kind *kind = &KINDS[type];
    Curve curve = {.pieces = ARENA_ARRAY(arena, CurvePiece, count),
                   .low = {INFINITY, INFINITY},
                   .high = {-INFINITY, -INFINITY}};
    Vec2 first = points[kind->first];
    for (uint32_t i = 0; i + kind->points <= count; i += kind->step) {
        CurvePiece piece = make_piece(kind, points + i);
        add_piece(&curve, piece);
        if (rings && type != OUTLINE_BEZIER && same_point(piece.end, first)) {
            i += kind->points - 1;
            if (i + kind->step + kind->first < count)
                first = points[i + kind->step + kind->first];
        }
    }
    return curve;
}

Curve curve_of_arcs(const double *arcs, uint32_t count, Arena *arena) {
    Curve curve = {.pieces = ARENA_ARRAY(arena, CurvePiece, count),
                   .low = {INFINITY, INFINITY},
                   .high = {-INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < count; i++) {
        Vec2 p[3];
        memcpy(p, arcs + 6 * (size_t)i, sizeof p);
        add_piece(&curve, make_piece(&ARC_KIND, p));
    }
    return curve;
}

// Does the piece cross the height v an odd number of times at or beyond u? Each stretch in which it
// rises or falls crosses when one end is above and the other is not, so that the ends of
// neighbours, being the same numbers, never count twice.
static bool crosses(const CurvePiece *piece, double u, double v) {
    if (v < piece->low.v || v > piece->high.v || u > piece->high.u)
        return false;
    if (u < piece->low.u) // wherever it crosses, that is beyond u
        return (piece->start.v > v) != (piece->end.v > v);
    double ends[6], values[6];
    int count = turns_of(piece->v, piece->degree, ends + 1) + 1;
    ends[0] = 0.0, values[0] = piece->start.v - v;
    for (int i = 1; i < count; i++)
        values[i] = curve_at(piece, ends[i]).v - v;
    ends[count] = 1.0, values[count] = piece->end.v - v;
    double c[4];
    memcpy(c, piece->v, sizeof c);
    c[0] -= v;
    bool odd = false;
    for (int i = 0; i < count; i++) {
        if ((values[i] > 0.0) == (values[i + 1] > 0.0))
            continue;
        double roots[4];
        int found = roots_find(c, piece->degree, ends[i], ends[i + 1], roots);
        double w = found > 0                               ? roots[0]
                   : fabs(values[i]) < fabs(values[i + 1]) ? ends[i]
                                                           : ends[i + 1];
        if (curve_at(piece, w).u >= u)
            odd = !odd;
    }
    return odd;
}

CurveBox curve_shadow(double u0, double v0, double u1, double v1, double slack) {
    bool finite = isfinite(u0) && isfinite(v0) && isfinite(u1) && isfinite(v1);
    if (!finite)
        return CURVE_EVERYWHERE;
    return (CurveBox){{fmin(u0, u1) - slack, fmin(v0, v1) - slack},
                      {fmax(u0, u1) + slack, fmax(v0, v1) + slack}};
}

bool curve_apart(const CurveBox *shadow, Vec2 low, Vec2 high) {
    return low.u > shadow->high.u || high.u < shadow->low.u || low.v > shadow->high.v ||
           high.v < shadow->low.v;
}

bool curve_holds(const Curve *curve, double u, double v) {
    if (!(u >= curve->low.u && u <= curve->high.u && v >= curve->low.v && v <= curve->high.v))
        return false;
    bool odd = false;
    for (uint32_t i = 0; i < curve->count; i++)
        odd ^= crosses(&curve->pieces[i], u, v);
    return odd;
}
