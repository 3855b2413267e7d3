// SPDX-License-Identifier: MIT
// A scene of the teapot is the same picture at every scale: its rays start where bounds say, not
// where constants do. POV-Ray's constants (1e-4 for a hit, 1e-3 for a shadow, 1e-5 for a patch)
// left nothing of it at 1e-4, and sheets 1e-6 apart were one for shadows and reflections.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "pictures.h"
#include "world_stage.h"

#include "base/rng.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char *const scene_text =
    "#version 3.7;\n"
    "#include \"teapot_patches.inc\"\n"
    "global_settings { assumed_gamma 1 }\n"
    "camera { location S*<1.8, 4.6, -11.5> right x*image_width/image_height angle 42\n"
    "  look_at S*<0.1, 1.15, 0> }\n"
    "light_source { S*<-9, 13, -8> rgb <1.5, 1.38, 1.2> }\n"
    "sky_sphere { pigment { gradient y color_map { [0 rgb <0.8,0.66,0.5>] [1 rgb 0.3] } } }\n"
    "object { Teapot texture { pigment { rgb <0.62, 0.25, 0.13> }\n"
    "  finish { ambient 0.06 diffuse 0.6 reflection 0.4 specular 0.4 } } scale S }\n"
    "bicubic_patch { type 1 flatness 0 u_steps 4 v_steps 4\n"
    "  <-5,0,-5>,<-2,0,-5>,<2,0,-5>,<5,0,-5>, <-5,0,-2>,<-2,0.2,-2>,<2,0,-2>,<5,0,-2>,\n"
    "  <-5,0,2>,<-2,0,2>,<2,0.2,2>,<5,0,2>, <-5,0,5>,<-2,0,5>,<2,0,5>,<5,0,5>\n"
    "  pigment { rgb 0.7 } finish { reflection 0.2 } scale S }\n";

static const char *picture_at(const char *scene, const char *scale) {
    char switches[4096], name[64], here[2048];
    assert_non_null(getcwd(here, sizeof here));
    snprintf(name, sizeof name, "at-%s", scale);
    snprintf(switches, sizeof switches, "+W160 +H120 -D -A Declare=S=%s +L%s/scenes/teapot", scale,
             here);
    return render_with_qirender(name, scene, switches);
}

// Rounding moves edges by less than a billionth: a few pixels of 19,200 see the other side of one.
static void same_at_every_scale(void **state) {
    (void)state;
    char path[2048];
    snprintf(path, sizeof path, "%s/scales.pov", scratch_folder());
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(scene_text, f);
    fclose(f);
    char *one = strdup(picture_at(path, "1"));
    static const char *const scales[] = {"1e-8", "1e-4", "1e6"};
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        double differ = percent_over(one, picture_at(path, scales[i]), 1.5 / 255.0);
        printf("scale %s: %.4f %% of the pixels differ\n", scales[i], differ);
        assert_true(differ <= 0.05);
    }
    free(one);
}

// A ray that leaves one of two sheets 1e-6 apart meets the other, and never the one it leaves,
// however flat it goes.
static void sheets_are_two(void **state) {
    (void)state;
    Stage stage = stage_begin();
    Object low = stage_flat_patch(&stage, 0.0), high = stage_flat_patch(&stage, 1e-6);
    uint32_t first = stage_put(&stage, &low), second = stage_put(&stage, &high);
    stage_put_root(&stage, first);
    stage_put_root(&stage, second);
    stage_ready(&stage, false);
    PatchSetOptions options = patchset_options_default();
    World *world = world_create(&stage.scene, &options);
    Rng rng = {5};
    for (int i = 0; i < 500; i++) {
        Vec3 p = vec3(rng_range(&rng, 0.2, 0.8), rng_range(&rng, 0.2, 0.8), 0.0);
        Vec3 d = vec3(rng_range(&rng, -1, 1), rng_range(&rng, -1, 1), rng_range(&rng, 0.2, 1));
        Ray ray = {vec_madd(p, -2.0, d), d};
        WorldHit hit, next;
        assert_true(world_nearest(world, &ray, world_near(world, NULL, d, 1e-4), INFINITY,
                                  RAY_CAMERA, NULL, &hit));
        assert_int_equal(hit.object, first);
        // On through, and back.
        d.z *= pow(10.0, -rng_range(&rng, 0, 4));
        ray = (Ray){hit.p, d};
        WorldNear near = world_near(world, &hit, d, 1e-4);
        uint32_t last = WORLD_NO_BLOCKER;
        assert_true(world_nearest(world, &ray, near, INFINITY, RAY_ALL, NULL, &next));
        assert_int_equal(next.object, second);
        assert_true(world_blocked(world, &ray, near, INFINITY, &last, NULL));
        ray.dir = d = vec_neg(d);
        near = world_near(world, &hit, d, 1e-4);
        assert_false(world_nearest(world, &ray, near, INFINITY, RAY_ALL, NULL, &next));
        assert_false(world_blocked(world, &ray, near, INFINITY, &last, NULL));
    }
    world_destroy(world);
    stage_end(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_at_every_scale),
        cmocka_unit_test(sheets_are_two),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
