// SPDX-License-Identifier: MIT
// Single rays that the hard cases of `make stress` found, kept as they were or made simple.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "found_ray.h"
#include "ray_oracle.h"

static const Found tiny = {
    "of size 1e-45 bounds of second derivatives were 0 in single precision: Newton ended 5e-11 of "
    "the patch before the crossing and said it was there to 4e-14",
    {{-1.8549100409955476e-46, 2.3211865411967644e-47, 1.9984338834647672e-46},
     {5.1770146755819959e-47, -3.2972416479856093e-46, -1.2086482767681379e-47},
     {-9.7421677525207889e-47, -6.429937857370539e-46, 1.6106334915856324e-46},
     {-1.6666850532582989e-46, -9.8383413349809834e-46, 2.6836664340674331e-46},
     {2.1161923978976153e-46, 1.7681733351993908e-47, 2.4067703578938798e-46},
     {8.291190396201567e-47, -3.2213261295627558e-46, 4.1610706746449916e-46},
     {1.8008167028510437e-46, -6.5380845826294056e-46, 3.5831827498575354e-46},
     {2.1619859528870103e-46, -9.7622896001530734e-46, 3.350280942601783e-46},
     {3.7578245189017606e-46, 3.3319435061468867e-47, 5.9092883707055583e-46},
     {5.8392071076629711e-46, -3.0352062963961228e-46, 3.7967463304416551e-46},
     {6.5659682698903033e-46, -6.2608553549187997e-46, 3.3164502115999107e-46},
     {3.1326850930133169e-46, -9.7295219702090431e-46, 7.3459595996025145e-46},
     {5.6799037119592297e-46, 5.0091550766795371e-47, 8.4370054552489642e-46},
     {7.4012706405264e-46, -2.8006221638577556e-46, 6.9647953007119169e-46},
     {7.280410139545876e-46, -6.0592155881614552e-46, 7.079936930026812e-46},
     {8.3356510264745434e-46, -9.3785146044498019e-46, 6.4638349643360548e-46}},
    {{5.766739844134632e-46, 2.7616344783311095e-45, 4.1424890735156032e-47},
     {-4.2034602363318159e-46, -3.1507234347537883e-45, 2.452575610008156e-46}}};

static void patches_smaller_than_floats(void **state) {
    (void)state;
    PatchDef def = def_of(tiny.points);
    PatchSet *set = set_of(&def);
    PatchHit hit;
    assert_true(patchset_intersect(set, &tiny.ray, 0.0, INFINITY, UINT32_MAX, NULL, &hit));
    double off = ray_oracle_residual(&def, &tiny.ray, hit.t, hit.u, hit.v);
    if (!(off <= hit.bound))
        fail_msg("%s: off %g, bound %g", tiny.before, off, hit.bound);
    patchset_destroy(set);
}

static const Found corner = {
    "through the point that u = 0 and v = 0 are, 0.1 behind another crossing: the two were one, "
    "since a piece at both sides was taken for the place of the point",
    {{-3.4060460287964366e-09, 1.5041662891131675e-09, 6.8756135274687663e-10},
     {-3.4060460287964366e-09, 1.5041662891131675e-09, 6.8756135274687663e-10},
     {-3.4060460287964366e-09, 1.5041662891131675e-09, 6.8756135274687663e-10},
     {-3.4060460287964366e-09, 1.5041662891131675e-09, 6.8756135274687663e-10},
     {-3.4060460287964366e-09, 1.5041662891131675e-09, 6.8756135274687663e-10},
     {2.3825982275639794e-09, 4.744919149492458e-09, -9.5070918450882336e-10},
     {6.7812952116210568e-10, 1.1478214281376051e-08, -8.7236405171199736e-11},
     {2.8364745611694852e-09, 1.425739155773128e-08, 2.3816556617275125e-09},
     {-3.4060460287964366e-09, 1.5041662891131675e-09, 6.8756135274687663e-10},
     {3.5391780202944656e-09, 7.5052772956856169e-09, -4.1912301381991236e-09},
     {4.1086790725003814e-09, 1.4241859193996721e-08, -1.7196178887169569e-09},
     {1.264999393344353e-08, 1.143973810766353e-08, 1.0076373533389818e-09},
     {-3.4060460287964366e-09, 1.5041662891131675e-09, 6.8756135274687663e-10},
     {3.4448356260722367e-09, 1.2261027685261543e-08, -7.5766630475091556e-09},
     {8.584069364549221e-09, 1.3524074450985368e-08, -7.3286962076160254e-09},
     {9.6768467437687222e-09, 1.6642474805516646e-08, -3.0755106514382339e-09}},
    {{8.584069364549221e-09, 1.3524074450985368e-08, -7.3286962076160254e-09},
     {-1.1990115393345657e-08, -1.20199081618722e-08, 8.0162575603629012e-09}}};

static void two_sides_one_point(void **state) {
    (void)state;
    PatchDef def = def_of(corner.points);
    PatchSet *set = set_of(&def);
    int count = 0;
    patchset_all(set, &corner.ray, 0.0, INFINITY, UINT32_MAX, NULL, count_hit, &count);
    if (count != 2)
        fail_msg("%s: %d hits", corner.before, count);
    patchset_destroy(set);
}

// z = twist x y + bend x^2 over [0,1]^2.
static void sheet(Vec3 points[16], double twist, double bend) {
    static const double square[4] = {0.0, 0.0, 1.0 / 3.0, 1.0};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            points[4 * i + j] = vec3(i / 3.0, j / 3.0, twist * i * j / 9.0 + bend * square[i]);
}

// Rays along the tangent x at (1/4, 1/2), where the sheet bends away by less than its own size or
// not at all (a ruling, up to its end): it was taken to bend by 1, so that the ray was said to be
// clear where it is a hundredth of the hit's bound beside the surface.
static void clear_of_what_hardly_bends(void **state) {
    (void)state;
    static const double bends[] = {0.5, 0.1, 1e-2, 1e-3, 1e-6, 1e-10, 0.0};
    for (size_t k = 0; k < sizeof bends / sizeof *bends; k++) {
        for (double bound = 1e-15; bound < 1e-9; bound *= 100.0) {
            Vec3 points[16], s[3];
            sheet(points, 0.25, bends[k]);
            PatchDef def = def_of(points);
            ray_oracle_jet(&def, 0.25, 0.5, s);
            PatchHit hit = {.u = 0.25, .v = 0.5, .bound = bound};
            hit.normal = vec_normalize(vec_cross(s[1], s[2]));
            Ray ray = {s[0], s[1]};
            // Its height over the ray is bend (x - 1/4)^2.
            double t = patch_clearance(&def, &hit, &ray), height = bends[k] * t * t;
            if (!(t >= 0.75 || height >= bound) || t > 0.75 + 20.0 * bound + 1e-12 ||
                !(t <= 0.75 || height <= 12.0 * bound + 1e-13))
                fail_msg("bend %g, bound %g: %.17g", bends[k], bound, t);
        }
    }
}

// x and y folded three times each, z their sum: where x = -y the sheet holds lines at 45 degrees.
// All hits of a ray along one were asked for in each piece to the end: 61,066 nets, 0.15 s.
static void all_along_a_line(void **state) {
    (void)state;
    static const double fold[4] = {-1.0, 5.0, -5.0, 1.0};
    const double size = 6.6170995134498946e-05;
    Vec3 points[16];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            points[4 * i + j] = vec_scale(vec3(fold[i], fold[j], -0.5 * (i + j)), size);
    Ray ray = {vec3(size, -size, -1.5 * size), vec3(-4.0 * size, 4.0 * size, 0.0)};
    PatchDef def = def_of(points);
    PatchSet *set = set_of(&def);
    PatchStats stats = {0};
    PatchHit nearest;
    int count = 0;
    assert_true(patchset_intersect(set, &ray, 0.0, INFINITY, UINT32_MAX, NULL, &nearest));
    assert_true(ray_oracle_residual(&def, &ray, nearest.t, nearest.u, nearest.v) <= nearest.bound);
    patchset_all(set, &ray, 0.0, INFINITY, UINT32_MAX, &stats, count_hit, &count);
    if (count == 0 || stats.steps > 10000)
        fail_msg("%d hits, %d nets", count, (int)stats.steps);
    patchset_destroy(set);
}

// Beside a corner whose two tangents are one line, where the sheet bends within a hundredth of the
// hit's bound: the ray was said to be clear after that, and met the corner again.
static void clear_of_singular_corners(void **state) {
    (void)state;
    static const Vec3 points[20] = {
        {1, 0, -1},  {-1, 1, -1},  {0, 1, -1},  {0, -1, 1},  {1, -1, 1}, {-1, 1, -1}, {0, -1, 0},
        {1, 1, -1},  {0, 0, 0},    {-1, -1, 1}, {1, -1, -1}, {0, -1, 0}, {-1, 1, -1}, {1, -1, -1},
        {0, -1, -1}, {-1, -1, -1}, {-1, 0, -1}, {0, -1, -1}, {1, -1, 0}, {0, 1, 1}};
    PatchDef def = {.degree_u = 3, .degree_v = 4, .points = points, .mask = UINT32_MAX};
    PatchHit hit = {.u = 3.8271674379910449e-10,
                    .v = 1.0,
                    .normal = {-7.2615396567530498e-10, 0.31622776659776108, 0.94868329785687278},
                    .bound = 9.64575e-14};
    Ray ray = {{0.99999999770369952, -1.0, 1.0},
               {-1.8417240939681729e-18, 6.7158264292330097e-19, -3.4858388271381689e-19}};
    double way = patch_clearance(&def, &hit, &ray) * vec_length(ray.dir);
    if (!(way >= 2.0 * hit.bound))
        fail_msg("clear after %g", way);
}

// Rays at a sheet's end, along it or nearly so and onwards: beside nothing any more. They were said
// to be clear where the sheet, had it gone on, would have been left: the crossing with a neighbour
// was passed over, 5e-10 behind the corner of six patches.
static void clear_where_the_patch_ends(void **state) {
    (void)state;
    const double bound = 1e-13;
    for (int k = 0; k < 8; k++) {
        double slope = k & 1 ? 1e-6 : 0.0, bend = k & 2 ? 2.0 : 0.0, back = k & 4 ? 1e-12 : 0.0;
        Vec3 points[16], s[3];
        sheet(points, 0.25, bend);
        PatchDef def = def_of(points);
        ray_oracle_jet(&def, 1.0 - back, 0.5, s);
        Vec3 normal = vec_normalize(vec_cross(s[1], s[2]));
        PatchHit hit = {.u = 1.0 - back, .v = 0.5, .normal = normal, .bound = bound};
        Ray ray = {s[0], vec_madd(vec_normalize(s[1]), slope, normal)};
        // To the end, and then away by 7 bounds and what rounding adds.
        double t = patch_clearance(&def, &hit, &ray);
        if (!(t >= 2.0 * bound && t <= back * vec_length(s[1]) + 8.0 * bound))
            fail_msg("%d: clear after %g", k, t);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patches_smaller_than_floats), cmocka_unit_test(two_sides_one_point),
        cmocka_unit_test(clear_of_what_hardly_bends),  cmocka_unit_test(clear_of_singular_corners),
        cmocka_unit_test(clear_where_the_patch_ends),  cmocka_unit_test(all_along_a_line),
    };
    return cmocka_run_group_tests_name("qi_found", tests, NULL, NULL);
}
