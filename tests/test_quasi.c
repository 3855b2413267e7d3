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

static void random_patch(Rng *rng, int du, int dv, Bezier *s) {
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
        random_patch(&rng, du, dv, &s);
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
                random_patch(&rng, du, dv, &s);
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constants_match_the_paper),
        cmocka_unit_test(net_is_the_product_of_matrices),
        cmocka_unit_test(bound_holds),
    };
    return cmocka_run_group_tests_name("quasi", tests, NULL, NULL);
}
