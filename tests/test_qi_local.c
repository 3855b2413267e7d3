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
    QiFrame frame = {.exponent = 0};
    frame.slack_x = frame.slack_y = frame.slack_z = (8.0 * (s->du + s->dv) + 52.0) * DBL_EPSILON;
    return frame;
}

static QiLocal local_over(const Bezier *s, BezierRect over) {
    Bezier cut;
    QiNet net;
    QiFrame frame = frame_of(s);
    QiLocal local;
    bezier_restrict(s, over, &cut);
    for (int n = 0; n < bezier_count(&cut); n++) {
        net.x[n] = cut.p[n].x;
        net.y[n] = cut.p[n].y;
        net.z[n] = cut.p[n].z;
    }
    qi_local_init(&local, &frame, s->du, s->dv, &net, over);
    return local;
}

// A part of [low, high], from all of it to a millionth.
static void part_of(Rng *rng, double low, double high, double *from, double *to) {
    double width = (high - low) * pow(10.0, -6.0 * rng_unit(rng));
    *from = low + rng_unit(rng) * (high - low - width);
    *to = fmin(*from + width, high);
}

static void check_part(Rng *rng, const QiLocal *local, const Bezier *s) {
    BezierRect r, over = local->over;
    part_of(rng, over.u0, over.u1, &r.u0, &r.u1);
    part_of(rng, over.v0, over.v1, &r.v0, &r.v1);
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

static void bounds_hold(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 2000; seed++) {
        Rng rng = {seed};
        Bezier s;
        sheet(&rng, 1 + (int)(rng_next(&rng) % 16), 1 + (int)(rng_next(&rng) % 16), &s);
        BezierRect over;
        part_of(&rng, 0.0, 1.0, &over.u0, &over.u1);
        part_of(&rng, 0.0, 1.0, &over.v0, &over.v1);
        QiLocal local = local_over(&s, over);
        for (int n = 0; n < 4; n++)
            check_part(&rng, &local, &s);
    }
}

// The rest falls with the fourth power of the size; else nothing would be gained.
static void rest_is_small(void **state) {
    (void)state;
    Rng rng = {7};
    Bezier s;
    sheet(&rng, 12, 12, &s);
    QiLocal local = local_over(&s, bezier_whole());
    double out[16], rest, wide;
    QiLocalPart part;
    qi_local_part(&local, (BezierRect){0.5, 0.5 + 0x1p-6, 0.25, 0.25 + 0x1p-6}, &part);
    qi_local_cut(&local, &part, 2, out, &rest);
    qi_local_part(&local, (BezierRect){0.5, 0.5 + 0x1p-5, 0.25, 0.25 + 0x1p-5}, &part);
    qi_local_cut(&local, &part, 2, out, &wide);
    assert_true(rest < 1e-3);
    assert_true(wide > 15.0 * rest && wide < 17.0 * rest);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_hold),
        cmocka_unit_test(rest_is_small),
    };
    return cmocka_run_group_tests_name("qi_local", tests, NULL, NULL);
}
