// SPDX-License-Identifier: MIT
// The further channels of a picture, against what can be worked out by hand: a flat patch that is
// parallel to the picture plane of an orthographic camera, a ball before it, nothing at the sides.
#include "pictures.h"

#include "converter/convert.h"
#include "render/aov.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// u runs along x from -3 to 3 and v along y from -1.5 to 1.5; a first patch is out of sight.
static const char *const text =
    "#version 3.7; global_settings { assumed_gamma 1 }\n"
    "camera { orthographic location -5*z right 8*x up 6*y direction z }\n"
    "#macro P(X) bicubic_patch { type 1 u_steps 0 v_steps 0"
    " #local I = 0; #while (I < 4) #local J = 0; #while (J < 4) <2*I-3+X, J-1.5, 2>"
    " #local J = J+1; #end #local I = I+1; #end pigment { rgb <0.25, 0.5, 0.75> }"
    " finish { ambient 1 diffuse 0 } } #end\n"
    "P(100) sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 diffuse 0 } } P(0)\n";

enum { WIDE = 32, HIGH = 24 };

static const ImageLayers *layers_of(Arena *arena, const char *list) {
    char path[4400], input[4500], aov[200];
    snprintf(path, sizeof path, "%s/aov.pov", scratch_folder());
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
    snprintf(input, sizeof input, "+I%s", path);
    snprintf(aov, sizeof aov, "%s", list);
    char *words[] = {"qirender", input, "+W32", "+H24", "-V", "--aov", aov};
    RenderOptions o = options_default();
    assert_true(options_parse(PROGRAM_QIRENDER, 7, words, arena, &o));
    ImageWriteOptions write;
    RenderStats stats;
    assert_non_null(render_scene(convert_scene(&o, arena), &o, arena, &write, &stats));
    assert_non_null(stats.layers);
    return stats.layers;
}

static int channel(const ImageLayers *layers, const char *name) {
    for (int i = 0; i < layers->channels; i++)
        if (strcmp(layers->names[i], name) == 0)
            return i;
    fail_msg("no channel %s", name);
    return -1;
}

static double value(const ImageLayers *layers, const char *name, int x, int y) {
    size_t at = (size_t)y * (size_t)layers->width + (size_t)x;
    return (double)layers->pixels[at * (size_t)layers->channels + (size_t)channel(layers, name)];
}

static void assert_close(double got, double want, double error) {
    if (!(fabs(got - want) <= error))
        fail_msg("%.9g instead of %.9g", got, want);
}

static void channels_are_right(void **state) {
    (void)state;
    Arena *arena = arena_create();
    const ImageLayers *all = layers_of(arena, "depth,normal,uv,patch,steps,bound,object");
    assert_int_equal(all->width, WIDE);
    assert_int_equal(all->height, HIGH);
    assert_int_equal(all->channels, 3 + 12);
    int seen[3] = {0};
    for (int j = 0; j < HIGH; j++) {
        for (int i = 0; i < WIDE; i++) {
            double x = 8.0 * ((i + 0.5) / WIDE - 0.5), y = 6.0 * (0.5 - (j + 0.5) / HIGH);
            double square = 1.0 - x * x - y * y;
            bool ball = square > 0, patch = !ball && fabs(x) < 3 && fabs(y) < 1.5;
            double z = ball ? 5 - sqrt(square) : patch ? 7 : INFINITY;
            // Single precision: 2^-24 of the value.
            if (isinf(z))
                assert_true(isinf(value(all, "Z", i, j)));
            else
                assert_close(value(all, "Z", i, j), z, z * 0x1p-23);
            assert_close(value(all, "object", i, j), ball ? 1 : patch ? 2 : -1, 0);
            assert_close(value(all, "patch", i, j), patch ? 1 : -1, 0);
            assert_close(value(all, "N.X", i, j), ball ? x : 0, 1e-6);
            assert_close(value(all, "N.Y", i, j), ball ? y : 0, 1e-6);
            assert_close(value(all, "N.Z", i, j), ball ? -sqrt(square) : patch ? 1 : 0, 1e-6);
            assert_close(value(all, "B", i, j), ball ? 1 : patch ? 0.75 : 0, 1e-6);
            if (patch) { // POV-Ray's texture coordinates: U is the second parameter
                assert_close(value(all, "uv.U", i, j), (y + 1.5) / 3, 1e-6);
                assert_close(value(all, "uv.V", i, j), (x + 3) / 6, 1e-6);
                assert_true(value(all, "steps.newton", i, j) >= 1);
                assert_true(value(all, "steps.leaf", i, j) >= 1);
                double bound = value(all, "bound", i, j), diameter = sqrt(45);
                assert_true(bound >= 0 && bound <= 1e-9 * diameter);
            }
            seen[ball ? 0 : patch ? 1 : 2]++;
        }
    }
    assert_true(seen[0] > 30 && seen[1] > 100 && seen[2] > 100);
    arena_destroy(arena);
}

static void only_what_was_asked(void **state) {
    (void)state;
    Arena *arena = arena_create();
    const ImageLayers *some = layers_of(arena, "bound,depth");
    assert_int_equal(some->channels, 5);
    assert_string_equal(some->names[3], "Z");
    assert_string_equal(some->names[4], "bound");
    arena_destroy(arena);
}

// OpenImageIO's own tool reads the file; with +FE there is one file with all channels.
static void file_is_multi_layer(void **state) {
    (void)state;
    const char *folder = scratch_folder(), *log;
    static const char *const cases[][3] = {{"", "aov.png", "aov.aov.exr"},
                                           {"+FE", "aov.exr", "aov.exr"}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(run_command(&log,
                                     "build/test/qirender '+I%s/aov.pov' +W32 +H24 %s --aov "
                                     "depth,normal '+O%s/%s' && oiiotool --info -v '%s/%s'",
                                     folder, cases[i][0], folder, cases[i][1], folder, cases[i][2]),
                         0);
        assert_non_null(strstr(log, "channel list: R, G, B, Z, N.X, N.Y, N.Z"));
        assert_null(strstr(log, "DateTime: \"20"));
    }
    assert_int_equal(run_command(&log, "build/test/qirender a.pov --aov depth,nomral"), 2);
    assert_non_null(strstr(log, "depth,normal,uv"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(channels_are_right),
        cmocka_unit_test(only_what_was_asked),
        cmocka_unit_test(file_is_multi_layer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
