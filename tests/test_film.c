// SPDX-License-Identifier: MIT
// Transfer curves, rounding, alpha and grey against POV-Ray's own files: one box a pixel, each of
// its own colour, so that the values before the file are known to the bit.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "reference.h"
#include "render/film.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 24, COUNT = SIDE * SIDE };

// Values that matter: the ends, outside, the knee of sRGB, fine steps near black, random ones.
static void fill_colors(Color *colors, bool alpha) {
    Rng rng = {7};
    for (int i = 0; i < COUNT; i++) {
        float v[3];
        for (int c = 0; c < 3; c++) {
            double x = rng_unit(&rng);
            if (i < 64)
                x = (i * 3 + c) / 50000.0; // 0 .. 0.0038
            else if (i < 96)
                x = 0.9 + 0.004 * (i - 64) + 0.001 * c; // over 1
            else if (i < 100)
                x = -0.1 * c;
            // As the scene's text will carry it.
            char text[32];
            snprintf(text, sizeof text, "%.7f", x);
            v[c] = (float)strtod(text, NULL);
        }
        float transmit = alpha ? (float)(i % 9) / 8.0f : 0.0f;
        colors[i] = (Color){v[0], v[1], v[2], 0, transmit};
    }
}

// Boxes of one unit under an orthographic camera that looks along z; the first is at the upper
// left. With alpha, what is behind the boxes is nothing: the pixel's colour is the opaque share.
static const char *boxes(Arena *arena, const char *header, const Color *colors) {
    size_t room = 160 * COUNT + 400, at;
    char *text = arena_alloc(arena, room);
    at = (size_t)snprintf(text, room,
                          "%s\ncamera { orthographic location <%d, -%d, -5> direction z up %d*y "
                          "right %d*x }\n#default { finish { ambient 1 diffuse 0 } }\n",
                          header, SIDE / 2, SIDE / 2, SIDE, SIDE);
    for (int i = 0; i < COUNT; i++) {
        const Color *c = &colors[i];
        int x = i % SIDE, y = i / SIDE;
        at += (size_t)snprintf(text + at, room - at,
                               "polygon { 5 <%d,-%d,0> <%d,-%d,0> <%d,-%d,0> <%d,-%d,0> <%d,-%d,0> "
                               "pigment { rgbt <%.7f,%.7f,%.7f,%g> } }\n",
                               x, y, x + 1, y, x + 1, y + 1, x, y + 1, x, y, (double)c->r,
                               (double)c->g, (double)c->b, (double)c->transmit);
    }
    return text;
}

static Image *develop(Arena *arena, const Film *film, DitherMethod method, const Color *colors) {
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){.width = SIDE, .height = SIDE, .channels = film_channels(film)};
    image->pixels = ARENA_ARRAY(arena, float, (size_t)COUNT *(size_t)image->channels);
    Dither *dither = dither_create(method, SIDE, arena);
    for (int i = 0; i < COUNT; i++) {
        float *values = image->pixels + i * image->channels;
        if (dither)
            film_develop_dithered(film, dither, i % SIDE, i / SIDE, colors[i], values);
        else
            film_develop(film, colors[i], values);
    }
    return image;
}

typedef struct {
    const char *header, *switches;
    DitherMethod dither;
    Settings settings;
    int bits;
    bool grayscale, alpha;
    double file_gamma;
} Case;

static Image *our_picture(Arena *arena, const Case *c) {
    Color colors[COUNT];
    fill_colors(colors, c->alpha);
    if (c->alpha) { // what shading does: the pigment's opaque share
        for (int i = 0; i < COUNT; i++) {
            float k = 1.0f - colors[i].transmit;
            colors[i].r *= k, colors[i].g *= k, colors[i].b *= k;
        }
    }
    Film film =
        film_create(&c->settings, IMAGE_PNG, c->bits, c->grayscale, c->alpha, c->file_gamma);
    Image *ours = develop(arena, &film, c->dither, colors);
    // Odd numbers of bits come back from the file with their upper bits repeated below.
    if (c->bits != 8 && c->bits != 16) {
        int stored = c->bits > 8 ? 16 : 8, count = COUNT * ours->channels;
        for (int i = 0; i < count; i++) {
            long k = lroundf(ours->pixels[i] * (float)((1 << c->bits) - 1));
            long wide = k << (stored - c->bits) | k >> (2 * c->bits - stored);
            ours->pixels[i] = (float)wide / (float)((1 << stored) - 1);
        }
    }
    return ours;
}

static void compare_all(const Case *cases, size_t count) {
    enum { MOST = 16 };
    assert_true(count <= MOST);
    if (!reference_available()) {
        print_message("skipped: povray is not installed\n");
        skip();
    }
    Arena *arena = arena_create();
    Reference *theirs[MOST];
    for (size_t i = 0; i < count; i++) {
        Color colors[COUNT];
        fill_colors(colors, cases[i].alpha);
        theirs[i] =
            reference_begin(arena, boxes(arena, cases[i].header, colors),
                            arena_printf(arena, "+W%d +H%d %s", SIDE, SIDE, cases[i].switches));
    }
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++) {
        char first[128];
        size_t off = reference_mismatches(our_picture(arena, &cases[i]), reference_end(theirs[i]),
                                          first, sizeof first);
        if (off)
            print_message("%s, %s: %zu values differ; ours, POV-Ray's at %s\n", cases[i].switches,
                          cases[i].header, off, first);
        wrong += off;
    }
    assert_int_equal(wrong, 0);
    arena_destroy(arena);
}
#define COMPARE_ALL(cases) compare_all(cases, sizeof cases / sizeof *cases)

#define POWER(g)                                                                                   \
    { .version = 370, .gamma_mode = GAMMA_POWER, .assumed_gamma = g }
#define LINEAR "#version 3.7; global_settings { assumed_gamma 1.0 }"

static void curves_at_16_bits(void **state) {
    (void)state;
    const Case cases[] = {
        {LINEAR, "+FN16", DITHER_NONE, POWER(1), 16, false, false, 0},
        {LINEAR, "+FN16 File_Gamma=1.0", DITHER_NONE, POWER(1), 16, false, false, 1.0},
        {LINEAR, "+FN16 File_Gamma=2.2", DITHER_NONE, POWER(1), 16, false, false, 2.2},
        {"#version 3.7; global_settings { assumed_gamma 2.2 }", "+FN16", DITHER_NONE, POWER(2.2f),
         16, false, false, 0},
        {"#version 3.7; global_settings { assumed_gamma 1.8 }", "+FN16 File_Gamma=2.4", DITHER_NONE,
         POWER(1.8f), 16, false, false, 2.4},
        {"#version 3.7; global_settings { assumed_gamma 2.2 }", "+FN16 File_Gamma=1.0", DITHER_NONE,
         POWER(2.2f), 16, false, false, 1.0},
        {"#version 3.7; global_settings { assumed_gamma srgb }",
         "+FN16 File_Gamma=1.8",
         DITHER_NONE,
         {.version = 370, .gamma_mode = GAMMA_SRGB},
         16,
         false,
         false,
         1.8},
        {"#version 3.7; global_settings { assumed_gamma srgb }",
         "+FN16",
         DITHER_NONE,
         {.version = 370, .gamma_mode = GAMMA_SRGB},
         16,
         false,
         false,
         0},
        {"#version 3.6;",
         "+FN16",
         DITHER_NONE,
         {.version = 360, .gamma_mode = GAMMA_NONE},
         16,
         false,
         false,
         0},
    };
    COMPARE_ALL(cases);
}

static void numbers_of_bits(void **state) {
    (void)state;
    const Case cases[] = {
        {LINEAR, "+FN8", DITHER_NONE, POWER(1), 8, false, false, 0},
        {LINEAR, "+FN5", DITHER_NONE, POWER(1), 5, false, false, 0},
        {LINEAR, "+FN10", DITHER_NONE, POWER(1), 10, false, false, 0},
    };
    COMPARE_ALL(cases);
}

static void alpha_and_grey(void **state) {
    (void)state;
    const Case cases[] = {
        {LINEAR, "+FN8 +UA", DITHER_NONE, POWER(1), 8, false, true, 0},
        {LINEAR, "+FN16 +UA", DITHER_NONE, POWER(1), 16, false, true, 0},
        {LINEAR, "+FNg", DITHER_NONE, POWER(1), 16, true, false, 0},
        {LINEAR, "+FNg +UA", DITHER_NONE, POWER(1), 16, true, true, 0},
    };
    COMPARE_ALL(cases);
}

// Each method, with curves both ways, few and many bits, grey and alpha.
static void dithering(void **state) {
    (void)state;
    const Case cases[] = {
        {LINEAR, "+TH", DITHER_FS, POWER(1), 8, false, false, 0},
        {LINEAR, "Dither=on Dither_Method=b2", DITHER_B2, POWER(1), 8, false, false, 0},
        {LINEAR, "+FN5 +THB3", DITHER_B3, POWER(1), 5, false, false, 0},
        {LINEAR, "+THB4 File_Gamma=1.0", DITHER_B4, POWER(1), 8, false, false, 1.0},
        {LINEAR, "+THD1 +UA", DITHER_D1, POWER(1), 8, false, true, 0},
        {LINEAR, "+THD2 +FN5 File_Gamma=1.8", DITHER_D2, POWER(1), 5, false, false, 1.8},
        {LINEAR, "+THFS +FN16", DITHER_FS, POWER(1), 16, false, false, 0},
        {LINEAR, "+THFS +FN6 +UA", DITHER_FS, POWER(1), 6, false, true, 0},
        {LINEAR, "+THD2 +FNg", DITHER_D2, POWER(1), 16, true, false, 0},
        {"#version 3.7; global_settings { assumed_gamma 1.8 }", "+TH File_Gamma=2.4", DITHER_FS,
         POWER(1.8f), 8, false, false, 2.4},
        {LINEAR, "+TH -TH", DITHER_NONE, POWER(1), 8, false, false, 0},
    };
    COMPARE_ALL(cases);
}

// The values that the facts name, by hand.
static void known_values(void **state) {
    (void)state;
    const struct {
        Settings settings;
        int r, g, b;
    } known[] = {
        {POWER(1), 188, 137, 89},
        {POWER(2.2f), 128, 61, 19},
        {POWER(1.8f), 146, 81, 34},
        {{.version = 370, .gamma_mode = GAMMA_SRGB}, 128, 64, 26},
        {{.version = 350, .gamma_mode = GAMMA_NONE}, 128, 64, 26},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        Film film = film_create(&known[i].settings, IMAGE_PNG, 8, false, false, 0);
        float v[3];
        film_develop(&film, (Color){0.5f, 0.25f, 0.1f, 0, 0}, v);
        assert_int_equal(lroundf(v[0] * 255), known[i].r);
        assert_int_equal(lroundf(v[1] * 255), known[i].g);
        assert_int_equal(lroundf(v[2] * 255), known[i].b);
    }
}

// Float formats keep what is outside 0..1, and stay linear and premultiplied.
static void floats_are_linear(void **state) {
    (void)state;
    const Settings settings = POWER(1);
    Film film = film_create(&settings, IMAGE_EXR, 8, false, true, 0);
    float v[4];
    film_develop(&film, (Color){7.5f, -0.25f, 0.1f, 0, 0.5f}, v);
    assert_true(v[0] == 7.5f && v[1] == -0.25f && v[2] == 0.1f && v[3] == 0.5f);
    const Settings screen = POWER(2.0f);
    film = film_create(&screen, IMAGE_HDR, 8, false, false, 0);
    film_develop(&film, (Color){0.5f, 0.25f, 2, 0, 0}, v);
    assert_true(v[0] == 0.25f && v[1] == 0.0625f && v[2] == 4);
}

// Whatever comes in, the values lie in 0..1: NaN is black.
static void odd_colors_are_clipped(void **state) {
    (void)state;
    const Settings settings = POWER(1);
    const float odd[] = {NAN, INFINITY, -INFINITY, -1, 1e30f};
    for (int alpha = 0; alpha <= 1; alpha++) {
        for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
            Film film = film_create(&settings, IMAGE_PNG, 8, false, alpha != 0, 0);
            float v[4] = {-1, -1, -1, 0};
            film_develop(&film, (Color){odd[i], 0.5f, odd[i], 0, alpha ? odd[i] : 0}, v);
            for (int c = 0; c < 4; c++)
                assert_true(v[c] >= 0 && v[c] <= 1);
        }
    }
}

// The table must say what the curves say, also for the floats around each step.
static void tables_change_nothing(void **state) {
    (void)state;
    const Settings spaces[] = {{.gamma_mode = GAMMA_POWER, .assumed_gamma = 1.0f},
                               {.gamma_mode = GAMMA_POWER, .assumed_gamma = 2.2f},
                               {.gamma_mode = GAMMA_SRGB},
                               {.gamma_mode = GAMMA_NONE}};
    const double gammas[] = {0, 1, 2.2, 0.5};
    Rng rng = {7};
    Arena *arena = arena_create();
    for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++) {
        for (size_t j = 0; j < sizeof gammas / sizeof *gammas; j++) {
            int bits = 8 - (int)((i + j) % 4) * 2;
            Film film = film_create(&spaces[i], IMAGE_PNG, bits, false, false, gammas[j]);
            Film quick = film;
            film_prepare(&quick, arena);
            assert_non_null(quick.table);
            float x = 0.0f;
            for (int k = 0; k < 200000; k++) {
                // In the first half neighbours, a thousand at a time.
                x = k % 1000 ? nextafterf(x, 2.0f) : (float)rng_range(&rng, -0.01, 1.01);
                if (k >= 100000)
                    x = (float)pow(10, rng_range(&rng, -6, 0.1));
                float want[4], got[4];
                film_develop(&film, (Color){x, x, -x, 0, 0}, want);
                film_develop(&quick, (Color){x, x, -x, 0, 0}, got);
                assert_memory_equal(want, got, 3 * sizeof *want);
            }
            for (int k = 1; k < 1 << bits; k++) { // around the steps
                uint32_t low = 0, high = 0x3f800000;
                while (low + 1 < high) {
                    uint32_t middle = (low + high) / 2;
                    float v[4];
                    memcpy(&x, &middle, sizeof x);
                    film_develop(&film, (Color){x, x, x, 0, 0}, v);
                    if (v[0] * (float)((1 << bits) - 1) >= (float)k - 0.5f)
                        high = middle;
                    else
                        low = middle;
                }
                for (uint32_t near = low - 20; near < low + 20; near++) {
                    float want[4], got[4];
                    memcpy(&x, &near, sizeof x);
                    film_develop(&film, (Color){x, x, x, 0, 0}, want);
                    film_develop(&quick, (Color){x, x, x, 0, 0}, got);
                    assert_true(want[0] == got[0]);
                }
            }
        }
    }
    arena_destroy(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_at_16_bits),      cmocka_unit_test(numbers_of_bits),
        cmocka_unit_test(alpha_and_grey),         cmocka_unit_test(dithering),
        cmocka_unit_test(known_values),           cmocka_unit_test(floats_are_linear),
        cmocka_unit_test(odd_colors_are_clipped), cmocka_unit_test(tables_change_nothing),
    };
    return cmocka_run_group_tests_name("film", tests, NULL, NULL);
}
