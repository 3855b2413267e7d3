// SPDX-License-Identifier: MIT
// Evaluation, cutting and normals of Bézier patches, against sums of Bernstein polynomials in long
// double and against geometry.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "patch_oracle.h"

#include <string.h>

static double distance(Vec3 a, Vec3 b) { return vec_length(vec_sub(a, b)); }

static bool same_bits(Vec3 a, Vec3 b) { return memcmp(&a, &b, sizeof a) == 0; }

// Every degree pair: values within the stated rounding, tangents within 2 d times that.
static void values_and_tangents(void **state) {
    (void)state;
    for (int du = 1; du <= BEZIER_MAX_DEGREE; du++) {
        for (int dv = 1; dv <= BEZIER_MAX_DEGREE; dv++) {
            Rng rng = {(uint64_t)(100 * du + dv)};
            Bezier s;
            random_patch(&rng, du, dv, 0.5, &s);
            double rounding = 2.0 * bezier_rounding(&s); // of three coordinates together
            for (int k = 0; k < 4; k++) {
                double u = k == 0 ? 0.0 : k == 1 ? 1.0 : rng_unit(&rng), v = rng_unit(&rng);
                Vec3 su, sv, tu, tv;
                Vec3 p = bezier_eval1(&s, u, v, &su, &sv);
                oracle_tangents(&s, u, v, &tu, &tv);
                assert_true(distance(p, oracle_point(&s, u, v)) <= rounding);
                assert_true(same_bits(p, bezier_eval(&s, u, v)));
                assert_true(distance(su, tu) <= 2.0 * du * rounding);
                assert_true(distance(sv, tv) <= 2.0 * dv * rounding);
            }
        }
    }
}

// Second derivatives against differences of the first, which are exact for the step chosen here up
// to h^2 times the fourth derivative.
static void second_derivatives(void **state) {
    (void)state;
    const double h = 1e-5;
    for (int n = 0; n < 60; n++) {
        Rng rng = {(uint64_t)n};
        Bezier s;
        random_patch(&rng, 1 + n % 6, 1 + n / 10, 0.3, &s);
        double u = rng_range(&rng, 0.1, 0.9), v = rng_range(&rng, 0.1, 0.9);
        BezierJet jet;
        bezier_eval2(&s, u, v, &jet);
        Vec3 au, av, bu, bv;
        oracle_tangents(&s, u - h, v, &au, &av);
        oracle_tangents(&s, u + h, v, &bu, &bv);
        assert_true(distance(vec_scale(vec_sub(bu, au), 0.5 / h), jet.suu) < 1e-5);
        assert_true(distance(vec_scale(vec_sub(bv, av), 0.5 / h), jet.suv) < 1e-5);
        oracle_tangents(&s, u, v - h, &au, &av);
        oracle_tangents(&s, u, v + h, &bu, &bv);
        assert_true(distance(vec_scale(vec_sub(bv, av), 0.5 / h), jet.svv) < 1e-5);
        assert_true(distance(jet.s, oracle_point(&s, u, v)) < 1e-14);
    }
}

static void parts_are_the_same_surface(void **state) {
    (void)state;
    for (int n = 0; n < 200; n++) {
        Rng rng = {(uint64_t)n};
        Bezier s, part, low, high;
        random_patch(&rng, 1 + n % 16, 1 + (n * 7) % 16, 0.3, &s);
        double a = rng_unit(&rng), b = rng_unit(&rng), c = rng_unit(&rng), d = rng_unit(&rng);
        BezierRect r = {fmin(a, b), fmax(a, b), fmin(c, d), fmax(c, d)};
        bezier_restrict(&s, r, &part);
        double rounding = 4.0 * bezier_rounding(&s);
        for (int k = 0; k < 5; k++) {
            double u = rng_unit(&rng), v = rng_unit(&rng);
            Vec3 want = oracle_point(&s, r.u0 + u * (r.u1 - r.u0), r.v0 + v * (r.v1 - r.v0));
            assert_true(distance(bezier_eval(&part, u, v), want) <= 2.0 * rounding);
        }
        // A cut: both halves, aliased with the input, agree with the restriction bit for bit.
        bezier_copy(&low, &s);
        bezier_split_u(&low, a, &low, &high);
        bezier_restrict(&s, (BezierRect){a, 1.0, 0.0, 1.0}, &part);
        for (int k = 0; k < bezier_count(&s); k++)
            assert_true(same_bits(part.p[k], high.p[k]));
        for (int j = 0; j <= s.dv; j++)
            assert_true(same_bits(bezier_at(&low, s.du, j), bezier_at(&high, 0, j)));
        bezier_copy(&high, &s);
        bezier_split_v(&high, c, &low, &high);
        for (int i = 0; i <= s.du; i++)
            assert_true(same_bits(bezier_at(&low, i, s.dv), bezier_at(&high, i, 0)));
    }
}

// Rectangles of one patch that share a side share its control points, and corners are S.
static void neighbours_share_their_bits(void **state) {
    (void)state;
    for (int n = 0; n < 100; n++) {
        Rng rng = {(uint64_t)n};
        Bezier s, left, right, above;
        random_patch(&rng, 1 + n % 7, 1 + n % 5, 0.3, &s);
        double cut = rng_range(&rng, 0.3, 0.7), v0 = rng_unit(&rng) * 0.4, v1 = 0.8;
        bezier_restrict(&s, (BezierRect){0.1, cut, v0, v1}, &left);
        bezier_restrict(&s, (BezierRect){cut, 0.9, v0, v1}, &right);
        bezier_restrict(&s, (BezierRect){0.1, cut, v1, 1.0}, &above);
        for (int j = 0; j <= s.dv; j++)
            assert_true(same_bits(bezier_at(&left, s.du, j), bezier_at(&right, 0, j)));
        for (int i = 0; i <= s.du; i++)
            assert_true(same_bits(bezier_at(&left, i, s.dv), bezier_at(&above, i, 0)));
        assert_true(same_bits(bezier_at(&left, s.du, 0), bezier_eval(&s, cut, v0)));
    }
}

// Equal points stay equal, ends are exact, and a reversed patch gives the same points.
static void exactness(void **state) {
    (void)state;
    Rng rng = {5};
    Bezier s, back, part;
    random_patch(&rng, 3, 4, 0.3, &s);
    for (int j = 0; j <= 4; j++)
        s.p[j] = vec3(0.1, 0.2, 0.3);
    bezier_restrict(&s, (BezierRect){0.0, 0.37, 0.21, 0.77}, &part);
    for (int j = 0; j <= 4; j++) {
        assert_true(same_bits(part.p[j], vec3(0.1, 0.2, 0.3)));
        assert_true(same_bits(bezier_eval(&s, 0.0, 0.173 * j), vec3(0.1, 0.2, 0.3)));
    }
    assert_true(same_bits(bezier_eval(&s, 1.0, 1.0), s.p[19]));
    back.du = 3;
    back.dv = 4;
    for (int i = 0; i <= 3; i++)
        for (int j = 0; j <= 4; j++)
            back.p[i * 5 + j] = bezier_at(&s, 3 - i, j);
    for (int k = 0; k <= 64; k++) // 1 - k/64 is exact
        assert_true(
            same_bits(bezier_eval(&s, k / 64.0, 0.3), bezier_eval(&back, 1 - k / 64.0, 0.3)));
}

static void bounds_hold_the_patch(void **state) {
    (void)state;
    Rng rng = {6};
    Bezier s;
    random_patch(&rng, 5, 2, 1.0, &s);
    Box box = bezier_bounds(&s);
    for (int k = 0; k < 500; k++) {
        Vec3 p = bezier_eval(&s, rng_unit(&rng), rng_unit(&rng));
        for (int axis = 0; axis < 3; axis++)
            assert_true(vec_get(p, axis) >= vec_get(box.low, axis) - 1e-14 &&
                        vec_get(p, axis) <= vec_get(box.high, axis) + 1e-14);
    }
    assert_true(fabs(bezier_diameter(&s) - distance(box.low, box.high)) < 1e-15);
}

// ---- Normals ----

static void check_unit(Vec3 n) {
    assert_true(vec_is_finite(n));
    assert_true(fabs(vec_length(n) - 1.0) < 1e-14);
}

static void regular_normals(void **state) {
    (void)state;
    for (int n = 0; n < 300; n++) {
        Rng rng = {(uint64_t)n};
        Bezier s;
        random_patch(&rng, 1 + n % 5, 1 + n % 4, 0.2, &s);
        double u = rng_unit(&rng), v = rng_unit(&rng);
        Vec3 su, sv, normal = bezier_normal(&s, u, v, vec3(0, 0, 1));
        oracle_tangents(&s, u, v, &su, &sv);
        Vec3 want = vec_cross(su, sv);
        check_unit(normal);
        if (vec_length(want) > 1e-3)
            assert_true(distance(normal, vec_normalize(want)) < 1e-10);
    }
}

// Collapsed edges, at both ends of both parameters: the limit, which for the lid is the z axis all
// along the edge, and for a cone the normal of each ruling.
static void collapsed_normals(void **state) {
    (void)state;
    Bezier lid, cone, turned;
    teapot_lid(&lid);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            Vec3 p = lid.p[12 + j];
            cone.p[4 * i + j] = vec3(p.x * i / 3.0, p.y * i / 3.0, -i / 3.0);
        }
    cone.du = cone.dv = 3;
    for (int k = 0; k <= 20; k++) {
        double v = k / 20.0;
        for (int side = 0; side < 4; side++) {
            for (int shape = 0; shape < 2; shape++) {
                const Bezier *s = shape ? &cone : &lid;
                // side 1: u reversed, 2: transposed, 3: both; 1 and 2 turn the normal over.
                turned.du = turned.dv = 3;
                for (int i = 0; i < 4; i++)
                    for (int j = 0; j < 4; j++) {
                        int a = side & 1 ? 3 - i : i;
                        turned.p[side & 2 ? 4 * j + i : 4 * i + j] = bezier_at(s, a, j);
                    }
                double edge = side & 1 ? 1.0 : 0.0, sign = side == 1 || side == 2 ? -1.0 : 1.0;
                Vec3 normal = vec_scale(side & 2 ? bezier_normal(&turned, v, edge, vec3(1, 0, 0))
                                                 : bezier_normal(&turned, edge, v, vec3(1, 0, 0)),
                                        sign);
                check_unit(normal);
                // The same a little inside, where the product of tangents decides.
                Vec3 su, sv;
                oracle_tangents(s, 1e-9, v, &su, &sv);
                assert_true(distance(normal, vec_normalize(vec_cross(su, sv))) < 1e-7);
                if (!shape)
                    assert_true(distance(normal, vec3(0, 0, 1)) < 1e-15);
            }
        }
    }
}

// Towards the pole the normal tends to that of the pole without a jump or lost digits.
static void normals_are_continuous_at_the_pole(void **state) {
    (void)state;
    Bezier s;
    teapot_lid(&s);
    Rng rng = {3};
    for (double u = 1e-1; u > 1e-300; u *= 0.03) {
        double v = rng_unit(&rng);
        Vec3 n = bezier_normal(&s, u, v, vec3(1, 0, 0));
        check_unit(n);
        assert_true(distance(n, vec3(0, 0, 1)) <= 5.0 * u + 1e-15);
    }
}

// Along a ruling of a cone the normal is the same, down to the apex and to the last digits.
static void normals_keep_their_digits_at_an_apex(void **state) {
    (void)state;
    Bezier lid, cone = {.du = 3, .dv = 3};
    teapot_lid(&lid);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            Vec3 p = lid.p[12 + j];
            cone.p[4 * i + j] = vec3(5.0 + p.x * i / 3.0, p.y * i / 3.0, 7.0 - i / 3.0);
        }
    Rng rng = {4};
    for (double u = 0.3; u > 1e-14; u *= 0.1) {
        double v = rng_unit(&rng);
        Vec3 want = bezier_normal(&cone, 0.5, v, vec3(1, 0, 0));
        // 2^-36 is what the quickest way to a normal may lose.
        assert_true(distance(bezier_normal(&cone, u, v, vec3(1, 0, 0)), want) < 3e-11);
    }
}

// Corners and edges where control points coincide, one way or another: against the product of
// tangents well inside, on the diagonal.
static void coinciding_points(void **state) {
    (void)state;
    for (int n = 0; n < 200; n++) {
        Rng rng = {(uint64_t)n};
        Bezier s;
        random_patch(&rng, 3, 3, 0.05, &s);
        switch (n % 5) {
        case 0: // the corner and one neighbour
            s.p[1] = s.p[0];
            break;
        case 1: // the corner and both neighbours
            s.p[1] = s.p[4] = s.p[0];
            break;
        case 2: // a double row
            for (int j = 0; j < 4; j++)
                s.p[4 + j] = s.p[j];
            break;
        case 3: // a collapsed edge with a double row
            for (int j = 0; j < 4; j++)
                s.p[j] = s.p[0];
            for (int j = 1; j < 4; j++)
                s.p[4 + j] = s.p[4];
            break;
        default: // two collapsed edges
            for (int j = 0; j < 4; j++)
                s.p[j] = s.p[0], s.p[12 + j] = s.p[12];
            break;
        }
        Vec3 normal = bezier_normal(&s, 0.0, 0.0, vec3(0, 0, 1)), su, sv;
        check_unit(normal);
        oracle_tangents(&s, 1e-4, 1e-4, &su, &sv);
        assert_true(distance(normal, vec_normalize(vec_cross(su, sv))) < 0.05);
        for (int k = 0; k < 9; k++)
            check_unit(bezier_normal(&s, (k % 3) * 0.5, (k / 3) * 0.5, vec3(0, 0, 1)));
    }
}

static void curves_and_points_face_the_viewer(void **state) {
    (void)state;
    Bezier s = {.du = 3, .dv = 3};
    for (int k = 0; k < 16; k++)
        s.p[k] = vec3(1e7, 2.0, -3.0);
    Vec3 n = bezier_normal(&s, 0.3, 0.4, vec3(0, 3, 4));
    assert_true(distance(n, vec3(0, 0.6, 0.8)) < 1e-15);
    check_unit(bezier_normal(&s, 0.0, 1.0, vec3(0, 0, 0)));
    for (int k = 0; k < 16; k++)
        s.p[k] = vec3(k / 4, 0.0, 0.0);
    n = bezier_normal(&s, 0.3, 0.4, vec3(5, 0, 2));
    assert_true(distance(n, vec3(0, 0, 1)) < 1e-15);
    n = bezier_normal(&s, 0.3, 0.4, vec3(5, 0, 0)); // along the curve: any across
    check_unit(n);
    assert_true(fabs(n.x) < 1e-15);
}

static void normals_at_any_scale(void **state) {
    (void)state;
    const double scales[] = {1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e300};
    for (int n = 0; n < 7 * 20; n++) {
        Rng rng = {(uint64_t)(n / 7)};
        Bezier s, big;
        random_patch(&rng, 3, 3, 0.1, &s);
        bezier_copy(&big, &s);
        for (int k = 0; k < 16; k++)
            big.p[k] = vec_scale(s.p[k], scales[n % 7]);
        double u = rng_unit(&rng), v = rng_unit(&rng);
        Vec3 a = bezier_normal(&s, u, v, vec3(0, 0, 1)),
             b = bezier_normal(&big, u, v, vec3(0, 0, 1));
        check_unit(b);
        assert_true(distance(a, b) < 1e-12);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_and_tangents),
        cmocka_unit_test(second_derivatives),
        cmocka_unit_test(parts_are_the_same_surface),
        cmocka_unit_test(neighbours_share_their_bits),
        cmocka_unit_test(exactness),
        cmocka_unit_test(bounds_hold_the_patch),
        cmocka_unit_test(regular_normals),
        cmocka_unit_test(collapsed_normals),
        cmocka_unit_test(normals_are_continuous_at_the_pole),
        cmocka_unit_test(normals_keep_their_digits_at_an_apex),
        cmocka_unit_test(coinciding_points),
        cmocka_unit_test(curves_and_points_face_the_viewer),
        cmocka_unit_test(normals_at_any_scale),
    };
    return cmocka_run_group_tests_name("bezier", tests, NULL, NULL);
}
