// SPDX-License-Identifier: MIT
// Rational patches: a sphere made of eight, which is exact; weights that change nothing; weights
// from 1e-6 to 1e6; and the methods that have none.
#include "patch_oracle.h"
#include "pictures.h"

#include "base/diag.h"
#include "base/rng.h"
#include "patch/patch.h"
#include "patch/rational.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const PatchMethod methods[] = {METHOD_QI, METHOD_CLIPPING, METHOD_NEWTON};
enum { METHODS = 3 };

typedef struct {
    Bezier s;
    double w[BEZIER_MAX_POINTS];
} Patch;

static PatchSet *set_of(PatchMethod method, const Patch *patches, int count, double tolerance) {
    PatchSetOptions options = {.method = method, .tolerance = tolerance};
    PatchSet *set = patchset_create(&options);
    for (int i = 0; i < count; i++) {
        PatchDef def = {.degree_u = (uint32_t)patches[i].s.du,
                        .degree_v = (uint32_t)patches[i].s.dv,
                        .points = patches[i].s.p,
                        .weights = patches[i].w,
                        .id = (uint32_t)i,
                        .mask = 1};
        patchset_add(set, &def);
    }
    patchset_commit(set);
    return set;
}

// S(u,v) in long double.
static Vec3 point_of(const Patch *p, double u, double v) {
    long double sum[4] = {0}, bu[BEZIER_MAX_DEGREE + 1] = {1}, bv[BEZIER_MAX_DEGREE + 1] = {1};
    for (int n = 1; n <= p->s.du; n++)
        for (int i = n; i >= 0; i--)
            bu[i] = (i < n ? bu[i] * (1.0L - u) : 0) + (i > 0 ? bu[i - 1] * u : 0);
    for (int n = 1; n <= p->s.dv; n++)
        for (int i = n; i >= 0; i--)
            bv[i] = (i < n ? bv[i] * (1.0L - v) : 0) + (i > 0 ? bv[i - 1] * v : 0);
    for (int i = 0; i <= p->s.du; i++) {
        for (int j = 0; j <= p->s.dv; j++) {
            int k = i * (p->s.dv + 1) + j;
            long double b = bu[i] * bv[j] * p->w[k];
            sum[0] += b * p->s.p[k].x;
            sum[1] += b * p->s.p[k].y;
            sum[2] += b * p->s.p[k].z;
            sum[3] += b;
        }
    }
    return vec3((double)(sum[0] / sum[3]), (double)(sum[1] / sum[3]), (double)(sum[2] / sum[3]));
}

static double residual(const Patch *p, const Ray *ray, const PatchHit *hit) {
    Vec3 s = point_of(p, hit->u, hit->v);
    return vec_length(vec_sub(vec_madd(ray->org, hit->t, ray->dir), s));
}

// An octant of the unit sphere: a quarter circle turned about z by a quarter. u runs to the pole.
static void octant(int which, Patch *out) {
    static const double r[3] = {1, 1, 0}, z[3] = {0, 1, 1}, w[3] = {1, 0.70710678118654757, 1};
    static const double cx[3] = {1, 1, 0}, cy[3] = {0, 1, 1};
    out->s.du = out->s.dv = 2;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out->s.p[3 * i + j] =
                vec3(r[i] * cx[j] * (which & 1 ? -1 : 1), r[i] * cy[j] * (which & 2 ? -1 : 1),
                     z[i] * (which & 4 ? -1 : 1));
            out->w[3 * i + j] = w[i] * w[j];
        }
    }
}

static int count_hits(const PatchSet *set, const Ray *ray);

// Rays from outside meet the sphere where its equation says, twice; from inside once; the normal is
// the radius. Seams and poles included: nothing leaks.
static void sphere_of_octants(void **state) {
    (void)state;
    Patch patches[8];
    for (int i = 0; i < 8; i++)
        octant(i, &patches[i]);
    for (int m = 0; m < METHODS; m++) {
        PatchSet *set = set_of(methods[m], patches, 8, 1e-10);
        int hits = 0;
        for (int n = 0; n < 1500; n++) {
            Rng rng = {(uint64_t)n};
            Vec3 at = random_direction(&rng); // a point of the sphere
            if (n % 3 == 1)                   // on a seam or at a pole
                at = n % 2 ? vec_normalize(vec3(at.x, at.y, 0)) : vec3(0, 0, 1);
            Vec3 org = vec_scale(random_direction(&rng), n % 2 ? 0.5 : 3.0);
            Ray ray = {org, vec_sub(at, org)};
            // |org + t dir| = 1
            double a = vec_dot(ray.dir, ray.dir), b = vec_dot(org, ray.dir),
                   c = vec_dot(org, org) - 1.0, root = b * b - a * c;
            // Newton finds one of two roots in one sub-patch.
            if (root < (methods[m] == METHOD_NEWTON ? 0.1 : 1e-4) * a)
                continue;
            double t = n % 2 ? (-b + sqrt(root)) / a : (-b - sqrt(root)) / a;
            PatchHit hit;
            if (!patchset_intersect(set, &ray, 0, INFINITY, 1, NULL, &hit))
                fail_msg("%s misses ray %d", patch_method_name(methods[m]), n);
            double reach = 8e-10 / sqrt(root / a);
            if (fabs(hit.t - t) * sqrt(a) > reach)
                fail_msg("%s, ray %d: t %.17g, not %.17g", patch_method_name(methods[m]), n, hit.t,
                         t);
            Vec3 p = vec_madd(org, hit.t, ray.dir);
            if (!(fabs(fabs(vec_dot(p, hit.normal)) - 1.0) < 1e-6))
                fail_msg("%s, ray %d: normal off by %g at (%.17g, %.17g)",
                         patch_method_name(methods[m]), n, 1.0 - fabs(vec_dot(p, hit.normal)),
                         hit.u, hit.v);
            assert_true(residual(&patches[hit.id], &ray, &hit) <= hit.bound && hit.bound < 4e-10);
            hits++;
            if (n % 3 != 1 && count_hits(set, &ray) != 2 - n % 2)
                fail_msg("%s, ray %d: %d hits", patch_method_name(methods[m]), n,
                         count_hits(set, &ray));
        }
        assert_true(hits > 1000);
        patchset_destroy(set);
    }
}

static void count(void *context, const PatchHit *hit) {
    (void)hit;
    ++*(int *)context;
}

static int count_hits(const PatchSet *set, const Ray *ray) {
    int hits = 0;
    patchset_all(set, ray, 0, INFINITY, 1, NULL, count, &hits);
    return hits;
}

static void random_rational(Rng *rng, int du, int dv, double decades, Patch *out) {
    random_patch(rng, du, dv, 0.1, &out->s);
    for (int k = 0; k < bezier_count(&out->s); k++)
        out->w[k] = pow(10.0, rng_range(rng, -decades, decades));
}

// Weights c a^i b^j are the same surface at other parameters: the same hits, as many, at the same
// depths, as the polynomial patch has.
static void weights_that_change_nothing(void **state) {
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        int hits = 0;
        for (int n = 0; n < 60; n++) {
            Rng rng = {(uint64_t)n};
            Patch p, q;
            random_rational(&rng, 1 + n % 4, 1 + n / 4 % 4, 0.0, &p);
            q = p;
            double a = n % 2 ? 1.0 : 1.7, b = n % 2 ? 1.0 : 0.4, c = n % 3 ? 1e5 : 1e-200;
            for (int i = 0; i <= q.s.du; i++)
                for (int j = 0; j <= q.s.dv; j++)
                    q.w[i * (q.s.dv + 1) + j] = c * pow(a, i) * pow(b, j);
            PatchSet *set = set_of(methods[m], &q, 1, 1e-10);
            for (int k = 0; k < 10; k++) {
                Ray ray = ray_to(&p.s, rng_unit(&rng), rng_unit(&rng), random_direction(&rng), 2.0);
                OracleHits oracle;
                oracle_hits(&p.s, ray, 0, INFINITY, &oracle);
                double sine = 1.0;
                for (int i = 0; i < oracle.count; i++)
                    sine = fmin(sine, oracle.hits[i].sine);
                if (oracle.doubtful || sine < (methods[m] == METHOD_NEWTON ? 0.3 : 0.02))
                    continue;
                PatchHit hit;
                assert_true(patchset_intersect(set, &ray, 0, INFINITY, 1, NULL, &hit));
                assert_true(fabs(hit.t - oracle.hits[0].t) <= 4e-9 / sine);
                assert_int_equal(count_hits(set, &ray), oracle.count);
                hits++;
            }
            patchset_destroy(set);
        }
        assert_true(hits > 200);
    }
}

// Rays at points of patches whose weights differ by up to 1e12: met there or before, within a bound
// that is true. What a parameter's last bit moves the point by is all that the bound may add.
static void wild_weights(void **state) {
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        int hits = 0, close = 0;
        for (int n = 0; n < 40; n++) {
            Rng rng = {(uint64_t)n};
            Patch p;
            random_rational(&rng, 2 + n % 3, 2 + n / 3 % 3, n % 2 ? 6.0 : 1.0, &p);
            PatchSet *set = set_of(methods[m], &p, 1, 1e-9);
            for (int k = 0; k < 10; k++) {
                double u = rng_unit(&rng), v = rng_unit(&rng);
                Vec3 at = point_of(&p, u, v), dir = random_direction(&rng);
                Ray ray = {vec_madd(at, -3.0, dir), dir};
                PatchHit hit;
                if (!patchset_intersect(set, &ray, 0, INFINITY, 1, NULL, &hit)) {
                    if (methods[m] == METHOD_QI)
                        fail_msg("patch %d, ray %d missed at (%g, %g)", n, k, u, v);
                    continue;
                }
                hits++;
                close += hit.bound < 1e-8;
                double off = residual(&p, &ray, &hit);
                if (!(off <= hit.bound))
                    fail_msg("%s, patch %d: off by %g, bound %g", patch_method_name(methods[m]), n,
                             off, hit.bound);
            }
            patchset_destroy(set);
        }
        if (hits < 380 || close < 380)
            fail_msg("%s: %d hits of 400, %d of them near", patch_method_name(methods[m]), hits,
                     close);
    }
}

// Writes the eight octants as patches of a scene file.
static void write_octants(FILE *out) {
    for (int n = 0; n < 8; n++) {
        Patch p;
        octant(n, &p);
        fprintf(out, "%s{\"type\": \"bezier_patch\", \"texture\": 1, \"points\": [", n ? "," : "");
        for (int i = 0; i < 3; i++) {
            fprintf(out, "%s[", i ? "," : "");
            for (int j = 0; j < 3; j++)
                fprintf(out, "%s[%g, %g, %g]", j ? "," : "", p.s.p[3 * i + j].x, p.s.p[3 * i + j].y,
                        p.s.p[3 * i + j].z);
            fprintf(out, "]");
        }
        fprintf(out, "], \"weights\": [");
        for (int i = 0; i < 3; i++)
            fprintf(out, "%s[%.17g, %.17g, %.17g]", i ? "," : "", p.w[3 * i], p.w[3 * i + 1],
                    p.w[3 * i + 2]);
        fprintf(out, "]}");
    }
}

// A picture of a sphere, shiny and with its shadow, and one in which eight patches stand for it.
static void pictures_are_equal(void **state) {
    (void)state;
    static const char pov[] =
        "camera { location <0,1,-4> look_at 0 } light_source { <5,9,-9>, 1 }\n"
        "plane { y, -1 pigment { checker rgb 1, rgb 0.2 } }\n"
        "sphere { 0, 1 pigment { rgb <1,0.6,0.2> } finish { phong 0.6 reflection 0.2 } }\n";
    static const char sphere[] = "{\"type\": \"sphere\"";
    char folder[2300], path[2400], line[4096], one[2500], two[2500];
    snprintf(folder, sizeof folder, "%s", scratch_folder());
    snprintf(path, sizeof path, "%s/ball.pov", folder);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(pov, out);
    fclose(out);
    const char *log;
    assert_int_equal(run_command(&log, "build/pov2qi '%s' -o '%s/ball.qi.json'", path, folder), 0);
    snprintf(path, sizeof path, "%s/ball.qi.json", folder);
    FILE *in = fopen(path, "r");
    snprintf(path, sizeof path, "%s/octants.qi.json", folder);
    out = fopen(path, "w");
    assert_true(in && out);
    int replaced = 0;
    while (fgets(line, sizeof line, in)) {
        bool here = strstr(line, sphere) != NULL;
        if (here)
            write_octants(out);
        else
            fputs(strstr(line, "\"requires\"") ? "\"requires\": [\"rational_patch\"],\n" : line,
                  out);
        replaced += here;
    }
    fclose(in);
    fclose(out);
    assert_int_equal(replaced, 1);
    snprintf(one, sizeof one, "%s/ball.png", folder);
    snprintf(two, sizeof two, "%s/octants.png", folder);
    int status = run_command(&log,
                             "build/qirender '%s/ball.qi.json' +W160 +H120 -A '+O%s' && "
                             "build/qirender '%s/octants.qi.json' +W160 +H120 -A '+O%s'",
                             folder, one, folder, two);
    if (status != 0)
        fail_msg("qirender: %s", log);
    // A pixel or two on the outline or an edge of a mirrored check may fall to the other side.
    assert_true(percent_over(one, two, 1.5 / 255.0) < 0.05);
    status = run_command(
        &log, "build/qirender '%s/octants.qi.json' +W16 +H12 --method facets '+O%s'", folder, two);
    assert_true(status == 1 && strstr(log, "the method facets has no rational patches"));
}

static void commit_refused(void *method) {
    Patch p;
    octant(0, &p);
    set_of(*(const PatchMethod *)method, &p, 1, 1e-9);
}

static void other_methods_refuse(void **state) {
    (void)state;
    static PatchMethod refusing[] = {METHOD_QI_PAPER, METHOD_FACETS, METHOD_TESSELLATION};
    for (int i = 0; i < 3; i++) {
        char *message = NULL;
        assert_false(diag_catch(commit_refused, &refusing[i], &message));
        assert_non_null(strstr(message, patch_method_name(refusing[i])));
        assert_non_null(strstr(message, "has no rational patches"));
        free(message);
    }
}

// Preparing it never ended: its weights alone ask for more pieces than a patch may have, however
// thick these may be.
static void weights_to_and_fro(void **state) {
    (void)state;
    static const double w[12] = {6.8e-6, 4e2,   5.4e-4, 7.1e2, 3.3e3, 6,
                                 3.9e-3, 4.1e5, 4.2e-2, 2e-5,  2.3,   1.8e-4};
    static const double z[12] = {-0.248, 0.182, 0.86,  0.125, 0.52,  0.453,
                                 0.125,  0.495, 0.683, -0.22, 0.306, 0.688};
    Patch p = {.s = {.du = 3, .dv = 2}};
    for (int k = 0; k < 12; k++) {
        p.s.p[k] = vec3(k / 3 / 3.0, k % 3 / 2.0, z[k]);
        p.w[k] = w[k];
    }
    for (int m = 0; m < METHODS; m++) {
        PatchSet *set = set_of(methods[m], &p, 1, 1e-9);
        Ray ray = {vec3(0.4, 0.3, 2.0), vec3(0.1, 0.1, -1.0)};
        PatchHit hit;
        assert_true(patchset_intersect(set, &ray, 0.0, INFINITY, 1, NULL, &hit));
        Vec3 at = vec_madd(ray.org, hit.t, ray.dir);
        assert_true(vec_length(vec_sub(at, point_of(&p, hit.u, hit.v))) <= 1e-8);
        patchset_destroy(set);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_of_octants),  cmocka_unit_test(weights_that_change_nothing),
        cmocka_unit_test(wild_weights),       cmocka_unit_test(other_methods_refuse),
        cmocka_unit_test(pictures_are_equal), cmocka_unit_test(weights_to_and_fro),
    };
    return cmocka_run_group_tests_name("rational", tests, NULL, NULL);
}
