// SPDX-License-Identifier: MIT
// The constants of the paper, and the deviation bound: never exceeded, and sharp.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "patch/quasi.h"

// The paper's table, d = 2..8, as fractions.
static void constants_match_the_paper(void **state) {
    (void)state;
    static const double n[] = {1.0 / 4, 1.0 / 3, 1.0 / 2, 3.0 / 5, 3.0 / 4, 6.0 / 7, 1.0};
    static const double z[] = {1.0 / 16, 1.0 / 12, 1.0 / 4, 7.0 / 20, 1.0 / 2, 17.0 / 28, 3.0 / 4};
    for (int d = 2; d <= 8; d++) {
        assert_true(fabs(quasi_n_infinity(d) - n[d - 2]) < 1e-15);
        assert_true(fabs(quasi_z_infinity(d) - z[d - 2]) < 1e-15);
    }
    assert_true(quasi_n_infinity(1) == 0.0 && quasi_z_infinity(1) == 0.0);
}

static void random_net(Rng *rng, int du, int dv, Bezier *s) {
    s->du = du;
    s->dv = dv;
    for (int k = 0; k < bezier_count(s); k++)
        s->p[k] = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
}

// Definition of the net, entry by entry: M_du P M_dv^T.
static double m_entry(int d, int row, int column) {
    if (row == 0 || row == d)
        return row == column ? 1.0 : 0.0;
    int away = abs(row - column);
    return away == 0 ? 0.5 : away == 1 ? 0.25 : 0.0;
}

static void net_is_the_product_of_matrices(void **state) {
    (void)state;
    Rng rng = {1};
    for (int du = 1; du <= BEZIER_MAX_DEGREE; du++) {
        int dv = 1 + (du * 7) % BEZIER_MAX_DEGREE;
        Bezier s, q;
        random_net(&rng, du, dv, &s);
        quasi_net(&s, &q);
        for (int i = 0; i <= du; i++) {
            for (int j = 0; j <= dv; j++) {
                Vec3 sum = vec3(0, 0, 0);
                for (int a = 0; a <= du; a++)
                    for (int b = 0; b <= dv; b++)
                        sum = vec_madd(sum, m_entry(du, i, a) * m_entry(dv, j, b),
                                       bezier_at(&s, a, b));
                assert_true(vec_length(vec_sub(sum, bezier_at(&q, i, j))) < 1e-15);
                Vec3 at = quasi_eval(&q, (double)i / du, (double)j / dv);
                assert_true(vec_length(vec_sub(sum, at)) < 1e-14);
            }
        }
    }
}

// |S - Q| <= eps at samples of random nets, in length and in each coordinate, every pair to 8.
static void bound_holds(void **state) {
    (void)state;
    for (int du = 1; du <= 8; du++) {
        for (int dv = 1; dv <= 8; dv++) {
            for (int n = 0; n < 6; n++) {
                Rng rng = {(uint64_t)(du * 1000 + dv * 10 + n)};
                Bezier s, q;
                random_net(&rng, du, dv, &s);
                quasi_net(&s, &q);
                double eps = quasi_deviation(&s);
                Vec3 axes = quasi_deviation_axes(&s);
                for (int k = 0; k < 100; k++) {
                    double u = rng_unit(&rng), v = k < 20 ? 1.0 : rng_unit(&rng);
                    Vec3 d = vec_sub(bezier_eval(&s, u, v), quasi_eval(&q, u, v));
                    assert_true(vec_length(d) <= eps + 1e-14);
                    assert_true(fabs(d.x) <= axes.x + 1e-14);
                    assert_true(fabs(d.y) <= axes.y + 1e-14);
                    assert_true(fabs(d.z) <= axes.z + 1e-14);
                }
            }
        }
    }
}

// The curve of degree d with second differences +-1 that leaves its QI polygon farthest at t: the
// deviation is linear in the second differences, so each takes the sign of its own share. The share
// of the k-th is the deviation of the hinge max(0, i - k).
static double farthest_curve(int d, double t, double points[BEZIER_MAX_DEGREE + 1]) {
    double sum = 0.0;
    for (int i = 0; i <= d; i++)
        points[i] = 0.0;
    for (int k = 1; k < d; k++) {
        Bezier hinge = {.du = d, .dv = 1}, net;
        for (int i = 0; i <= d; i++)
            hinge.p[2 * i] = hinge.p[2 * i + 1] = vec3(i > k ? i - k : 0, 0, 0);
        quasi_net(&hinge, &net);
        double share = bezier_eval(&hinge, t, 0.0).x - quasi_eval(&net, t, 0.0).x;
        double sign = share < 0.0 ? -1.0 : 1.0;
        for (int i = 0; i <= d; i++)
            points[i] += sign * hinge.p[2 * i].x;
        sum += fabs(share);
    }
    return sum;
}

static double worst_place(int d) {
    double worst = -1.0, at = 0.0, points[BEZIER_MAX_DEGREE + 1];
    for (int k = 0; k <= 240; k++) {
        double t = (k % 2 ? (double)k / 240 : (double)(k / 2 % (d + 1)) / d);
        double far = farthest_curve(d, t, points);
        if (far > worst)
            worst = far, at = t;
    }
    return at;
}

// For every pair of degrees some net comes within 1 % of the bound, in any direction of space; and
// no curve at all exceeds Z.
static void bound_is_sharp(void **state) {
    (void)state;
    double place[9] = {0};
    for (int d = 2; d <= 8; d++) {
        double points[BEZIER_MAX_DEGREE + 1];
        place[d] = worst_place(d);
        double far = farthest_curve(d, place[d], points);
        assert_true(far <= quasi_z_infinity(d) * (1.0 + 1e-12));
        assert_true(far >= quasi_z_infinity(d) * 0.99);
    }
    const Vec3 along = vec3(2.0 / 7, -3.0 / 7, 6.0 / 7);
    for (int du = 1; du <= 8; du++) {
        for (int dv = 1; dv <= 8; dv++) {
            double pu[BEZIER_MAX_DEGREE + 1], pv[BEZIER_MAX_DEGREE + 1];
            double far_u = farthest_curve(du, place[du], pu),
                   far_v = farthest_curve(dv, place[dv], pv);
            Bezier s = {.du = du, .dv = dv}, net;
            // Opposite deviations would cancel: each curve's own is positive by construction.
            for (int i = 0; i <= du; i++)
                for (int j = 0; j <= dv; j++)
                    s.p[i * (dv + 1) + j] = vec_scale(along, pu[i] + pv[j]);
            quasi_net(&s, &net);
            double u = place[du], v = place[dv], eps = quasi_deviation(&s);
            Vec3 off = vec_sub(bezier_eval(&s, u, v), quasi_eval(&net, u, v));
            assert_true(fabs(vec_length(off) - far_u - far_v) < 1e-12);
            assert_true(vec_length(off) <= eps + 1e-12 && vec_length(off) >= 0.99 * eps);
            Vec3 axes = quasi_deviation_axes(&s);
            assert_true(fabs(off.y) <= axes.y + 1e-12 && fabs(off.y) >= 0.99 * axes.y);
        }
    }
}

// Cutting to a third divides the bound by nine.
static void bound_shrinks_with_the_square(void **state) {
    (void)state;
    Rng rng = {77};
    for (int n = 0; n < 50; n++) {
        Bezier s, part;
        random_net(&rng, 1 + n % 8, 1 + n % 5, &s);
        double u = rng_unit(&rng) * 2 / 3, v = rng_unit(&rng) * 2 / 3;
        bezier_restrict(&s, (BezierRect){u, u + 1.0 / 3, v, v + 1.0 / 3}, &part);
        assert_true(quasi_deviation(&part) <= quasi_deviation(&s) / 9.0 + 1e-14);
    }
}

// The net of a bilinear patch is the patch; the projected forms agree with those in space.
static void nets_in_two_coordinates(void **state) {
    (void)state;
    Rng rng = {78};
    for (int n = 0; n < 50; n++) {
        Bezier s, net;
        Bezier2 flat, net2;
        random_net(&rng, 1 + n % 8, 1 + n % 5, &s);
        flat.du = s.du;
        flat.dv = s.dv;
        for (int k = 0; k < bezier_count(&s); k++)
            flat.p[k] = (Vec2){s.p[k].x, s.p[k].z};
        quasi_net(&s, &net);
        quasi_net2(&flat, &net2);
        for (int k = 0; k < bezier_count(&s); k++)
            assert_true(net2.p[k].u == net.p[k].x && net2.p[k].v == net.p[k].z);
        Vec2 eps = quasi_deviation_axes2(&flat);
        Vec3 axes = quasi_deviation_axes(&s);
        assert_true(fabs(eps.u - axes.x) < 1e-15 && fabs(eps.v - axes.z) < 1e-15);
        if (s.du == 1 && s.dv == 1) {
            assert_true(quasi_deviation(&s) == 0.0);
            Vec3 d = vec_sub(quasi_eval(&net, 0.3, 0.6), bezier_eval(&s, 0.3, 0.6));
            assert_true(vec_length(d) < 1e-15);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constants_match_the_paper),
        cmocka_unit_test(net_is_the_product_of_matrices),
        cmocka_unit_test(bound_holds),
        cmocka_unit_test(bound_is_sharp),
        cmocka_unit_test(bound_shrinks_with_the_square),
        cmocka_unit_test(nets_in_two_coordinates),
    };
    return cmocka_run_group_tests_name("quasi", tests, NULL, NULL);
}
