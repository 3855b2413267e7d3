// SPDX-License-Identifier: MIT
// The ray's frame and the list of hits. See qi_frame.h.
#include "patch/qi_frame.h"

#include "patch/quasi.h"
#include "patch/rational.h"

#include <float.h>

static const double HALF_ULP = 0.5 * DBL_EPSILON;

static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double largest(Vec3 a) { return larger(fabs(a.x), larger(fabs(a.y), fabs(a.z))); }

// Times 2^exponent, in two factors: one alone could leave the range.
static Vec3 shifted(Vec3 a, int exponent) {
    double half = ldexp(1.0, exponent / 2), rest = ldexp(1.0, exponent - exponent / 2);
    return vec_scale(vec_scale(a, half), rest);
}

// Rounding of one frame coordinate that is at most `side`, made from terms that add up to `terms`.
//
// Getting into the frame: P - org errs by 1/2 ulp of each coordinate, a sum of up to three products
// by 3 more halves of its terms, the factors by 4 (cross product and normalisation of the axes
// across; the skew frame's quotients have 1) to each side: 12 half ulps of the terms, all told.
// Within it: a value of S, a restricted point or a net point is a convex mean in at most 4 (or 3,
// by bezier.h) operations a level and direction; parameters rounded by an ulp move it by at most
// 2 (du + dv) half ulps more; 40 covers averages of the net, linear maps and distances.
static double slack_of(int du, int dv, double terms, double side) {
    return HALF_ULP * (12.0 * terms + (8.0 * (du + dv) + 40.0) * side);
}

// What the stop rules need: a second difference errs by 4 slacks, times Z. Twice that, and some
// slacks more for the tests, so that eps can fall below half of it.
static double floor_of(int du, int dv, double rounding) {
    return (16.0 * (quasi_z_infinity(du) + quasi_z_infinity(dv)) + 8.0) * rounding;
}

double qi_rounding(const Bezier *patch, Vec3 org) {
    double reach = 0.0;
    for (int k = 0; k < bezier_count(patch); k++)
        reach = fmax(reach, largest(vec_sub(patch->p[k], org)));
    reach *= sqrt(3.0);
    int du = patch->du < 2 ? 2 : patch->du, dv = patch->dv < 2 ? 2 : patch->dv;
    // Terms and sides of x and y are at most twice the farthest coordinate in the skew frame, and z
    // counts sqrt(3) times at most: 2 sqrt(2) + sqrt(3), less than 3 sqrt(3).
    double rounding = 3.0 * sqrt(3.0) * slack_of(du, dv, reach, reach);
    return rounding + floor_of(du, dv, rounding);
}

int qi_work_limit(const Bezier *patch) { return 2048 + 128 * patch->du * patch->dv; }

QiQuery qi_query_default(const Bezier *patch, Ray ray) {
    return (QiQuery){ray, 0.0, INFINITY, 1e-9 * bezier_diameter(patch), bezier_whole(), NULL};
}

static bool query_is_sound(const QiQuery *q) {
    const BezierRect *r = &q->rect;
    return q->t_min < q->t_max && q->tolerance >= 0.0 && r->u0 >= 0.0 && r->u0 <= r->u1 &&
           r->u1 <= 1.0 && r->v0 >= 0.0 && r->v0 <= r->v1 && r->v1 <= 1.0;
}

// Depth of a t, moved by `ulps` half ulps.
static double depth_of(const QiFrame *f, double t, double ulps) {
    double z = ldexp(t * f->length, -f->t_exponent);
    return isfinite(z) ? z + ulps * HALF_ULP * fabs(z) : z;
}

// The frame's axes, as rows.
typedef struct {
    Vec3 x, y, z;
} Axes;

static Axes axes_across(Vec3 dir, double *length) {
    *length = vec_length(dir);
    Vec3 w = vec_scale(dir, 1.0 / *length);
    double x = fabs(w.x), y = fabs(w.y), z = fabs(w.z);
    Vec3 far = x <= y && x <= z ? vec3(1.0, 0.0, 0.0)
               : y <= z         ? vec3(0.0, 1.0, 0.0)
                                : vec3(0.0, 0.0, 1.0);
    Vec3 e = vec_normalize(vec_cross(w, far));
    return (Axes){e, vec_cross(w, e), w};
}

// Is |dir_a| / far_a larger than |dir_b| / far_b?
static bool steeper(Vec3 dir, Vec3 far, int a, int b) {
    return fabs(vec_get(dir, a)) * vec_get(far, b) > fabs(vec_get(dir, b)) * vec_get(far, a);
}

// far: largest coordinates of the patch, seen from the origin.
static Axes axes_skew(Vec3 dir, Vec3 far, double *length) {
    // A component below any rounding of the others cannot carry z.
    const double least = 0x1p-900;
    int k = -1;
    for (int axis = 0; axis < 3; axis++)
        if (fabs(vec_get(dir, axis)) > least && (k < 0 || steeper(dir, far, axis, k)))
            k = axis;
    double along = vec_get(dir, k), sign = copysign(1.0, along);
    *length = fabs(along);
    double x = -dir.x / along, y = -dir.y / along, z = -dir.z / along;
    if (k == 0)
        return (Axes){{y, 1.0, 0.0}, {z, 0.0, 1.0}, {sign, 0.0, 0.0}};
    if (k == 1)
        return (Axes){{1.0, x, 0.0}, {0.0, z, 1.0}, {0.0, sign, 0.0}};
    return (Axes){{1.0, 0.0, x}, {0.0, 1.0, y}, {0.0, 0.0, sign}};
}

static double terms(Vec3 a, Vec3 b) { return fabs(a.x * b.x) + fabs(a.y * b.y) + fabs(a.z * b.z); }

// Scales the patch by 2^exponent and moves the origin to org. Returns the largest coordinates.
static Vec3 move_points(int exponent, const Bezier *patch, Vec3 org, Bezier *out) {
    double half = ldexp(1.0, exponent / 2), rest = ldexp(1.0, exponent - exponent / 2);
    Vec3 far = vec3(0.0, 0.0, 0.0);
    org = vec_scale(vec_scale(org, half), rest);
    out->du = patch->du;
    out->dv = patch->dv;
    for (int k = 0; k < bezier_count(patch); k++) {
        Vec3 q = vec_sub(vec_scale(vec_scale(patch->p[k], half), rest), org);
        far = vec_max(far, vec3(fabs(q.x), fabs(q.y), fabs(q.z)));
        out->p[k] = q;
    }
    return far;
}

// times: 1, or 2 for a rational patch. Its points are quotients of two sums of positive terms: each
// errs by as much as a polynomial's, relative to itself, and 12 + 40 have room for the products
// with the weights and the quotient.
static void turn_points(QiFrame *f, const Axes *axes, double times, Bezier *s) {
    Vec3 side = vec3(0.0, 0.0, 0.0), sums = side;
    for (int k = 0; k < bezier_count(s); k++) {
        Vec3 q = s->p[k];
        Vec3 p = vec3(vec_dot(axes->x, q), vec_dot(axes->y, q), vec_dot(axes->z, q));
        side = vec_max(side, vec3(fabs(p.x), fabs(p.y), fabs(p.z)));
        sums = vec_max(sums, vec3(terms(axes->x, q), terms(axes->y, q), terms(axes->z, q)));
        s->p[k] = p;
    }
    f->side_x = side.x;
    f->side_y = side.y;
    f->slack_x = times * slack_of(s->du, s->dv, sums.x, side.x);
    f->slack_y = times * slack_of(s->du, s->dv, sums.y, side.y);
    f->slack_z = times * slack_of(s->du, s->dv, sums.z, side.z);
}

bool qi_frame_init(QiFrame *f, QiFrameKind kind, const Bezier *patch, const Ray *ray, Bezier *out) {
    if (!vec_is_finite(ray->org) || !vec_is_finite(ray->dir) || !(largest(ray->dir) > 0.0))
        return false;
    double most = largest(ray->org);
    for (int k = 0; k < bezier_count(patch); k++)
        most = larger(most, largest(patch->p[k]));
    if (!isfinite(most))
        return false;
    int exponent, dir_exponent;
    frexp(most, &exponent);
    frexp(largest(ray->dir), &dir_exponent);
    f->exponent = -exponent;
    f->t_exponent = exponent - dir_exponent;

    Vec3 dir = shifted(ray->dir, -dir_exponent);
    Vec3 far = move_points(f->exponent, patch, ray->org, out);
    Axes axes =
        kind == FRAME_ACROSS ? axes_across(dir, &f->length) : axes_skew(dir, far, &f->length);
    f->axes[0] = axes.x;
    f->axes[1] = axes.y;
    f->axes[2] = axes.z;
    turn_points(f, &axes, kind == FRAME_SKEW_RATIONAL ? 2.0 : 1.0, out);
    // An error of z moves the ray's point by |dir| / length as much.
    f->stretch = vec_length(dir) / f->length;
    f->rounding = sqrt(f->slack_x * f->slack_x + f->slack_y * f->slack_y) + f->stretch * f->slack_z;
    f->least_tolerance = 0.5 * floor_of(out->du, out->dv, f->rounding);
    return true;
}

bool qi_frame_ask(QiFrame *f, const QiQuery *query) {
    if (!query_is_sound(query))
        return false;
    f->tolerance = larger(ldexp(query->tolerance, f->exponent), f->least_tolerance);
    f->z_low = depth_of(f, query->t_min, -8.0) - f->slack_z;
    f->z_high = depth_of(f, query->t_max, 8.0) + f->slack_z;
    return true;
}

double qi_frame_t(const QiFrame *f, double z) { return ldexp(z / f->length, f->t_exponent); }

double qi_frame_scene(const QiFrame *f, double length) { return ldexp(length, -f->exponent); }

static bool touching(BezierRect a, BezierRect b) {
    const double ulps = 4.0 * DBL_EPSILON; // rectangles that share a side may differ by rounding
    return a.u0 <= b.u1 + ulps && b.u0 <= a.u1 + ulps && a.v0 <= b.v1 + ulps && b.v0 <= a.v1 + ulps;
}

static BezierRect hull_of(BezierRect a, BezierRect b) {
    return (BezierRect){fmin(a.u0, b.u0), fmax(a.u1, b.u1), fmin(a.v0, b.v0), fmax(a.v1, b.v1)};
}

static bool one_crossing(const QiFound *a, const QiFound *b) {
    return a->sign * b->sign >= 0 && touching(a->rect, b->rect);
}

// The better of the two stays, over both rectangles: a crossing proved (sign known) before a mere
// approach, then the bound if it differs much, then the nearer.
static void absorb(QiFound *into, const QiFound *from) {
    BezierRect both = hull_of(into->rect, from->rect);
    int known_a = into->sign != 0, known_b = from->sign != 0;
    bool better = known_b != known_a                ? known_b > known_a
                  : from->bound < 0.5 * into->bound ? true
                  : into->bound < 0.5 * from->bound ? false
                                                    : from->t < into->t;
    if (better)
        *into = *from;
    into->rect = both;
}

void qi_list_add(QiList *list, QiFound found) {
    if (!(found.t >= list->t_min && found.t < list->t_max))
        return;
    if (list->mode != QI_ALL) {
        if (list->count == 0 || found.t < list->found[0].t)
            list->found[0] = found;
        list->count = 1;
        return;
    }
    // A merged rectangle is larger and may touch others in turn: repeat until none does.
    for (int i = 0; i < list->count;) {
        if (one_crossing(&list->found[i], &found)) {
            absorb(&found, &list->found[i]);
            list->found[i] = list->found[--list->count];
            i = 0;
        } else {
            i++;
        }
    }
    if (list->count < list->capacity)
        list->found[list->count++] = found;
}

double qi_list_z_high(const QiList *list, const QiFrame *frame) {
    return list->mode == QI_NEAREST && list->count ? list->found[0].z : frame->z_high;
}

// Within three roundings along the ray: a depth errs by one slack of z, and the bound of a piece's
// roots is at 2 slacks of z, and of the forms, before what was computed (qi_reduce.c).
bool qi_list_no_nearer(const QiList *list, const QiFrame *frame, double z) {
    return list->mode == QI_NEAREST && list->count > 0 &&
           z >= list->found[0].z - 3.0 * frame->rounding / frame->stretch;
}

// z_low lies a slack before the range, and a depth errs by one.
static bool is_first(const QiFound *found, const QiFrame *frame) {
    return found->z <= frame->z_low + 2.0 * frame->slack_z;
}

bool qi_list_done(const QiList *list, const QiFrame *frame) {
    return list->mode != QI_ALL && list->count > 0 &&
           (list->mode == QI_ANY || is_first(&list->found[0], frame));
}

bool qi_list_has(QiList *list, const QiFrame *frame, double low, double high, double radius,
                 BezierRect rect) {
    double reach = radius / frame->stretch;
    low = larger(low, frame->z_low);
    high = high < frame->z_high ? high : frame->z_high;
    for (int i = 0; list->mode == QI_ALL && i < list->count; i++) {
        QiFound *f = &list->found[i];
        if (f->z - low <= reach && high - f->z <= reach) {
            if (touching(f->rect, rect))
                f->rect = hull_of(f->rect, rect);
            return true;
        }
    }
    return false;
}

int qi_list_report(QiList *list, const Bezier *patch, const double *weights, const QiFrame *frame,
                   Vec3 dir, QiStats *stats, QiSink sink, void *context) {
    for (int i = 1; i < list->count; i++) {
        QiFound found = list->found[i];
        int at = i;
        for (; at > 0 && found.t < list->found[at - 1].t; at--)
            list->found[at] = list->found[at - 1];
        list->found[at] = found;
    }
    for (int i = 0; sink && i < list->count; i++) {
        const QiFound *f = &list->found[i];
        Vec3 normal = weights ? rational_normal(patch, weights, f->u, f->v, vec_neg(dir))
                              : bezier_normal(patch, f->u, f->v, vec_neg(dir));
        QiHit hit = {f->t, f->u, f->v, normal, qi_frame_scene(frame, f->bound)};
        sink(context, &hit);
    }
    if (stats)
        stats->hits += (uint64_t)list->count;
    return list->count;
}
