// SPDX-License-Identifier: MIT
#include "stress_judge.h"

#include <float.h>
#include <stdio.h>

static const char *const names[STRESS_VERDICTS] = {"fine", "missed", "false",  "over", "order",
                                                   "lost", "twice",  "differ", "NaN"};

bool stress_is_triangles(PatchMethod method) {
    return method == METHOD_FACETS || method == METHOD_TESSELLATION;
}

const char *stress_verdict_name(StressVerdict verdict) { return names[verdict]; }

// ---- Truth

void stress_truth_init(StressTruth *truth, const StressScene *scene, const StressRay *ray) {
    truth->scene = scene;
    truth->ray = ray;
    truth->made = 0;
    truth->open = false;
}

static double length_of(Vec3 a) { return hypot(a.x, hypot(a.y, a.z)); }

static void find(StressTruth *truth, RayOraclePrecision precision, RayOracleRange range) {
    int level = 1 + (int)precision;
    if (truth->made >= level && truth->range.t0 <= range.t0 && truth->range.t1 >= range.t1)
        return;
    truth->made = level;
    truth->range = range;
    truth->oracle.count = truth->oracle.open = 0;
    ray_oracle_search(&truth->oracle, truth->scene->oracle, &truth->ray->ray, range, precision);
}

static const RayOracleRange everywhere = {-INFINITY, INFINITY};

static double sine_of(StressTruth *truth, int k) {
    RayOracleRoot *root = &truth->oracle.root[k];
    return ray_oracle_sine(root, &truth->scene->defs[root->patch], &truth->ray->ray);
}

void stress_truth_print(StressTruth *truth) {
    static const char *const kinds[] = {"certain", "border", "open"};
    find(truth, ORACLE_EXACT, everywhere);
    for (int k = 0; k < truth->oracle.count; k++) {
        const RayOracleRoot *c = &truth->oracle.root[k];
        printf("  truth: patch %d t %.17g +- %.2g u %.17g v %.17g sine %.3g %s\n",
               truth->oracle.root[k].patch, c->t, c->dt, c->u, c->v, sine_of(truth, k),
               kinds[c->kind]);
    }
}

// ---- Hits

// What rounding may cost, in scene units: 128 units of the last place a degree, at the farthest
// point that ray and patch involve.
static double rounding_for(const PatchDef *def, double reach) {
    return 128.0 * (def->degree_u + def->degree_v) * 0x1p-53 * reach + 64.0 * 0x1p-1074;
}

static double rounding_of(const PatchDef *def, const Ray *ray) {
    long double most = 0; // of the squares, which double has no room for
    for (uint32_t k = 0; k < (def->degree_u + 1) * (def->degree_v + 1); k++) {
        Vec3 d = vec_sub(def->points[k], ray->org);
        long double x = d.x, y = d.y, z = d.z, square = x * x + y * y + z * z;
        most = square > most ? square : most;
    }
    return rounding_for(def, (double)sqrtl(most));
}

static double tolerance_of(const StressCase *which, PatchMethod method) {
    return stress_is_triangles(method) ? 1e-2 : which->tolerance;
}

static StressVerdict judge_hit(const StressCase *which, PatchMethod method,
                               const StressTruth *truth, const PatchHit *hit) {
    double sum = hit->t + hit->u + hit->v + hit->normal.x + hit->normal.y + hit->normal.z;
    if (!isfinite(sum + hit->bound) || !(fabs(vec_length(hit->normal) - 1.0) < 1e-9))
        return STRESS_NAN;
    const StressRay *r = truth->ray;
    if (hit->id >= (uint32_t)truth->scene->count || !(hit->t >= r->t_min && hit->t < r->t_max) ||
        !(hit->u >= 0.0 && hit->u <= 1.0 && hit->v >= 0.0 && hit->v <= 1.0))
        return STRESS_FALSE;
    const PatchDef *def = &truth->scene->defs[hit->id];
    double share = tolerance_of(which, method) * truth->scene->diameter[hit->id];
    double off = ray_oracle_residual(def, &r->ray, hit->t, hit->u, hit->v);
    // Mostly it is well within the tolerance, and what rounding allows does not matter.
    if (!stress_is_triangles(method) && off <= hit->bound && hit->bound <= share)
        return STRESS_FINE;
    double allowed = share + rounding_of(def, &r->ray);
    if (def->weights) { // which may stretch the last bit of a parameter to any length
        Vec3 jet[3];
        ray_oracle_jet(def, hit->u, hit->v, jet);
        allowed += 4.0 * DBL_EPSILON * (length_of(jet[1]) + length_of(jet[2]));
    }
    if (!(off <= allowed))
        return STRESS_FALSE;
    if (!stress_is_triangles(method) && !(off <= hit->bound && hit->bound <= allowed))
        return STRESS_OVER;
    return STRESS_FINE;
}

// How far a hit with that bound may lie from a crossing, in t, when the angle between ray and
// surface has that sine: at least, and at most, for 1 and 0.
static double slack_for(const RayOracleRoot *c, double bound, const Ray *ray, double sine) {
    return c->dt + 4.0 * bound / (fmax(sine, 1e-3) * length_of(ray->dir)) +
           8.0 * DBL_EPSILON * fabs(c->t) + 4.0 * 0x1p-1074;
}

static double slack_of(StressTruth *truth, int k, double bound) {
    return slack_for(&truth->oracle.root[k], bound, &truth->ray->ray, sine_of(truth, k));
}

// Between the hit and the crossing k.
static bool near_between(const StressTruth *truth, const PatchHit *hit, int k, double bound) {
    const RayOracleRoot *c = &truth->oracle.root[k];
    const double from[2] = {hit->u, hit->v}, to[2] = {c->u, c->v};
    if ((int)hit->id == truth->oracle.root[k].patch &&
        ray_oracle_way(&truth->scene->defs[hit->id], &truth->ray->ray, from, to, 4.0 * bound))
        return true;
    return ray_oracle_near(truth->scene->oracle, &truth->ray->ray, fmin(c->t, hit->t),
                           fmax(c->t, hit->t), 4.0 * bound);
}

typedef struct {
    const StressCase *which;
    PatchMethod method;
    StressTruth *truth;
    const StressAnswer *answer;
} Trial;

static double share_of(const Trial *trial, int patch) {
    return tolerance_of(trial->which, trial->method) * trial->truth->scene->diameter[patch];
}

static double bound_at(const Trial *trial, const PatchHit *hit, int patch) {
    if (hit && !stress_is_triangles(trial->method))
        return hit->bound;
    const PatchDef *def = &trial->truth->scene->defs[patch];
    return share_of(trial, patch) + rounding_of(def, &trial->truth->ray->ray);
}

static bool within(const StressRay *r, double t, double slack) {
    return t - slack >= r->t_min && t + slack < r->t_max;
}

// Does the range surely hold the crossing k? Asked first with more slack than there can be.
static bool surely_in_range(const Trial *trial, int k) {
    StressTruth *truth = trial->truth;
    const RayOracleRoot *c = &truth->oracle.root[k];
    const StressRay *r = truth->ray;
    const PatchDef *def = &truth->scene->defs[c->patch];
    double reach =
        length_of(vec_sub(def->points[0], r->ray.org)) + truth->scene->diameter[c->patch];
    double most = share_of(trial, c->patch) + 1.001 * rounding_for(def, reach);
    return within(r, c->t, slack_for(c, most, &r->ray, 0.0)) ||
           within(r, c->t, slack_of(truth, k, bound_at(trial, NULL, c->patch)));
}

// Does the ray run beside the surface all the way from an end of the range to the crossing k? Then
// it is a matter of the tolerance on which side of that end the two meet.
static bool beside_range_end(const Trial *trial, int k) {
    StressTruth *truth = trial->truth;
    const RayOracleRoot *c = &truth->oracle.root[k];
    const StressRay *r = truth->ray;
    double near = 4.0 * bound_at(trial, NULL, c->patch);
    return sine_of(truth, k) < 1e-3 &&
           ((isfinite(r->t_min) &&
             ray_oracle_near(truth->scene->oracle, &r->ray, r->t_min, c->t, near)) ||
            (isfinite(r->t_max) &&
             ray_oracle_near(truth->scene->oracle, &r->ray, c->t, r->t_max, near)));
}

// Is a hit too far behind the crossing to be it?
static bool behind(const Trial *trial, const PatchHit *hit, int k) {
    StressTruth *truth = trial->truth;
    const RayOracleRoot *c = &truth->oracle.root[k];
    double bound = fmax(bound_at(trial, hit, (int)hit->id), bound_at(trial, hit, c->patch));
    return hit->t > c->t + slack_for(c, bound, &truth->ray->ray, 1.0) &&
           hit->t > c->t + slack_of(truth, k, bound) && !near_between(truth, hit, k, bound);
}

// Where a crossing matters: the range, less what is too near to its ends or to the answer to be
// held against it whatever the angle.
static RayOracleRange range_that_matters(const Trial *trial) {
    const StressRay *r = trial->truth->ray;
    const StressAnswer *a = trial->answer;
    double four = (1.0 - 0x1p-40) * 4.0, length = length_of(r->ray.dir); // may be denormal
    double least = tolerance_of(trial->which, trial->method) * trial->truth->scene->least_diameter;
    RayOracleRange range = {r->t_min + four * least / length, r->t_max - four * least / length};
    if (a->found && a->any && !stress_is_triangles(trial->method))
        range.t1 = fmin(range.t1, a->hit.t - four * a->hit.bound / length);
    return range;
}

// By the crossings in that range, more and more exactly as far as it matters.
static StressVerdict judge_nearest(const Trial *trial, RayOracleRange range) {
    const StressAnswer *a = trial->answer;
    StressTruth *truth = trial->truth;
    const StressRay *r = truth->ray;
    const RayOracle *o = &truth->oracle;
    for (RayOraclePrecision level = ORACLE_QUICK; level <= ORACLE_EXACT; level++) {
        find(truth, level, range);
        bool open = false;
        for (int k = 0; k < o->count; k++) {
            const RayOracleRoot *c = &o->root[k];
            if (c->kind == ROOT_CERTAIN) {
                if (!surely_in_range(trial, k))
                    continue;
                if ((!a->found || !a->any) && beside_range_end(trial, k))
                    continue;
                if (!a->found || !a->any)
                    return a->found ? STRESS_DIFFER : STRESS_MISSED;
                if (behind(trial, &a->hit, k) && !beside_range_end(trial, k))
                    return STRESS_ORDER;
            } else if (c->t + c->dt >= r->t_min && c->t - c->dt < r->t_max) {
                // Only matters when it may lie before the answer.
                double most = bound_at(trial, NULL, c->patch);
                open |= !a->found || c->t - c->dt < a->hit.t - slack_of(truth, k, most);
            }
        }
        if (!open)
            return STRESS_FINE;
    }
    truth->open = true;
    return STRESS_FINE;
}

static bool accounts(const Trial *trial, const PatchHit *hit, int k, bool far) {
    StressTruth *truth = trial->truth;
    const RayOracleRoot *c = &truth->oracle.root[k];
    if ((int)hit->id != c->patch && !stress_is_triangles(trial->method))
        return false;
    double bound = bound_at(trial, hit, c->patch), off = fabs(hit->t - c->t);
    if (!far)
        return off <= slack_for(c, bound, &truth->ray->ray, 1.0) ||
               off <= slack_of(truth, k, bound);
    // Crossings that the tolerance can't tell apart may be one.
    return near_between(truth, hit, k, bound_at(trial, NULL, c->patch));
}

// Whatever crossings there are in what was left open: would they all be a hit that is known, or
// outside of the range?
static bool accounted(const Trial *trial, int k) {
    StressTruth *truth = trial->truth;
    const StressRay *r = truth->ray;
    const StressAnswer *a = trial->answer;
    const RayOracleRoot *c = &truth->oracle.root[k];
    RayOracleRoot one = *c; // of them: all of the uncertainty of t has to fit
    one.dt = 0.0;
    double slack = slack_for(&one, share_of(trial, c->patch), &r->ray, 1.0) - c->dt;
    bool found = c->t - slack < r->t_min || c->t + slack >= r->t_max;
    for (int i = 0; !found && i < a->count; i++) {
        const PatchHit *hit = &a->all[i];
        if ((int)hit->id == c->patch && !stress_is_triangles(trial->method))
            found = fabs(hit->t - c->t) + c->dt <= slack_for(&one, hit->bound, &r->ray, 1.0);
    }
    return found;
}

// Is there a hit for each crossing?
static StressVerdict judge_lost(const Trial *trial) {
    const StressAnswer *a = trial->answer;
    StressTruth *truth = trial->truth;
    for (RayOraclePrecision level = ORACLE_QUICK; level <= ORACLE_EXACT; level++) {
        find(truth, level, everywhere);
        bool open = false;
        for (int k = 0; k < truth->oracle.count; k++) {
            if (truth->oracle.root[k].kind != ROOT_CERTAIN) {
                open |= !accounted(trial, k);
                continue;
            }
            bool found = !surely_in_range(trial, k);
            for (int far = 0; far < 2; far++)
                for (int i = 0; !found && i < a->count; i++)
                    found = accounts(trial, &a->all[i], k, far);
            if (!found && !beside_range_end(trial, k))
                return STRESS_LOST;
        }
        if (!open)
            break;
    }
    return STRESS_FINE;
}

// Two hits in one place?
static StressVerdict judge_twice(const Trial *trial) {
    const StressAnswer *a = trial->answer;
    StressTruth *truth = trial->truth;
    const RayOracle *o = &truth->oracle;
    double length = length_of(truth->ray->ray.dir);
    for (int i = 0; i < a->count; i++) {
        for (int j = 0; j < i; j++) {
            const PatchHit *p = &a->all[i], *q = &a->all[j];
            if (p->id != q->id || fabs(p->u - q->u) > 1e-6 || fabs(p->v - q->v) > 1e-6 ||
                fabs(p->t - q->t) * length > p->bound + q->bound)
                continue;
            int certain = 0, other = 0;
            for (int k = 0; k < o->count; k++) {
                const RayOracleRoot *c = &o->root[k];
                if (c->patch != (int)p->id)
                    continue;
                bool here = fabs(c->u - p->u) < 1e-5 && fabs(c->v - p->v) < 1e-5;
                certain += here && c->kind == ROOT_CERTAIN && sine_of(truth, k) > 1e-3;
                other += c->kind != ROOT_CERTAIN || (here && sine_of(truth, k) <= 1e-3);
            }
            if (certain == 1 && other == 0)
                return STRESS_TWICE;
        }
    }
    return STRESS_FINE;
}

// A surface that must be there by construction.
static StressVerdict judge_known(const Trial *trial) {
    const StressAnswer *a = trial->answer;
    StressTruth *truth = trial->truth;
    const StressRay *r = truth->ray;
    bool edges = trial->which->aim == stress_cases[0].aim;
    double bound = bound_at(trial, NULL, a->found ? (int)a->hit.id : 0);
    double slack = 8.0 * bound / length_of(r->ray.dir) + 8.0 * DBL_EPSILON * r->t_known;
    if (a->found && a->any && a->hit.t <= r->t_known + fmax(slack, edges ? 1e-6 : 0.0))
        return STRESS_FINE;
    if (!edges)
        return a->found ? (a->any ? STRESS_ORDER : STRESS_DIFFER) : STRESS_MISSED;
    // The target was rounded: at an outline the ray may truly pass beside it.
    find(truth, ORACLE_EXACT, everywhere);
    for (int k = 0; k < truth->oracle.count; k++) {
        const RayOracleRoot *c = &truth->oracle.root[k];
        if (c->kind == ROOT_OPEN || c->t < r->t_min)
            continue;
        if (!a->found)
            return STRESS_MISSED;
        if (behind(trial, &a->hit, k))
            return STRESS_ORDER;
    }
    truth->open = true;
    return STRESS_FINE;
}

StressVerdict stress_judge(const StressCase *which, PatchMethod method, StressTruth *truth,
                           const StressAnswer *answer) {
    Trial trial = {which, method, truth, answer};
    StressExpect expect = truth->ray->expect;
    if (expect == EXPECT_NONE)
        return answer->found || answer->any || answer->count ? STRESS_FALSE : STRESS_FINE;
    if (answer->found) {
        StressVerdict verdict = judge_hit(which, method, truth, &answer->hit);
        if (verdict != STRESS_FINE)
            return verdict;
    }
    for (int k = 0; k < answer->count; k++) {
        StressVerdict verdict = judge_hit(which, method, truth, &answer->all[k]);
        if (verdict != STRESS_FINE)
            return verdict;
    }
    StressVerdict verdict = expect == EXPECT_HIT
                                ? judge_known(&trial)
                                : judge_nearest(&trial, range_that_matters(&trial));
    if (verdict == STRESS_FINE && answer->found != answer->any && expect == EXPECT_TRUTH)
        verdict = judge_nearest(&trial, everywhere); // is there anything to differ about?
    if (verdict != STRESS_FINE)
        return verdict;
    if (answer->found != answer->any && !truth->open)
        return STRESS_DIFFER;
    if (answer->has_all && expect == EXPECT_TRUTH)
        verdict = judge_lost(&trial);
    if (answer->has_all && expect == EXPECT_TRUTH && verdict == STRESS_FINE)
        verdict = judge_twice(&trial);
    return verdict;
}

StressVerdict stress_judge_left(const StressAnswer *answer, StressTruth *truth,
                                const PatchHit *left, double bound) {
    const StressRay *r = truth->ray;
    const StressScene *s = truth->scene;
    double rounding = 8.0 * 0x1p-52 * length_of(r->ray.org), reach = bound + rounding;
    double own = 0.5 * (left->bound + rounding);
    // The same surface, as far as the bound of the hit that was left can tell? Asked in steps: from
    // t_min on in steps of that way, lest one step hold the end of the surface and another sheet.
    if (answer->found && ray_oracle_near(s->oracle, &r->ray, 0.0, answer->hit.t, own) &&
        ray_oracle_near(s->oracle, &r->ray, r->t_min, answer->hit.t, own))
        return STRESS_FALSE;
    // What was left out before t_min must have been that surface.
    RayOracleRange range = {16.0 * reach / length_of(r->ray.dir), r->t_min};
    if (range.t0 >= range.t1)
        return STRESS_FINE;
    find(truth, ORACLE_QUICK, range);
    for (int k = 0; k < truth->oracle.count; k++) {
        const RayOracleRoot *c = &truth->oracle.root[k];
        if (c->kind != ROOT_CERTAIN || c->t >= r->t_min || !(c->t > range.t0))
            continue;
        const double from[2] = {left->u, left->v}, to[2] = {c->u, c->v};
        if (!((int)left->id == c->patch &&
              ray_oracle_way(&s->defs[c->patch], &r->ray, from, to, 16.0 * reach)) &&
            !ray_oracle_along(&s->defs[left->id], &r->ray, from, c->t, 16.0 * reach) &&
            !ray_oracle_near(s->oracle, &r->ray, 0.0, c->t, 16.0 * reach))
            return STRESS_MISSED;
    }
    return STRESS_FINE;
}
