// SPDX-License-Identifier: MIT
// The bicubic that stands for a part of a patch of high degree, against the patch.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/rng.h"
#include "patch/qi_local.h"

#include <float.h>

// A wavy sheet of any degree.
static void sheet(Rng *rng, int du, int dv, Bezier *s) {
    s->du = du;
    s->dv = dv;
    for (int i = 0; i <= du; i++) {
        for (int j = 0; j <= dv; j++) {
            Vec3 noise = vec3(rng_unit(rng), rng_unit(rng), rng_unit(rng));
            s->p[i * (dv + 1) + j] =
                vec_madd(vec3((double)i / du, (double)j / dv, 0.0), 0.3, noise);
        }
    }
}

// The frame's rounding, of numbers up to 2.
static QiFrame frame_of(const Bezier *s) {
    QiFrame frame = {.exponent = 0, .axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    frame.slack_x = frame.slack_y = frame.slack_z = (8.0 * (s->du + s->dv) + 52.0) * DBL_EPSILON;
    return frame;
}

// A part of [low, high], from all of it to a millionth.
static void span_of(Rng *rng, double low, double high, double *from, double *to) {
    double width = (high - low) * pow(10.0, -6.0 * rng_unit(rng));
    *from = fmin(low + rng_unit(rng) * (high - low - width), high);
    *to = fmin(*from + width, high);
}

static BezierRect part_of(Rng *rng, BezierRect r) {
    BezierRect part;
    span_of(rng, r.u0, r.u1, &part.u0, &part.u1);
    span_of(rng, r.v0, r.v1, &part.v0, &part.v1);
    return part;
}

// Points and slopes over a part.
static void check_part(Rng *rng, QiLocal *local, const Bezier *s, BezierRect r) {
    QiLocalPart part;
    qi_local_part(local, r, &part);
    for (int k = 0; k < 3; k++) {
        Bezier cubic = {.du = 3, .dv = 3};
        double net[16], rest;
        qi_local_cut(local, &part, k, net, &rest);
        for (int n = 0; n < 16; n++)
            cubic.p[n] = vec3(net[n], 0.0, 0.0);
        for (int n = 0; n < 8; n++) {
            double a = n < 4 ? (double)(n & 1) : rng_unit(rng);
            double b = n < 4 ? (double)(n >> 1) : rng_unit(rng);
            double width = r.u1 - r.u0, height = r.v1 - r.v0;
            Vec3 su, sv, cu, cv;
            Vec3 at = bezier_eval1(s, fmin(r.u0 + a * width, 1.0), fmin(r.v0 + b * height, 1.0),
                                   &su, &sv);
            double here = bezier_eval1(&cubic, a, b, &cu, &cv).x, off = vec_get(at, k) - here;
            double turn =
                fabs(vec_get(su, k) * width - cu.x) + fabs(vec_get(sv, k) * height - cv.x);
            if (!(fabs(off) <= rest && turn <= 8.0 * rest))
                fail_msg("degrees %d %d: off %g, slopes by %g, rest %g", s->du, s->dv, off, turn,
                         rest);
        }
    }
}

// A target whose frame is that of the patch itself.
static void target_of(const Bezier *s, QiTarget *target) {
    target->du = s->du;
    target->dv = s->dv;
    target->rational = false;
    target->frame = frame_of(s);
    for (int n = 0; n < bezier_count(s); n++) {
        target->whole.x[n] = s->p[n].x;
        target->whole.y[n] = s->p[n].y;
        target->whole.z[n] = s->p[n].z;
    }
}

// Of parts, and of parts of them, which the same bicubic serves; with bounds made for the query,
// and with those of a piece.
static void bounds_hold(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 2000; seed++) {
        Rng rng = {seed};
        Bezier s, piece;
        int du = 1 + (int)(rng_next(&rng) % 16), dv = 1 + (int)(rng_next(&rng) % 16);
        sheet(&rng, du, dv, &s);
        if (!qi_local_pays(du, dv))
            continue;
        BezierRect over = part_of(&rng, bezier_whole());
        QiTarget target;
        QiLocal local;
        float most[3][5];
        QiFourth fourth = {over, most};
        target_of(&s, &target);
        bezier_restrict(&s, over, &piece);
        qi_local_fourth(&piece, target.frame.slack_x, most);
        assert_true(qi_local_init(&local, &target, over, seed % 2 ? &fourth : NULL));
        for (int n = 0; n < 4; n++) {
            BezierRect part = part_of(&rng, over);
            qi_local_forget(&local);
            check_part(&rng, &local, &s, part);
            check_part(&rng, &local, &s, part_of(&rng, part));
        }
    }
}

// The rest falls with the fourth power of the size; else nothing would be gained.
static void rest_is_small(void **state) {
    (void)state;
    Rng rng = {7};
    Bezier s;
    sheet(&rng, 12, 12, &s);
    QiTarget target;
    QiLocal local;
    target_of(&s, &target);
    assert_true(qi_local_init(&local, &target, bezier_whole(), NULL));
    double out[16], rest, wide;
    QiLocalPart part;
    qi_local_part(&local, (BezierRect){0.5, 0.5 + 0x1p-6, 0.25, 0.25 + 0x1p-6}, &part);
    qi_local_cut(&local, &part, 2, out, &rest);
    qi_local_part(&local, (BezierRect){0.5, 0.5 + 0x1p-5, 0.25, 0.25 + 0x1p-5}, &part);
    qi_local_cut(&local, &part, 2, out, &wide);
    assert_true(rest < 1e-3);
    assert_true(wide > 15.0 * rest && wide < 17.0 * rest);
}

// Rays tangent to pieces of a patch of high degree. Each step had a net of that degree once, then
// each search had three of them before its first step: 110,000 instructions.
static void nets_are_rare(void **state) {
    (void)state;
    Rng rng = {11};
    QiStats stats = {0};
    for (int n = 0; n < 200; n++) {
        Bezier s, piece;
        sheet(&rng, 13, 15, &s);
        BezierRect over = {0.0, 0.03125, 0.0, 0.03125};
        double shift = (double)(rng_next(&rng) % 32) / 32.0;
        over.u0 += shift, over.u1 += shift;
        over.v0 += 1.0 - 0.03125 - shift, over.v1 += 1.0 - 0.03125 - shift;
        bezier_restrict(&s, over, &piece);
        float most[3][5];
        QiFourth fourth = {over, most};
        qi_local_fourth(&piece, 1e-14, most);
        Vec3 su, sv, at = bezier_eval1(&piece, rng_unit(&rng), rng_unit(&rng), &su, &sv);
        Vec3 dir = vec_madd(vec_normalize(su), 4.0 * rng_unit(&rng) - 2.0, vec_normalize(sv));
        QiQuery q = qi_query_default(&s, (Ray){vec_madd(at, -3.0, dir), dir});
        q.rect = over;
        q.fourth = &fourth;
        qi_reduce_nearest(&s, &q, &stats, &(QiHit){0});
    }
    if (stats.full * 8 > stats.steps)
        fail_msg("%d nets of the patch's own degree in %d steps", (int)stats.full,
                 (int)stats.steps);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_hold),
        cmocka_unit_test(rest_is_small),
        cmocka_unit_test(nets_are_rare),
    };
    return cmocka_run_group_tests_name("qi_local", tests, NULL, NULL);
}
