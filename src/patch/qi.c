// SPDX-License-Identifier: MIT
// The published algorithm: Fougerolle, Lanquetin, Neveu, Lauthelie, "A Geometric Algorithm for
// Ray/Bézier Surfaces Intersection using Quasi-interpolating Control Net", section 4.
//
// A patch and a ray come in, the hits go out. Until no piece is left:
//   1. take the nearest piece; build its net Q and the bound eps of |S - Q|;
//   2. if eps is above the tolerance, keep the squares of Q whose projection along the ray (the
//      convex hull of four points) comes within eps of the ray, and cut the piece down to them;
//   3. else meet each such square with the ray: a bilinear square in the plane across the ray.
// Step 2 loses nothing: where S(u,v) is on the ray, Q(u,v) is within eps of it, at the same (u,v).
//
// Two rules go beyond the paper, both for collapsed edges, where every slice of one parameter
// contains the pole and plain cutting grows as 3^level:
//   - a piece more than SLENDER times longer than wide in space is cut across its length only;
//   - a piece that as a whole is within the tolerance of one point is one hit.
// Each level cuts the longer of the two sizes of a piece at least in half, so levels are bounded.
#include "patch/qi.h"

#include "patch/qi_frame.h"
#include "patch/quasi.h"

#include <assert.h>
#include <stddef.h>

// A piece starts with sizes of at most 2 * 16 * diameter and is done below the least tolerance of
// 2^-45 of it or more (see qi_frame.c: 8 roundings of 12 half ulps), both sizes together with
// 2 eps <= 4 * 3.75 * size: 45 + 5 + 5 halvings of the longer size, and one for each slender turn.
enum { LEVELS = 64, SQUARES = BEZIER_MAX_DEGREE * BEZIER_MAX_DEGREE };
static const double SLENDER = 3.0;

// Some squares of a net: columns u0..u1 - 1, rows v0..v1 - 1.
typedef struct {
    uint8_t u0, u1, v0, v1;
} Block;

// A piece that was cut, and what is left of it, nearest block first.
typedef struct {
    BezierRect rect;
    int count, next;
    Block blocks[SQUARES];
} Level;

typedef struct {
    QiFrame frame;
    Bezier patch; // in the ray's frame
    QiList list;
    uint64_t steps, work_limit;
} Search;

// A piece with its net.
typedef struct {
    BezierRect rect;
    Bezier net;
    double eps, disc; // |S - Q|; radius of the disc that stands for the ray
    double size_u, size_v;
} Piece;

static double at_break(double low, double high, int i, int d) {
    return i == 0 ? low : i == d ? high : low + (high - low) * ((double)i / d);
}

static BezierRect block_rect(const Bezier *net, BezierRect r, Block b) {
    return (BezierRect){at_break(r.u0, r.u1, b.u0, net->du), at_break(r.u0, r.u1, b.u1, net->du),
                        at_break(r.v0, r.v1, b.v0, net->dv), at_break(r.v0, r.v1, b.v1, net->dv)};
}

// Bounds of the length of a piece along u and along v: degree times the longest difference.
static void measure(const Bezier *s, double *size_u, double *size_v) {
    double u = 0.0, v = 0.0;
    for (int i = 0; i <= s->du; i++) {
        for (int j = 0; j <= s->dv; j++) {
            Vec3 p = bezier_at(s, i, j);
            if (i < s->du)
                u = fmax(u, vec_length(vec_sub(bezier_at(s, i + 1, j), p)));
            if (j < s->dv)
                v = fmax(v, vec_length(vec_sub(bezier_at(s, i, j + 1), p)));
        }
    }
    *size_u = u * s->du;
    *size_v = v * s->dv;
}

static void build_piece(Search *q, BezierRect rect, Piece *p) {
    q->steps++;
    p->rect = rect;
    bezier_restrict(&q->patch, rect, &p->net);
    p->eps = quasi_deviation(&p->net);
    p->disc = p->eps + q->frame.slack_x + q->frame.slack_y;
    measure(&p->net, &p->size_u, &p->size_v);
    quasi_net(&p->net, &p->net);
}

// ---- One square of a net, projected along the ray ----

typedef struct {
    Vec3 c00, c10, c01, c11; // first index along u
} Square;

static Square square_at(const Bezier *net, int i, int j) {
    return (Square){bezier_at(net, i, j), bezier_at(net, i + 1, j), bezier_at(net, i, j + 1),
                    bezier_at(net, i + 1, j + 1)};
}

static double cross2(Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; }
static double dot2(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y; }

// Place on the segment a b nearest to the ray, in [0,1], and its distance.
static double nearest_on_segment(Vec3 a, Vec3 b, double *distance) {
    Vec3 e = vec_sub(b, a);
    double length2 = dot2(e, e);
    double s = length2 > 0.0 ? fmin(fmax(-dot2(a, e) / length2, 0.0), 1.0) : 0.0;
    Vec3 p = vec_madd(a, s, e);
    *distance = sqrt(dot2(p, p));
    return s;
}

static bool inside_triangle(Vec3 a, Vec3 b, Vec3 c) {
    double ab = cross2(a, b), bc = cross2(b, c), ca = cross2(c, a);
    return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

// Does the convex hull of the four corners come within `radius` of the ray? The hull is the union
// of its triangles; a rounded sign matters only beside an edge, where the distances decide.
static bool hull_meets_disc(const Square *s, double radius) {
    const Vec3 c[4] = {s->c00, s->c10, s->c11, s->c01};
    Vec3 low = vec_min(vec_min(c[0], c[1]), vec_min(c[2], c[3]));
    Vec3 high = vec_max(vec_max(c[0], c[1]), vec_max(c[2], c[3]));
    if (low.x > radius || high.x < -radius || low.y > radius || high.y < -radius)
        return false;
    for (int a = 0; a < 4; a++) {
        for (int b = a + 1; b < 4; b++) {
            double distance;
            nearest_on_segment(c[a], c[b], &distance);
            if (distance <= radius)
                return true;
        }
    }
    return inside_triangle(c[0], c[1], c[2]) || inside_triangle(c[0], c[2], c[3]) ||
           inside_triangle(c[0], c[1], c[3]) || inside_triangle(c[1], c[2], c[3]);
}

static bool square_in_depth(const Search *q, const Square *s, double eps) {
    double low = fmin(fmin(s->c00.z, s->c10.z), fmin(s->c01.z, s->c11.z)) - eps;
    double high = fmax(fmax(s->c00.z, s->c10.z), fmax(s->c01.z, s->c11.z)) + eps;
    return high + q->frame.slack_z >= q->frame.z_low &&
           low - q->frame.slack_z <= qi_list_z_high(&q->list, &q->frame);
}

static Vec3 square_point(const Square *s, double a, double b) {
    Vec3 low = vec_madd(s->c00, a, vec_sub(s->c10, s->c00));
    Vec3 high = vec_madd(s->c01, a, vec_sub(s->c11, s->c01));
    return vec_madd(low, b, vec_sub(high, low));
}

// Where the projected bilinear square c00 + a e + b f + a b g is the origin. Crossing out a leaves
// (f x g) b^2 + (c00 x g + f x e) b + c00 x e = 0. Returns how many (a,b) lie in [0,1]^2.
static int solve_square(const Square *s, double a[2], double b[2]) {
    Vec3 e = vec_sub(s->c10, s->c00), f = vec_sub(s->c01, s->c00);
    Vec3 g = vec_sub(vec_sub(s->c11, s->c01), e);
    double k2 = cross2(f, g), k1 = cross2(s->c00, g) + cross2(f, e), k0 = cross2(s->c00, e);
    double root = k1 * k1 - 4.0 * k2 * k0;
    if (!(root >= 0.0))
        return 0;
    // The root that adds equal signs, then the other from the product of both.
    double half = -0.5 * (k1 + copysign(sqrt(root), k1));
    double b_of[2] = {half / k2, k0 / half};
    int count = 0;
    for (int n = 0; n < 2; n++) {
        if (!(b_of[n] >= 0.0 && b_of[n] <= 1.0)) // also when the division gave no number
            continue;
        Vec3 from = vec_madd(s->c00, b_of[n], f), along = vec_madd(e, b_of[n], g);
        double a_of = -dot2(from, along) / dot2(along, along);
        if (!(a_of >= 0.0 && a_of <= 1.0) || (count == 1 && b[0] == b_of[n]))
            continue;
        a[count] = a_of;
        b[count++] = b_of[n];
    }
    return count;
}

// Sign of the Jacobian of the projected square at (a,b), which is linear in a and b.
static double square_jacobian(const Square *s, double a, double b) {
    Vec3 along_a = vec_madd(vec_sub(s->c10, s->c00), b,
                            vec_sub(vec_sub(s->c11, s->c01), vec_sub(s->c10, s->c00)));
    Vec3 along_b = vec_madd(vec_sub(s->c01, s->c00), a,
                            vec_sub(vec_sub(s->c11, s->c10), vec_sub(s->c01, s->c00)));
    return cross2(along_a, along_b);
}

static bool square_folds(const Square *s) {
    double j00 = square_jacobian(s, 0.0, 0.0), j10 = square_jacobian(s, 1.0, 0.0),
           j01 = square_jacobian(s, 0.0, 1.0), j11 = square_jacobian(s, 1.0, 1.0);
    return !(j00 > 0.0 && j10 > 0.0 && j01 > 0.0 && j11 > 0.0) &&
           !(j00 < 0.0 && j10 < 0.0 && j01 < 0.0 && j11 < 0.0);
}

// ---- The last step: hits of the ray with a net that is near enough to the surface ----

// Reports (a,b) of the square: the net's point there, off the ray by its own distance, and off the
// surface by at most eps. The hit stands for all of `rect`.
static void report(Search *q, const Piece *p, Block block, const Square *s, double a, double b,
                   int sign, BezierRect rect) {
    Vec3 at = square_point(s, a, b);
    BezierRect cell = block_rect(&p->net, p->rect, block);
    QiFound found;
    found.u = fmin(fmax(cell.u0 + a * (cell.u1 - cell.u0), cell.u0), cell.u1);
    found.v = fmin(fmax(cell.v0 + b * (cell.v1 - cell.v0), cell.v0), cell.v1);
    found.z = at.z;
    found.t = qi_frame_t(&q->frame, at.z);
    found.bound = sqrt(dot2(at, at)) + p->eps + q->frame.rounding;
    found.rect = rect;
    found.sign = sign;
    qi_list_add(&q->list, found);
}

// The side of a square nearest to the ray, if one comes within the disc: of several, the one met
// first.
static bool report_side(Search *q, const Piece *p, Block block, const Square *s) {
    const struct {
        Vec3 from, to;
        double a0, b0, da, db;
    } sides[4] = {{s->c00, s->c10, 0.0, 0.0, 1.0, 0.0},
                  {s->c01, s->c11, 0.0, 1.0, 1.0, 0.0},
                  {s->c00, s->c01, 0.0, 0.0, 0.0, 1.0},
                  {s->c10, s->c11, 1.0, 0.0, 0.0, 1.0}};
    bool any = false;
    double best_z = INFINITY, a = 0.0, b = 0.0;
    for (int k = 0; k < 4; k++) {
        double distance, at = nearest_on_segment(sides[k].from, sides[k].to, &distance);
        double z = sides[k].from.z + at * (sides[k].to.z - sides[k].from.z);
        double t = qi_frame_t(&q->frame, z);
        bool in_range = t >= q->list.t_min && t < q->list.t_max;
        if (distance > p->disc || (any && !(in_range && z < best_z)))
            continue;
        any = true;
        best_z = in_range ? z : INFINITY;
        a = sides[k].a0 + at * sides[k].da;
        b = sides[k].b0 + at * sides[k].db;
    }
    if (any)
        report(q, p, block, s, a, b, 0, block_rect(&p->net, p->rect, block));
    return any;
}

// False: the square folds over the ray in a way that eps does not settle; cut on.
static bool finish_square(Search *q, const Piece *p, Block block, const Square *s) {
    double a[2], b[2];
    int count = solve_square(s, a, b);
    bool settled = count > 0;
    for (int n = 0; n < count; n++) {
        Vec3 at = square_point(s, a[n], b[n]);
        if (sqrt(dot2(at, at)) > p->disc)
            settled = false; // lost to rounding in a sliver
    }
    if (settled) {
        for (int n = 0; n < count; n++) {
            double jacobian = square_jacobian(s, a[n], b[n]);
            int sign = jacobian > 0.0 ? 1 : jacobian < 0.0 ? -1 : 0;
            report(q, p, block, s, a[n], b[n], sign, block_rect(&p->net, p->rect, block));
        }
        return true;
    }
    // A square that does not fold has its four sides for its border: off all of them by more than
    // the disc, and without a solution, it is off the ray. A folded one has other borders too.
    return report_side(q, p, block, s) || (count == 0 && !square_folds(s));
}

// ---- Cutting ----

static bool block_meets(const Search *q, const Piece *p, int i, int j, Square *s) {
    *s = square_at(&p->net, i, j);
    return square_in_depth(q, s, p->eps) && hull_meets_disc(s, p->disc);
}

static double block_depth(const Piece *p, Block b) {
    double low = INFINITY;
    for (int i = b.u0; i <= b.u1; i++)
        for (int j = b.v0; j <= b.v1; j++)
            low = fmin(low, bezier_at(&p->net, i, j).z);
    return low;
}

static void add_block(const Piece *p, Level *level, double depths[SQUARES], Block block) {
    double depth = block_depth(p, block);
    int at = level->count++;
    for (; at > 0 && depth < depths[at - 1]; at--) {
        depths[at] = depths[at - 1];
        level->blocks[at] = level->blocks[at - 1];
    }
    depths[at] = depth;
    level->blocks[at] = block;
}

// Slices across one direction, each reduced to the run of squares kept in it.
static void add_slices(const Piece *p, Level *level, bool kept[SQUARES], bool along_u) {
    double depths[SQUARES];
    int slices = along_u ? p->net.du : p->net.dv, length = along_u ? p->net.dv : p->net.du;
    for (int k = 0; k < slices; k++) {
        int first = length, last = -1;
        for (int m = 0; m < length; m++) {
            if (kept[along_u ? k * p->net.dv + m : m * p->net.dv + k]) {
                first = m < first ? m : first;
                last = m;
            }
        }
        if (last < 0)
            continue;
        uint8_t k0 = (uint8_t)k, k1 = (uint8_t)(k + 1);
        uint8_t m0 = (uint8_t)first, m1 = (uint8_t)(last + 1);
        add_block(p, level, depths, along_u ? (Block){k0, k1, m0, m1} : (Block){m0, m1, k0, k1});
    }
}

static void add_squares(const Piece *p, Level *level, bool kept[SQUARES]) {
    double depths[SQUARES];
    for (int i = 0; i < p->net.du; i++)
        for (int j = 0; j < p->net.dv; j++)
            if (kept[i * p->net.dv + j])
                add_block(p, level, depths,
                          (Block){(uint8_t)i, (uint8_t)(i + 1), (uint8_t)j, (uint8_t)(j + 1)});
}

// Steps 1 to 3 of the intro for one piece. Leaves in *level what has to be looked at further.
static void examine(Search *q, BezierRect rect, Level *level) {
    Piece p;
    build_piece(q, rect, &p);
    level->rect = rect;
    level->count = level->next = 0;
    bool flat = 2.0 * p.eps <= q->frame.tolerance;
    bool point = p.size_u + p.size_v + 2.0 * p.eps <= q->frame.tolerance;

    bool kept[SQUARES] = {false};
    for (int i = 0; i < p.net.du; i++) {
        for (int j = 0; j < p.net.dv; j++) {
            Square s;
            if (!block_meets(q, &p, i, j, &s))
                continue;
            Block block = {(uint8_t)i, (uint8_t)(i + 1), (uint8_t)j, (uint8_t)(j + 1)};
            if (point) {
                report(q, &p, block, &s, 0.5, 0.5, 0, rect);
                return;
            }
            kept[i * p.net.dv + j] = !flat || !finish_square(q, &p, block, &s);
        }
    }
    if (p.size_u > SLENDER * p.size_v)
        add_slices(&p, level, kept, true);
    else if (p.size_v > SLENDER * p.size_u)
        add_slices(&p, level, kept, false);
    else
        add_squares(&p, level, kept);
    if (q->steps > q->work_limit && level->count > 1)
        level->count = 1;
}

static void search(Search *q, BezierRect rect) {
    Level levels[LEVELS];
    int depth = 0;
    examine(q, rect, &levels[0]);
    while (depth >= 0 && !qi_list_done(&q->list, &q->frame)) {
        Level *level = &levels[depth];
        if (level->next == level->count) {
            depth--;
            continue;
        }
        BezierRect part = block_rect(&q->patch, level->rect, level->blocks[level->next++]);
        assert(depth + 1 < LEVELS);
        examine(q, part, &levels[depth + 1]);
        depth++;
    }
}

// A linear direction has one square and could not be cut. As degree 2 it is the same surface.
static void raise_linear(Bezier *s) {
    if (s->du == 1) {
        int row = s->dv + 1;
        for (int j = 0; j < row; j++) {
            s->p[2 * row + j] = s->p[row + j];
            s->p[row + j] = vec_scale(vec_add(s->p[j], s->p[row + j]), 0.5);
        }
        s->du = 2;
    }
    if (s->dv == 1) {
        for (int i = s->du; i >= 0; i--) {
            Vec3 a = s->p[2 * i], b = s->p[2 * i + 1];
            s->p[3 * i] = a;
            s->p[3 * i + 1] = vec_scale(vec_add(a, b), 0.5);
            s->p[3 * i + 2] = b;
        }
        s->dv = 2;
    }
}

static int intersect(const Bezier *patch, const QiQuery *query, QiMode mode, QiStats *stats,
                     QiSink sink, void *context) {
    QiFound found[QI_MAX_HITS];
    Search q;
    Bezier raised;
    bezier_copy(&raised, patch);
    raise_linear(&raised);
    if (!qi_frame_init(&q.frame, FRAME_ACROSS, &raised, &query->ray, &q.patch) ||
        !qi_frame_ask(&q.frame, query))
        return 0;
    q.list = (QiList){mode, query->t_min, query->t_max, 0, mode == QI_ALL ? QI_MAX_HITS : 1, found};
    q.steps = 0;
    q.work_limit = (uint64_t)qi_work_limit(patch);
    search(&q, query->rect);
    if (stats) {
        stats->steps += q.steps;
        stats->limited += q.steps > q.work_limit;
    }
    return qi_list_report(&q.list, patch, NULL, &q.frame, query->ray.dir, stats, sink, context);
}

int qi_paper_all(const Bezier *patch, const QiQuery *query, QiStats *stats, QiSink sink,
                 void *context) {
    return intersect(patch, query, QI_ALL, stats, sink, context);
}

static void take_hit(void *context, const QiHit *hit) { *(QiHit *)context = *hit; }

bool qi_paper_nearest(const Bezier *patch, const QiQuery *query, QiStats *stats, QiHit *hit) {
    return intersect(patch, query, QI_NEAREST, stats, take_hit, hit) > 0;
}

bool qi_paper_any(const Bezier *patch, const QiQuery *query, QiStats *stats) {
    return intersect(patch, query, QI_ANY, stats, NULL, NULL) > 0;
}
