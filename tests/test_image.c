// SPDX-License-Identifier: MIT
// Pictures out and in again, what a file's header says, files that cannot be written or read, and
// the figures of comparisons against sums by hand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "own_folder.h"
#include "base/diag.h"
#include "base/file.h"
#include "base/rng.h"
#include "image/image.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static int files_in(const OwnFolder *place) {
    char command[128];
    snprintf(command, sizeof command, "ls -A %s | wc -l", place->folder);
    FILE *pipe = popen(command, "r");
    int count = -1;
    assert_int_equal(fscanf(pipe, "%d", &count), 1);
    pclose(pipe);
    return count;
}

// Values k / (2^bits - 1), all of them if there is room.
static Image *ramp(Arena *arena, int width, int height, int channels, int bits) {
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){.width = width, .height = height, .channels = channels, .bits = bits};
    size_t count = (size_t)width * (size_t)height * (size_t)channels;
    image->pixels = ARENA_ARRAY(arena, float, count);
    unsigned most = (1u << bits) - 1;
    Rng rng = {5};
    for (size_t i = 0; i < count; i++) {
        unsigned k = i <= most ? (unsigned)i : (unsigned)(rng_next(&rng) % (most + 1));
        image->pixels[i] = (float)k / (float)most;
    }
    return image;
}

static ImageWriteOptions options_of(ImageFormat format, int bits) {
    ImageWriteOptions o = image_write_options_default();
    o.format = format;
    o.bits = bits;
    return o;
}

typedef struct {
    const char *path;
    const Image *image;
    ImageWriteOptions options;
} Write;
static void write_body(void *arg) {
    const Write *w = arg;
    image_write(w->path, w->image, &w->options);
}

// ---- tests -----------------------------------------------------------------------------------

static void extensions(void **state) {
    (void)state;
    ImageFormat format;
    for (int i = IMAGE_PNG; i <= IMAGE_TIFF; i++) {
        char name[32];
        snprintf(name, sizeof name, "a.b/x.%s", image_extension((ImageFormat)i));
        assert_true(image_format_of(name, &format));
        assert_int_equal(format, i);
    }
    assert_true(image_format_of("X.JPEG", &format) && format == IMAGE_JPEG);
    assert_true(image_format_of("x.tiff", &format) && format == IMAGE_TIFF);
    assert_false(image_format_of("png", &format));
    assert_false(image_format_of("a.png/x", &format));
    assert_false(image_format_of("x.gif", &format));
    assert_false(image_format_of("", &format));
}

// What goes out comes in again, value for value.
static void lossless_formats(void **state) {
    OwnFolder *place = *state;
    const struct {
        ImageFormat format;
        int bits, channels;
        bool compressed;
    } cases[] = {
        {IMAGE_PNG, 8, 3, false},  {IMAGE_PNG, 8, 4, false},   {IMAGE_PNG, 16, 3, false},
        {IMAGE_PNG, 16, 4, false}, {IMAGE_PNG, 16, 1, false},  {IMAGE_PNG, 16, 2, false},
        {IMAGE_PNG, 5, 3, false},  {IMAGE_PNG, 12, 3, false},  {IMAGE_TGA, 8, 3, false},
        {IMAGE_TGA, 8, 3, true},   {IMAGE_TGA, 8, 4, false},   {IMAGE_PPM, 8, 3, false},
        {IMAGE_PPM, 16, 3, false}, {IMAGE_PPM, 16, 1, false},  {IMAGE_BMP, 8, 3, false},
        {IMAGE_TIFF, 8, 3, false}, {IMAGE_TIFF, 16, 4, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Image *out = ramp(place->arena, 29, 37, cases[i].channels, cases[i].bits);
        ImageWriteOptions o = options_of(cases[i].format, cases[i].bits);
        o.compressed = cases[i].compressed;
        const char *path = own_path(
            place, arena_printf(place->arena, "%zu.%s", i, image_extension(cases[i].format)));
        image_write(path, out, &o);
        Image *back = image_read(place->arena, path);
        assert_int_equal(back->width, out->width);
        assert_int_equal(back->height, out->height);
        assert_int_equal(back->channels, out->channels);
        assert_int_equal(back->bits, cases[i].bits > 8 ? 16 : 8);
        int stored = back->bits;
        for (int p = 0; p < 29 * 37 * out->channels; p++) {
            // Odd numbers of bits come back within half of their own step: upper bits repeated.
            float off = fabsf(out->pixels[p] - back->pixels[p]);
            float most = cases[i].bits == stored ? 1e-6f : 0.5f / (float)((1 << cases[i].bits) - 1);
            if (!(off <= most))
                fail_msg("case %zu, value %d: %.9g, %.9g", i, p, (double)out->pixels[p],
                         (double)back->pixels[p]);
        }
        unlink(path);
    }
}

static void float_formats(void **state) {
    OwnFolder *place = *state;
    Image *out = ramp(place->arena, 16, 9, 3, 8);
    out->pixels[0] = 40.0f; // brighter than white survives
    image_write(own_path(place, "x.exr"), out,
                &(ImageWriteOptions){.format = IMAGE_EXR, .gamma = 1});
    image_write(own_path(place, "x.hdr"), out,
                &(ImageWriteOptions){.format = IMAGE_HDR, .gamma = 1});
    Image *exr = image_read(place->arena, own_path(place, "x.exr"));
    Image *hdr = image_read(place->arena, own_path(place, "x.hdr"));
    for (int i = 0; i < 16 * 9 * 3; i++) {
        // Half floats have 11 bits; RGBE shares an exponent: 8 bits of the brightest channel.
        float x = out->pixels[i], brightest = 0;
        for (int c = 0; c < 3; c++)
            brightest = fmaxf(brightest, out->pixels[i / 3 * 3 + c]);
        assert_true(fabsf(exr->pixels[i] - x) <= x / 2048 + 1e-7f);
        assert_true(fabsf(hdr->pixels[i] - x) <= brightest / 128);
    }
}

// Where a format has no place for alpha, the colours stay.
static void alpha_is_dropped_where_it_must(void **state) {
    OwnFolder *place = *state;
    Image *out = ramp(place->arena, 4, 3, 4, 8);
    const ImageWriteOptions o = options_of(IMAGE_PPM, 8);
    image_write(own_path(place, "x.ppm"), out, &o);
    Image *back = image_read(place->arena, own_path(place, "x.ppm"));
    assert_int_equal(back->channels, 3);
    for (int i = 0; i < 12; i++)
        for (int c = 0; c < 3; c++)
            assert_true(fabsf(back->pixels[3 * i + c] - out->pixels[4 * i + c]) < 1e-6f);
}

// The first chunk of that type: its data, or NULL.
static const unsigned char *png_chunk(const char *file, size_t size, const char *type) {
    for (size_t at = 8; at + 12 <= size;) {
        const unsigned char *p = (const unsigned char *)file + at;
        size_t length = (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
        if (memcmp(p + 4, type, 4) == 0)
            return p + 8;
        at += 12 + length;
    }
    return NULL;
}

static void png_headers(void **state) {
    OwnFolder *place = *state;
    const struct {
        double gamma;
        bool srgb;
        int written; // 100000 / gamma; 0: none
    } cases[] = {{2.2, true, 45455}, {1.0, false, 100000}, {1.8, false, 55556}, {0, false, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ImageWriteOptions o = options_of(IMAGE_PNG, 8);
        o.gamma = cases[i].gamma;
        o.srgb = cases[i].srgb;
        o.software = "qipov test";
        image_write(own_path(place, "h.png"), ramp(place->arena, 3, 2, 3, 8), &o);
        size_t size;
        const char *file = file_read(place->arena, own_path(place, "h.png"), &size, NULL);
        const unsigned char *gama = png_chunk(file, size, "gAMA");
        int written = gama ? gama[0] << 24 | gama[1] << 16 | gama[2] << 8 | gama[3] : 0;
        assert_in_range(written, cases[i].written ? cases[i].written - 1 : 0,
                        cases[i].written ? cases[i].written + 1 : 0);
        assert_int_equal(png_chunk(file, size, "sRGB") != NULL, cases[i].srgb);
        assert_null(png_chunk(file, size, "tIME")); // the same picture is the same bytes
        assert_non_null(png_chunk(file, size, "tEXt"));
    }
}

static void same_bytes_twice(void **state) {
    OwnFolder *place = *state;
    for (int f = IMAGE_PNG; f <= IMAGE_TIFF; f++) {
        const ImageWriteOptions o = options_of((ImageFormat)f, 8);
        size_t size[2];
        const char *bytes[2];
        for (int i = 0; i < 2; i++) {
            image_write(own_path(place, "same"), ramp(place->arena, 31, 7, 3, 8), &o);
            bytes[i] = file_read(place->arena, own_path(place, "same"), &size[i], NULL);
        }
        assert_int_equal(size[0], size[1]);
        assert_memory_equal(bytes[0], bytes[1], size[0]);
    }
}

static void nothing_is_left_after_failure(void **state) {
    OwnFolder *place = *state;
    Write w = {.image = ramp(place->arena, 8, 8, 3, 8), .options = image_write_options_default()};
    const struct {
        const char *path, *why;
    } cases[] = {
        {own_path(place, "no/such/x.png"), "No such file"},
        {place->folder, "directory"},
        {"/dev/null/x.png", "Not a directory"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        w.path = cases[i].path;
        char *message = NULL;
        assert_false(diag_catch(write_body, &w, &message));
        assert_non_null(strstr(message, w.path));
        assert_non_null(strstr(message, cases[i].why));
        free(message);
    }
    assert_int_equal(files_in(place), 0);

    // A file that was there before stays as it was.
    if (geteuid() != 0) {
        w.path = own_path(place, "kept.png");
        image_write(w.path, w.image, &w.options);
        chmod(place->folder, 0500);
        char *message = NULL;
        assert_false(diag_catch(write_body, &w, &message));
        free(message);
        chmod(place->folder, 0700);
        assert_int_equal(image_read(place->arena, w.path)->width, 8);
    }
}

// A limit on the size of files stands in for a full disk: the write fails part of the way.
static void full_disk(void **state) {
    OwnFolder *place = *state;
    Rng rng = {9};
    Image *noise = ramp(place->arena, 256, 256, 3, 8); // will not compress below the limit
    for (int i = 0; i < 256 * 256 * 3; i++)
        noise->pixels[i] = (float)(rng_next(&rng) & 255) / 255.0f;
    Write w = {
        .path = own_path(place, "full.png"), .image = noise, .options = options_of(IMAGE_PNG, 8)};
    image_write(w.path, ramp(place->arena, 2, 2, 3, 8), &w.options); // an older file of that name

    struct rlimit before, small;
    getrlimit(RLIMIT_FSIZE, &before);
    small = before;
    small.rlim_cur = 65536;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    char *message = NULL;
    bool ok = diag_catch(write_body, &w, &message);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_DFL);
    assert_false(ok);
    assert_non_null(strstr(message, "full.png"));
    assert_non_null(strstr(message, "File too large"));
    free(message);
    assert_int_equal(files_in(place), 1); // no piece of the new one; the old one whole
    assert_int_equal(image_read(place->arena, w.path)->width, 2);
}

static void standard_output(void **state) {
    OwnFolder *place = *state;
    Image *out = ramp(place->arena, 11, 5, 3, 8);
    const ImageWriteOptions o = options_of(IMAGE_PNG, 8);
    fflush(stdout);
    int keep = dup(STDOUT_FILENO);
    assert_non_null(freopen(own_path(place, "stdout.png"), "wb", stdout));
    image_write("-", out, &o);
    fflush(stdout);
    dup2(keep, STDOUT_FILENO);
    close(keep);
    Image *back = image_read(place->arena, own_path(place, "stdout.png"));
    assert_int_equal(back->width, 11);
    assert_true(fabsf(back->pixels[100] - out->pixels[100]) < 1e-6f);
}

typedef struct {
    Arena *arena;
    const char *path;
} Read;

static void read_body(void *arg) { image_read(((Read *)arg)->arena, ((Read *)arg)->path); }

static void unreadable_pictures(void **state) {
    OwnFolder *place = *state;
    const ImageWriteOptions o = options_of(IMAGE_PNG, 8);
    image_write(own_path(place, "whole.png"), ramp(place->arena, 64, 64, 3, 8), &o);
    size_t size;
    const char *bytes = file_read(place->arena, own_path(place, "whole.png"), &size, NULL);
    const struct {
        const char *name;
        size_t length;
    } files[] = {{"empty.png", 0}, {"cut.png", size / 2}, {"head.png", 20}, {"text.png", 3}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        FILE *f = fopen(own_path(place, files[i].name), "wb");
        fwrite(bytes, 1, files[i].length, f);
        fclose(f);
    }
    // A header that claims 2^31 - 1 pixels a side, with a checksum that fits.
    static const unsigned char huge[] = {
        0x89, 'P',  'N',  'G',  13,   10,   26,   10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0x7f,
        0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 8,  2, 0, 0, 0,  0,   0,   0,   0};
    FILE *f = fopen(own_path(place, "huge.png"), "wb");
    fwrite(huge, 1, sizeof huge, f);
    fclose(f);

    const char *const names[] = {"empty.png", "cut.png",     "head.png", "text.png",
                                 "huge.png",  "missing.png", "."};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *message = NULL;
        Read r = {place->arena, own_path(place, names[i])};
        if (diag_catch(read_body, &r, &message))
            fail_msg("%s was read", names[i]);
        assert_non_null(strstr(message, names[i]));
        free(message);
    }
}

// ---- comparison ------------------------------------------------------------------------------

static void equal_pictures(void **state) {
    OwnFolder *place = *state;
    Image *a = ramp(place->arena, 20, 10, 3, 8);
    ImageDifference d = image_compare(a, a, 1e-6, 1e-6);
    assert_true(d.mean == 0 && d.rms == 0 && d.max == 0 && isinf(d.psnr));
    assert_true(d.failed == 0 && d.warned == 0 && d.different == 0 && d.pixels == 200);
}

// Three values of 600 are off by 0.5, 0.25 and one step of 8 bits.
static void figures_by_hand(void **state) {
    OwnFolder *place = *state;
    Image *a = ramp(place->arena, 20, 10, 3, 8), *b = ramp(place->arena, 20, 10, 3, 8);
    memset(a->pixels, 0, 600 * sizeof(float));
    memset(b->pixels, 0, 600 * sizeof(float));
    b->pixels[3 * (7 * 20 + 13) + 1] = 0.5f;
    a->pixels[3 * (2 * 20 + 4) + 2] = 0.25f;
    a->pixels[0] = 1.0f / 255.0f;
    ImageDifference d = image_compare(a, b, 0.3, 0.1);
    double mean = (0.5 + 0.25 + 1 / 255.0) / 600;
    double rms = sqrt((0.25 + 0.0625 + 1 / 255.0 / 255.0) / 600);
    assert_true(fabs(d.mean - mean) < 1e-9 && fabs(d.rms - rms) < 1e-9);
    assert_true(fabs(d.psnr - 20 * log10(1 / rms)) < 1e-6);
    assert_true(d.max == 0.5 && d.max_x == 13 && d.max_y == 7 && d.max_channel == 1);
    assert_true(d.failed == 1 && d.warned == 2);
    assert_true(d.different == 2); // one step alone does not count

    Image *off = image_difference(place->arena, a, b);
    assert_int_equal(off->channels, 1);
    assert_true(off->pixels[7 * 20 + 13] == 0.5f && off->pixels[2 * 20 + 4] == 0.25f);
}

static void unlike_channels_and_nan(void **state) {
    OwnFolder *place = *state;
    Image *grey = ramp(place->arena, 4, 4, 1, 8), *rgb = ramp(place->arena, 4, 4, 3, 8);
    Image *rgba = ramp(place->arena, 4, 4, 4, 8);
    for (int i = 0; i < 16; i++)
        for (int c = 0; c < 4; c++) {
            if (c < 3)
                rgb->pixels[3 * i + c] = grey->pixels[i];
            rgba->pixels[4 * i + c] = c < 3 ? grey->pixels[i] : 1.0f;
        }
    assert_true(image_compare(grey, rgb, 1e-6, 1e-6).max == 0);
    assert_true(image_compare(rgba, grey, 1e-6, 1e-6).max == 0);
    rgba->pixels[4 * 5 + 3] = 0.75f;
    ImageDifference d = image_compare(rgba, rgb, 1e-6, 1e-6);
    assert_true(d.max == 0.25 && d.max_channel == 3 && d.failed == 1);

    // A NaN on one side is the largest difference, on both sides none.
    rgb->pixels[0] = NAN;
    d = image_compare(rgb, grey, 1e-6, 1e-6);
    assert_true(d.max == 1 && d.failed == 1 && isfinite(d.mean) && isfinite(d.rms));
    grey->pixels[0] = NAN;
    rgb->pixels[1] = rgb->pixels[2] = NAN;
    assert_true(image_compare(rgb, grey, 1e-6, 1e-6).max == 0);
}

typedef struct {
    Image *a, *b;
} Pair;

static void compare_body(void *arg) { image_compare(((Pair *)arg)->a, ((Pair *)arg)->b, 0, 0); }

static void unlike_sizes(void **state) {
    OwnFolder *place = *state;
    Pair pair = {ramp(place->arena, 20, 10, 3, 8), ramp(place->arena, 10, 20, 3, 8)};
    char *message = NULL;
    assert_false(diag_catch(compare_body, &pair, &message));
    assert_non_null(strstr(message, "20 x 10"));
    assert_non_null(strstr(message, "10 x 20"));
    free(message);
}

// From 0 to 1 the false colours grow lighter, step by step (CIE luminance).
static void false_colors_are_ordered(void **state) {
    OwnFolder *place = *state;
    Image *values = ramp(place->arena, 256, 1, 1, 8);
    Image *colors = image_false_color(place->arena, values);
    double before = -1;
    for (int i = 0; i < 256; i++) {
        double weights[3] = {0.2126, 0.7152, 0.0722}, light = 0;
        for (int c = 0; c < 3; c++) {
            assert_true(colors->pixels[3 * i + c] >= 0 && colors->pixels[3 * i + c] <= 1);
            light += weights[c] * (double)colors->pixels[3 * i + c];
        }
        assert_true(light >= before);
        before = light;
    }
    assert_true(before > 0.8);
}

static void png_in_memory(void **state) {
    OwnFolder *place = *state;
    Image *out = ramp(place->arena, 13, 7, 3, 8);
    size_t size;
    unsigned char *bytes = image_encode_png(place->arena, out, &size);
    FILE *f = fopen(own_path(place, "memory.png"), "wb");
    fwrite(bytes, 1, size, f);
    fclose(f);
    Image *back = image_read(place->arena, own_path(place, "memory.png"));
    for (int i = 0; i < 13 * 7 * 3; i++)
        assert_true(fabsf(back->pixels[i] - out->pixels[i]) < 1e-6f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        OWN_FOLDER_TEST(extensions),
        OWN_FOLDER_TEST(lossless_formats),
        OWN_FOLDER_TEST(float_formats),
        OWN_FOLDER_TEST(alpha_is_dropped_where_it_must),
        OWN_FOLDER_TEST(png_headers),
        OWN_FOLDER_TEST(same_bytes_twice),
        OWN_FOLDER_TEST(nothing_is_left_after_failure),
        OWN_FOLDER_TEST(full_disk),
        OWN_FOLDER_TEST(standard_output),
        OWN_FOLDER_TEST(unreadable_pictures),
        OWN_FOLDER_TEST(equal_pictures),
        OWN_FOLDER_TEST(figures_by_hand),
        OWN_FOLDER_TEST(unlike_channels_and_nan),
        OWN_FOLDER_TEST(unlike_sizes),
        OWN_FOLDER_TEST(false_colors_are_ordered),
        OWN_FOLDER_TEST(png_in_memory),
    };
    return cmocka_run_group_tests_name("image", tests, NULL, NULL);
}
