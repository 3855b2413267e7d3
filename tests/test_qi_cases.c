// SPDX-License-Identifier: MIT
// Single rays that `make stress` found, kept as they were.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "found_ray.h"
#include "patch/qi.h"
#include "patch/rational.h"
#include "ray_oracle.h"

enum { MOST_STEPS = 400 };

// A sheet with its corner at (x, 0, z), bent by `bend`.
static PatchDef sheet(Vec3 points[16], double x, double z, double side, double bend) {
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            points[4 * i + j] =
                vec3(x + side * i / 3.0, side * j / 3.0, z + bend * i * (3 - i) * j);
    return (PatchDef){.degree_u = 3, .degree_v = 3, .points = points, .mask = UINT32_MAX};
}

// Beside one of 1e30 all others lie in one point of the tree, and all had Newton's steps, not only
// the pieces of the one that the ray passes: 28,000 for 436.
static void small_beside_huge(void **state) {
    (void)state;
    enum { COUNT = 64 };
    Vec3 points[COUNT + 1][16];
    PatchSetOptions options = patchset_options_default();
    PatchSet *set = patchset_create(&options);
    for (int k = 0; k <= COUNT; k++) {
        PatchDef def = k < COUNT ? sheet(points[k], 3.0 * k, 0.0, 1.0, 0.1)
                                 : sheet(points[k], 0.0, -1.0, 1e30, 0.0);
        def.id = (uint32_t)k;
        patchset_add(set, &def);
    }
    patchset_commit(set);
    for (int k = 0; k < COUNT; k++) {
        Ray ray = {{3.0 * k + 0.4, 0.3, 5.0}, {0.01, 0.02, -1.0}};
        PatchStats stats = {0};
        PatchHit hit;
        assert_true(patchset_intersect(set, &ray, 0.0, INFINITY, UINT32_MAX, &stats, &hit));
        assert_int_equal(hit.id, k);
        PatchDef def = sheet(points[k], 3.0 * k, 0.0, 1.0, 0.1);
        assert_true(ray_oracle_residual(&def, &ray, hit.t, hit.u, hit.v) <= hit.bound);
        if (stats.newton > 1000)
            fail_msg("%d Newton steps", (int)stats.newton);
    }
    patchset_destroy(set);
}

// A quarter of a cap: the side u = 0 is its top, where it is level; `both` makes v = 0 the top too.
static void cap(Bezier *s, bool both) {
    static const double c[4] = {1.0, 1.0, 0.55, 0.0}, drop[4] = {0.0, 0.0, 0.4, 1.0};
    s->du = s->dv = 3;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            double r = both ? i / 3.0 * j / 3.0 : i / 3.0;
            s->p[4 * i + j] = vec3(r * c[j], r * c[3 - j], both ? -r * r : -drop[i]);
        }
    }
}

// Rays through the top, as good as level: 60 to 600 nets came down to it in all its slices.
static void flat_rays_at_poles(void **state) {
    (void)state;
    for (int k = 0; k < 1000; k++) {
        double turn = 0.01 * (k % 100) * 6.3, slope = pow(10.0, -4.0 * (k / 100) / 9.0);
        Bezier s;
        cap(&s, k % 2);
        Vec3 dir = vec3(cos(turn), sin(turn), -slope);
        QiQuery q = qi_query_default(&s, (Ray){vec_neg(dir), dir});
        QiHit hit;
        QiStats stats = {0};
        assert_true(qi_reduce_nearest(&s, &q, &stats, &hit));
        assert_true(hit.t <= 1.0 + 1e-8);
        if (stats.steps > 100)
            fail_msg("%d steps at slope %g, turned by %g", (int)stats.steps, slope, turn);
    }
}

// Rays beside the top by 10^-k of the cap, k up to 14: up to 29 nets came down to it by a
// constant factor each.
static void rays_beside_poles(void **state) {
    (void)state;
    for (int k = 0; k < 2000; k++) {
        double turn = 0.05 * k, off = pow(0.1, 14.0 * (k % 37) / 36.0);
        Bezier s;
        cap(&s, false);
        Vec3 side = vec3(cos(turn), sin(turn), 0.0);
        Vec3 dir = vec3(0.3 * sin(0.7 * k), 0.3 * cos(0.9 * k), -1.0);
        QiQuery q = qi_query_default(&s, (Ray){vec_madd(vec_neg(dir), off, side), dir});
        QiHit hit;
        QiStats stats = {0};
        qi_reduce_nearest(&s, &q, &stats, &hit);
        if (stats.steps > 12)
            fail_msg("%d steps at %g, turned by %g", (int)stats.steps, off, turn);
    }
}

// Rays along the tangent plane of a wavy sheet, above it or below by 10^-k of its size: up to 560
// nets halved their way along the curve on which the ray is level with the sheet.
static void tangent_rays(void **state) {
    (void)state;
    Bezier s = {.du = 3, .dv = 3};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            s.p[4 * i + j] = vec3(i + 0.1 * j, j - 0.2 * i, sin(2.5 * i - 1.0) * cos(1.5 * j));
    for (int k = 0; k < 2000; k++) {
        double u = 0.01 * (k % 97 + 1), v = 0.01 * (k % 89 + 1), turn = 0.1 * k;
        double off = k % 10 == 0 ? 0.0 : pow(0.1, k % 10 + 4.0) * (k % 20 < 10 ? 3.0 : -3.0);
        Vec3 su, sv, at = bezier_eval1(&s, u, v, &su, &sv);
        Vec3 normal = vec_normalize(vec_cross(su, sv));
        Vec3 dir = vec_add(vec_scale(su, cos(turn)), vec_scale(sv, sin(turn)));
        Vec3 org = vec_sub(vec_madd(at, off, normal), dir);
        QiQuery q = qi_query_default(&s, (Ray){org, dir});
        QiHit hit;
        QiStats stats = {0};
        qi_reduce_nearest(&s, &q, &stats, &hit);
        if (stats.steps > 80)
            fail_msg("ray %d: %d steps", k, (int)stats.steps);
    }
}

// Rays at rational patches whose weights differ by up to 1e12.
typedef struct {
    const char *before;
    int du, dv;
    Vec3 points[16];
    double weights[16];
    Ray ray;
} FoundRational;

static const FoundRational last_bit = {
    "v known to its last bit only, which is 9e-11 on the ray: Newton ended 2 bits beside and was "
    "told to have left the ray, so the hit was missed",
    1,
    3,
    {{-0.19990123565970053, -0.28449219711194379, 0.30465936463582594},
     {0.20637272990297992, 0.35055214400713408, -0.065545313350764633},
     {0.12103309911069279, 0.69300946754249615, 0.15432196827808209},
     {-0.052455272878254355, 0.76724177251008818, 0.32135666536087776},
     {0.79289051680670264, 0.11245152257705038, 0.28188718140500535},
     {0.81784264217749159, 0.63366828974205192, 0.55181345064291176},
     {0.77889380173725009, 0.53030890728486124, 0.79640409906765774},
     {0.16628132545967347, 0.8255764298628514, 1.3799316481103128}},
    {537923.37018169672, 0.0002734362356720375, 2.0392693670999664, 18044.922896527911,
     161.64926266211597, 0.00024352767832166934, 223242.91336984487, 0.0001508967805343768},
    {{0.577439715919567, 0.3910706986597221, 0.69339900435860624},
     {-0.43306810623143982, 0.31808350783971212, -0.25889603873942407}}};

static void known_to_the_last_bit(void **state) {
    (void)state;
    const FoundRational *f = &last_bit;
    Bezier s;
    bezier_init(&s, f->du, f->dv, f->points);
    QiQuery q = qi_query_default(&s, f->ray);
    q.t_min = 1e-3;
    q.rect = (BezierRect){0x1.fffe8p-1, 0x1.ffffp-1, 0x1.fffffp-1, 1.0};
    QiHit hit;
    if (!qi_rational_nearest(&s, f->weights, &q, NULL, &hit))
        fail_msg("%s", f->before);
    assert_true(fabs(hit.t - 1.0106030725) < 1e-9);
}

static const FoundRational short_tangent = {
    "weights of one side 1e9 times larger leave dS/dv 1e-9 long, which rounding covered: the "
    "normal "
    "of the points without their weights came out, 54 degrees beside",
    3,
    1,
    {{0.090581898128142671, 0.4662942422099271, 0.031878998824501681},
     {0.71369588626231306, 0.23524044888363091, 0.47725258409480409},
     {-0.34623092516504833, 0.19001396173070945, 0.17673078182603194},
     {0.80458167764279909, 0.83538458467089849, 0.60952113630361748},
     {-0.08053785188085677, 0.20115132883490669, 0.94147731714278082},
     {0.46644693649740598, 0.42080867206198713, 0.72798479318593423},
     {-0.4961782266427287, 0.58915633816885027, 0.78743486925226513},
     {0.75874283212231663, 0.60920328139442659, 1.1280018581956388}},
    {9.3959015793204675e-05, 0.13824066745177155, 0.017019530929775935, 0.00085465343204657487,
     37793.16412565163, 1.1584338896218008e-05, 5768.4952365861154, 1.2533916156201238e-05},
    {{-0.2560117368206497, 0.36495818825003568, 0.87644409743547069},
     {-0.70508612526014636, -0.1312917529526281, 0.25179188151436943}}};

// Both tangents are known to the oracle's digits.
static void normals_of_uneven_weights(void **state) {
    (void)state;
    const FoundRational *f = &short_tangent;
    PatchDef def = {.degree_u = (uint32_t)f->du,
                    .degree_v = (uint32_t)f->dv,
                    .points = f->points,
                    .weights = f->weights,
                    .mask = UINT32_MAX};
    Bezier s;
    bezier_init(&s, f->du, f->dv, f->points);
    for (int k = 0; k <= 16; k++) {
        double u = 0.93489830045055355, v = k < 16 ? k / 16.0 : 0.010710036846071778;
        Vec3 jet[3], normal = rational_normal(&s, f->weights, u, v, f->ray.dir);
        ray_oracle_jet(&def, u, v, jet);
        for (int n = 1; n < 3; n++)
            if (!(fabs(vec_dot(normal, vec_normalize(jet[n]))) < 1e-7))
                fail_msg("%s: v %g", f->before, v);
    }
    // So a ray that leaves there is far from clear after three bounds.
    PatchHit hit = {.u = 0.93489830045055355,
                    .v = 0.010710036846071778,
                    .normal = rational_normal(&s, f->weights, 0.93489830045055355,
                                              0.010710036846071778, f->ray.dir),
                    .bound = 6.7932030143528592e-14};
    double t = patch_clearance(&def, &hit, &f->ray);
    Arena *arena = arena_create();
    const RayOracleSet *oracle = ray_oracle_prepare(arena, &def, 1);
    assert_false(ray_oracle_near(oracle, &f->ray, t, 1.001 * t, hit.bound));
    arena_destroy(arena);
}

static const Found late_start = {
    "a range that begins where the ray is still near the surface, nearer than rounding can tell: "
    "3250 nets and 1459 walks to the begin of the range, 16 ms",
    {{-1518313528.1373816, 2150612497.0725904, -899754857.39025879},
     {1279401648.1454339, -1812206189.408083, 758175321.19716358},
     {1374816944.0163467, -1947357015.5878119, 814718567.29858768},
     {-288190479.16201764, 408206891.80917019, -170782108.15164042},
     {1642468144.2357581, -2326471082.8640385, 973329067.88967252},
     {-12258704623.374523, 17363820366.790848, -7264526611.1983805},
     {1649375288.3467655, -2336254694.8090754, 977422251.09586644},
     {-534707189.15188259, 757385046.78971064, -316868277.33111387},
     {-974263621.44508445, 1379993972.9751685, -577350072.33891034},
     {89270587.803632498, -126447166.54208916, 52901883.244895682},
     {1373096559.6226897, -1944920181.3046176, 813699065.16913891},
     {1856535940.7935784, -2629687033.0606556, 1100185961.898221},
     {2260395160.4481583, -3201732707.2648082, 1339513538.0324306},
     {805755198.39888239, -1141310519.6723406, 477491730.30169976},
     {-305435255.95157945, 432633223.50088215, -181001387.6914362},
     {2382711650.2213874, -3374987681.7352905, 1411998470.8516405}},
    {{2258326641.703804, -3198802757.5799866, 1338287729.622036},
     {-0.20925651892037114, -0.24315841473708635, 0.038929264399099238}}};

static const FoundRational behind_the_start = {
    "depths of a curve before the range all counted: 2584 nets, 5 ms, and a hit 8e-10 beside the "
    "surface before the crossing at 0.0051",
    2,
    2,
    {{-0.055756919196510407, -0.31892063063129084, -0.20670175672785335},
     {-0.56267616356534045, 0.34774993877414995, 0.066963418336763392},
     {-1.0956362831244573, 0.29804996394302358, 0.15231637371360926},
     {0.20101582973233678, 0.36760535473200029, -0.55115533415334295},
     {-0.55154344990916093, -0.078586551026968154, -0.58183242992197604},
     {-1.1373272683997986, 0.35544252286402883, -0.43349565263675655},
     {0.084079021654702074, 0.50717101643252893, -1.0127924630504637},
     {-0.56454546160637176, 0.44273843618795045, -0.95617397819058148},
     {-0.9722652467710946, 0.6240968928734143, -0.95232500624991001}},
    {9.240463640005248e-05, 0.13338050652366273, 0.00056376603800073716, 0.00016187333818212739,
     13888.447550519031, 0.00023951990355944994, 20.918210645307859, 3.6315746070718321e-05,
     0.00091777451888745947},
    {{-0.54897194536947702, -0.076216368824670422, -0.58357580394499808},
     {0.84014379733921407, 0.52712768906654006, -0.05765216023581024}}};

static const FoundRational bent_depths = {
    "a curve whose depths end at half of the range's begin, bounded to the first order: 1265 nets, "
    "1 ms",
    1,
    2,
    {
        {-0.044683028043571285, -0.14948729280385742, 0.14467795395913785},
        {-0.12534613710819734, -0.51208546798003141, -0.078735828204649416},
        {0.19772193986647366, -0.82217067642611252, -0.56786036658786077},
        {0.72751201215095795, -0.42822293643977166, 0.63048125500366514},
        {0.91976649721515347, -0.74645179949129237, 0.28366981121522705},
        {1.0329858771240468, -0.99946223923115962, 0.073722740311006146},
    },
    {140578.583228017, 1.0933013006126812e-06, 9.6227432105830459e-05, 6.1151106599554988e-06,
     22145.090468882056, 1.4707803771972239},
    {{-0.044016411122706378, -0.14989990817816337, 0.14477402352775426},
     {0.59983151435952853, 0.10438390523637978, 0.68145228030895788}}};

// Rays that are clear of the surface by no more than what rounding can tell.
static void ranges_near_the_surface(void **state) {
    (void)state;
    Bezier s;
    QiHit hit;
    bezier_init(&s, 3, 3, late_start.points);
    QiQuery q = qi_query_default(&s, late_start.ray);
    q.t_min = 0.039702519479758766;
    QiStats stats = {0}, all = stats;
    qi_reduce_nearest(&s, &q, &stats, &hit);
    qi_reduce_all(&s, &q, &all, NULL, NULL);
    if (stats.steps + all.steps > MOST_STEPS)
        fail_msg("%s: %d steps", late_start.before, (int)(stats.steps + all.steps));

    const FoundRational *f = &behind_the_start;
    bezier_init(&s, f->du, f->dv, f->points);
    q = qi_query_default(&s, f->ray);
    q.t_min = 1.5792037496330096e-09;
    stats = (QiStats){0};
    assert_true(qi_rational_nearest(&s, f->weights, &q, &stats, &hit));
    if (stats.steps > MOST_STEPS || !(fabs(hit.t - 0.0051312083615664) < 1e-12))
        fail_msg("%s: %d steps, t %.17g", f->before, (int)stats.steps, hit.t);

    f = &bent_depths;
    bezier_init(&s, f->du, f->dv, f->points);
    q = qi_query_default(&s, f->ray);
    q.t_min = 7.0601061348227676e-11;
    stats = (QiStats){0};
    qi_rational_nearest(&s, f->weights, &q, &stats, &hit);
    if (stats.steps > MOST_STEPS)
        fail_msg("%s: %d steps", f->before, (int)stats.steps);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_beside_huge),       cmocka_unit_test(flat_rays_at_poles),
        cmocka_unit_test(rays_beside_poles),       cmocka_unit_test(tangent_rays),
        cmocka_unit_test(known_to_the_last_bit),   cmocka_unit_test(normals_of_uneven_weights),
        cmocka_unit_test(ranges_near_the_surface),
    };
    return cmocka_run_group_tests_name("qi_cases", tests, NULL, NULL);
}
