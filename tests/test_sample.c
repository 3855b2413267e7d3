// SPDX-License-Identifier: MIT
// Anti-aliasing against POV-Ray itself: spheres of one plain colour each, which both sides can
// compute, so that every difference is one of sampling. All comparisons are of whole 16-bit files.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "reference.h"
#include "render/film.h"
#include "render/sample.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- the scene in our words and in POV-Ray's -------------------------------------------------

typedef struct {
    Vec3 center;
    double radius;
    Rgb color;
} Ball;

static const Ball balls[] = {
    {{-0.3, 0.25, 0}, 0.9, {0.9f, 0.5f, 0.1f}},
    {{0.85, -0.4, -1.2}, 0.61, {0.2f, 0.25f, 0.8f}},
    {{0.4, 0.7, -1.5}, 0.33, {3.0f, 2.0f, 0.02f}},   // brighter than white
    {{-0.9, -0.8, -1}, 0.45, {0.05f, 0.06f, 0.04f}}, // hardly to be seen
    {{-1.1, 0.6, -2}, 0.07, {1, 1, 1}},              // smaller than a pixel of some pictures
};
enum { BALLS = sizeof balls / sizeof *balls };

static Color trace_balls(void *context, const Ray *ray) {
    (void)context;
    double nearest = INFINITY;
    Color color = {0.02f, 0.03f, 0.05f, 0, 0};
    for (int i = 0; i < BALLS; i++) {
        Vec3 to = vec_sub(balls[i].center, ray->org);
        double along = vec_dot(to, ray->dir);
        double half = balls[i].radius * balls[i].radius - (vec_dot(to, to) - along * along);
        if (half <= 0 || along - sqrt(half) >= nearest || along - sqrt(half) <= 0)
            continue;
        nearest = along - sqrt(half);
        Rgb c = balls[i].color;
        color = (Color){c.r, c.g, c.b, 0, 0};
    }
    return color;
}

static const char *scene_text(Arena *arena, const char *gamma, const char *camera) {
    char *text = arena_printf(arena,
                              "#version 3.7; global_settings { assumed_gamma %s }\n"
                              "background { rgb <0.02, 0.03, 0.05> }\n"
                              "camera { %s }\n",
                              gamma, camera);
    for (int i = 0; i < BALLS; i++) {
        const Ball *b = &balls[i];
        text = arena_printf(arena,
                            "%ssphere { <%.9g, %.9g, %.9g>, %.9g pigment { rgb <%.9g, %.9g, %.9g> }"
                            " finish { ambient 1 diffuse 0 } }\n",
                            text, b->center.x, b->center.y, b->center.z, b->radius,
                            (double)b->color.r, (double)b->color.g, (double)b->color.b);
    }
    return text;
}

static const char *const FLAT = "orthographic location <0, 0, -3> direction z up 2.7*y right 3.3*x";
static const char *const DEEP = "location <0.1, 0.2, -3> direction 0.9*z up y right -1.33*x";

static Camera camera_of(const char *text) {
    if (text == FLAT)
        return (Camera){.type = CAMERA_ORTHOGRAPHIC,
                        .location = {0, 0, -3},
                        .direction = {0, 0, 1},
                        .up = {0, 2.7, 0},
                        .right = {3.3, 0, 0}};
    return (Camera){.type = CAMERA_PERSPECTIVE,
                    .location = {0.1, 0.2, -3},
                    .direction = {0, 0, 0.9},
                    .up = {0, 1, 0},
                    .right = {-1.33, 0, 0}};
}

// ---- one comparison --------------------------------------------------------------------------

typedef struct {
    const char *switches; // for POV-Ray
    int width, height;
    int method, depth;
    double threshold, jitter; // as POV-Ray holds them: rounded to float
    int block;
    const char *camera, *gamma;
    int left, top, right, bottom; // partial picture; all 0: everything
} Case;

static Image *render_balls(Arena *arena, const Case *c) {
    Settings settings = {.version = 370, .gamma_mode = GAMMA_POWER};
    settings.assumed_gamma = strtof(c->gamma, NULL);
    if (strcmp(c->gamma, "srgb") == 0)
        settings.gamma_mode = GAMMA_SRGB;
    Camera camera = camera_of(c->camera);
    SampleOptions options = {.method = c->method,
                             .depth = c->depth,
                             .threshold = (double)(float)c->threshold,
                             .jitter = (double)(float)c->jitter};
    options.eye = transfer_between(curve_working(&settings), curve_power(2.5f));
    Color *picture = ARENA_ARRAY(arena, Color, (size_t)c->width * (size_t)c->height);
    PixelRect area = {c->left, c->top, c->right ? c->right : c->width,
                      c->bottom ? c->bottom : c->height};

    // Tiles in reverse: their order must not matter.
    Sampler *sampler = sampler_create(&options, &camera, c->width, c->height, c->block);
    int across = (area.right - area.left + c->block - 1) / c->block;
    int down = (area.bottom - area.top + c->block - 1) / c->block;
    for (int i = across * down - 1; i >= 0; i--) {
        PixelRect tile = {.left = area.left + i % across * c->block,
                          .top = area.top + i / across * c->block};
        tile.right = tile.left + c->block < area.right ? tile.left + c->block : area.right;
        tile.bottom = tile.top + c->block < area.bottom ? tile.top + c->block : area.bottom;
        sampler_tile(sampler, tile, trace_balls, NULL, picture);
    }
    assert_true(sampler_rays(sampler) >= (uint64_t)across);
    sampler_destroy(sampler);

    Film film = film_create(&settings, IMAGE_PNG, 16, false, false, 0);
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){.width = c->width, .height = c->height, .channels = 3, .bits = 16};
    size_t pixels = (size_t)c->width * (size_t)c->height;
    image->pixels = ARENA_ARRAY(arena, float, pixels * 3);
    for (size_t i = 0; i < pixels; i++)
        film_develop(&film, picture[i], image->pixels + 3 * i);
    return image;
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
        const Case *c = &cases[i];
        theirs[i] = reference_begin(
            arena, scene_text(arena, c->gamma, c->camera),
            arena_printf(arena, "+W%d +H%d +FN16 %s", c->width, c->height, c->switches));
    }
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++) {
        const Case *c = &cases[i];
        char first[128];
        size_t off = reference_mismatches(render_balls(arena, c), reference_end(theirs[i]), first,
                                          sizeof first);
        if (off)
            print_message("%s, %d x %d, gamma %s: %zu values differ; ours, POV-Ray's at %s\n",
                          c->switches, c->width, c->height, c->gamma, off, first);
        wrong += off;
    }
    assert_int_equal(wrong, 0);
    arena_destroy(arena);
}
#define COMPARE_ALL(cases) compare_all(cases, sizeof cases / sizeof *cases)

// ---- tests -----------------------------------------------------------------------------------

static void permutation_and_offsets(void **state) {
    (void)state;
    const int first[] = {2291, 2574, 3654, 1557, 1196, 3388, 2637, 1820};
    for (int i = 0; i < 8; i++)
        assert_int_equal(sample_permutation(i), first[i]);
    bool seen[4096] = {false};
    for (int i = 0; i < 4096; i++) {
        assert_false(seen[sample_permutation(i)]);
        seen[sample_permutation(i)] = true;
    }

    // The offsets are k / 32768 - 0.5 to six decimals; over many places all 256 come up, and the
    // known first ones among them.
    const float known[] = {-0.5f, 0.005890f, 0.011749f, -0.490234f};
    bool found[4] = {false};
    double low = 1, high = -1;
    Rng rng = {1};
    for (int i = 0; i < 100000; i++) {
        double jx, jy;
        sample_jitter(rng_range(&rng, -1, 700), rng_range(&rng, -1, 700), &jx, &jy);
        for (int k = 0; k < 4; k++)
            found[k] = found[k] || (float)jx == known[k];
        low = fmin(low, fmin(jx, jy));
        high = fmax(high, fmax(jx, jy));
    }
    for (int k = 0; k < 4; k++)
        assert_true(found[k]);
    assert_true(low == -0.5 && high < 0.5 && high > 0.49);

    // At the origin both hashes are P[P[0] ^ 0]: by hand P[2291] & 255 into the table.
    double jx, jy;
    sample_jitter(0, 0, &jx, &jy);
    assert_true(jx == jy);
}

static void pixel_centres(void **state) {
    (void)state;
    const Case cases[] = {
        {"", 44, 36, 0, 3, 0.3, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"", 44, 36, 0, 3, 0.3, 1, 32, DEEP, "1.0", 0, 0, 0, 0},
        {"", 37, 53, 0, 3, 0.3, 1, 7, DEEP, "2.2", 0, 0, 0, 0},
        {"", 1, 1, 0, 3, 0.3, 1, 32, DEEP, "1.0", 0, 0, 0, 0},
    };
    COMPARE_ALL(cases);
}

static void method_one(void **state) {
    (void)state;
    const Case cases[] = {
        {"+A", 70, 66, 1, 3, 0.3, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.3 -J", 70, 66, 1, 3, 0.3, 0, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.3 +J0.3 +R2", 70, 66, 1, 2, 0.3, 0.3, 32, DEEP, "1.0", 0, 0, 0, 0},
        {"+A0.1 +R1", 70, 66, 1, 1, 0.1, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.0 +R4", 40, 37, 1, 4, 0.0, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.9 +R9", 40, 37, 1, 9, 0.9, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.05 +R5", 40, 37, 1, 5, 0.05, 1, 32, DEEP, "2.2", 0, 0, 0, 0},
        {"+A0.2", 40, 37, 1, 3, 0.2, 1, 32, DEEP, "srgb", 0, 0, 0, 0},
    };
    COMPARE_ALL(cases);
}

static void method_one_depends_on_tiles(void **state) {
    (void)state;
    const Case cases[] = {
        {"+A0.1 +BS16", 70, 66, 1, 3, 0.1, 1, 16, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.1 +BS5", 70, 66, 1, 3, 0.1, 1, 5, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.1 +BS200", 70, 66, 1, 3, 0.1, 1, 200, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.1 +SC11 +EC60 +SR6 +ER50", 70, 66, 1, 3, 0.1, 1, 32, FLAT, "1.0", 10, 5, 60, 50},
    };
    COMPARE_ALL(cases);

    // The pictures of two tile sizes do differ, or these cases say nothing.
    Arena *arena = arena_create();
    char first[128];
    Image *a = render_balls(arena, &cases[0]), *b = render_balls(arena, &cases[1]);
    assert_true(reference_mismatches(a, b, first, sizeof first) > 0);
    arena_destroy(arena);
}

static void method_two(void **state) {
    (void)state;
    const Case cases[] = {
        {"+A0.3 +AM2", 70, 66, 2, 3, 0.3, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.3 +AM2 -J", 70, 66, 2, 3, 0.3, 0, 32, DEEP, "1.0", 0, 0, 0, 0},
        {"+A0.1 +AM2 +R1", 70, 66, 2, 1, 0.1, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.05 +AM2 +R5 +J0.5", 40, 37, 2, 5, 0.05, 0.5, 32, DEEP, "2.2", 0, 0, 0, 0},
        {"+A0.3 +AM2 +R9", 20, 17, 2, 9, 0.3, 1, 32, FLAT, "1.0", 0, 0, 0, 0},
        {"+A0.2 +AM2 +BS7", 40, 37, 2, 3, 0.2, 1, 32, FLAT, "srgb", 0, 0, 0, 0},
        {"+A0.1 +AM2 +SC11 +EC60 +SR6 +ER50", 70, 66, 2, 3, 0.1, 1, 32, FLAT, "1.0", 10, 5, 60, 50},
    };
    COMPARE_ALL(cases);
}

static Color trace_white(void *context, const Ray *ray) {
    (void)ray;
    ++*(int *)context;
    return (Color){1, 1, 1, 0, 0};
}

// A picture without differences costs one ray a pixel and its frame, and keeps its colour exactly.
static void plain_pictures_cost_nothing(void **state) {
    (void)state;
    Camera camera = camera_of(FLAT);
    for (int method = 0; method <= 2; method++) {
        SampleOptions options = {.method = method, .depth = 9, .threshold = 0.3, .jitter = 1};
        Sampler *sampler = sampler_create(&options, &camera, 10, 6, 32);
        Color picture[60];
        int traced = 0;
        sampler_tile(sampler, (PixelRect){0, 0, 10, 6}, trace_white, &traced, picture);
        assert_int_equal(traced, method == 0 ? 60 : method == 1 ? 60 + 10 + 6 : 11 * 7);
        assert_int_equal(sampler_rays(sampler), (uint64_t)traced);
        assert_int_equal(sampler_pixels(sampler), 0);
        for (int i = 0; i < 60; i++)
            assert_true(picture[i].r == 1.0f && picture[i].b == 1.0f && picture[i].transmit == 0);
        sampler_destroy(sampler);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(permutation_and_offsets),
        cmocka_unit_test(pixel_centres),
        cmocka_unit_test(method_one),
        cmocka_unit_test(method_one_depends_on_tiles),
        cmocka_unit_test(method_two),
        cmocka_unit_test(plain_pictures_cost_nothing),
    };
    return cmocka_run_group_tests_name("sample", tests, NULL, NULL);
}
