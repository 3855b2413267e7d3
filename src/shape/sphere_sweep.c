// SPDX-License-Identifier: MIT
// Sphere sweeps: the union of the balls with centre c(u) and radius r(u). While the ray meets the
// ball of u, it is in it from t_in(u) to t_out(u); over a stretch of u without a gap these add up
// to one interval of the ray, from the least t_in to the largest t_out. So per piece: the stretches
// (roots of the discriminant), the extremes (roots of what the two conditions f = 0, df/du = 0
// leave when t is eliminated), and at last the union of all intervals.
#include "shape/roots.h"
#include "shape/solid.h"

#include <stdlib.h>

typedef struct {
    Vec3 c[4];
    double r[4];
    int degree;
    Box box;
} Piece;

typedef struct {
    Piece *pieces;
    uint32_t count;
} Sweep;

enum { DEGREE = 3, MAX_ENDS = 256 };

static void add_product(double *out, const double *p, int n, const double *q, int m, double k) {
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= m; j++)
            out[i + j] += k * p[i] * q[j];
}

static void derive(const double *p, int n, double *out) {
    for (int i = 1; i <= n; i++)
        out[i - 1] = i * p[i];
}

// f = t^2 + 2 b(u) t + c(u): b of degree n, c of 2n.
typedef struct {
    double b[DEGREE + 1], c[2 * DEGREE + 1];
    int n;
} Family;

static Family family(const Piece *piece, const Ray *ray) {
    Family f = {.n = piece->degree};
    double x[4], y[4], z[4];
    for (int i = 0; i <= f.n; i++) {
        Vec3 off = vec_neg(piece->c[i]);
        if (i == 0)
            off = vec_add(off, ray->org);
        f.b[i] = vec_dot(off, ray->dir);
        x[i] = off.x, y[i] = off.y, z[i] = off.z;
    }
    add_product(f.c, x, f.n, x, f.n, 1.0);
    add_product(f.c, y, f.n, y, f.n, 1.0);
    add_product(f.c, z, f.n, z, f.n, 1.0);
    add_product(f.c, piece->r, f.n, piece->r, f.n, -1.0);
    return f;
}

// Where t_in or t_out turns: c'^2 - 4 b b' c' + 4 c b'^2 = 0, and at both ends.
static int extremes(const Family *f, double u[13]) {
    int n = f->n;
    double db[DEGREE], dc[2 * DEGREE], bb[2 * DEGREE], db2[2 * DEGREE - 1];
    double g[4 * DEGREE - 1] = {0};
    derive(f->b, n, db);
    derive(f->c, 2 * n, dc);
    for (int i = 0; i < 2 * n; i++)
        bb[i] = 0.0;
    for (int i = 0; i < 2 * n - 1; i++)
        db2[i] = 0.0;
    add_product(bb, f->b, n, db, n - 1, 1.0);
    add_product(db2, db, n - 1, db, n - 1, 1.0);
    add_product(g, dc, 2 * n - 1, dc, 2 * n - 1, 1.0);
    add_product(g, bb, 2 * n - 1, dc, 2 * n - 1, -4.0);
    add_product(g, db2, 2 * n - 2, f->c, 2 * n, 4.0);
    int count = roots_find(g, 4 * n - 2, 0.0, 1.0, u);
    u[count++] = 0.0;
    u[count++] = 1.0;
    return count;
}

typedef struct {
    double t, u;
    uint32_t piece;
    bool enters;
} End;

typedef struct {
    End ends[MAX_ENDS];
    int count;
} Ends;

// Looks at the ball of u: does it reach farther than what is known?
static void reach(const Family *f, double u, End *in, End *out) {
    double b = roots_value(f->b, f->n, u);
    double d = fmax(b * b - roots_value(f->c, 2 * f->n, u), 0.0);
    double root = sqrt(d);
    if (-b - root < in->t)
        in->t = -b - root, in->u = u;
    if (-b + root > out->t)
        out->t = -b + root, out->u = u;
}

static void piece_intervals(const Piece *piece, uint32_t index, const Ray *ray, Ends *ends) {
    Family f = family(piece, ray);
    double gap[2 * DEGREE + 1] = {0}, borders[2 * DEGREE + 3], turns[13];
    add_product(gap, f.b, f.n, f.b, f.n, 1.0);
    for (int i = 0; i <= 2 * f.n; i++)
        gap[i] -= f.c[i];
    borders[0] = 0.0;
    int count = 1 + roots_find(gap, 2 * f.n, 0.0, 1.0, borders + 1);
    borders[count] = 1.0;
    int turn_count = -1;
    for (int i = 0; i < count; i++) {
        double low = borders[i], high = borders[i + 1];
        if (!(roots_value(gap, 2 * f.n, 0.5 * (low + high)) > 0.0) || ends->count + 2 > MAX_ENDS)
            continue;
        if (turn_count < 0)
            turn_count = extremes(&f, turns);
        End in = {INFINITY, 0, index, true}, out = {-INFINITY, 0, index, false};
        reach(&f, low, &in, &out);
        reach(&f, high, &in, &out);
        for (int k = 0; k < turn_count; k++)
            if (turns[k] >= low && turns[k] <= high)
                reach(&f, turns[k], &in, &out);
        ends->ends[ends->count++] = in;
        ends->ends[ends->count++] = out;
    }
}

static bool meets_box(const Box *box, const Ray *ray) {
    double low = -INFINITY, high = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = vec_get(ray->org, axis), d = vec_get(ray->dir, axis);
        double near = vec_get(box->low, axis), far = vec_get(box->high, axis);
        if (d == 0.0) {
            if (o < near || o > far)
                return false;
            continue;
        }
        double a = (near - o) / d, b = (far - o) / d;
        low = fmax(low, fmin(a, b));
        high = fmin(high, fmax(a, b));
    }
    return low <= high && high > 0.0;
}

static int by_depth(const void *a, const void *b) {
    const End *x = a, *y = b;
    if (x->t != y->t)
        return x->t < y->t ? -1 : 1;
    return (int)y->enters - (int)x->enters; // no seam where one begins as another ends
}

static void hits(const void *data, const Ray *ray, HitSink *sink) {
    const Sweep *sweep = data;
    Ends ends = {.count = 0};
    for (uint32_t i = 0; i < sweep->count; i++)
        if (meets_box(&sweep->pieces[i].box, ray))
            piece_intervals(&sweep->pieces[i], i, ray, &ends);
    qsort(ends.ends, (size_t)ends.count, sizeof *ends.ends, by_depth);
    int depth = 0;
    for (int i = 0; i < ends.count; i++) {
        const End *end = &ends.ends[i];
        depth += end->enters ? 1 : -1;
        if (depth == (end->enters ? 1 : 0))
            sink_put(sink, end->t, (int)end->piece, vec3(end->u, 0, 0));
    }
}

static Vec3 center_at(const Piece *piece, double u) {
    Vec3 c = piece->c[piece->degree];
    for (int i = piece->degree - 1; i >= 0; i--)
        c = vec_madd(piece->c[i], u, c);
    return c;
}

static Vec3 normal(const void *data, Vec3 p, const ShapeHit *hit) {
    const Sweep *sweep = data;
    const Piece *piece = &sweep->pieces[hit->part];
    return vec_sub(p, center_at(piece, hit->keep.x));
}

static bool inside(const void *data, Vec3 p) {
    const Sweep *sweep = data;
    for (uint32_t i = 0; i < sweep->count; i++) {
        const Piece *piece = &sweep->pieces[i];
        const Box *b = &piece->box;
        if (p.x < b->low.x || p.x > b->high.x || p.y < b->low.y || p.y > b->high.y ||
            p.z < b->low.z || p.z > b->high.z)
            continue;
        // |p - c(u)|^2 - r(u)^2 is f at t = 0 of any ray from p.
        const Ray ray = {p, {1, 0, 0}};
        Family f = family(piece, &ray);
        double roots[2 * DEGREE + 1];
        if (f.c[0] < 0.0 || roots_find(f.c, 2 * f.n, 0.0, 1.0, roots) > 0)
            return true;
    }
    return false;
}

// ---- preparing ------------------------------------------------------------------------------

static const double CATMULL_ROM[4][4] = {
    {0, 1, 0, 0}, {-0.5, 0, 0.5, 0}, {1, -2.5, 2, -0.5}, {-0.5, 1.5, -1.5, 0.5}};
static const double B_SPLINE[4][4] = {{1.0 / 6, 4.0 / 6, 1.0 / 6, 0},
                                      {-0.5, 0, 0.5, 0},
                                      {0.5, -1, 0.5, 0},
                                      {-1.0 / 6, 0.5, -0.5, 1.0 / 6}};

// The balls of the curve's Bezier points hold all balls between.
static Box box_of(const Piece *piece) {
    Box box = box_empty();
    const Vec3 *c = piece->c;
    const double *r = piece->r;
    Vec3 p[4] = {c[0], vec_madd(c[0], 1.0 / 3, c[1]), {0, 0, 0}, {0, 0, 0}};
    double q[4] = {r[0], r[0] + r[1] / 3, 0, 0};
    p[2] = vec_add(vec_madd(c[0], 2.0 / 3, c[1]), vec_scale(c[2], 1.0 / 3));
    q[2] = r[0] + 2.0 * r[1] / 3 + r[2] / 3;
    p[3] = vec_add(vec_add(c[0], c[1]), vec_add(c[2], c[3]));
    q[3] = r[0] + r[1] + r[2] + r[3];
    for (int i = 0; i < 4; i++) {
        double k = fabs(q[i]);
        box = box_extend(box, vec_sub(p[i], vec3(k, k, k)));
        box = box_extend(box, vec_add(p[i], vec3(k, k, k)));
    }
    return box;
}

static Piece make_piece(OutlineType curve, const SweepSphere *s) {
    Piece piece = {.degree = 3};
    if (curve == OUTLINE_LINEAR) {
        piece.degree = 1;
        piece.c[0] = s[0].center, piece.r[0] = s[0].radius;
        piece.c[1] = vec_sub(s[1].center, s[0].center);
        piece.r[1] = s[1].radius - s[0].radius;
    } else {
        const double(*weights)[4] = curve == OUTLINE_CUBIC ? CATMULL_ROM : B_SPLINE;
        for (int power = 0; power < 4; power++)
            for (int i = 0; i < 4; i++) {
                piece.c[power] = vec_madd(piece.c[power], weights[power][i], s[i].center);
                piece.r[power] += weights[power][i] * s[i].radius;
            }
    }
    piece.box = box_of(&piece);
    return piece;
}

// The tolerance of a sweep stands in for the least depth; its own copy of the table holds it.
typedef struct {
    Sweep sweep;
    SolidOps ops;
} Prepared;

SolidData sphere_sweep_prepare(const SphereSweepShape *shape, Arena *arena) {
    Prepared *prepared = ARENA_NEW(arena, Prepared);
    uint32_t look = shape->outline == OUTLINE_LINEAR ? 2 : 4;
    Sweep *sweep = &prepared->sweep;
    sweep->count = shape->count - look + 1;
    sweep->pieces = ARENA_ARRAY(arena, Piece, sweep->count);
    Box box = box_empty();
    for (uint32_t i = 0; i < sweep->count; i++) {
        sweep->pieces[i] = make_piece(shape->outline, shape->spheres + i);
        box = box_union(box, sweep->pieces[i].box);
    }
    prepared->ops = (SolidOps){.near = shape->tolerance,
                               .far = INFINITY,
                               .hits = hits,
                               .normal = normal,
                               .inside = inside};
    return (SolidData){&prepared->ops, sweep, box};
}
