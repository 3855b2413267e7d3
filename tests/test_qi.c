// SPDX-License-Identifier: MIT
// Both QI searches against an independent judge, and at every extreme known to break others.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "patch/qi.h"
#include "patch_oracle.h"

typedef struct {
    const char *name;
    int (*all)(const Bezier *, const QiQuery *, QiStats *, QiSink, void *);
    bool (*nearest)(const Bezier *, const QiQuery *, QiStats *, QiHit *);
    bool (*any)(const Bezier *, const QiQuery *, QiStats *);
} Method;

static const Method METHODS[] = {{"paper", qi_paper_all, qi_paper_nearest, qi_paper_any},
                                 {"reduce", qi_reduce_all, qi_reduce_nearest, qi_reduce_any}};
enum { PAPER, REDUCE, METHOD_NUMBER };

typedef struct {
    int count;
    QiHit hits[QI_MAX_HITS];
    uint64_t steps;
    bool limited;
} Answer;

static void collect(void *context, const QiHit *hit) {
    Answer *a = context;
    a->hits[a->count++] = *hit;
}

// All hits, each checked against the promises of qi.h, and nearest and any against them.
static void ask(const Method *m, const Bezier *s, const QiQuery *q, Answer *a) {
    a->count = 0;
    QiStats stats = {0};
    int count = m->all(s, q, &stats, collect, a);
    a->steps = stats.steps;
    a->limited = stats.limited > 0;
    assert_int_equal(count, a->count);
    double most = q->tolerance + qi_rounding(s, q->ray.org);
    for (int k = 0; k < a->count; k++) {
        const QiHit *h = &a->hits[k];
        double off = oracle_residual(s, q->ray, h->t, h->u, h->v);
        if (!(off <= h->bound && h->bound <= most))
            fail_msg("%s: off %g, bound %g, promised %g", m->name, off, h->bound, most);
        assert_true(h->t >= q->t_min && h->t < q->t_max);
        assert_true(h->u >= q->rect.u0 && h->u <= q->rect.u1);
        assert_true(h->v >= q->rect.v0 && h->v <= q->rect.v1);
        assert_true(fabs(vec_length(h->normal) - 1.0) < 1e-12);
        assert_true(k == 0 || a->hits[k - 1].t <= h->t);
    }
    QiHit hit;
    bool found = m->nearest(s, q, NULL, &hit);
    assert_int_equal(found, a->count > 0);
    assert_int_equal(m->any(s, q, NULL), a->count > 0);
    if (found)
        assert_true(oracle_residual(s, q->ray, hit.t, hit.u, hit.v) <= hit.bound);
}

static int count_hits(const Method *m, const Bezier *s, Ray ray) {
    Answer a;
    QiQuery q = qi_query_default(s, ray);
    ask(m, s, &q, &a);
    return a.count;
}

static void net(Bezier *s, int du, int dv, Vec3 (*point)(double, double)) {
    s->du = du;
    s->dv = dv;
    for (int i = 0; i <= du; i++)
        for (int j = 0; j <= dv; j++)
            s->p[i * (dv + 1) + j] = point((double)i / du, (double)j / dv);
}

// ---- Against the judge ----

static void compare_with_judge(uint64_t seed, int du, int dv, double wild, int rays) {
    Rng rng = {seed};
    Bezier s;
    random_patch(&rng, du, dv, wild, &s);
    for (int k = 0; k < rays; k++) {
        double u = rng_unit(&rng), v = rng_unit(&rng);
        Vec3 dir = vec_scale(random_direction(&rng), rng_range(&rng, 0.1, 10.0));
        Ray ray = ray_to(&s, u, v, dir, rng_range(&rng, 0.0, 4.0));
        QiQuery q = qi_query_default(&s, ray);
        q.t_max = 1e6;
        OracleHits truth;
        oracle_hits(&s, ray, q.t_min, q.t_max, &truth);
        if (truth.doubtful)
            continue;
        for (int n = 0; n < METHOD_NUMBER; n++) {
            Answer a;
            ask(&METHODS[n], &s, &q, &a);
            if (a.count != truth.count)
                fail_msg("%s: seed %u ray %d degrees %d %d: %d hits, truth %d", METHODS[n].name,
                         (unsigned)seed, k, du, dv, a.count, truth.count);
            assert_false(a.limited);
            // A hit off by its bound lies off along the ray by bound / sine.
            for (int i = 0; i < a.count; i++)
                assert_true(fabs(a.hits[i].t - truth.hits[i].t) * vec_length(dir) *
                                truth.hits[i].sine <=
                            2.0 * a.hits[i].bound);
        }
    }
}

static void random_patches_agree_with_the_judge(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 120; seed++) {
        Rng rng = {seed};
        int du = 1 + (int)(rng_next(&rng) % 5), dv = 1 + (int)(rng_next(&rng) % 5);
        compare_with_judge(seed, du, dv, 0.1 + 0.3 * (double)(seed % 4), 4);
    }
}

static void every_degree_agrees_with_the_judge(void **state) {
    (void)state;
    for (int d = 1; d <= BEZIER_MAX_DEGREE; d++) {
        compare_with_judge(1000 + (uint64_t)d, d, d, 0.1, 1);
        compare_with_judge(2000 + (uint64_t)d, d, 1 + (d * 5) % 16, 0.1, 1);
        compare_with_judge(3000 + (uint64_t)d, 1 + (d * 11) % 4, d, 0.4, 1);
    }
}

// Halves of a patch asked one by one: together the hits of the whole, none lost in between.
static void rectangles_lose_nothing(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 60; seed++) {
        Rng rng = {seed};
        Bezier s;
        random_patch(&rng, 3, 3, 0.5, &s);
        // Through a side of the parts in every other case.
        double u = seed % 2 ? 0.375 : rng_unit(&rng), v = rng_unit(&rng);
        Ray ray = ray_to(&s, u, v, random_direction(&rng), 3.0);
        for (int n = 0; n < METHOD_NUMBER; n++) {
            Answer whole, part;
            QiQuery q = qi_query_default(&s, ray);
            ask(&METHODS[n], &s, &q, &whole);
            int sum = 0, doubles = 0;
            for (int k = 0; k < 4; k++) {
                q.rect = (BezierRect){k & 1 ? 0.375 : 0.0, k & 1 ? 1.0 : 0.375, k & 2 ? 0.625 : 0.0,
                                      k & 2 ? 1.0 : 0.625};
                ask(&METHODS[n], &s, &q, &part);
                sum += part.count;
                for (int i = 0; i < part.count; i++)
                    doubles +=
                        fabs(part.hits[i].u - 0.375) < 1e-8 || fabs(part.hits[i].v - 0.625) < 1e-8;
            }
            assert_true(sum - doubles / 2 <= whole.count && sum >= whole.count);
        }
    }
}

// ---- Many sheets ----

// Bernstein coefficients of the Chebyshev cubic: three passes over [-1,1].
static const double THRICE[4] = {-1.0, 5.0, -5.0, 1.0};

static void folded_three_times(Bezier *s) {
    s->du = s->dv = 3;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            s->p[4 * i + j] = vec3(THRICE[i], j / 3.0, i / 3.0);
}

static void folds_give_every_sheet(void **state) {
    (void)state;
    Bezier three, nine;
    folded_three_times(&three);
    nine.du = nine.dv = 3;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            nine.p[4 * i + j] = vec3(THRICE[i], THRICE[j], i / 3.0 + 4.0 * j / 3.0);
    // The roots of the cubic in [0,1]; a ray off the axes by x meets nearby ones.
    for (int n = 0; n < METHOD_NUMBER; n++) {
        Answer a;
        QiQuery q = qi_query_default(&three, (Ray){{0.0, 0.4, -1.0}, {0.0, 0.0, 1.0}});
        ask(&METHODS[n], &three, &q, &a);
        assert_int_equal(a.count, 3);
        for (int k = 0; k < 3; k++) {
            double root = 0.5 - 0.5 * cos((2 * k + 1) * acos(-1.0) / 6.0);
            assert_true(fabs(a.hits[k].u - root) < 1e-8 && fabs(a.hits[k].v - 0.4) < 1e-8);
            assert_true(fabs(a.hits[k].t - 1.0 - root) < 1e-8);
        }
        q = qi_query_default(&nine, (Ray){{0.1, -0.2, 9.0}, {0.0, 0.0, -2.0}});
        ask(&METHODS[n], &nine, &q, &a);
        assert_int_equal(a.count, 9);
        QiHit hit;
        assert_true(METHODS[n].nearest(&nine, &q, NULL, &hit));
        assert_true(fabs(hit.t - a.hits[0].t) < 1e-8);
        assert_true(hit.u > 0.8 && hit.v > 0.8); // the largest z is met first
        q.t_min = 0.5 * (a.hits[3].t + a.hits[4].t);
        q.t_max = 0.5 * (a.hits[5].t + a.hits[6].t);
        ask(&METHODS[n], &nine, &q, &a);
        assert_int_equal(a.count, 2);
    }
}

// Two sheets 1e-6 apart: the first is the nearest, and both are there.
static Vec3 thin_fold(double u, double v) {
    return vec3(u < 0.5 ? 0.0 : 1.0, v, u == 0.0 || u == 1.0 ? 0.0 : u < 0.5 ? 0.0 : 0.0);
}

static void thin_sheets_stay_apart(void **state) {
    (void)state;
    Bezier s;
    net(&s, 3, 3, thin_fold);
    for (int j = 0; j < 4; j++) {
        s.p[j] = vec3(0.0, j / 3.0, 0.0);
        s.p[4 + j] = vec3(1.0, j / 3.0, 0.0);
        s.p[8 + j] = vec3(1.0, j / 3.0, 1e-6);
        s.p[12 + j] = vec3(0.0, j / 3.0, 1e-6);
    }
    Rng rng = {4};
    for (int k = 0; k < 50; k++) {
        Ray ray = {{rng_range(&rng, 0.05, 0.7), rng_unit(&rng), 2.0}, {0.0, 0.0, -1.0}};
        for (int n = 0; n < METHOD_NUMBER; n++) {
            Answer a;
            QiQuery q = qi_query_default(&s, ray);
            ask(&METHODS[n], &s, &q, &a);
            assert_int_equal(a.count, 2);
            assert_true(a.hits[0].u > 0.5 && a.hits[1].u < 0.5);
        }
    }
}

// ---- Edges, corners, collapsed edges ----

// Rays at points of a shared edge, and at the corner of four: at least one patch is hit.
static void shared_edges_are_tight(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 150; seed++) {
        Rng rng = {seed};
        Bezier parts[4];
        for (int k = 0; k < 4; k++)
            random_patch(&rng, 3, 3, 0.08, &parts[k]);
        // 0 and 1 beside each other along u, 2 and 3 above them: equal rows, one of them reversed.
        for (int m = 0; m < 4; m++) {
            parts[1].p[m] = parts[0].p[12 + m];
            parts[2].p[4 * m] = parts[0].p[4 * m + 3];
            parts[3].p[m] = parts[2].p[12 + m];
        }
        for (int m = 0; m < 4; m++)
            parts[3].p[4 * m] = parts[1].p[4 * m + 3];
        double v = seed % 3 ? rng_unit(&rng) : 1.0;
        Vec3 dir = random_direction(&rng);
        dir.z = -1.0 - fabs(dir.z);
        Ray ray = ray_to(&parts[0], 1.0, v, dir, 5.0);
        for (int n = 0; n < METHOD_NUMBER; n++) {
            int hit = 0;
            for (int k = 0; k < 4; k++)
                hit += count_hits(&METHODS[n], &parts[k], ray);
            if (hit < 1)
                fail_msg("%s: seed %u went through", METHODS[n].name, (unsigned)seed);
        }
    }
}

// One quarter turned by 90 degrees, exactly.
static void turn(Bezier *s) {
    for (int k = 0; k < bezier_count(s); k++)
        s->p[k] = vec3(-s->p[k].y, s->p[k].x, s->p[k].z);
}

static void collapsed_edges_are_tight(void **state) {
    (void)state;
    void (*const make[2])(Bezier *) = {teapot_lid, teapot_bottom};
    for (int part = 0; part < 2; part++) {
        Bezier s[4];
        make[part](&s[0]);
        for (int k = 1; k < 4; k++) {
            bezier_copy(&s[k], &s[k - 1]);
            turn(&s[k]);
        }
        Rng rng = {(uint64_t)part};
        for (int k = 0; k < 60; k++) {
            double off = k % 13 == 0 ? 0.0 : pow(10.0, -(double)(k % 13));
            double angle = k % 2 ? rng_range(&rng, 0.0, 6.3) : 0.0;
            Vec3 dir = random_direction(&rng);
            dir.z = -0.3 - fabs(dir.z);
            Vec3 top = vec_add(s[0].p[0], vec3(off * cos(angle), off * sin(angle), 0.0));
            Ray ray = {vec_madd(top, -7.0, dir), dir};
            for (int n = 0; n < METHOD_NUMBER; n++) {
                int hit = 0;
                double t = INFINITY;
                for (int m = 0; m < 4; m++) {
                    Answer a;
                    QiQuery q = qi_query_default(&s[m], ray);
                    ask(&METHODS[n], &s[m], &q, &a);
                    hit += a.count;
                    assert_true(a.steps < 600);
                    if (a.count && a.hits[0].t < t) {
                        t = a.hits[0].t;
                        // Both are level at the pole; the lid's slope there is 0.
                        if (off < 1e-3 && fabs(t - 7.0) < 1e-2)
                            assert_true(fabs(fabs(a.hits[0].normal.z) - 1.0) < 1e-3);
                    }
                    if (off == 0.0)
                        assert_true(a.count == 1 || (a.count > 0 && a.hits[1].t > 7.001));
                }
                assert_true(hit >= 1);
                // The pole is flat: the surface is within about off^2 of the level of its top.
                assert_true(fabs(t - 7.0) <= 20.0 * off * off + 1e-7);
            }
        }
    }
}

// x = s^3 over z = s^2: a cusp along v. The ray along z crosses it once, with multiplicity three.
static void cusps_are_crossed_once(void **state) {
    (void)state;
    static const double cube[4] = {-1.0, 1.0, -1.0, 1.0},
                        square[4] = {1.0, -1.0 / 3, -1.0 / 3, 1.0};
    Bezier s = {.du = 3, .dv = 3};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            s.p[4 * i + j] = vec3(cube[i], j / 3.0, square[i]);
    for (int n = 0; n < METHOD_NUMBER; n++) {
        assert_int_equal(count_hits(&METHODS[n], &s, (Ray){{0, 0.4, 5}, {0, 0, -1}}), 1);
        assert_int_equal(count_hits(&METHODS[n], &s, (Ray){{-1, 0.4, 1e-3}, {1, 0, 0}}), 2);
        assert_int_equal(count_hits(&METHODS[n], &s, (Ray){{-1, 0.4, -1e-3}, {1, 0, 0}}), 0);
        assert_true(count_hits(&METHODS[n], &s, (Ray){{-1, 0.4, 0}, {1, 0, 0}}) <= 1);
    }
}

// ---- Misses, ranges, tangents ----

static Vec3 bump(double u, double v) {
    double h = (u > 0.2 && u < 0.8) && (v > 0.2 && v < 0.8) ? 1.0 : 0.0;
    return vec3(u, v, h);
}

static void every_way_to_miss(void **state) {
    (void)state;
    Bezier s;
    net(&s, 3, 3, bump);
    double top = bezier_eval(&s, 0.5, 0.5).z, size = bezier_diameter(&s);
    const Ray misses[] = {
        {{1.1, 0.5, 2}, {0, 0, -1}},               // beside
        {{1.0 + 1e-6, 0.5, 2}, {0, 0, -1}},        // just beside
        {{0.5, 0.5, 2}, {0, 0, 1}},                // behind
        {{-1, 0.5, 2}, {1, 0, 0}},                 // parallel, above
        {{-1, 0.5, top + 1e-8 * size}, {1, 0, 0}}, // above the tangent by 10 tolerances
        {{-1, 0.5, -1e-8 * size}, {1, 0, 0}},      // below the border's plane
        {{0.5, 0.5, 2}, {0, 0, 0}},                // no direction
        {{NAN, 0.5, 2}, {0, 0, -1}},               // no numbers
        {{0.5, 0.5, INFINITY}, {0, 0, -1}},
        {{0.5, 0.5, 2}, {0, NAN, -1}},
    };
    for (int n = 0; n < METHOD_NUMBER; n++) {
        for (size_t k = 0; k < sizeof misses / sizeof misses[0]; k++) {
            QiQuery q = qi_query_default(&s, misses[k]);
            if (METHODS[n].all(&s, &q, NULL, NULL, NULL) != 0 || METHODS[n].any(&s, &q, NULL))
                fail_msg("%s: miss %d was hit", METHODS[n].name, (int)k);
        }
        // The hit at t = 2 - top: excluded by either end of the range, included by t_min itself.
        QiQuery q = qi_query_default(&s, (Ray){{0.5, 0.5, 2}, {0, 0, -1}});
        QiHit hit, again;
        assert_true(METHODS[n].nearest(&s, &q, NULL, &hit));
        assert_true(fabs(hit.t - (2.0 - top)) < 1e-8);
        q.t_min = hit.t + 1e-7;
        assert_false(METHODS[n].any(&s, &q, NULL));
        q.t_min = 0.0;
        q.t_max = hit.t - 1e-7;
        assert_false(METHODS[n].any(&s, &q, NULL));
        q.t_max = hit.t;
        assert_false(METHODS[n].any(&s, &q, NULL));
        q.t_min = hit.t;
        q.t_max = INFINITY;
        assert_true(METHODS[n].nearest(&s, &q, NULL, &again) && again.t == hit.t);
        q.t_min = q.t_max = 1.0;
        assert_false(METHODS[n].any(&s, &q, NULL));
    }
}

// Below the top of the bump by delta: in and out again, at sqrt(delta / 9) to either side. Above
// by more than the tolerance: nothing.
static void grazing_rays(void **state) {
    (void)state;
    Bezier s;
    net(&s, 3, 3, bump);
    double top = bezier_eval(&s, 0.5, 0.5).z;
    for (int n = 0; n < METHOD_NUMBER; n++) {
        for (double delta = 1e-2; delta > 0.9e-8; delta *= 0.01) {
            Answer a;
            QiQuery q = qi_query_default(&s, (Ray){{-1, 0.5, top - delta}, {1, 0, 0}});
            ask(&METHODS[n], &s, &q, &a);
            assert_int_equal(a.count, 2);
            // z = 9 (3/4) u^2 (1-u)^2 ... is 3 u (1 - u) * 3/4 at v = 1/2.
            double half = sqrt(delta / 2.25);
            assert_true(fabs(a.hits[1].u - a.hits[0].u - 2.0 * half) < 1e-9 / half + 1e-9);
            q.ray.org.z = top + delta;
            ask(&METHODS[n], &s, &q, &a);
            assert_int_equal(a.count, 0);
        }
    }
    // With the tolerance at rounding the reduction tells 1e-12 apart.
    Answer a;
    QiQuery q = qi_query_default(&s, (Ray){{-1, 0.5, top - 1e-12}, {1, 0, 0}});
    q.tolerance = 0.0;
    ask(&METHODS[REDUCE], &s, &q, &a);
    assert_int_equal(a.count, 2);
    q.ray.org.z = top + 1e-12;
    ask(&METHODS[REDUCE], &s, &q, &a);
    assert_int_equal(a.count, 0);
}

// Rays tangent to the surface to the last bit, with the contact in any direction of the parameters:
// one answer or none, and no long search.
static void exact_tangents_are_cheap(void **state) {
    (void)state;
    Rng rng = {21};
    for (int k = 0; k < 200; k++) {
        Bezier s;
        random_patch(&rng, 2 + k % 3, 2 + k % 2, 0.2, &s);
        double u = rng_range(&rng, 0.1, 0.9), v = rng_range(&rng, 0.1, 0.9);
        Vec3 su, sv;
        bezier_eval1(&s, u, v, &su, &sv);
        double angle = rng_range(&rng, 0.0, 6.3);
        Vec3 dir = vec_add(vec_scale(su, cos(angle)), vec_scale(sv, sin(angle)));
        Answer a;
        QiQuery q = qi_query_default(&s, ray_to(&s, u, v, dir, 2.0));
        ask(&METHODS[REDUCE], &s, &q, &a);
        assert_true(a.steps < 600);
        assert_true(a.count < 12);
    }
}

// ---- Sizes ----

static void moved(const Bezier *s, double scale, Vec3 by, Vec3 stretch, Bezier *out) {
    bezier_copy(out, s);
    for (int k = 0; k < bezier_count(s); k++)
        out->p[k] = vec_add(vec_scale(vec_mul(s->p[k], stretch), scale), by);
}

// The same rays in units from 1e-150 to 1e150 must give the same hits.
static void scale_does_not_matter(void **state) {
    (void)state;
    const double scales[] = {1e-150, 1e-30, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e30, 1e150};
    for (uint64_t seed = 0; seed < 30; seed++) {
        Rng rng = {seed};
        Bezier s, big;
        random_patch(&rng, 3, 3, 0.3, &s);
        double u = rng_unit(&rng), v = rng_unit(&rng);
        Ray ray = ray_to(&s, u, v, random_direction(&rng), 3.0);
        OracleHits truth;
        oracle_hits(&s, ray, 0.0, 1e9, &truth);
        if (truth.doubtful)
            continue;
        for (size_t k = 0; k < sizeof scales / sizeof scales[0]; k++) {
            moved(&s, scales[k], vec3(0, 0, 0), vec3(1, 1, 1), &big);
            Ray far = {vec_scale(ray.org, scales[k]),
                       vec_scale(ray.dir, seed % 2 ? scales[k] : 1.0)};
            for (int n = 0; n < METHOD_NUMBER; n++) {
                QiQuery q = qi_query_default(&big, far);
                QiHit hit;
                assert_int_equal(METHODS[n].all(&big, &q, NULL, NULL, NULL), truth.count);
                assert_true(METHODS[n].nearest(&big, &q, NULL, &hit));
                double t = seed % 2 ? hit.t : hit.t / scales[k];
                assert_true(fabs(t - truth.hits[0].t) < 1e-5);
                assert_true(hit.bound <= 2e-9 * bezier_diameter(&big));
            }
        }
    }
}

static void offset_and_aspect(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 40; seed++) {
        Rng rng = {seed};
        Bezier s, other;
        random_patch(&rng, 3, 3, 0.1, &s);
        // Far from the origin, camera near: only the input's own rounding is left.
        Vec3 far = vec3(1e7, -3e7, 2e7);
        double u = rng_range(&rng, 0.05, 0.95), v = rng_range(&rng, 0.05, 0.95);
        Vec3 dir = random_direction(&rng);
        moved(&s, 1.0, far, vec3(1, 1, 1), &other);
        for (int n = 0; n < METHOD_NUMBER; n++)
            assert_true(count_hits(&METHODS[n], &other, ray_to(&other, u, v, dir, 3.0)) > 0);
        // Camera 1e7 away from a patch of size 1.
        for (int n = 0; n < METHOD_NUMBER; n++)
            assert_true(count_hits(&METHODS[n], &s, ray_to(&s, u, v, dir, 1e7)) > 0);
        // 1e10 times longer than wide, in each direction; also seen by rays that were stretched
        // with it, which are edge-on to 1e-10. Where u and v lines become parallel within 1e-10,
        // and for such rays, the squares of the paper give up; the reduction does not notice.
        const Vec3 stretches[] = {{1e10, 1, 1}, {1, 1e10, 1}, {1, 1, 1e-10}, {1, 1e-10, 1}};
        for (int k = 0; k < 4; k++) {
            moved(&s, 1.0, vec3(0, 0, 0), stretches[k], &other);
            Vec3 at = bezier_eval(&other, u, v), along = vec_mul(dir, stretches[k]);
            for (int n = k < 2 ? REDUCE : PAPER; n < METHOD_NUMBER; n++) {
                Answer a;
                QiQuery q = qi_query_default(&other, (Ray){vec_madd(at, -3.0, dir), dir});
                q.tolerance = 0.0;
                ask(&METHODS[n], &other, &q, &a);
                assert_true(a.count > 0);
                assert_false(a.limited);
                if (n == PAPER)
                    continue;
                q.ray = (Ray){vec_madd(at, -3.0, along), along};
                OracleHits truth;
                Ray plain = ray_to(&s, u, v, dir, 3.0);
                oracle_hits(&s, plain, 0.0, 1e9, &truth);
                ask(&METHODS[n], &other, &q, &a);
                if (!truth.doubtful)
                    assert_int_equal(a.count, truth.count);
                assert_false(a.limited);
            }
        }
    }
}

// ---- Infinitely many answers ----

static Vec3 flat(double u, double v) { return vec3(u + 0.1 * u * v, v - 0.1 * u * v, 0.0); }
static Vec3 saddle(double u, double v) { return vec3(u, v, u * v); }
static Vec3 nowhere(double u, double v) {
    (void)u, (void)v;
    return vec3(1.0, 2.0, 3.0);
}
static Vec3 segment(double u, double v) { return vec3(u * v + 0.3 * u, 0.0, 0.0); }
static Vec3 slope(double u, double v) {
    (void)v;
    return vec3(u, u / 3.0, 0.0);
}

static void degenerate_patches_answer_in_bounded_time(void **state) {
    (void)state;
    const struct {
        Vec3 (*make)(double, double);
        Ray ray;
        double first; // smallest t that is an answer
    } cases[] = {
        {flat, {{-1, 0.3, 0}, {1, 0, 0}}, 1.0},           // edge-on
        {flat, {{-1, -0.7, 0}, {1, 1, 0}}, 1.0},          // edge-on, askew
        {flat, {{0.5, 0.5, 0}, {1, 1, 0}}, 0.0},          // from inside the plane
        {saddle, {{0.25, -1, -0.25}, {0, 1, 0.25}}, 1.0}, // along a ruling
        {saddle, {{-1, 0, 0}, {1, 0, 0}}, 1.0},           // along an edge
        {nowhere, {{0, 0, 0}, {1, 2, 3}}, 1.0},           // 16 equal points
        {segment, {{0.4, -1, -1}, {0, 1, 1}}, 1.0},       // across a segment
        {segment, {{-1, 0, 0}, {1, 0, 0}}, 1.0},          // along it
        {slope, {{0.3, 0.1, -2}, {0, 0, 1}}, 2.0},        // a patch that is a curve
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        Bezier s;
        net(&s, 3, 3, cases[k].make);
        for (int n = 0; n < METHOD_NUMBER; n++) {
            Answer a;
            QiQuery q = qi_query_default(&s, cases[k].ray);
            ask(&METHODS[n], &s, &q, &a);
            if (a.count == 0)
                fail_msg("%s: degenerate case %d has no answer", METHODS[n].name, (int)k);
            assert_true(a.steps <= 4u * (uint64_t)qi_work_limit(&s));
            QiHit hit;
            QiStats stats = {0};
            assert_true(METHODS[n].nearest(&s, &q, &stats, &hit));
            assert_true(stats.steps <= (n == REDUCE ? 200 : 4u * (uint64_t)qi_work_limit(&s)));
            // The paper's loop answers with sides of its last squares.
            assert_true(hit.t >= cases[k].first - 1e-8);
            if (n == REDUCE)
                assert_true(hit.t <= cases[k].first + 1e-8);
        }
    }
}

// ---- Habits ----

// Rays through parameters where pieces meet: one hit each, not two.
static void seams_between_pieces_report_once(void **state) {
    (void)state;
    const double at[] = {0.5, 1.0 / 3, 2.0 / 3, 0.25, 0.75, 1.0 / 9, 4.0 / 9, 0.0, 1.0, 0.375};
    enum { N = sizeof at / sizeof at[0] };
    Rng rng = {9};
    Bezier s;
    random_patch(&rng, 3, 3, 0.02, &s); // not wild: one crossing for steep rays
    for (int k = 0; k < N * N; k++) {
        Vec3 dir = vec3(0.05 * rng_unit(&rng), 0.05 * rng_unit(&rng), -1.0);
        Ray ray = ray_to(&s, at[k / N], at[k % N], dir, 2.0);
        bool border = fmin(at[k / N], at[k % N]) == 0.0 || fmax(at[k / N], at[k % N]) == 1.0;
        for (int n = 0; n < METHOD_NUMBER; n++) {
            int count = count_hits(&METHODS[n], &s, ray);
            assert_true(count == 1 || (border && count == 0));
        }
    }
}

// A ray that starts on the surface and leaves: nothing beyond the rounding of its start.
static void leaving_rays_do_not_hit_again(void **state) {
    (void)state;
    Bezier s;
    net(&s, 3, 3, bump);
    Rng rng = {11};
    for (int k = 0; k < 100; k++) {
        double u = rng_unit(&rng), v = rng_unit(&rng);
        Vec3 normal = bezier_normal(&s, u, v, vec3(0, 0, 1));
        QiQuery q = qi_query_default(&s, (Ray){bezier_eval(&s, u, v), normal});
        q.t_min = 4e-9 * bezier_diameter(&s);
        for (int n = 0; n < METHOD_NUMBER; n++)
            assert_false(METHODS[n].any(&s, &q, NULL));
    }
}

static void signed_zeros_and_lengths(void **state) {
    (void)state;
    Bezier s;
    net(&s, 3, 3, bump);
    const double lengths[] = {1e-300, 1e-20, 0.3, 1.0, 1e20, 1e300};
    for (size_t k = 0; k < sizeof lengths / sizeof lengths[0]; k++) {
        for (int n = 0; n < METHOD_NUMBER; n++) {
            QiQuery q = qi_query_default(&s, (Ray){{0.3, 0.6, 2}, {-0.0, 0.0, -lengths[k]}});
            QiHit hit;
            assert_true(METHODS[n].nearest(&s, &q, NULL, &hit));
            double z = bezier_eval(&s, 0.3, 0.6).z;
            assert_true(fabs(hit.t * lengths[k] - (2.0 - z)) < 1e-8);
            assert_true(fabs(hit.u - 0.3) < 1e-8 && fabs(hit.v - 0.6) < 1e-8);
        }
    }
}

static void loose_tolerances_are_kept(void **state) {
    (void)state;
    Rng rng = {12};
    for (int k = 0; k < 60; k++) {
        Bezier s;
        random_patch(&rng, 1 + k % 5, 1 + k % 3, 0.2, &s);
        double u = rng_unit(&rng), v = rng_unit(&rng);
        QiQuery q = qi_query_default(&s, ray_to(&s, u, v, random_direction(&rng), 2.0));
        for (double tolerance = 0.1; tolerance > 1e-16; tolerance *= 0.05) {
            q.tolerance = tolerance;
            for (int n = 0; n < METHOD_NUMBER; n++) {
                Answer a;
                ask(&METHODS[n], &s, &q, &a);
                // Aimed at the surface: only rays at the border may slip past by rounding.
                assert_true(a.count > 0);
            }
        }
    }
}

// ---- What the stress found

// A range that begins on a pole, a little more or less: what lies there is one place, in the range
// or not. Every slice of the patch was halved down to the last bit: 3,000 nets for each piece.
static void ranges_that_begin_on_a_pole_are_cheap(void **state) {
    (void)state;
    Bezier lid;
    teapot_lid(&lid);
    Rng rng = {22};
    for (int k = 0; k < 100; k++) {
        Vec3 dir = random_direction(&rng);
        QiQuery q = qi_query_default(&lid, (Ray){vec_sub(lid.p[0], dir), dir});
        q.t_min = 1.0 + (k % 3 - 1) * 1e-15;
        Answer a;
        ask(&METHODS[REDUCE], &lid, &q, &a);
        assert_true(a.steps < 300);
        assert_false(a.limited);
    }
}

// All points on one line, back and forth, and the ray along it: the smallest t of the whole patch.
// It was the t of whichever point the last steps of Newton's came to.
static void first_depth_along_a_segment(void **state) {
    (void)state;
    Rng rng = {23};
    for (int k = 0; k < 50; k++) {
        Bezier s = {.du = 3, .dv = 3};
        double least = 1.0;
        for (int i = 0; i < 16; i++) {
            double t = (double)(rng_next(&rng) % 65) / 64.0;
            s.p[i] = vec3(t, 2.0 * t, -t);
        }
        for (int i = 0; i <= 200; i++)
            for (int j = 0; j <= 200; j++)
                least = fmin(least, bezier_eval(&s, i / 200.0, j / 200.0).x);
        QiQuery q = qi_query_default(&s, (Ray){{-1, -2, 1}, {1, 2, -1}});
        QiHit hit;
        QiStats stats = {0};
        assert_true(qi_reduce_nearest(&s, &q, &stats, &hit));
        assert_true(hit.t <= 1.0 + least + 1e-8);
        assert_true(hit.t >= 1.0 + least - 1e-3); // the grid is no finer
        assert_true(stats.steps < 600);
        // And from within: the place where the ray begins.
        q.ray.org = vec3(0.0, 0.0, 0.0);
        q.t_min = 0.5 * (least + bezier_eval(&s, 0.5, 0.5).x);
        assert_true(qi_reduce_nearest(&s, &q, NULL, &hit));
        assert_true(hit.t >= q.t_min && hit.t <= q.t_min + 1e-8);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_patches_agree_with_the_judge),
        cmocka_unit_test(every_degree_agrees_with_the_judge),
        cmocka_unit_test(rectangles_lose_nothing),
        cmocka_unit_test(folds_give_every_sheet),
        cmocka_unit_test(thin_sheets_stay_apart),
        cmocka_unit_test(shared_edges_are_tight),
        cmocka_unit_test(collapsed_edges_are_tight),
        cmocka_unit_test(cusps_are_crossed_once),
        cmocka_unit_test(every_way_to_miss),
        cmocka_unit_test(grazing_rays),
        cmocka_unit_test(exact_tangents_are_cheap),
        cmocka_unit_test(scale_does_not_matter),
        cmocka_unit_test(offset_and_aspect),
        cmocka_unit_test(degenerate_patches_answer_in_bounded_time),
        cmocka_unit_test(seams_between_pieces_report_once),
        cmocka_unit_test(leaving_rays_do_not_hit_again),
        cmocka_unit_test(signed_zeros_and_lengths),
        cmocka_unit_test(loose_tolerances_are_kept),
        cmocka_unit_test(ranges_that_begin_on_a_pole_are_cheap),
        cmocka_unit_test(first_depth_along_a_segment),
    };
    return cmocka_run_group_tests_name("qi", tests, NULL, NULL);
}
