// SPDX-License-Identifier: MIT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "texture_rows.h"

#include "base/array.h"
#include "base/diag.h"
#include "base/file.h"
#include "converter/convert.h"
#include "reference.h"
#include "render/render.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

// At most so many percent of the pixels may be off by more than a step of 8 bits. One of 1728
// pixels is 0.06 %.
static const double MOST_PERCENT = 0.1;
static const char SIZE[] = "+W48 +H36 +FN16 File_Gamma=1.0 -A";

static const char HEAD[] = "#version 3.7; global_settings { assumed_gamma 1 }\n"
                           "camera { location <0.3,0.6,-6> look_at 0 angle 42 }\n"
                           "light_source { <-5,8,-9> rgb 0.9 }\n"
                           "light_source { <7,-3,-8> rgb 0.3 shadowless }\n";
static const char PATCH[] = "bicubic_patch { type 1 flatness 0 u_steps 4 v_steps 4\n"
                            "<-3.1,-2.3,0>, <-1.1,-2.6,-1.2>, <0.9,-2.4,1.1>, <3.2,-2.2,0.3>,\n"
                            "<-3.3,-0.8,1.3>, <-1,-0.7,-2.4>, <1.1,-0.9,0.9>, <3.1,-0.8,-0.7>,\n"
                            "<-3.2,0.9,-0.4>, <-0.9,0.8,1.9>, <1,0.7,-1.8>, <3.3,0.9,1.1>,\n"
                            "<-3,2.4,0.6>, <-1.1,2.3,-0.9>, <0.8,2.5,0.7>, <3.1,2.3,-0.8>\n";

static const char *scene_text(Arena *arena, const TextureRow *row) {
    const char *include = "";
    if (row->include[0])
        include = arena_printf(arena, "#include \"colors.inc\"\n#include \"%s\"\n", row->include);
    return arena_printf(arena, "%s%s%s%s }\n", HEAD, include, PATCH, row->text);
}

static Image *render_ours(Arena *arena, const char *text) {
    char path[] = "/tmp/qipov-test-XXXXXX.pov";
    int file = mkstemps(path, 4);
    assert_true(file >= 0);
    assert_int_equal(write(file, text, strlen(text)), strlen(text));
    close(file);
    char *line =
        arena_printf(arena, "+I%s +L/usr/share/povray-3.7/include --method facets %s", path, SIZE);
    char *words[16] = {arena_strdup(arena, "qirender")}, *save = NULL;
    int count = 1;
    for (char *w = strtok_r(line, " ", &save); w; w = strtok_r(NULL, " ", &save))
        words[count++] = w;
    RenderOptions options = options_default();
    assert_true(options_parse(PROGRAM_QIRENDER, count, words, arena, &options));
    options.verbose = false;
    render_check(&options);
    ImageWriteOptions written;
    RenderStats stats;
    Image *image = render_scene(convert_scene(&options, arena), &options, arena, &written, &stats);
    unlink(path);
    return image;
}

// How far apart the darkest and the lightest value of the picture are.
static float contrast(const Image *image) {
    float low = 1, high = 0;
    for (int i = 0; i < image->width * image->height * image->channels; i++) {
        low = image->pixels[i] < low ? image->pixels[i] : low;
        high = image->pixels[i] > high ? image->pixels[i] : high;
    }
    return high - low;
}

// All of POV-Ray's pictures are made while ours are.
void texture_rows_check(const TextureRow *rows, size_t count) {
    if (!reference_available()) {
        print_message("skipped: povray is not installed\n");
        skip();
    }
    Arena *arena = arena_create();
    Reference **theirs = ARENA_ARRAY(arena, Reference *, count);
    size_t bad = 0;
    enum { AHEAD = 4 };
    for (size_t i = 0; i < count + AHEAD; i++) {
        if (i < count)
            theirs[i] = reference_begin(arena, scene_text(arena, &rows[i]),
                                        arena_printf(arena, "%s +WT1", SIZE));
        if (i < AHEAD)
            continue;
        const TextureRow *row = &rows[i - AHEAD];
        size_t warnings = diag_warning_count();
        Image *ours = render_ours(arena, scene_text(arena, row));
        ImageDifference d =
            image_compare(ours, reference_end(theirs[i - AHEAD]), 1.0 / 255, 1.0 / 255);
        double percent = 100.0 * (double)d.failed / (double)d.pixels;
        bool something = contrast(ours) > 0.15f; // to compare
        bool good = something && percent <= MOST_PERCENT && diag_warning_count() == warnings;
        bad += !good;
        if (!good || getenv("SHOW_FIGURES"))
            print_message("%5.2f %% off, at most %.4f of %.2f; %zu warnings: %s %.90s\n", percent,
                          d.max, (double)contrast(ours), diag_warning_count() - warnings,
                          row->include, row->text);
    }
    arena_destroy(arena);
    assert_int_equal(bad, 0);
}
