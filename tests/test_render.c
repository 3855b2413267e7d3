// SPDX-License-Identifier: MIT
// The whole way from a scene to the values of a file, against POV-Ray's own files: one ball of a
// plain colour, so that this tests tiles, area, alpha and threads, not the shading. Its radius is
// one that no sample touches the silhouette of.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "option_line.h"
#include "reference.h"
#include "render/render.h"

#include <stdio.h>
#include <string.h>

static const char *const ball_text =
    "#version 3.7; global_settings { assumed_gamma 1.0 }\n"
    "camera { orthographic location -3*z right 4*x up 3*y direction z }\n"
    "sphere { 0, 0.97 pigment { rgb <0.9, 0.6, 0.3> } finish { ambient 1 diffuse 0 } }\n";

static Scene *ball(Arena *arena) {
    Scene *scene = ARENA_NEW(arena, Scene);
    scene->settings = (Settings){.version = 370,
                                 .gamma_mode = GAMMA_POWER,
                                 .assumed_gamma = 1,
                                 .ambient_light = {1, 1, 1},
                                 .max_trace_level = 5,
                                 .adc_bailout = 1.0f / 255.0f,
                                 .noise_generator = 2,
                                 .number_of_waves = 10,
                                 .background = {0, 0, 0, 0, 1}};
    scene->camera = (Camera){.type = CAMERA_ORTHOGRAPHIC,
                             .location = {0, 0, -3},
                             .direction = {0, 0, 1},
                             .up = {0, 3, 0},
                             .right = {4, 0, 0},
                             .angle_deg = 90};
    Pigment *pigment = scene->pigments = ARENA_NEW(arena, Pigment);
    pigment->color = (Color){0.9f, 0.6f, 0.3f, 0, 0};
    Texture *texture = scene->textures = ARENA_NEW(arena, Texture);
    texture->layers = ARENA_NEW(arena, Layer);
    texture->layers[0].finish = (Finish){.ambient = {1, 1, 1},
                                         .brilliance = 1,
                                         .phong_size = 40,
                                         .roughness = 0.05f,
                                         .reflection_falloff = 1,
                                         .reflection_exponent = 1};
    texture->layers[0].normal = NO_INDEX;
    texture->layer_count = 1;
    Object *object = scene->objects = ARENA_NEW(arena, Object);
    *object = (Object){.type = OBJECT_SPHERE,
                       .interior_texture = NO_INDEX,
                       .interior = NO_INDEX,
                       .transform = transform_identity(),
                       .shape.sphere = {.radius = 0.97}};
    scene->roots = ARENA_NEW(arena, uint32_t);
    scene->pigment_count = scene->texture_count = scene->object_count = scene->root_count = 1;
    return scene;
}

static Image *render_ball(Arena *arena, const char *line, RenderStats *stats) {
    RenderOptions o = options_of_line(arena, line);
    ImageWriteOptions write;
    render_check(&o);
    return render_scene(ball(arena), &o, arena, &write, stats);
}

// ---- tests -----------------------------------------------------------------------------------

static void equal_to_the_reference(void **state) {
    (void)state;
    if (!reference_available()) {
        print_message("skipped: povray is not installed\n");
        skip();
    }
    const char *const lines[] = {
        "+W64 +H48",
        "+W99 +H67 +A0.3 +FN16",
        "+W99 +H67 +A0.1 +AM2 +R4 -J +FN16",
        "+W99 +H67 +A0.1 +R2 +BS20 +UA",
        "+W99 +H67 +A0.1 +UA +AM2 +FN16",
        "+W60 +H40 +A0.1 +SC11 +EC50 +SR6 +ER30 +UA",
        "+W60 +H40 +SC0.25 +EC0.7 +SR0.3 +ER0.75",
        "+W7 +H7 +SC0.5 +EC0.99",
        "+W10 +H10 +SC2.7 +SR3 +ER2.5",
        "+W10 +H10 +SC2 +EC1 +ER0.1",
        "+W64 +H48 +FNg File_Gamma=1.0",
        "+W1 +H50 +A0.0",
    };
    enum { LINES = sizeof lines / sizeof *lines };
    Arena *arena = arena_create();
    Reference *theirs[LINES];
    for (int i = 0; i < LINES; i++)
        theirs[i] = reference_begin(arena, ball_text, lines[i]);
    size_t wrong = 0;
    for (int i = 0; i < LINES; i++) {
        RenderStats stats;
        char first[128];
        size_t off = reference_mismatches(render_ball(arena, lines[i], &stats),
                                          reference_end(theirs[i]), first, sizeof first);
        if (off)
            print_message("%s: %zu values differ; ours, POV-Ray's at %s\n", lines[i], off, first);
        wrong += off;
    }
    assert_int_equal(wrong, 0);
    arena_destroy(arena);
}

static void same_values_for_any_number_of_threads(void **state) {
    (void)state;
    const char *const lines[] = {"+W130 +H101 +A0.05", "+W130 +H101 +A0.05 +AM2 +UA",
                                 "+W130 +H101 +A0.05 +BS7"};
    for (int i = 0; i < 3; i++) {
        Arena *arena = arena_create();
        RenderStats one, many;
        Image *first = render_ball(arena, arena_printf(arena, "%s +WT1", lines[i]), &one);
        for (int threads = 2; threads <= 9; threads += 7) {
            Image *image =
                render_ball(arena, arena_printf(arena, "%s +WT%d", lines[i], threads), &many);
            assert_int_equal(many.threads, threads);
            assert_memory_equal(first->pixels, image->pixels,
                                (size_t)first->width * (size_t)first->height *
                                    (size_t)first->channels * sizeof(float));
            assert_int_equal(many.samples, one.samples);
            assert_int_equal(many.supersampled, one.supersampled);
        }
        arena_destroy(arena);
    }
}

static void an_area_without_pixels_is_black(void **state) {
    (void)state;
    Arena *arena = arena_create();
    RenderStats stats;
    Image *image = render_ball(arena, "+W9 +H9 +SC5 +EC4", &stats);
    for (int i = 0; i < 9 * 9 * 3; i++)
        assert_true(image->pixels[i] == 0);
    assert_int_equal(stats.samples, 0);
    arena_destroy(arena);
}

static void check_body(void *options) { render_check(options); }

static void impossible_pictures(void **state) {
    (void)state;
    const struct {
        const char *line, *says;
    } cases[] = {
        {"+W0", "+W and +H"},
        {"+W-640", "-640 x 600"},
        {"+H0", "800 x 0"},
        {"+W1000000 +H1000000", "limit is 2147483647"},
        {"+W46000 +H46000", "GB"}, // 135 GB; no test runs on a machine with so much
        {"+W99999999999", "limit is 2147483647"},
        {"+W10 +H10 +SC11", "+SC11"},
        {"+W10 +H10 +EC11", "+EC11"},
        {"+W10 +H10 +EC0", "+EC0"},
        {"+W10 +H10 +ER0.01", "+ER0.01"},
        {"+W10 +H10 +SR1e9", "+SR1e+09"},
    };
    Arena *arena = arena_create();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        RenderOptions o = options_of_line(arena, cases[i].line);
        char *message = NULL;
        if (diag_catch(check_body, &o, &message))
            fail_msg("%s was taken", cases[i].line);
        if (!strstr(message, cases[i].says))
            fail_msg("%s: %s", cases[i].line, message);
        free(message);
    }
    arena_destroy(arena);
}

// What a hollow patch takes, prepared as the line says.
static uint64_t memory_of(Arena *arena, const char *line) {
    Scene *scene = ball(arena);
    Vec3 *points = ARENA_ARRAY(arena, Vec3, 16);
    for (int i = 0; i < 16; i++)
        points[i] = vec3(i / 4 - 1.5, i % 4 - 1.5, i % 4 % 3 && i / 4 % 3 ? 2.0 : 0.0);
    scene->objects[0].type = OBJECT_PATCH;
    scene->objects[0].shape.patch =
        (PatchShape){.degree_u = 3, .degree_v = 3, .points = points, .u_steps = 3, .v_steps = 3};
    RenderOptions o = options_of_line(arena, line);
    ImageWriteOptions write;
    RenderStats stats = {0};
    render_scene(scene, &o, arena, &write, &stats);
    return stats.memory;
}

// Rays must be many to pay for a full preparation: of one patch, from 5,000 pixels on.
static void prepares_by_the_work(void **state) {
    (void)state;
    Arena *arena = arena_create();
    uint64_t light = memory_of(arena, "+W40 +H40 --prepare light");
    uint64_t full = memory_of(arena, "+W40 +H40 --prepare full");
    assert_true(light < full);
    assert_int_equal(memory_of(arena, "+W40 +H40"), light);
    assert_int_equal(memory_of(arena, "+W80 +H80"), full);
    assert_int_equal(memory_of(arena, "+W80 +H80 +SR40 +ER50"), full); // the same for a part
    assert_int_equal(memory_of(arena, "+W80 +H80 --prepare light"), light);
    arena_destroy(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prepares_by_the_work),
        cmocka_unit_test(equal_to_the_reference),
        cmocka_unit_test(same_values_for_any_number_of_threads),
        cmocka_unit_test(an_area_without_pixels_is_black),
        cmocka_unit_test(impossible_pictures),
    };
    return cmocka_run_group_tests_name("render", tests, NULL, NULL);
}
