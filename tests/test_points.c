// SPDX-License-Identifier: MIT
// Random points through random patterns: every kind, with random warps, transforms, turbulence,
// waves, maps and noise generators, written as text. POV-Ray evaluates it as a function and prints
// all digits; ours goes the whole way from the text, and must give the same number.
//
// 94 patterns and 150 points are 14,100 comparisons, 300 or more of each kind. POINTS_ROUNDS=N does
// N times as many, with other random numbers (make points: 10,200 of each kind).
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/arena.h"
#include "base/rng.h"
#include "convert_help.h"
#include "digits.h"
#include "texture/pattern.h"
#include "texture/pigment.h"

#include <stdio.h>
#include <string.h>

enum { PATTERNS = 94 };

static Arena *arena;
static Rng rng;

static double between(double low, double high) {
    // Six decimals: the text and the number are the same double.
    return floor(rng_range(&rng, low, high) * 1e6) / 1e6;
}

static uint32_t below(uint32_t count) { return (uint32_t)(rng_next(&rng) % count); }
static bool coin(void) { return below(2) == 0; }

static const char *vector(double low, double high) {
    return arena_printf(arena, "<%g, %g, %g>", between(low, high), between(low, high),
                        between(low, high));
}

static const char *join(const char *a, const char *b) { return arena_printf(arena, "%s %s", a, b); }

// ---- the text of a pattern --------------------------------------------------------------------

static const char *turbulence(void) {
    const char *text = vector(-1, 1);
    if (coin())
        text = arena_printf(arena, "%s octaves %u lambda %g omega %g", text, 1 + below(9),
                            between(1, 3), between(0.2, 0.9));
    return text;
}

static const char *mapping(void) {
    const char *text = "";
    if (coin())
        text = arena_printf(arena, "orientation %s", vector(0.1, 1));
    return coin() ? text : arena_printf(arena, "%s dist_exp %g", text, between(0, 2));
}

static const char *warp(void) {
    switch (below(8)) {
    case 0:
        return arena_printf(arena, "turbulence %s", turbulence());
    case 1:
        return arena_printf(arena, "repeat %g*%c offset %s flip <%u,%u,%u>", between(0.3, 3),
                            "xyz"[below(3)], vector(-1, 1), below(2), below(2), below(2));
    case 2:
        return arena_printf(arena, "black_hole %s, %g strength %g falloff %g %s", vector(-1, 1),
                            between(0.2, 3), between(0.2, 2), between(0.5, 3),
                            coin() ? "inverse" : "");
    case 3:
        return arena_printf(arena, "black_hole %s, %g repeat %s turbulence %s", vector(-1, 1),
                            between(0.2, 1), vector(1, 4), vector(0, 1));
    case 4:
        return arena_printf(arena, "spherical %s", mapping());
    case 5:
        return arena_printf(arena, "cylindrical %s", mapping());
    case 6:
        return arena_printf(arena, "toroidal %s major_radius %g", mapping(), between(0.3, 3));
    default:
        return arena_printf(arena, "planar %s, %g", vector(0.1, 1), between(-1, 1));
    }
}

static const char *move(void) {
    switch (below(4)) {
    case 0:
        return arena_printf(arena, "translate %s", vector(-3, 3));
    case 1:
        return arena_printf(arena, "rotate %s", vector(-180, 180));
    case 2:
        return arena_printf(arena, "scale %s", vector(0.2, 4));
    default:
        return arena_printf(arena, "matrix <%g,%g,%g, %g,%g,%g, %g,%g,%g, %g,%g,%g>", between(1, 2),
                            between(0, 0.5), between(0, 0.5), between(0, 0.5), between(1, 2),
                            between(0, 0.5), between(0, 0.5), between(0, 0.5), between(1, 2),
                            between(-1, 1), between(-1, 1), between(-1, 1));
    }
}

static const char *wave(void) {
    static const char *const waves[] = {"ramp_wave",    "triangle_wave", "sine_wave",
                                        "scallop_wave", "cubic_wave",    "poly_wave 1.7"};
    return waves[below(6)];
}

static const char *modifiers(const char *text) {
    uint32_t count = below(6);
    for (uint32_t i = 0; i < count; i++)
        switch (below(7)) {
        case 0:
            text = arena_printf(arena, "%s warp { %s }", text, warp());
            break;
        case 1:
            text = arena_printf(arena, "%s turbulence %s", text, turbulence());
            break;
        case 2:
            text = join(text, wave());
            break;
        case 3:
            text = arena_printf(arena, "%s frequency %g", text, between(-3, 5));
            break;
        case 4:
            text = arena_printf(arena, "%s phase %g", text, between(-2, 2));
            break;
        default:
            text = join(text, move());
            break;
        }
    return text;
}

// The kinds that POV-Ray evaluates as patterns; those with numbers of their own come after these.
static const char *const plain_kinds[] = {
    "boxed",    "bozo",    "bumps",     "cells",   "crackle", "cylindrical",
    "dents",    "granite", "leopard",   "marble",  "onion",   "planar",
    "radial",   "ripples", "spherical", "spotted", "waves",   "wood",
    "wrinkles", "checker", "brick",     "hexagon", "agate",   "density_file df3 \"spiral.df3\"",
};
// Those that it evaluates only as pigments: what they choose of is shades of red.
static const char *const pigment_kinds[] = {
    "cubic rgb 0 rgb 0.2*x rgb 0.4*x rgb 0.6*x rgb 0.8*x rgb x",
    "square rgb 0 rgb 0.3*x rgb 0.6*x rgb x",
    "triangular rgb 0 rgb 0.2*x rgb 0.4*x rgb 0.6*x rgb 0.8*x rgb x",
    // So far out that a root of 3 with ten digits is a triangle off: it was here.
    "triangular rgb 0 rgb 0.2*x rgb 0.4*x rgb 0.6*x rgb 0.8*x rgb x scale 1e-6",
    "average pigment_map { [1 bozo scale 0.4] [2.5 gradient y sine_wave] [0.7 wood] }",
    "onion pigment_map { [0 granite] [0.4 rgb <0.3, 0, 1>] [0.5 spiral1 3 frequency 2] [1 rgb 1] }",
    "image_map { png \"test.png\" interpolate 2 }",
    "image_map { png \"test.png\" map_type 1 interpolate 4 }",
    "image_map { png \"bumpmap_.png\" map_type 2 once }",
};
enum {
    PLAIN_KINDS = sizeof plain_kinds / sizeof *plain_kinds,
    PIGMENT_KINDS = sizeof pigment_kinds / sizeof *pigment_kinds,
    KINDS = PLAIN_KINDS + 14 + PIGMENT_KINDS
};

static bool is_pigment(uint32_t number) { return number % KINDS >= KINDS - PIGMENT_KINDS; }

static const char *kind(uint32_t number) {
    if (number < PLAIN_KINDS)
        return plain_kinds[number];
    if (is_pigment(number))
        return pigment_kinds[number - (KINDS - PIGMENT_KINDS)];
    switch (number - PLAIN_KINDS) {
    case 0:
        return arena_printf(arena, "gradient %s", vector(-1, 1));
    case 1:
        return arena_printf(arena, "agate agate_turb %g", between(0, 2));
    case 2:
        return arena_printf(arena, "brick brick_size %s mortar %g", vector(0.3, 3),
                            between(0.01, 0.3));
    case 3:
        return arena_printf(arena, "crackle form %s metric %g offset %g %s", vector(-1, 1),
                            coin() ? 1.0 : between(1, 4), coin() ? 0.0 : between(0, 1),
                            coin() ? "solid" : "");
    case 4:
        return arena_printf(arena, "quilted control0 %g control1 %g", between(0, 2), between(0, 2));
    case 5:
        return arena_printf(arena, "spiral1 %d", (int)below(9) - 4);
    case 6:
        return arena_printf(arena, "spiral2 %d", (int)below(9) - 4);
    case 7:
        return arena_printf(arena, "mandel %u exponent %u exterior %u, %g interior %u, %g",
                            below(30), 2 + below(6), below(7), between(0.1, 2), below(7),
                            between(0.1, 2));
    case 8:
        return arena_printf(arena, "julia <%g, %g>, %u exponent %u exterior %u, %g", between(-1, 1),
                            between(-1, 1), below(30), 2 + below(6), below(7), between(0.1, 2));
    case 9:
        return arena_printf(arena, "magnet %u mandel %u exterior %u, %g", 1 + below(2), below(20),
                            below(7), between(0.1, 2));
    case 10:
        return arena_printf(arena, "magnet %u julia <%g, %g>, %u interior %u, %g", 1 + below(2),
                            between(-2, 2), between(-2, 2), below(20), below(7), between(0.1, 2));
    case 11:
        return arena_printf(arena,
                            "image_pattern { png \"bumpmap_.png\" interpolate %u map_type %u }",
                            2 + below(3), below(3));
    case 12:
        return arena_printf(arena,
                            "pigment_pattern { bozo color_map { [0 rgb <%g, 0, 1>] [1 rgb <0, "
                            "%g, 0.2>] } turbulence %g }",
                            between(0, 1), between(0, 1), between(0, 1));
    default:
        return arena_printf(arena,
                            "function { sin(x * %g) * cos(y * %g) + f_noise3d(x, y, z * %g) }",
                            between(0.5, 3), between(0.5, 3), between(0.5, 3));
    }
}

static const char *random_pattern(uint32_t number) {
    const char *text = modifiers(kind(number % KINDS));
    if (coin())
        text = arena_printf(arena, "%s noise_generator %u", text, 1 + below(3));
    return text;
}

// ---- comparing --------------------------------------------------------------------------------

static const char HEAD[] = "#include \"functions.inc\"\n";

// That of the sphere; others may lie before it in the pool.
static uint32_t outer_pigment(const Textures *textures) {
    return textures->scene->textures[0].layers[0].pigment;
}

static double red(const Textures *textures, Vec3 p) {
    const TextureHit nowhere = texture_no_hit(false);
    Color color;
    pigment_color(textures, outer_pigment(textures), &nowhere, p, &color);
    return color.r;
}

static double ours(const Textures *textures, Vec3 p) {
    const Pattern *pattern = &textures->scene->pigments[outer_pigment(textures)].pattern;
    const TextureHit nowhere = texture_no_hit(false);
    return pattern_value(textures, pattern, &nowhere, pattern_point(pattern, p));
}

static void check(uint32_t seed) {
    rng = (Rng){seed};
    arena = arena_create();
    const char *texts[PATTERNS];
    Digits *digits = digits_create(HEAD);
    for (uint32_t i = 0; i < PATTERNS; i++) {
        texts[i] = random_pattern(i);
        digits_function(digits,
                        arena_printf(arena, "function { %s { %s } }",
                                     is_pigment(i) ? "pigment" : "pattern", texts[i]),
                        is_pigment(i) ? ".red" : "");
    }
    const double *want = digits_run(digits);
    for (uint32_t i = 0; i < PATTERNS; i++) {
        Converted converted = convert_text(
            arena_printf(arena, "#version 3.7; %ssphere { 0, 1 pigment { %s } }", HEAD, texts[i]));
        if (converted.scene == NULL || converted.warnings != 0)
            fail_msg("%s: %s", texts[i], converted.scene ? "a warning" : converted.message);
        const Textures *textures = textures_create(converted.scene, arena);
        for (int k = 0; k < DIGITS_POINTS; k++)
            digits_equal(digits, (is_pigment(i) ? red : ours)(textures, digits_point(k)), *want++,
                         texts[i], k);
    }
    digits_finish(digits);
    arena_destroy(arena);
}

static void random_patterns(void **state) {
    (void)state;
    const char *rounds = getenv("POINTS_ROUNDS");
    uint32_t count = rounds ? (uint32_t)strtoul(rounds, NULL, 10) : 1;
    for (uint32_t i = 0; i < count; i++)
        check(i + 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_patterns)};
    return cmocka_run_group_tests_name("points", tests, NULL, NULL);
}
