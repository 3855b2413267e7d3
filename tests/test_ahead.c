// SPDX-License-Identifier: MIT
// Blocks of camera rays whose hits, light rays and reflections are looked at ahead, in packets,
// against the same rays traced one by one.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "render/camera.h"
#include "render/trace.h"
#include "tests/convert_help.h"

#include <string.h>

enum { ACROSS = 33, DOWN = 23, BLOCK = 4 };

#define CAMERA "camera { location <0.3, 2, -4> look_at <0, 0.2, 0> }\n"
#define BOWL(at, texture)                                                                          \
    "bicubic_patch { type 1 u_steps 3 v_steps 3\n"                                                 \
    "<-1,1,-1>,<-0.4,0,-1>,<0.4,0,-1>,<1,1,-1>, <-1,0,-0.4>,<-0.4,-1,-0.4>,<0.4,-1,-0.4>,"         \
    "<1,0,-0.4>, <-1,0,0.4>,<-0.4,-1,0.4>,<0.4,-1,0.4>,<1,0,0.4>, <-1,1,1>,<-0.4,0,1>,<0.4,0,1>,"  \
    "<1,1,1> texture { " texture " } translate " at " }\n"
#define CHROME "pigment { rgb 0.3 } finish { reflection 0.7 specular 0.8 }"
#define GLASS "pigment { rgbf <0.9, 1, 0.8, 0.7> } finish { reflection { 0.1, 0.9 } }"
#define CLAY "pigment { rgb <0.8, 0.6, 0.4> }"
#define FLOOR "plane { y, -1 pigment { checker rgb 1, rgb 0.2 } finish { reflection 0.2 } }\n"
#define BOWLS                                                                                      \
    BOWL("<-1, 0, 0>", CHROME) BOWL("<1, 0.2, 0.4>", CLAY) BOWL("<0, 0.9, 1>", CHROME) FLOOR
#define LIGHT "light_source { <3, 5, -4>, 0.9 }\n"

static const char *const scenes[] = {
    CAMERA LIGHT BOWLS,
    // Light that comes through.
    CAMERA LIGHT BOWL("<0, 1.2, -0.5>", GLASS) BOWLS "sphere { <0, 0, -1>, 0.5 " CLAY " }\n",
    // Lights of all kinds.
    CAMERA
    "light_source { <3, 5, -4>, 0.5 spotlight point_at <0, 0, 0> radius 8 falloff 20 }\n"
    "light_source { <-3, 5, -4>, 0.4 parallel point_at <0, 0, 0> }\n"
    "light_source { <0, 4, 1>, 0.3 shadowless }\n"
    "light_source { <1, 4, 3>, 0.3 area_light x, z, 3, 3 fade_distance 4 fade_power 2 }\n"
    "light_source { <-1, 3, 2>, 0.3 cylinder point_at <0, 0, 0> radius 1 falloff 2 }\n" BOWLS,
    // Bent normals, textures side by side, both sides lit, no lights at all on one.
    CAMERA LIGHT BOWL("<-1, 0, 0>", CHROME " normal { bumps 0.7 scale 0.1 }")
        BOWL("<1, 0, 0>", "checker texture { " CHROME " } texture { " CLAY " } scale 0.3") BOWL(
            "<0, 1, 1>", CLAY " finish { diffuse 0.6, 0.4 } } double_illuminate texture { " CLAY)
            BOWL("<0, 0, 2>", "pigment { rgb 1 } finish { ambient 1 diffuse 0 }") FLOOR,
    // Some lights shine on some things.
    CAMERA "light_group { light_source { <3, 5, -4>, 0.9 } " BOWL("<-1, 0, 0>", CHROME) " }\n" BOWL(
        "<1, 0, 0>", CLAY) LIGHT FLOOR,
    CAMERA LIGHT LIGHT LIGHT LIGHT LIGHT LIGHT LIGHT LIGHT LIGHT BOWLS,
    CAMERA LIGHT "fog { distance 8 rgb <0.5, 0.6, 0.8> }\n" BOWLS,
    "camera { orthographic location <0, 3, -4> look_at 0 right 4*x up 3*y }\n" LIGHT BOWLS,
};

static void planned(const CameraView *view, int top, int down, Ray *rays) {
    for (int y = 0; y < down; y++)
        for (int x = 0; x < ACROSS; x++)
            assert_true(camera_ray(view, x, top + y, &rays[y * ACROSS + x]));
}

// Between them, a ray that nobody has foreseen.
static void interrupt(Tracer *ahead, const Ray *ray) {
    Ray other = *ray;
    other.dir = vec_normalize(vec_add(other.dir, vec3(0.001, 0.002, 0)));
    tracer_trace(ahead, &other);
}

static void compare(const Scene *scene, int number) {
    PatchSetOptions qi = patchset_options_default();
    World *world = world_create(scene, &qi);
    const TraceOptions options = {.quality = 9, .patches = qi};
    Shading *shading = shading_create(scene, world, &options);
    Tracer *ahead = tracer_create(shading), *alone = tracer_create(shading);
    CameraView view = camera_view(&scene->camera, shading_textures(shading), ACROSS, DOWN);
    Ray rays[BLOCK * ACROSS];
    for (int top = 0; top < DOWN; top += BLOCK) {
        int down = DOWN - top < BLOCK ? DOWN - top : BLOCK;
        planned(&view, top, down, rays);
        tracer_foresee(ahead, rays, ACROSS, (size_t)down);
        for (int i = 0; i < down * ACROSS; i++) {
            Ray same = rays[i];
            Color a = tracer_trace(ahead, &rays[i]), b = tracer_trace(alone, &same);
            if (memcmp(&a, &b, sizeof a) != 0)
                print_error("scene %d, pixel %d,%d: %g %g %g, alone %g %g %g\n", number, i % ACROSS,
                            top + i / ACROSS, a.r, a.g, a.b, b.r, b.g, b.b);
            assert_memory_equal(&a, &b, sizeof a);
            if (i % 5 == 0)
                interrupt(ahead, &rays[i]);
        }
    }
    RayStats a = tracer_stats(ahead), b = tracer_stats(alone);
    assert_true(a.shadow > b.shadow && b.shadow > 0 && a.reflected > b.reflected);
    tracer_destroy(ahead);
    tracer_destroy(alone);
    shading_destroy(shading);
    world_destroy(world);
}

static void colors_are_those_of_single_rays(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        compare(scene_of(scenes[i]), (int)i);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(colors_are_those_of_single_rays)};
    return cmocka_run_group_tests_name("ahead", tests, NULL, NULL);
}
