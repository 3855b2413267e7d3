// SPDX-License-Identifier: MIT
// Patterns and pigments against POV-Ray: each row of the table is one pattern, written for both;
// POV-Ray evaluates it as a function at many points and prints all digits, which must be equal.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "base/array.h"
#include "pattern_oracle.h"
#include "texture/pattern.h"
#include "texture/texture.h"

typedef struct {
    const char *text;
    Pattern pattern;
} Row;

typedef ARRAY(Row) Rows;

static Arena *arena;

static int setup(void **state) {
    (void)state;
    arena = arena_create();
    return 0;
}

static int teardown(void **state) {
    (void)state;
    arena_destroy(arena);
    return 0;
}

static void check_rows(const Rows *rows) {
    Oracle *oracle = oracle_create("");
    for (size_t r = 0; r < rows->count; r++)
        oracle_function(
            oracle, arena_printf(arena, "function { pattern { %s } }", rows->items[r].text), "");
    const double *want = oracle_run(oracle);
    for (size_t r = 0; r < rows->count; r++)
        for (int i = 0; i < ORACLE_POINTS; i++) {
            const Pattern *pattern = &rows->items[r].pattern;
            double have = pattern_value(pattern, pattern_point(pattern, pattern_oracle_point(i)));
            oracle_equal(oracle, have, *want++, rows->items[r].text, i);
        }
    oracle_finish(oracle);
}

// ---- the table --------------------------------------------------------------------------------

static void add(Rows *rows, const char *text, Pattern pattern) {
    Row row = {text, pattern};
    array_push(rows, row);
}

static Pattern with_transform(Pattern pattern, Transform transform) {
    pattern.warps = ARENA_NEW(arena, Warp);
    *pattern.warps = (Warp){.type = WARP_TRANSFORM, .transform = transform};
    pattern.warp_count = 1;
    return pattern;
}

static Pattern gradient(double x, double y, double z) {
    return (Pattern){.type = PATTERN_GRADIENT,
                     .frequency = 1.0f,
                     .exponent = 1.0f,
                     .gradient = vec_normalize(vec3(x, y, z))};
}

static Pattern with_wave(WaveType wave, float frequency, float phase, float exponent) {
    Pattern pattern = gradient(1, 0, 0);
    pattern.wave = wave;
    pattern.frequency = frequency;
    pattern.phase = phase;
    pattern.exponent = exponent;
    return pattern;
}

static void simple_patterns(void **state) {
    (void)state;
    Rows rows = {0};
    Pattern checker = {.type = PATTERN_CHECKER, .exponent = 1.0f};
    add(&rows, "checker", checker);
    add(&rows, "gradient x", gradient(1, 0, 0));
    add(&rows, "gradient <1, -2, 3>", gradient(1, -2, 3));
    Transform turn = transform_rotate(vec3(10, 20, 30)), size = transform_scale(vec3(0.3, 2, -0.7)),
              move = transform_translate(vec3(0.1, 0.2, 0.3));
    Transform all = transform_compose(&turn, &size);
    all = transform_compose(&all, &move);
    add(&rows, "checker rotate <10, 20, 30> scale <0.3, 2, -0.7> translate <0.1, 0.2, 0.3>",
        with_transform(checker, all));
    add(&rows,
        "gradient <1, 1, 0> rotate <10, 20, 30> scale <0.3, 2, -0.7> translate <0.1, 0.2, "
        "0.3>",
        with_transform(gradient(1, 1, 0), all));
    add(&rows, "gradient x triangle_wave", with_wave(WAVE_TRIANGLE, 1.0f, 0.0f, 1.0f));
    add(&rows, "gradient x sine_wave frequency 2.3", with_wave(WAVE_SINE, 2.3f, 0.0f, 1.0f));
    add(&rows, "gradient x scallop_wave phase 0.4", with_wave(WAVE_SCALLOP, 1.0f, 0.4f, 1.0f));
    add(&rows, "gradient x cubic_wave frequency -1.7 phase -0.3",
        with_wave(WAVE_CUBIC, -1.7f, -0.3f, 1.0f));
    add(&rows, "gradient x poly_wave 2.6", with_wave(WAVE_POLY, 1.0f, 0.0f, 2.6f));
    add(&rows, "gradient x frequency 0 phase 0.3", with_wave(WAVE_RAMP, 0.0f, 0.3f, 1.0f));
    check_rows(&rows);
    array_free(&rows);
}

// ---- maps -------------------------------------------------------------------------------------

static Scene scene_of(Pigment *pigments, uint32_t count) {
    Scene scene = {.pigments = pigments, .pigment_count = count};
    return scene;
}

static const char *const channels[5] = {".red", ".green", ".blue", ".filter", ".transmit"};

static void check_pigment(const char *text, const Scene *scene, uint32_t pigment) {
    Oracle *oracle = oracle_create("");
    for (int c = 0; c < 5; c++)
        oracle_function(oracle, arena_printf(arena, "function { pigment { %s } }", text),
                        channels[c]);
    const double *want = oracle_run(oracle);
    for (int c = 0; c < 5; c++)
        for (int i = 0; i < ORACLE_POINTS; i++) {
            TexturePoint at = {.p = pattern_oracle_point(i)};
            Color have;
            assert_true(pigment_color(scene, pigment, &at, &have));
            const float values[5] = {have.r, have.g, have.b, have.filter, have.transmit};
            oracle_equal(oracle, values[c], *want++, channels[c], i);
        }
    oracle_finish(oracle);
}

// Positions out of order of colours, a position twice, the end before 1.
static void color_map(void **state) {
    (void)state;
    MapEntry entries[5] = {{0.1f, {1.0f, 0.2f, 0.3f, 0.4f, 0.0f}, NO_INDEX},
                           {0.35f, {0.0f, 0.7f, 0.9f, 0.0f, 0.3f}, NO_INDEX},
                           {0.35f, {0.3f, 0.3f, 0.1f, 0.1f, 0.1f}, NO_INDEX},
                           {0.5f, {-0.2f, 1.4f, 0.3f, 0.0f, 0.9f}, NO_INDEX},
                           {0.875f, {0.6f, 0.1f, 0.8f, 0.2f, 0.2f}, NO_INDEX}};
    Pigment pigment = {.pattern = gradient(1, 0, 0), .entries = entries, .entry_count = 5};
    Scene scene = scene_of(&pigment, 1);
    check_pigment("gradient x color_map { [0.1 rgbft <1, 0.2, 0.3, 0.4, 0>] [0.35 rgbft <0, 0.7, "
                  "0.9, 0, 0.3>] [0.35 rgbft <0.3, 0.3, 0.1, 0.1, 0.1>] [0.5 rgbft <-0.2, 1.4, "
                  "0.3, 0, 0.9>] [0.875 rgbft <0.6, 0.1, 0.8, 0.2, 0.2>] }",
                  &scene, 0);
}

// Pigments in the map: they stand in the outer pattern's space, with transforms of their own.
static void pigment_map(void **state) {
    (void)state;
    Transform big = transform_scale(vec3(3, 3, 3)), turn = transform_rotate(vec3(0, 0, 40)),
              small = transform_scale(vec3(0.5, 0.5, 0.5));
    MapEntry outer[3] = {
        {0.2f, {0, 0, 0, 0, 0}, 1}, {0.6f, {0, 0, 0, 0, 0}, 2}, {1.0f, {0, 0, 0, 0, 0}, 3}};
    MapEntry checks[2] = {{0.0f, {1, 0, 0, 0, 0.5f}, NO_INDEX}, {1.0f, {0, 1, 0, 0, 0}, NO_INDEX}};
    MapEntry ramp[2] = {{0.0f, {0.2f, 0.4f, 0.8f, 0.3f, 0}, NO_INDEX},
                        {1.0f, {0.9f, 0.5f, 0.1f, 0, 0}, NO_INDEX}};
    Pigment pigments[4] = {
        {.pattern = with_transform(gradient(0, 1, 0), big), .entries = outer, .entry_count = 3},
        {.pattern = with_transform((Pattern){.type = PATTERN_CHECKER, .exponent = 1.0f}, small),
         .entries = checks,
         .entry_count = 2},
        {.color = {0.3f, 0.6f, 0.9f, 0.0f, 0.0f}},
        {.pattern = with_transform(gradient(1, 0, 0), turn), .entries = ramp, .entry_count = 2},
    };
    Scene scene = scene_of(pigments, 4);
    check_pigment("gradient y pigment_map { [0.2 checker rgbt <1, 0, 0, 0.5> rgb <0, 1, 0> scale "
                  "0.5] [0.6 rgb <0.3, 0.6, 0.9>] [1 gradient x color_map { [0 rgbf <0.2, 0.4, "
                  "0.8, 0.3>] [1 rgb <0.9, 0.5, 0.1>] } rotate 40*z] } scale 3",
                  &scene, 0);
}

static void uv_and_quick(void **state) {
    (void)state;
    MapEntry ramp[2] = {{0.0f, {0, 0, 0, 0, 0}, NO_INDEX}, {1.0f, {1, 1, 1, 0, 0}, NO_INDEX}};
    Pigment pigments[3] = {
        {.pattern = gradient(1, 0, 0), .entries = ramp, .entry_count = 2},
        {.pattern = gradient(0, 1, 0), .entries = ramp, .entry_count = 2, .uv_mapping = true},
        {.color = {1, 1, 1, 0, 0}, .has_quick_color = true, .quick_color = {0, 0, 1, 0, 0}},
    };
    Scene scene = scene_of(pigments, 3);
    Layer layer = {.pigment = 0};
    Texture texture = {.layers = &layer, .layer_count = 1};
    Vec3 p = vec3(0.75, 0.9, 0.3);
    Color c;
    TexturePoint at = texture_point(&texture, false, p, 0.25, 0.5, false);
    assert_true(pigment_color(&scene, 0, &at, &c) && c.r == 0.75f);
    assert_true(pigment_color(&scene, 1, &at, &c) && c.r == 0.5f); // always at (u, v, 0)
    at = texture_point(&texture, true, p, 0.25, 0.5, false);       // the object's flag
    assert_true(pigment_color(&scene, 0, &at, &c) && c.r == 0.25f);
    texture.uv_mapping = true;
    at = texture_point(&texture, false, p, 0.25, 0.5, true);
    assert_true(pigment_color(&scene, 0, &at, &c) && c.r == 0.25f);
    assert_true(pigment_color(&scene, 2, &at, &c) && c.r == 0.0f && c.b == 1.0f);
    at.quick = false;
    assert_true(pigment_color(&scene, 2, &at, &c) && c.r == 1.0f);
}

// A map is as transparent as its most transparent entry, in whatever depth; one opaque layer
// makes a texture opaque.
static void opacity(void **state) {
    (void)state;
    MapEntry deep[2] = {{0.0f, {1, 1, 1, 0, 0}, NO_INDEX}, {1.0f, {1, 1, 1, 1e-9f, 0}, NO_INDEX}};
    MapEntry outer[2] = {{0.0f, {1, 1, 1, 0, 0}, NO_INDEX}, {1.0f, {0, 0, 0, 0, 0}, 0}};
    Pigment pigments[3] = {
        {.pattern = gradient(1, 0, 0), .entries = deep, .entry_count = 2},
        {.pattern = gradient(1, 0, 0), .entries = outer, .entry_count = 2},
        {.color = {1, 1, 1, 1e-11f, -1e-11f}},
    };
    Layer layers[2] = {{.pigment = 1}, {.pigment = 2}};
    Texture textures[2] = {{.layers = layers, .layer_count = 1},
                           {.layers = layers, .layer_count = 2}};
    Scene scene = scene_of(pigments, 3);
    scene.textures = textures, scene.texture_count = 2;
    assert_false(pigment_is_opaque(&scene, 0));
    assert_false(pigment_is_opaque(&scene, 1));
    assert_true(pigment_is_opaque(&scene, 2));
    assert_false(texture_is_opaque(&scene, 0));
    assert_true(texture_is_opaque(&scene, 1));
    assert_true(texture_is_opaque(&scene, NO_INDEX));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simple_patterns), cmocka_unit_test(color_map),
        cmocka_unit_test(pigment_map),     cmocka_unit_test(uv_and_quick),
        cmocka_unit_test(opacity),
    };
    return cmocka_run_group_tests_name("texture", tests, setup, teardown);
}
