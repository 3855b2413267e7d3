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
#include "digits.h"
#include "group_arena.h"
#include "noise/noise.h"
#include "texture/pattern.h"
#include "texture/pigment.h"
#include "texture/texture.h"

typedef struct {
    const char *text;
    Pattern pattern;
} Row;

typedef ARRAY(Row) Rows;

static const Scene empty = {.settings = {.noise_generator = 2, .number_of_waves = 10}};
static const Textures no_textures = {.scene = &empty};
static const TextureHit nowhere;

static int set_up(void **state) {
    noise_prepare();
    return create_arena(state);
}

static void check_rows(const Rows *rows) {
    Digits *digits = digits_create("");
    for (size_t r = 0; r < rows->count; r++)
        digits_function(
            digits, arena_printf(arena, "function { pattern { %s } }", rows->items[r].text), "");
    const double *want = digits_run(digits);
    for (size_t r = 0; r < rows->count; r++)
        for (int i = 0; i < DIGITS_POINTS; i++) {
            const Pattern *pattern = &rows->items[r].pattern;
            double have = pattern_value(&no_textures, pattern, &nowhere,
                                        pattern_point(pattern, digits_point(i)));
            digits_equal(digits, have, *want++, rows->items[r].text, i);
        }
    digits_finish(digits);
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

static Pattern of_type(PatternType type) {
    return (Pattern){
        .type = type,
        .frequency = 1.0f,
        .exponent = 1.0f,
        .agate_turb = 1.0f,
        .brick_size = {8, 3, 4.5},
        .mortar = 0.5f,
        .quilted = {1.0f, 1.0f},
        .crackle = {{-1, 1, 0}, 2.0, 0.0, false},
    };
}

static Pattern listed(PatternType type) {
    Pattern pattern = of_type(type);
    pattern.frequency = 0.0f;
    return pattern;
}

static Pattern waved(PatternType type, WaveType wave) {
    Pattern pattern = of_type(type);
    pattern.wave = wave;
    return pattern;
}

static Pattern turbulent(Pattern pattern, double x, double y, double z) {
    pattern.has_turbulence = true;
    pattern.turbulence = (Turbulence){{x, y, z}, 6, 2.0f, 0.5f};
    return pattern;
}

static void geometric_patterns(void **state) {
    (void)state;
    Rows rows = {0};
    add(&rows, "boxed", of_type(PATTERN_BOXED));
    add(&rows, "cylindrical", of_type(PATTERN_CYLINDRICAL));
    add(&rows, "leopard", of_type(PATTERN_LEOPARD));
    add(&rows, "onion", of_type(PATTERN_ONION));
    add(&rows, "planar", of_type(PATTERN_PLANAR));
    add(&rows, "radial frequency 3", (Pattern){.type = PATTERN_RADIAL, .frequency = 3.0f});
    add(&rows, "spherical", of_type(PATTERN_SPHERICAL));
    add(&rows, "brick", listed(PATTERN_BRICK));
    Pattern brick = listed(PATTERN_BRICK);
    brick.brick_size = vec3(1.3, 0.7, 0.9);
    brick.mortar = 0.11f;
    add(&rows, "brick brick_size <1.3, 0.7, 0.9> mortar 0.11", brick);
    add(&rows, "cells", of_type(PATTERN_CELLS));
    add(&rows, "hexagon", listed(PATTERN_HEXAGON));
    add(&rows, "quilted", listed(PATTERN_QUILTED));
    Pattern quilted = listed(PATTERN_QUILTED);
    quilted.quilted[0] = 0.3f, quilted.quilted[1] = 0.8f;
    add(&rows, "quilted control0 0.3 control1 0.8", quilted);
    add(&rows, "ripples", of_type(PATTERN_RIPPLES));
    Pattern ripples = of_type(PATTERN_RIPPLES);
    ripples.frequency = 1.7f, ripples.phase = 0.3f;
    add(&rows, "ripples frequency 1.7 phase 0.3", ripples);
    ripples.type = PATTERN_WAVES;
    add(&rows, "waves", of_type(PATTERN_WAVES));
    add(&rows, "waves frequency 1.7 phase 0.3", ripples);
    check_rows(&rows);
    array_free(&rows);
}

static void noise_patterns(void **state) {
    (void)state;
    Rows rows = {0};
    static const struct {
        const char *name;
        PatternType type;
        WaveType wave;
    } kinds[] = {
        {"bozo", PATTERN_BOZO, WAVE_RAMP},         {"dents", PATTERN_DENTS, WAVE_RAMP},
        {"granite", PATTERN_GRANITE, WAVE_RAMP},   {"wrinkles", PATTERN_WRINKLES, WAVE_RAMP},
        {"marble", PATTERN_MARBLE, WAVE_TRIANGLE}, {"agate", PATTERN_AGATE, WAVE_RAMP},
    };
    for (int k = 0; k < (int)(sizeof kinds / sizeof *kinds); k++)
        for (int g = 1; g <= 3; g++) {
            Pattern pattern = waved(kinds[k].type, kinds[k].wave);
            pattern.noise_generator = g;
            add(&rows, arena_printf(arena, "%s noise_generator %d", kinds[k].name, g), pattern);
            add(&rows,
                arena_printf(arena, "%s noise_generator %d turbulence <0.4, 0.3, -0.2>",
                             kinds[k].name, g),
                turbulent(pattern, 0.4, 0.3, -0.2));
        }
    add(&rows, "wood", waved(PATTERN_WOOD, WAVE_TRIANGLE));
    add(&rows, "wood turbulence <0.4, 0.3, -0.2>",
        turbulent(waved(PATTERN_WOOD, WAVE_TRIANGLE), 0.4, 0.3, -0.2));
    Pattern agate = turbulent(of_type(PATTERN_AGATE), 0.1, 0.1, 0.1);
    agate.agate_turb = 0.7f;
    agate.turbulence.octaves = 3, agate.turbulence.lambda = 2.3f, agate.turbulence.omega = 0.6f;
    add(&rows, "agate agate_turb 0.7 turbulence 0.1 octaves 3 lambda 2.3 omega 0.6", agate);
    Pattern spiral = waved(PATTERN_SPIRAL1, WAVE_TRIANGLE);
    spiral.arms = 3;
    add(&rows, "spiral1 3", spiral);
    add(&rows, "spiral1 3 turbulence 0.3", turbulent(spiral, 0.3, 0.3, 0.3));
    spiral.type = PATTERN_SPIRAL2;
    add(&rows, "spiral2 3", spiral);
    add(&rows, "spiral2 3 turbulence 0.3", turbulent(spiral, 0.3, 0.3, 0.3));
    check_rows(&rows);
    array_free(&rows);
}

static void add_crackle(Rows *rows, const char *text, CrackleShape shape) {
    Pattern pattern = of_type(PATTERN_CRACKLE);
    pattern.crackle = shape;
    add(rows, text, pattern);
}

static void crackles(void **state) {
    (void)state;
    Rows rows = {0};
    add(&rows, "crackle", of_type(PATTERN_CRACKLE));
    add_crackle(&rows, "crackle form <0.3, -0.2, 0.9>",
                (CrackleShape){{0.3, -0.2, 0.9}, 2.0, 0.0, false});
    add_crackle(&rows, "crackle metric 1 offset 0.2", (CrackleShape){{-1, 1, 0}, 1.0, 0.2, false});
    add_crackle(&rows, "crackle metric 3.5 offset 0.1 form x",
                (CrackleShape){{1, 0, 0}, 3.5, 0.1, false});
    add_crackle(&rows, "crackle offset 0.4 form <0, 0.4, 0>",
                (CrackleShape){{0, 0.4, 0}, 2.0, 0.4, false});
    add_crackle(&rows, "crackle solid", (CrackleShape){{-1, 1, 0}, 2.0, 0.0, true});
    check_rows(&rows);
    array_free(&rows);
}

// Coordinates at the limit of the chain of warps, where cells are no integers any more: every
// pattern still gives a number.
static void far_away(void **state) {
    (void)state;
    static const double far[] = {1e17, -1e17, 2147483647.9, -2147483649.0, 3e15, -1e-300, 0.0};
    enum { COUNT = sizeof far / sizeof *far };
    for (int type = PATTERN_CHECKER; type < PATTERN_AVERAGE; type++)
        for (int i = 0; i < COUNT * COUNT * COUNT; i++) {
            Pattern pattern = turbulent(of_type((PatternType)type), 0.1, 0.2, 0.3);
            pattern.gradient = vec3(1, 0, 0);
            Vec3 p = vec3(far[i % COUNT], far[i / COUNT % COUNT], far[i / COUNT / COUNT]);
            double v = pattern_value(&no_textures, &pattern, &nowhere, pattern_point(&pattern, p));
            if (!(v >= 0.0 && v <= 1.00001))
                fail_msg("pattern %d at %g, %g, %g: %g", type, p.x, p.y, p.z, v);
        }
}

// ---- warps ------------------------------------------------------------------------------------

// A pattern that shows where each coordinate has gone.
static Pattern probe(Warp *warps, uint32_t count) {
    Pattern pattern = gradient(3, 4, 5);
    pattern.frequency = 0.1f;
    pattern.warps = arena_copy(arena, warps, count * sizeof *warps);
    pattern.warp_count = count;
    return pattern;
}

static void add_warp(Rows *rows, const char *text, Warp warp) {
    add(rows, arena_printf(arena, "gradient <3, 4, 5> frequency 0.1 warp { %s }", text),
        probe(&warp, 1));
}

static void add_mapping(Rows *rows, const char *text, WarpType type, MappingWarp mapping) {
    Warp warp = {.type = type};
    warp.mapping = mapping;
    add_warp(rows, text, warp);
}

static void warps(void **state) {
    (void)state;
    Rows rows = {0};
    Turbulence turbulence = {{0.5, -0.3, 0.2}, 4, 2.1f, 0.55f};
    Warp warp = {.type = WARP_TURBULENCE, .turbulence = turbulence};
    add_warp(&rows, "turbulence <0.5, -0.3, 0.2> octaves 4 lambda 2.1 omega 0.55", warp);
    warp = (Warp){.type = WARP_REPEAT, .repeat = {1, 0.37f, {0.1, 0.2, 0.3}, {-1, 1, -1}}};
    add_warp(&rows, "repeat 0.37*y offset <0.1, 0.2, 0.3> flip <1, 0, 1>", warp);
    warp = (Warp){.type = WARP_REPEAT, .repeat = {0, 1.3f, {0, 0, 0}, {-1, 1, 1}}};
    add_warp(&rows, "repeat 1.3*x flip x", warp);
    BlackHoleWarp hole = {
        .center = {0.2, 0.1, -0.3}, .radius = 1.5, .strength = 0.8, .falloff = 1.5};
    warp = (Warp){.type = WARP_BLACK_HOLE, .black_hole = hole};
    add_warp(&rows, "black_hole <0.2, 0.1, -0.3>, 1.5 strength 0.8 falloff 1.5", warp);
    warp.black_hole.inverse = true;
    add_warp(&rows, "black_hole <0.2, 0.1, -0.3>, 1.5 strength 0.8 falloff 1.5 inverse", warp);
    hole = (BlackHoleWarp){.center = {0.5, 0.6, 0.7},
                           .radius = 0.5,
                           .strength = 1.0,
                           .falloff = 2.0,
                           .repeat = true,
                           .repeat_size = {2, 0, 3},
                           .uncertainty = {0.3, 0.2, 0.1}};
    warp = (Warp){.type = WARP_BLACK_HOLE, .black_hole = hole};
    add_warp(&rows, "black_hole <0.5, 0.6, 0.7>, 0.5 repeat <2, 0, 3> turbulence <0.3, 0.2, 0.1>",
             warp);
    add_warp(&rows, "cubic", (Warp){.type = WARP_CUBIC});
    const Vec3 z = vec3(0, 0, 1), x = vec3(1, 0, 0), tilted = vec_normalize(vec3(1, 2, 3));
    add_mapping(&rows, "planar", WARP_PLANAR, (MappingWarp){.orientation = z});
    add_mapping(&rows, "planar <1, 2, 3>, 0.7", WARP_PLANAR,
                (MappingWarp){.orientation = tilted, .distance = 0.7});
    add_mapping(&rows, "spherical", WARP_SPHERICAL, (MappingWarp){.orientation = z});
    add_mapping(&rows, "spherical orientation x dist_exp 1", WARP_SPHERICAL,
                (MappingWarp){.orientation = x, .dist_exp = 1.0});
    add_mapping(&rows, "spherical orientation <1, 2, 3> dist_exp 0.7", WARP_SPHERICAL,
                (MappingWarp){.orientation = tilted, .dist_exp = 0.7});
    add_mapping(&rows, "cylindrical", WARP_CYLINDRICAL, (MappingWarp){.orientation = z});
    add_mapping(&rows, "cylindrical orientation x dist_exp 2", WARP_CYLINDRICAL,
                (MappingWarp){.orientation = x, .dist_exp = 2.0});
    add_mapping(&rows, "toroidal", WARP_TOROIDAL,
                (MappingWarp){.orientation = z, .major_radius = 1.0});
    add_mapping(&rows, "toroidal major_radius 1.4 dist_exp 0.5", WARP_TOROIDAL,
                (MappingWarp){.orientation = z, .dist_exp = 0.5, .major_radius = 1.4});
    // Last written, first applied; the block's own turbulence at the end of the chain.
    Warp chain[3] = {{.type = WARP_TRANSFORM, .transform = transform_rotate(vec3(0, 0, 30))},
                     {.type = WARP_TURBULENCE, .turbulence = turbulence},
                     {.type = WARP_TRANSFORM, .transform = transform_scale(vec3(2, 2, 2))}};
    Pattern all = probe(chain, 3);
    add(&rows,
        "gradient <3, 4, 5> frequency 0.1 turbulence 0.2 scale 2 warp { turbulence <0.5, "
        "-0.3, 0.2> octaves 4 lambda 2.1 omega 0.55 } rotate 30*z",
        turbulent(all, 0.2, 0.2, 0.2));
    check_rows(&rows);
    array_free(&rows);
}

// ---- maps -------------------------------------------------------------------------------------

static Scene scene_of(Pigment *pigments, uint32_t count) {
    Scene scene = {.settings = empty.settings, .pigments = pigments, .pigment_count = count};
    return scene;
}

static const char *const channels[5] = {".red", ".green", ".blue", ".filter", ".transmit"};

static void check_pigment(const char *text, const Scene *scene, uint32_t pigment) {
    Digits *digits = digits_create("");
    for (int c = 0; c < 5; c++)
        digits_function(digits, arena_printf(arena, "function { pigment { %s } }", text),
                        channels[c]);
    const double *want = digits_run(digits);
    for (int c = 0; c < 5; c++)
        for (int i = 0; i < DIGITS_POINTS; i++) {
            const Textures textures = {.scene = scene};
            Color have;
            assert_true(pigment_color(&textures, pigment, &nowhere, digits_point(i), &have));
            const float values[5] = {have.r, have.g, have.b, have.filter, have.transmit};
            digits_equal(digits, values[c], *want++, channels[c], i);
        }
    digits_finish(digits);
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

// The patterns that POV-Ray evaluates only as pigments: the colour's red is the number / 8.
static void listed_patterns(void **state) {
    (void)state;
    static const struct {
        const char *name;
        PatternType type;
        uint32_t count;
    } kinds[] = {
        {"checker", PATTERN_CHECKER, 2},       {"brick", PATTERN_BRICK, 2},
        {"hexagon", PATTERN_HEXAGON, 3},       {"square", PATTERN_SQUARE, 4},
        {"triangular", PATTERN_TRIANGULAR, 6}, {"cubic", PATTERN_CUBIC, 6},
    };
    Digits *digits = digits_create("");
    for (int k = 0; k < (int)(sizeof kinds / sizeof *kinds); k++) {
        const char *colors = "";
        for (uint32_t i = 0; i < kinds[k].count; i++)
            colors = arena_printf(arena, "%s rgb %g", colors, i / 8.0);
        digits_function(
            digits, arena_printf(arena, "function { pigment { %s %s } }", kinds[k].name, colors),
            ".red");
    }
    const double *want = digits_run(digits);
    for (int k = 0; k < (int)(sizeof kinds / sizeof *kinds); k++) {
        MapEntry entries[6];
        for (uint32_t i = 0; i < kinds[k].count; i++)
            entries[i] = (MapEntry){(float)i, {(float)i / 8.0f, 0, 0, 0, 0}, NO_INDEX};
        Pigment pigment = {
            .pattern = listed(kinds[k].type), .entries = entries, .entry_count = kinds[k].count};
        Scene scene = scene_of(&pigment, 1);
        for (int i = 0; i < DIGITS_POINTS; i++) {
            const Textures textures = {.scene = &scene};
            Color have;
            pigment_color(&textures, 0, &nowhere, digits_point(i), &have);
            digits_equal(digits, have.r, *want++, kinds[k].name, i);
        }
    }
    digits_finish(digits);
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
    const Textures textures = {.scene = &scene};
    TextureHit hit = {.u = 0.25, .v = 0.5};
    Vec3 p = vec3(0.75, 0.9, 0.3);
    Color c;
    assert_true(pigment_color(&textures, 0, &hit, p, &c) && c.r == 0.75f);
    assert_true(pigment_color(&textures, 1, &hit, p, &c) && c.r == 0.5f); // always at (u, v, 0)
    assert_true(pigment_color(&textures, 2, &hit, p, &c) && c.r == 1.0f);
    hit.quick = true;
    assert_true(pigment_color(&textures, 2, &hit, p, &c) && c.r == 0.0f && c.b == 1.0f);
}

// A texture with uv_mapping, alone or in a map: where its layers are.
static void texture_places(void **state) {
    (void)state;
    Layer layer = {.pigment = 0, .normal = NO_INDEX};
    IndexEntry entries[2] = {{0.25f, 0}, {0.75f, 1}}, one = {1.0f, 2};
    Texture pool[4] = {{.layers = &layer, .layer_count = 1},
                       {.layers = &layer, .layer_count = 1, .uv_mapping = true},
                       {.pattern = gradient(1, 0, 0), .entries = entries, .entry_count = 2},
                       {.uv_mapping = true, .entries = &one, .entry_count = 1}};
    Scene scene = {.settings = empty.settings, .textures = pool, .texture_count = 4};
    const Textures textures = {.scene = &scene};
    TextureHit hit = {.u = 0.375, .v = 0.5};
    TextureSpaces spaces = {.count = 0};
    Vec3 p = vec3(0.5, 0.9, 0.3);
    TextureChoice choice = texture_choose(&textures, 0, &spaces, &hit, p);
    assert_true(choice.layers == &pool[0] && choice.p.x == 0.5 && spaces.count == 0);
    choice = texture_choose(&textures, 1, &spaces, &hit, p);
    assert_true(choice.layers == &pool[1] && choice.p.x == 0.375 && spaces.count == 1);
    choice = texture_choose(&textures, 2, &spaces, &hit, p);
    assert_true(choice.layers == NULL && !choice.average && spaces.count == 2);
    assert_true(choice.first == 1 && choice.second == 0 && choice.share == 0.5);
    choice = texture_choose(&textures, 3, &spaces, &hit, p);
    assert_true(choice.first == 0 && choice.second == 0 && choice.p.x == 0.375);
    choice = texture_choose(&textures, choice.entries[0].index, &spaces, &hit, choice.p);
    assert_true(choice.share == 0.25);
    spaces.count = TEXTURE_SPACES; // full: nothing is written beyond
    texture_choose(&textures, 1, &spaces, &hit, p);
    assert_int_equal(spaces.count, TEXTURE_SPACES);
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
    const Textures textures_of_scene = {.scene = &scene};
    assert_false(pigment_is_opaque(&textures_of_scene, 0));
    assert_false(pigment_is_opaque(&textures_of_scene, 1));
    assert_true(pigment_is_opaque(&textures_of_scene, 2));
    assert_false(texture_is_opaque(&textures_of_scene, 0));
    assert_true(texture_is_opaque(&textures_of_scene, 1));
    assert_true(texture_is_opaque(&textures_of_scene, NO_INDEX));
    IndexEntry mixed[2] = {{0.0f, 0}, {1.0f, 1}}, solid[2] = {{0.0f, 1}, {1.0f, 1}};
    Texture maps[4] = {textures[0],
                       textures[1],
                       {.pattern = gradient(1, 0, 0), .entries = mixed, .entry_count = 2},
                       {.pattern = gradient(1, 0, 0), .entries = solid, .entry_count = 2}};
    scene.textures = maps, scene.texture_count = 4;
    assert_false(texture_is_opaque(&textures_of_scene, 2));
    assert_true(texture_is_opaque(&textures_of_scene, 3));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simple_patterns), cmocka_unit_test(geometric_patterns),
        cmocka_unit_test(noise_patterns),  cmocka_unit_test(crackles),
        cmocka_unit_test(far_away),        cmocka_unit_test(warps),
        cmocka_unit_test(color_map),       cmocka_unit_test(pigment_map),
        cmocka_unit_test(listed_patterns), cmocka_unit_test(uv_and_quick),
        cmocka_unit_test(opacity),         cmocka_unit_test(texture_places),
    };
    return cmocka_run_group_tests_name("texture", tests, set_up, destroy_arena);
}
