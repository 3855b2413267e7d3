// SPDX-License-Identifier: MIT
// B-splines as Bézier patches against their definition: basis functions by Cox and de Boor's
// recursion, in long double.
#include "patch_oracle.h"

#include "base/rng.h"
#include "patch/bspline.h"
#include "patch/rational.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MAX_ROW = 24 };

// N_i^d(t) over whole knots.
static long double basis(const double *knots, int i, int d, long double t) {
    if (d == 0)
        return t >= knots[i] && t < knots[i + 1] ? 1.0L : 0.0L;
    long double left = (long double)knots[i + d] - knots[i],
                right = (long double)knots[i + d + 1] - knots[i + 1], sum = 0.0L;
    if (left > 0)
        sum += (t - knots[i]) / left * basis(knots, i, d - 1, t);
    if (right > 0)
        sum += (knots[i + d + 1] - t) / right * basis(knots, i + 1, d - 1, t);
    return sum;
}

typedef struct {
    int du, dv, rows, columns;
    double knots_u[MAX_ROW * 2], knots_v[MAX_ROW * 2];
    Vec3 points[MAX_ROW * MAX_ROW];
    double weights[MAX_ROW * MAX_ROW];
    bool rational;
} Surface;

static Vec3 surface_point(const Surface *s, long double u, long double v) {
    long double sum[4] = {0};
    for (int i = 0; i < s->rows; i++) {
        long double bu = basis(s->knots_u, i, s->du, u);
        for (int j = 0; j < s->columns && bu != 0; j++) {
            int k = i * s->columns + j;
            long double b =
                bu * basis(s->knots_v, j, s->dv, v) * (s->rational ? s->weights[k] : 1.0);
            sum[0] += b * s->points[k].x;
            sum[1] += b * s->points[k].y;
            sum[2] += b * s->points[k].z;
            sum[3] += b;
        }
    }
    return vec3((double)(sum[0] / sum[3]), (double)(sum[1] / sum[3]), (double)(sum[2] / sum[3]));
}

// n + d + 1 knots: growing at random, some repeated, ends perhaps clamped.
static void random_knots(Rng *rng, int n, int d, double *knots) {
    bool clamped = rng_next(rng) % 2;
    double at = rng_range(rng, -3, 3);
    for (int i = 0; i < n + d + 1; i++) {
        bool repeat = clamped ? i <= d || i > n : i > 0 && i + 1 < n && rng_next(rng) % 6 == 0;
        if (i > 0 && !repeat)
            at += rng_range(rng, 0.05, 2.0);
        else if (clamped && i == n + 1)
            at = knots[n];
        knots[i] = at;
    }
}

static void random_surface(Rng *rng, Surface *s) {
    s->du = 1 + (int)(rng_next(rng) % 5);
    s->dv = 1 + (int)(rng_next(rng) % 5);
    s->rows = s->du + 1 + (int)(rng_next(rng) % 4);
    s->columns = s->dv + 1 + (int)(rng_next(rng) % 4);
    s->rational = rng_next(rng) % 2;
    random_knots(rng, s->rows, s->du, s->knots_u);
    random_knots(rng, s->columns, s->dv, s->knots_v);
    for (int k = 0; k < s->rows * s->columns; k++) {
        s->points[k] = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        s->weights[k] = exp(rng_range(rng, -2, 2));
    }
}

// The span whose first control point is (i,j), as a Bézier patch.
static void span_at(const Surface *s, int i, int j, Bezier *out, double *weights) {
    Vec3 points[BEZIER_MAX_POINTS];
    double own[BEZIER_MAX_POINTS];
    for (int a = 0, k = 0; a <= s->du; a++) {
        for (int b = 0; b <= s->dv; b++, k++) {
            points[k] = s->points[(i + a) * s->columns + j + b];
            own[k] = s->weights[(i + a) * s->columns + j + b];
        }
    }
    BsplineSpan span = {
        s->du, s->dv, points, s->rational ? own : NULL, s->knots_u + i + 1, s->knots_v + j + 1};
    assert_null(bspline_knots_fault(span.knots_u, s->du));
    assert_null(bspline_knots_fault(span.knots_v, s->dv));
    out->du = s->du;
    out->dv = s->dv;
    bspline_span(&span, out->p, weights);
}

// Every span of random surfaces, at random places, to 1e-14 of the points' size.
static void spans_are_the_surface(void **state) {
    (void)state;
    int spans = 0;
    for (int n = 0; n < 150; n++) {
        Rng rng = {(uint64_t)n};
        Surface s;
        random_surface(&rng, &s);
        int first_u[MAX_ROW], first_v[MAX_ROW];
        int count_u = bspline_spans(s.knots_u, s.rows, s.du, first_u);
        int count_v = bspline_spans(s.knots_v, s.columns, s.dv, first_v);
        assert_true(count_u >= 1 && count_v >= 1);
        for (int k = 0; k < count_u * count_v; k++, spans++) {
            Bezier patch;
            double weights[BEZIER_MAX_POINTS];
            int i = first_u[k / count_v], j = first_v[k % count_v];
            span_at(&s, i, j, &patch, weights);
            double u0 = s.knots_u[i + s.du], u1 = s.knots_u[i + s.du + 1];
            double v0 = s.knots_v[j + s.dv], v1 = s.knots_v[j + s.dv + 1];
            for (int m = 0; m < 4; m++) {
                // Eighths: exact, so that both look at the same place.
                double a = (double)(rng_next(&rng) % 8) / 8, b = (double)(rng_next(&rng) % 8) / 8;
                Vec3 want = surface_point(&s, u0 + a * ((long double)u1 - u0),
                                          v0 + b * ((long double)v1 - v0));
                Vec3 have[3];
                rational_eval(&patch, s.rational ? weights : NULL, a, b, have);
                double off = vec_length(vec_sub(want, have[0]));
                if (!(off < 1e-14))
                    fail_msg("surface %d, span %d %d: off by %g", n, i, j, off);
            }
        }
    }
    assert_true(spans > 400);
}

// Uniform knots without saying so: regular Catmull-Clark and Doo-Sabin meshes. Their corners are
// the limit points (1 4 1)/6 and the middles of faces.
static void regular_meshes(void **state) {
    (void)state;
    Rng rng = {3};
    Vec3 points[16], out[16];
    for (int k = 0; k < 16; k++)
        points[k] = vec3(rng_range(&rng, -1, 1), rng_range(&rng, -1, 1), rng_range(&rng, -1, 1));
    BsplineSpan cubic = {3, 3, points, NULL, NULL, NULL};
    bspline_span(&cubic, out, NULL);
    static const double w[3] = {1 / 6.0, 4 / 6.0, 1 / 6.0};
    Vec3 corner = vec3(0, 0, 0);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            corner = vec_madd(corner, w[i] * w[j], points[4 * (i + 1) + j]);
    assert_true(vec_length(vec_sub(corner, out[12])) < 1e-15); // u = 1, v = 0
    BsplineSpan quadratic = {2, 2, points, NULL, NULL, NULL};
    bspline_span(&quadratic, out, NULL);
    Vec3 face =
        vec_scale(vec_add(vec_add(points[0], points[1]), vec_add(points[3], points[4])), 0.25);
    assert_true(vec_length(vec_sub(face, out[0])) < 1e-15);
    assert_true(vec_length(vec_sub(points[4], out[4])) < 1e-15);
}

static void wrong_knots(void **state) {
    (void)state;
    const double down[] = {0, 1, 0.5, 2}, same[] = {0, 1, 1, 2}, odd[] = {0, 1, NAN, 2};
    assert_non_null(strstr(bspline_knots_fault(down, 2), "do not grow"));
    assert_non_null(strstr(bspline_knots_fault(same, 2), "must differ"));
    assert_non_null(strstr(bspline_knots_fault(odd, 2), "not finite"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spans_are_the_surface),
        cmocka_unit_test(regular_meshes),
        cmocka_unit_test(wrong_knots),
    };
    return cmocka_run_group_tests_name("bspline", tests, NULL, NULL);
}
