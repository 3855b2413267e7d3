// SPDX-License-Identifier: MIT
// See rational.h.
#include "patch/rational.h"

#include "patch/bernstein.h"
#include "patch/qi.h"
#include "patch/refine.h"

void rational_eval(const Bezier *patch, const double *weights, double u, double v, Vec3 out[3]) {
    double wu[BEZIER_MAX_DEGREE + 1], su[BEZIER_MAX_DEGREE + 1];
    double wv[BEZIER_MAX_DEGREE + 1], sv[BEZIER_MAX_DEGREE + 1], w = 0.0, w_u = 0.0, w_v = 0.0;
    bernstein(patch->du, u, wu, su);
    bernstein(patch->dv, v, wv, sv);
    Vec3 n = vec3(0.0, 0.0, 0.0), n_u = n, n_v = n;
    for (int i = 0, k = 0; i <= patch->du; i++) {
        for (int j = 0; j <= patch->dv; j++, k++) {
            double weight = weights ? weights[k] : 1.0;
            double b = weight * wu[i] * wv[j], b_u = weight * su[i] * wv[j],
                   b_v = weight * wu[i] * sv[j];
            w += b;
            w_u += b_u;
            w_v += b_v;
            n = vec_madd(n, b, patch->p[k]);
            n_u = vec_madd(n_u, b_u, patch->p[k]);
            n_v = vec_madd(n_v, b_v, patch->p[k]);
        }
    }
    out[0] = vec_scale(n, 1.0 / w);
    out[1] = vec_scale(vec_madd(n_u, -w_u, out[0]), 1.0 / w);
    out[2] = vec_scale(vec_madd(n_v, -w_v, out[0]), 1.0 / w);
}

enum { LINE = BEZIER_MAX_DEGREE + 1 };

// B_i' B_k - B_k' B_i = C(n,i) C(n,k) (i - k) t^(i+k-1) (1-t)^(2n-i-k-1) for i > k: no difference
// of numbers nearly equal.
static void cross_basis(int n, double t, double out[LINE][LINE]) {
    double low[2 * LINE] = {1.0}, high[2 * LINE] = {1.0}, choose[LINE] = {1.0};
    for (int i = 1; i <= 2 * n - 2; i++) {
        low[i] = low[i - 1] * t;
        high[i] = high[i - 1] * (1.0 - t);
    }
    for (int i = 1; i <= n; i++)
        choose[i] = choose[i - 1] * (n - i + 1) / i;
    for (int i = 1; i <= n; i++)
        for (int k = 0; k < i; k++)
            out[i][k] = choose[i] * choose[k] * (i - k) * low[i + k - 1] * high[2 * n - i - k - 1];
}

// A net's points and weights by rows along one of its directions.
typedef struct {
    const Bezier *patch;
    int along, across;               // degrees
    int step_along, step_across;     // of indices
    double cross[LINE][LINE];        // of the one
    double terms[BEZIER_MAX_POINTS]; // weights times the basis of the other
} Tangent;

// dS/dt W^2 = sum of w_a w_b (B_a' B_b - B_b' B_a) (P_a - P_b) over pairs, where the basis across
// comes out as a factor. So points equal along t, or weights far larger on one side, leave the
// tangent its relative accuracy, however short it is. *scale is the same sum of the terms' lengths.
static Vec3 tangent(const Tangent *s, double *scale) {
    Vec3 sum = vec3(0.0, 0.0, 0.0);
    *scale = 0.0;
    for (int i = 1; i <= s->along; i++) {
        for (int k = 0; k < i; k++) {
            for (int m = 0; m <= s->across; m++) {
                int a = i * s->step_along + m * s->step_across;
                double times = s->cross[i][k] * s->terms[a];
                for (int n = 0; n <= s->across; n++) {
                    int b = k * s->step_along + n * s->step_across;
                    Vec3 between = vec_sub(s->patch->p[a], s->patch->p[b]);
                    double factor = times * s->terms[b];
                    sum = vec_madd(sum, factor, between);
                    *scale += factor * vec_length(between);
                }
            }
        }
    }
    return sum;
}

// The product of the tangents, by their lengths; false if rounding can explain it.
static bool normal_at(const Bezier *patch, const double *weights, double u, double v,
                      Vec3 *normal) {
    double wu[LINE], wv[LINE], slope[LINE], most = 0.0;
    Tangent along_u = {patch, patch->du, patch->dv, patch->dv + 1, 1, .terms = {0.0}};
    Tangent along_v = {patch, patch->dv, patch->du, 1, patch->dv + 1, .terms = {0.0}};
    bernstein(patch->du, u, wu, slope);
    bernstein(patch->dv, v, wv, slope);
    cross_basis(patch->du, u, along_u.cross);
    cross_basis(patch->dv, v, along_v.cross);
    for (int k = 0; k < bezier_count(patch); k++)
        most = fmax(most, weights ? weights[k] : 1.0);
    for (int i = 0, k = 0; i <= patch->du; i++) {
        for (int j = 0; j <= patch->dv; j++, k++) {
            double w = weights ? weights[k] / most : 1.0;
            along_u.terms[k] = w * wv[j];
            along_v.terms[k] = w * wu[i];
        }
    }
    double scale_u, scale_v;
    Vec3 tu = tangent(&along_u, &scale_u), tv = tangent(&along_v, &scale_v);
    double lu = vec_length(tu), lv = vec_length(tv);
    // Terms err by 4 (du + dv) + 8 half ulps; with 2^24 of them 8 digits of the direction are left.
    double share = 0x1p24 * 0x1p-53 * (4.0 * (patch->du + patch->dv) + 8.0);
    if (!(lu > share * scale_u && lv > share * scale_v))
        return false;
    Vec3 n = vec_cross(vec_scale(tu, 1.0 / lu), vec_scale(tv, 1.0 / lv));
    double sine = vec_length(n);
    if (!(sine > share * (scale_u / lu + scale_v / lv)))
        return false;
    *normal = vec_scale(n, 1.0 / sine);
    return true;
}

// Where the tangents span no plane, the place where they do on the way towards the farther sides
// stands for the limit: 2^-30 of that way is far enough, since the tangents are relatively exact.
// For curves and points it is as bezier_normal() has it.
Vec3 rational_normal(const Bezier *patch, const double *weights, double u, double v, Vec3 facing) {
    static const double steps[] = {0.0, 0x1p-30, 0x1p-20, 0x1p-10};
    double far_u = u > 0.5 ? -u : 1.0 - u, far_v = v > 0.5 ? -v : 1.0 - v;
    for (int k = 0; k < 4; k++) {
        Vec3 normal;
        if (normal_at(patch, weights, u + steps[k] * far_u, v + steps[k] * far_v, &normal))
            return normal;
    }
    return bezier_normal(patch, u, v, facing);
}

// ---- METHOD_QI

struct Rational {
    Refined refined;
};

Rational *rational_create(Arena *arena, const PatchDef *defs, size_t count) {
    Rational *rational = ARENA_NEW(arena, Rational);
    // Of no great influence: qi_reduce_* converges from anywhere.
    refine_build(arena, defs, count, 0.1, &rational->refined);
    return rational;
}

typedef struct {
    RefineWalk *walk;
    Bezier patch;
} Search;

static void take_hit(void *context, const QiHit *hit) {
    Search *s = context;
    const PatchDef *def = s->walk->ray.patch->def;
    PatchHit full = {hit->t, hit->u, hit->v, hit->normal, hit->bound, def->id};
    refine_take(s->walk, &full);
}

static void search(RefineWalk *walk, const SubPatch *sub) {
    Query *query = walk->query;
    const PatchDef *def = walk->ray.patch->def;
    Search s = {.walk = walk};
    bezier_init(&s.patch, (int)def->degree_u, (int)def->degree_v, def->points);
    QiQuery ask = {query->ray, query->t_min, query->t_max, def->tolerance, sub->rect, NULL};
    QiStats stats = {0};
    QiHit hit;
    if (query->kind == QUERY_ALL)
        qi_rational_all(&s.patch, def->weights, &ask, &stats, take_hit, &s);
    else if (qi_rational_nearest(&s.patch, def->weights, &ask, &stats, &hit))
        take_hit(&s, &hit);
    query->stats.steps += stats.steps;
    query->stats.newton += stats.newton;
}

void rational_query(const Rational *rational, Query *query) {
    refine_query(&rational->refined, query, search);
}
