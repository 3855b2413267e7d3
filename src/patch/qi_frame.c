// SPDX-License-Identifier: MIT
// The ray's frame and the list of hits. See qi_frame.h.
#include "patch/qi_frame.h"

#include "patch/quasi.h"

#include <float.h>

static const double HALF_ULP = 0.5 * DBL_EPSILON;

static double largest(Vec3 a) { return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))); }

// Times 2^exponent, in two factors: one alone could leave the range.
static Vec3 shifted(Vec3 a, int exponent) {
    double half = ldexp(1.0, exponent / 2), rest = ldexp(1.0, exponent - exponent / 2);
    return vec_scale(vec_scale(a, half), rest);
}

// Rounding of frame coordinates, for coordinates up to `side` when the point is `reach` away.
//
// Getting into the frame: P - org errs by 1/2 ulp of each coordinate, a dot product of three terms
// by 3 more halves of |e||q|, the axes themselves by 4 (cross product and normalisation) to each
// side: 12 half ulps of `reach`, all told.
// Within it: a value of S, a restricted point or a net point is a convex mean in at most 4 (or 3,
// by bezier.h) operations a level and direction; parameters rounded by an ulp move it by at most
// 2 (du + dv) half ulps more; 40 covers averages of the net, linear maps and distances.
static double slack_of(int du, int dv, double reach, double side) {
    return HALF_ULP * (12.0 * reach + (8.0 * (du + dv) + 40.0) * side);
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
    double rounding = (1.0 + sqrt(2.0)) * slack_of(du, dv, reach, reach);
    return rounding + floor_of(du, dv, rounding);
}

int qi_work_limit(const Bezier *patch) { return 2048 + 128 * patch->du * patch->dv; }

QiQuery qi_query_default(const Bezier *patch, Ray ray) {
    return (QiQuery){ray, 0.0, INFINITY, 1e-9 * bezier_diameter(patch), bezier_whole()};
}

static bool query_is_sound(const QiQuery *q) {
    const BezierRect *r = &q->rect;
    return vec_is_finite(q->ray.org) && vec_is_finite(q->ray.dir) && largest(q->ray.dir) > 0.0 &&
           q->t_min < q->t_max && q->tolerance >= 0.0 && r->u0 >= 0.0 && r->u0 <= r->u1 &&
           r->u1 <= 1.0 && r->v0 >= 0.0 && r->v0 <= r->v1 && r->v1 <= 1.0;
}

// Depth of a t, moved by `ulps` half ulps.
static double depth_of(const QiFrame *f, double t, double ulps) {
    double z = ldexp(t * f->length, -f->t_exponent);
    return isfinite(z) ? z + ulps * HALF_ULP * fabs(z) : z;
}

bool qi_frame_init(QiFrame *f, const Bezier *patch, const QiQuery *query, Bezier *out) {
    if (!query_is_sound(query))
        return false;
    double most = largest(query->ray.org);
    for (int k = 0; k < bezier_count(patch); k++)
        most = fmax(most, largest(patch->p[k]));
    if (!isfinite(most))
        return false;
    int exponent, dir_exponent;
    frexp(most, &exponent);
    frexp(largest(query->ray.dir), &dir_exponent);
    f->exponent = -exponent;
    f->t_exponent = exponent - dir_exponent;

    // Axes: w along the ray, e1 and e2 across, from the coordinate axis farthest from w.
    Vec3 dir = shifted(query->ray.dir, -dir_exponent);
    f->length = vec_length(dir);
    f->w = vec_scale(dir, 1.0 / f->length);
    double x = fabs(f->w.x), y = fabs(f->w.y), z = fabs(f->w.z);
    Vec3 far = x <= y && x <= z ? vec3(1.0, 0.0, 0.0)
               : y <= z         ? vec3(0.0, 1.0, 0.0)
                                : vec3(0.0, 0.0, 1.0);
    f->e1 = vec_normalize(vec_cross(f->w, far));
    f->e2 = vec_cross(f->w, f->e1);
    f->org = shifted(query->ray.org, f->exponent);

    out->du = patch->du;
    out->dv = patch->dv;
    double reach = 0.0, side = 0.0;
    for (int k = 0; k < bezier_count(patch); k++) {
        Vec3 q = vec_sub(shifted(patch->p[k], f->exponent), f->org);
        Vec3 p = vec3(vec_dot(f->e1, q), vec_dot(f->e2, q), vec_dot(f->w, q));
        reach = fmax(reach, vec_length(q));
        side = fmax(side, fmax(fabs(p.x), fabs(p.y)));
        out->p[k] = p;
    }
    f->reach = reach;
    f->slack = slack_of(out->du, out->dv, reach, side);
    f->slack_z = slack_of(out->du, out->dv, reach, reach);
    f->rounding = sqrt(2.0) * f->slack + f->slack_z;
    double least = 0.5 * floor_of(out->du, out->dv, f->rounding);
    f->tolerance = fmax(ldexp(query->tolerance, f->exponent), least);
    f->z_low = depth_of(f, query->t_min, -8.0);
    f->z_high = depth_of(f, query->t_max, 8.0);
    f->z_low -= 8.0 * HALF_ULP * fabs(f->z_low) + f->slack_z;
    f->z_high += f->slack_z;
    return true;
}

double qi_frame_t(const QiFrame *f, double z) { return ldexp(z / f->length, f->t_exponent); }

double qi_frame_scene(const QiFrame *f, double length) { return ldexp(length, -f->exponent); }

static bool touching(BezierRect a, BezierRect b) {
    const double ulps = 4.0 * DBL_EPSILON; // rectangles that share a side may differ by rounding
    return a.u0 <= b.u1 + ulps && b.u0 <= a.u1 + ulps && a.v0 <= b.v1 + ulps && b.v0 <= a.v1 + ulps;
}

static bool one_crossing(const QiFound *a, const QiFound *b) {
    return a->sign * b->sign >= 0 && touching(a->rect, b->rect);
}

// The better of the two stays, over both rectangles: a crossing proved (sign known) before a mere
// approach, then the smaller bound.
static void absorb(QiFound *into, const QiFound *from) {
    BezierRect a = into->rect, b = from->rect;
    int known_a = into->sign != 0, known_b = from->sign != 0;
    bool better = known_b != known_a ? known_b > known_a : from->bound < into->bound;
    if (better)
        *into = *from;
    into->rect =
        (BezierRect){fmin(a.u0, b.u0), fmax(a.u1, b.u1), fmin(a.v0, b.v0), fmax(a.v1, b.v1)};
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

bool qi_list_done(const QiList *list) { return list->mode == QI_ANY && list->count > 0; }

int qi_list_report(QiList *list, const Bezier *patch, const QiFrame *frame, Vec3 dir,
                   QiStats *stats, QiSink sink, void *context) {
    for (int i = 1; i < list->count; i++) {
        QiFound found = list->found[i];
        int at = i;
        for (; at > 0 && found.t < list->found[at - 1].t; at--)
            list->found[at] = list->found[at - 1];
        list->found[at] = found;
    }
    for (int i = 0; sink && i < list->count; i++) {
        const QiFound *f = &list->found[i];
        Vec3 normal = bezier_normal(patch, f->u, f->v, vec_neg(dir));
        QiHit hit = {f->t, f->u, f->v, normal, qi_frame_scene(frame, f->bound)};
        sink(context, &hit);
    }
    if (stats)
        stats->hits += (uint64_t)list->count;
    return list->count;
}
