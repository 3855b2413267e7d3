// SPDX-License-Identifier: MIT
// Whole scenes against POV-Ray: layers, visibility, nested glass, sky, quality, patches; and what
// is ours alone: the grain, the limit of nested rays.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "shade_fixture.h"

#include <math.h>
#include <stdio.h>

// Rows name only what differs from the default; later initialisers win on purpose.
#pragma GCC diagnostic ignored "-Woverride-init"

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

// Three layers, the middle one a mirror that conserves energy, seen from outside and, through the
// transparent ones, from inside.
static void check_layers(int version) {
    Fixture *f = fixture_create(version);
    fixture_orthographic(f, 48, 24, 5.0, 2.5, vec3(1.25, 0, 0));
    fixture_add_lights(f);
    fixture_add_room(f);
    const char *bottom = "texture { pigment { rgbt <0.2, 0.8, 0.4, 0.3> } finish { phong 0.4 } }";
    const char *middle = "texture { pigment { rgbft <0.9, 0.5, 0.1, 0.3, 0.2> } finish { specular "
                         "0.3 reflection { 0.2, 0.6 } conserve_energy } }";
    const char *top = "texture { pigment { rgbf <0.4, 0.4, 0.9, 0.7> } finish { ambient 0.3 "
                      "reflection 0.15 } }";
    Layer layers[3] = {
        {fixture_plain(f, (Color){0.4f, 0.4f, 0.9f, 0.7f, 0.0f}),
         FINISH(.ambient = GREY3(0.3f), .reflection_min = GREY3(0.15f),
                .reflection_max = GREY3(0.15f)),
         NO_INDEX},
        {fixture_plain(f, (Color){0.9f, 0.5f, 0.1f, 0.3f, 0.2f}),
         FINISH(.specular = 0.3f, .reflection_min = GREY3(0.2f), .reflection_max = GREY3(0.6f),
                .conserve_energy = true),
         NO_INDEX},
        {fixture_plain(f, (Color){0.2f, 0.8f, 0.4f, 0.0f, 0.3f}), FINISH(.phong = 0.4f), NO_INDEX},
    };
    char text[1024];
    snprintf(text, sizeof text, "%s %s %s interior { ior 1.2 }", bottom, middle, top);
    fixture_add_sphere(f, vec3(0, 0, 0), 1.0, text, fixture_texture(f, layers, 3),
                       fixture_interior(f, (Interior){.refraction = 1, .ior = 1.2f}));
    snprintf(text, sizeof text, "%s %s", bottom, top);
    Layer two[2] = {layers[0], layers[2]};
    fixture_add_sphere(f, vec3(2.5, 0, 0), 1.0, text, fixture_texture(f, two, 2), NO_INDEX);
    fixture_compare_later(f, 9, false);
}

static void layers(void **state) {
    (void)state;
    check_layers(370);
    check_layers(360);
    fixture_compare_now();
}

// The far inside of a transparent sphere has a texture of its own, also for shadows.
static void interior_texture(void **state) {
    (void)state;
    Fixture *f = fixture_create(370);
    fixture_orthographic(f, 48, 24, 5.0, 2.5, vec3(1.25, 0, 0));
    fixture_add_lights(f);
    fixture_add_room(f);
    fixture_text(f, "sphere { <0, 0, 0>, 1 texture { pigment { rgbt <1, 0.5, 0.2, 0.7> } } "
                    "interior_texture { pigment { rgbt <0.1, 0.9, 0.9, 0.2> } finish { phong 1 } "
                    "} }\n"
                    "sphere { <2.5, 0, 0>, 1 texture { pigment { rgb <1, 0.5, 0.2> } } "
                    "interior_texture { pigment { rgbt <0.1, 0.9, 0.9, 0.2> } } double_illuminate "
                    "}\n");
    Object sphere = fixture_sphere(vec3(0, 0, 0), 1.0);
    sphere.texture = fixture_one_layer(f, (Color){1.0f, 0.5f, 0.2f, 0.0f, 0.7f}, (Finish)FINISH());
    sphere.interior_texture =
        fixture_one_layer(f, (Color){0.1f, 0.9f, 0.9f, 0.0f, 0.2f}, (Finish)FINISH(.phong = 1.0f));
    fixture_object(f, sphere);
    sphere = fixture_sphere(vec3(2.5, 0, 0), 1.0);
    sphere.texture = fixture_one_layer(f, (Color){1.0f, 0.5f, 0.2f, 0.0f, 0.0f}, (Finish)FINISH());
    sphere.interior_texture =
        fixture_one_layer(f, (Color){0.1f, 0.9f, 0.9f, 0.0f, 0.2f}, (Finish)FINISH());
    sphere.double_illuminate = true;
    fixture_object(f, sphere);
    fixture_compare_later(f, 9, false);
    fixture_compare_now();
}

// Everything opaque, so that shadows are asked for with world_occluded; objects that hide from one
// kind of ray, and a mirror to see it.
static void visibility(void **state) {
    (void)state;
    Fixture *f = fixture_create(370);
    fixture_orthographic(f, 60, 30, 6.0, 3.0, vec3(1.0, 0, 0));
    fixture_add_lights(f);
    fixture_add_room(f);
    static const char *const flags[3] = {"no_shadow", "no_image", "no_reflection"};
    uint32_t texture =
        fixture_one_layer(f, (Color){0.9f, 0.4f, 0.2f, 0.0f, 0.0f}, (Finish)FINISH());
    for (int i = 0; i < 3; i++) {
        fixture_text(f, "sphere { <%g, 0.4, 0>, 0.6 pigment { rgb <0.9, 0.4, 0.2> } %s }\n",
                     1.4 * i - 0.5, flags[i]);
        Object sphere = fixture_sphere(vec3(1.4 * i - 0.5, 0.4, 0), 0.6);
        sphere.texture = texture;
        sphere.no_shadow = i == 0;
        sphere.no_image = i == 1;
        sphere.no_reflection = i == 2;
        fixture_object(f, sphere);
    }
    Finish mirror = FINISH(.reflection_min = GREY3(0.8f), .reflection_max = GREY3(0.8f));
    fixture_add_sphere(
        f, vec3(1.2, -1.4, 0.3), 1.0, "pigment { rgb <0.1, 0.1, 0.2> } finish { reflection 0.8 }",
        fixture_one_layer(f, (Color){0.1f, 0.1f, 0.2f, 0.0f, 0.0f}, mirror), NO_INDEX);
    fixture_compare_later(f, 9, false);
    fixture_compare_now();
}

// Two mirrors and glass in front of each other, for each small max_trace_level; then a large
// adc_bailout.
static void add_mirrors_and_glass(Fixture *f) {
    fixture_add_lights(f);
    fixture_add_room(f);
    Finish mirror = FINISH(.reflection_min = GREY3(0.7f), .reflection_max = GREY3(0.7f));
    uint32_t silver = fixture_one_layer(f, (Color){0.2f, 0.1f, 0.1f, 0.0f, 0.0f}, mirror);
    const char *silver_text = "pigment { rgb <0.2, 0.1, 0.1> } finish { reflection 0.7 }";
    fixture_add_sphere(f, vec3(-1.1, 0, 0), 1.0, silver_text, silver, NO_INDEX);
    fixture_add_sphere(f, vec3(1.1, 0, 0), 1.0, silver_text, silver, NO_INDEX);
    uint32_t clear = fixture_one_layer(f, (Color){0.9f, 0.9f, 1.0f, 0.0f, 0.8f}, (Finish)FINISH());
    fixture_add_sphere(f, vec3(0.0, 0.3, -2), 0.6,
                       "pigment { rgbt <0.9, 0.9, 1, 0.8> } interior { ior 1.4 }", clear,
                       fixture_interior(f, (Interior){.refraction = 1, .ior = 1.4f}));
    fixture_add_sphere(f, vec3(0.8, 0.1, -4), 0.5, "pigment { rgbt <0.9, 0.9, 1, 0.8> }", clear,
                       NO_INDEX);
}

static void trace_limits(void **state) {
    (void)state;
    for (int level = 1; level <= 4; level++) {
        Fixture *f = fixture_create(370);
        fixture_text(f, "global_settings { max_trace_level %d }\n", level);
        f->scene.settings.max_trace_level = level;
        fixture_orthographic(f, 44, 22, 4.4, 2.2, vec3(0, 0, 0));
        add_mirrors_and_glass(f);
        fixture_compare_later(f, 9, false);
    }
    Fixture *f = fixture_create(370);
    fixture_text(f, "global_settings { adc_bailout 0.45 max_trace_level 20 ambient_light rgb <2, "
                    "1, 0.5> irid_wavelength rgb <0.6, 0.5, 0.4> }\n");
    f->scene.settings.adc_bailout = 0.45f;
    f->scene.settings.max_trace_level = 20;
    f->scene.settings.ambient_light = rgb(2.0f, 1.0f, 0.5f);
    f->scene.settings.irid_wavelength = rgb(0.6f, 0.5f, 0.4f);
    fixture_orthographic(f, 44, 22, 4.4, 2.2, vec3(0, 0, 0));
    add_mirrors_and_glass(f);
    fixture_add_sphere(f, vec3(-0.8, 0.1, -4), 0.5,
                       "pigment { rgb 0.5 } finish { irid { 0.4 thickness 0.6 } }",
                       fixture_one_layer(f, (Color){0.5f, 0.5f, 0.5f, 0.0f, 0.0f},
                                         (Finish)FINISH(.irid = 0.4f, .irid_thickness = 0.6f)),
                       NO_INDEX);
    fixture_compare_later(f, 9, false);
    fixture_compare_now();
}

// Glass in glass, glass overlapping glass, a shared interior, and the camera inside of one.
static void nested_interiors(void **state) {
    (void)state;
    for (int inside = 0; inside < 2; inside++) {
        Fixture *f = fixture_create(370);
        fixture_perspective(f, 48, 48, vec3(0.1, -0.05, inside ? -3.0 : -6.0));
        fixture_add_lights(f);
        fixture_add_room(f);
        uint32_t clear = fixture_one_layer(
            f, (Color){0.9f, 0.95f, 1.0f, 0.0f, 0.85f},
            (Finish)FINISH(.reflection_max = GREY3(0.9f), .reflection_fresnel = true));
        const char *look = "pigment { rgbt <0.9, 0.95, 1, 0.85> } finish { reflection { 0.9 "
                           "fresnel } }";
        char text[400];
        static const struct {
            Vec3 center;
            double radius;
            float ior;
        } balls[] = {{{-1, 0.8, 0}, 1.0, 1.5f},
                     {{-1, 0.8, 0}, 0.5, 1.0f},
                     {{1, 0.8, 0}, 0.9, 1.3f},
                     {{1.6, 0.8, -0.5}, 0.7, 1.7f},
                     {{-0.6, -1.1, 0}, 0.8, 1.4f}};
        for (int i = 0; i < COUNT(balls); i++) {
            snprintf(text, sizeof text, "%s interior { ior %g }", look, (double)balls[i].ior);
            fixture_add_sphere(
                f, balls[i].center, balls[i].radius, text, clear,
                fixture_interior(f, (Interior){.refraction = 1, .ior = balls[i].ior}));
        }
        if (inside)
            fixture_add_sphere(
                f, vec3(0, 0, -3), 0.7,
                "pigment { rgbt 0.9 } interior { ior 1.2 "
                "fade_distance 1 fade_power 1 fade_color rgb <0.9, "
                "0.5, 0.5> }",
                fixture_one_layer(f, (Color){0.9f, 0.9f, 0.9f, 0.0f, 0.9f}, (Finish)FINISH()),
                fixture_interior(f, (Interior){.refraction = 1,
                                               .ior = 1.2f,
                                               .fade_distance = 1.0f,
                                               .fade_power = 1.0f,
                                               .fade_color = {0.9f, 0.5f, 0.5f}}));
        fixture_compare_later(f, 9, false);
    }
    fixture_compare_now();
}

// ---- sky, background, transparency of the picture ---------------------------------------------

static void add_sky(Fixture *f) {
    fixture_text(f, "sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.6, 0.3>] [0.3 "
                    "rgb <0.3, 0.4, 0.9>] [1 rgb <0, 0, 0.4>] } } "
                    "pigment { gradient x sine_wave frequency 3 phase 0.2 color_map { [0 rgbt "
                    "<1, 1, 1, 0.2>] [0.5 rgbf <0.9, 0.7, 0.5, 0.8>] [1 rgbft <0.2, 1, 0.6, 0.3, "
                    "0.4>] } } rotate <10, 20, 30> translate 0.1*y emission rgb <0.9, 1, 1.1> }\n");
    static MapEntry low[3] = {{0.0f, {0.9f, 0.6f, 0.3f, 0, 0}, NO_INDEX},
                              {0.3f, {0.3f, 0.4f, 0.9f, 0, 0}, NO_INDEX},
                              {1.0f, {0.0f, 0.0f, 0.4f, 0, 0}, NO_INDEX}};
    static MapEntry high[3] = {{0.0f, {1.0f, 1.0f, 1.0f, 0, 0.2f}, NO_INDEX},
                               {0.5f, {0.9f, 0.7f, 0.5f, 0.8f, 0}, NO_INDEX},
                               {1.0f, {0.2f, 1.0f, 0.6f, 0.3f, 0.4f}, NO_INDEX}};
    Pigment pigment = {
        .pattern = {.type = PATTERN_GRADIENT, .frequency = 1.0f, .gradient = {0, 1, 0}},
        .entries = low,
        .entry_count = 3,
    };
    uint32_t *pigments = ARENA_ARRAY(f->arena, uint32_t, 2);
    pigments[0] = fixture_pigment(f, pigment);
    pigment.pattern = (Pattern){.type = PATTERN_GRADIENT,
                                .wave = WAVE_SINE,
                                .frequency = 3.0f,
                                .phase = 0.2f,
                                .gradient = {1, 0, 0}};
    pigment.entries = high;
    pigments[1] = fixture_pigment(f, pigment);
    Transform turn = transform_rotate(vec3(10, 20, 30)),
              move = transform_translate(vec3(0, 0.1, 0));
    f->scene.has_sky_sphere = true;
    f->scene.sky_sphere =
        (SkySphere){pigments, 2, {0.9f, 1.0f, 1.1f}, transform_compose(&turn, &move)};
}

static void check_sky(int version, bool sky, bool background, bool alpha) {
    Fixture *f = fixture_create(version);
    fixture_perspective(f, 32, 32, vec3(0, 0, -4));
    fixture_add_lights(f);
    if (background) {
        fixture_text(f, "background { rgbft <0.6, 0.5, 0.4, 0.2, 0.3> }\n");
        f->scene.settings.background = (Color){0.6f, 0.5f, 0.4f, 0.2f, 0.3f};
    }
    if (sky)
        add_sky(f);
    Finish mirror = FINISH(.reflection_min = GREY3(0.7f), .reflection_max = GREY3(0.7f));
    fixture_add_sphere(f, vec3(-0.6, 0, 0), 0.6, "pigment { rgb 0.3 } finish { reflection 0.7 }",
                       fixture_one_layer(f, (Color){0.3f, 0.3f, 0.3f, 0.0f, 0.0f}, mirror),
                       NO_INDEX);
    fixture_add_sphere(
        f, vec3(0.6, 0, 0), 0.6, "pigment { rgbft <0.3, 0.8, 0.5, 0.4, 0.4> }",
        fixture_one_layer(f, (Color){0.3f, 0.8f, 0.5f, 0.4f, 0.4f}, (Finish)FINISH()), NO_INDEX);
    fixture_compare_later(f, 9, alpha);
}

static void sky_and_background(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        if ((i & 3) != 0) // without either the opaque picture is the one of other tests
            check_sky(i & 4 ? 360 : 370, i & 1, i & 2, false);
        check_sky(i & 4 ? 360 : 370, i & 1, i & 2, true);
    }
    fixture_compare_now();
}

static void quality_levels(void **state) {
    (void)state;
    static const int levels[] = {0, 1, 2, 3, 4, 5, 6, 8};
    for (int i = 0; i < COUNT(levels); i++) {
        Fixture *f = fixture_create(370);
        fixture_orthographic(f, 44, 22, 4.4, 2.2, vec3(0, 0, 0));
        add_mirrors_and_glass(f);
        fixture_text(f, "sphere { <-0.8, 0.1, -4>, 0.5 pigment { rgb <1, 0, 0> quick_color rgb "
                        "<0.2, 0.9, 0.4> } }\n");
        Pigment quick = {.color = {1.0f, 0.0f, 0.0f, 0.0f, 0.0f},
                         .has_quick_color = true,
                         .quick_color = {0.2f, 0.9f, 0.4f, 0.0f, 0.0f}};
        Layer layer = {fixture_pigment(f, quick), FINISH(), NO_INDEX};
        Object sphere = fixture_sphere(vec3(-0.8, 0.1, -4), 0.5);
        sphere.texture = fixture_texture(f, &layer, 1);
        fixture_object(f, sphere);
        fixture_compare_later(f, levels[i], false);
    }
    fixture_compare_now();
}

// Patches with texture coordinates: checks in (u, v), once by the object's flag and once by the
// pigment's; a patch lit on both sides, and one with a texture of its own behind and an index of
// refraction.
static void add_patch(Fixture *f, int k, const char *text, Object object) {
    Vec3 *points = ARENA_ARRAY(f->arena, Vec3, 16);
    fixture_text(f, "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3");
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            points[i * 4 + j] = vec3(-1.7 + 1.15 * k + 0.33 * j, -0.4 + 0.3 * i + 0.05 * j,
                                     0.3 * ((i * j + k) % 3) - 0.2 * i);
            Vec3 p = points[i * 4 + j];
            fixture_text(f, ", <%.17g, %.17g, %.17g>", p.x, p.y, p.z);
        }
    fixture_text(f, " %s }\n", text);
    object.type = OBJECT_PATCH;
    object.shape.patch = (PatchShape){.degree_u = 3,
                                      .degree_v = 3,
                                      .points = points,
                                      .type = 1,
                                      .u_steps = 3,
                                      .v_steps = 3,
                                      .uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    fixture_object(f, object);
}

static void patches(void **state) {
    (void)state;
    Fixture *f = fixture_create(370);
    fixture_perspective(f, 96, 96, vec3(0.02, 0.51, -3.6));
    fixture_add_lights(f);
    fixture_add_room(f);
    MapEntry checks[2] = {{0.0f, {0.9f, 0.2f, 0.1f, 0.0f, 0.0f}, NO_INDEX},
                          {1.0f, {0.2f, 0.9f, 0.3f, 0.0f, 0.6f}, NO_INDEX}};
    Warp warp = {.type = WARP_TRANSFORM, .transform = transform_scale(vec3(0.23, 0.31, 0.27))};
    Pigment pigment = {
        .pattern = {.type = PATTERN_CHECKER, .exponent = 1.0f, .warps = &warp, .warp_count = 1},
        .entries = checks,
        .entry_count = 2,
    };
    Layer layer = {fixture_pigment(f, pigment), FINISH(.phong = 0.5f), NO_INDEX};
    Object object = fixture_sphere(vec3(0, 0, 0), 1.0); // for what all objects have
    object.texture = fixture_texture(f, &layer, 1);
    Object by_object = object, by_pigment = object, two_sided = object;
    by_object.uv_mapping = true;
#define CHECKS "checker rgb <0.9, 0.2, 0.1> rgbt <0.2, 0.9, 0.3, 0.6> scale <0.23, 0.31, 0.27>"
#define PHONG " finish { phong 0.5 }"
    add_patch(f, 0, "uv_mapping pigment { " CHECKS " }" PHONG, by_object);
    pigment.uv_mapping = true;
    layer.pigment = fixture_pigment(f, pigment);
    by_pigment.texture = fixture_texture(f, &layer, 1);
    by_pigment.double_illuminate = true;
    add_patch(f, 1, "pigment { uv_mapping " CHECKS " }" PHONG " double_illuminate", by_pigment);
    two_sided.interior_texture =
        fixture_one_layer(f, (Color){0.3f, 0.3f, 1.0f, 0.7f, 0.0f}, (Finish)FINISH());
    two_sided.interior = fixture_interior(f, (Interior){.refraction = 1, .ior = 1.3f});
    add_patch(f, 2,
              "texture { pigment { " CHECKS " }" PHONG " } interior_texture { pigment { rgbf "
              "<0.3, 0.3, 1, 0.7> } } interior { ior 1.3 }",
              two_sided);
    fixture_compare_later(f, 9, false);
    fixture_compare_now();
}

// The grain is ours, not POV-Ray's: within the range of its strength, and the same again.
static void grain(void **state) {
    (void)state;
    Fixture *f = fixture_create(370);
    fixture_light(f, (Light){.location = {0, 0, -100}, .color = {1, 1, 1}});
    Object wall = fixture_plane(vec3(0, 0, -1), 0.0);
    wall.texture = fixture_one_layer(f, (Color){1.0f, 1.0f, 1.0f, 0.0f, 0.0f},
                                     (Finish)FINISH(.ambient = GREY3(0.0f), .crand = 0.25f));
    fixture_object(f, wall);
    PatchSetOptions patches = {.method = METHOD_FACETS, .tolerance = 1e-9};
    World *world = world_create(fixture_scene(f), &patches);
    TraceOptions options = {.quality = 9};
    Shading *shading = shading_create(fixture_scene(f), world, &options);
    Tracer *one = tracer_create(shading), *two = tracer_create(shading);
    double low = 1.0, high = 0.0, sum = 0.0;
    enum { RAYS = 4000 };
    for (int i = 0; i < RAYS; i++) {
        Ray ray = {vec3(1e-4 * i, 0.0, -5.0), vec3(0, 0, 1)};
        Color a = tracer_trace(one, &ray);
        ray.org.x = 1e-4 * (RAYS - 1 - i);
        tracer_trace(two, &ray); // another order on another tracer
        ray.org.x = 1e-4 * i;
        Color b = tracer_trace(two, &ray);
        assert_memory_equal(&a, &b, sizeof a);
        low = a.r < low ? a.r : low, high = a.r > high ? a.r : high, sum += a.r;
    }
    // Uniform in (0.35, 0.6]: 4000 draws come within 0.005 of both ends (chance of not: 1e-35), and
    // their mean within 5 standard deviations 0.25 / sqrt(12 x 4000).
    assert_true(low >= 0.3499 && low < 0.355 && high <= 0.6001 && high > 0.595);
    assert_true(fabs(sum / RAYS - 0.475) < 5 * 0.25 / sqrt(12.0 * RAYS));
    assert_int_equal(tracer_stats(one).primary, RAYS);
    tracer_destroy(one);
    tracer_destroy(two);
    shading_destroy(shading);
    world_destroy(world);
    fixture_destroy(f);
}

// A stack of panes costs no level, however thick; the rays nest, and only that is bounded.
static void thick_stack(void **state) {
    (void)state;
    static const int counts[] = {1000, 5000};
    for (int k = 0; k < COUNT(counts); k++) {
        Fixture *f = fixture_create(370);
        uint32_t pane =
            fixture_one_layer(f, (Color){1.0f, 1.0f, 1.0f, 0.0f, 1.0f}, (Finish)FINISH());
        uint32_t wall = fixture_one_layer(f, (Color){0.25f, 0.5f, 1.0f, 0.0f, 0.0f},
                                          (Finish)FINISH(.ambient = GREY3(1.0f), .diffuse = 0.0f));
        for (int i = 0; i <= counts[k]; i++) {
            Object plane = fixture_plane(vec3(0, 0, 1), 0.01 * i);
            plane.texture = i < counts[k] ? pane : wall;
            fixture_object(f, plane);
        }
        PatchSetOptions patches = {.method = METHOD_FACETS, .tolerance = 1e-9};
        World *world = world_create(fixture_scene(f), &patches);
        TraceOptions options = {.quality = 9};
        Shading *shading = shading_create(fixture_scene(f), world, &options);
        Tracer *tracer = tracer_create(shading);
        Color seen = tracer_trace(tracer, &(Ray){vec3(0, 0, -5), vec3(0, 0, 1)});
        assert_true(seen.b == (k == 0 ? 1.0f : 0.0f));
        tracer_destroy(tracer);
        shading_destroy(shading);
        world_destroy(world);
        fixture_destroy(f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grain),
        cmocka_unit_test(thick_stack),
        cmocka_unit_test(layers),
        cmocka_unit_test(interior_texture),
        cmocka_unit_test(visibility),
        cmocka_unit_test(trace_limits),
        cmocka_unit_test(nested_interiors),
        cmocka_unit_test(sky_and_background),
        cmocka_unit_test(quality_levels),
        cmocka_unit_test(patches),
    };
    return cmocka_run_group_tests_name("shade_scenes", tests, NULL, NULL);
}
