// SPDX-License-Identifier: MIT
// The C side of pictures: formats by name, whole files, and the checks that come before a library
// sees anything.
#include "image/image.h"

#include "base/array.h"
#include "base/diag.h"
#include "base/file.h"
#include "image/oiio.h"
#include "image/png.h"
#include "image/stored.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <strings.h>

// ORDER image_format
static const struct {
    const char *extension, *also;
} formats[] = {
    {"png", NULL},   {"tga", NULL}, {"ppm", "pgm"}, {"bmp", NULL},
    {"jpg", "jpeg"}, {"exr", NULL}, {"hdr", NULL},  {"tif", "tiff"},
};

const char *image_extension(ImageFormat format) { return formats[format].extension; }

bool image_format_of(const char *path, ImageFormat *format) {
    const char *dot = strrchr(file_name(path), '.');
    if (!dot)
        return false;
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        if (strcasecmp(dot + 1, formats[i].extension) == 0 ||
            (formats[i].also && strcasecmp(dot + 1, formats[i].also) == 0)) {
            *format = (ImageFormat)i;
            return true;
        }
    }
    return false;
}

ImageWriteOptions image_write_options_default(void) {
    return (ImageWriteOptions){.format = IMAGE_PNG, .bits = 8, .gamma = 2.2, .srgb = true};
}

// Portable pixmap, or greymap: a line of text, then bytes, the high one first.
static bool write_ppm(const Image *image, const ImageWriteOptions *options, FILE *out) {
    int stored = options->bits > 8 ? 16 : 8, shown = image->channels >= 3 ? 3 : 1;
    fprintf(out, "P%c\n%d %d\n%d\n", shown == 3 ? '6' : '5', image->width, image->height,
            stored == 16 ? 65535 : 255);
    size_t pixels = (size_t)image->width * (size_t)image->height;
    const float *in = image->pixels;
    for (size_t i = 0; i < pixels; i++, in += image->channels) {
        for (int c = 0; c < shown; c++) {
            unsigned value = image_stored(in[c], options->bits, stored);
            if (stored == 16)
                putc((int)(value >> 8), out);
            putc((int)(value & 255u), out);
        }
    }
    return !ferror(out);
}

static bool encode(const Image *image, const ImageWriteOptions *options, FILE *out,
                   char why[OIIO_WHY]) {
    why[0] = '\0';
    switch (options->format) {
    case IMAGE_PNG:
        return png_encode(image, options, out, why);
    case IMAGE_PPM:
        return write_ppm(image, options, out);
    default:
        return oiio_library()->encode(image, options, out, why);
    }
}

// What goes into a file: a picture, or layers.
typedef struct {
    const Image *image;
    const ImageWriteOptions *options;
    const ImageLayers *layers; // NULL: the picture
} Content;

static bool encode_content(const Content *c, FILE *out, char why[OIIO_WHY]) {
    if (!c->layers)
        return encode(c->image, c->options, out, why);
    why[0] = '\0';
    return oiio_library()->encode_layers(c->layers, c->options->software, out, why);
}

static void write_content(const char *path, const Content *content) {
    char why[OIIO_WHY];
    if (strcmp(path, "-") == 0) {
        bool ok = encode_content(content, stdout, why);
        if (!ok || fflush(stdout) != 0)
            die("cannot write the picture to standard output: %s",
                !ok && why[0] ? why : strerror(errno));
        return;
    }
    OutputFile *out = file_begin(path);
    errno = 0;
    if (!encode_content(content, file_stream(out), why)) {
        int error = errno;
        file_abandon(out);
        die("cannot write '%s': %s", path, why[0] ? why : strerror(error));
    }
    file_commit(out);
}

void image_write(const char *path, const Image *image, const ImageWriteOptions *options) {
    const Content content = {image, options, NULL};
    write_content(path, &content);
}

void image_write_layers(const char *path, const ImageLayers *layers, const char *software) {
    const ImageWriteOptions options = {.software = software};
    const Content content = {NULL, &options, layers};
    write_content(path, &content);
}

// The most pixels a picture to be read may have: 2^28, 16,384 x 16,384. A header of a few bytes can
// claim much more, and the memory would be asked for before the lie is found.
static const double MOST_PIXELS = 268435456.0;

Image *image_read(Arena *arena, const char *path) {
    char why[OIIO_WHY];
    if (!file_exists(path))
        die("cannot read '%s': no such file, or not readable", path);
    int width, height, channels, bits;
    OiioReader *reader = oiio_library()->open(path, &width, &height, &channels, &bits, why);
    if (!reader)
        die("cannot read '%s': %s", path, why);
    if (width < 1 || height < 1 || channels < 1 || (double)width * height > MOST_PIXELS) {
        oiio_library()->close(reader);
        die("cannot read '%s': %d x %d pixels, %d channels", path, width, height, channels);
    }
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){
        .width = width, .height = height, .channels = channels < 4 ? channels : 4, .bits = bits};
    image->pixels =
        ARENA_ARRAY(arena, float, (size_t)width *(size_t)height *(size_t)image->channels);
    if (!oiio_library()->read(reader, image->channels, image->pixels, why))
        die("cannot read '%s': %s", path, why);
    return image;
}

// Channel c (0..3: red, green, blue, alpha) of a pixel with `channels` values.
static float channel_of(const float *pixel, int channels, int c) {
    if (channels <= 2)
        return c < 3 ? pixel[0] : channels == 2 ? pixel[1] : 1.0f;
    return c < channels ? pixel[c] : 1.0f;
}

// Both pictures brought to the same number of channels; a NaN or infinity in one only, or in both
// but not alike, becomes a difference of 1.
static void make_alike(Arena *arena, const Image *a, const Image *b, Image *out_a, Image *out_b) {
    bool alpha = a->channels % 2 == 0 || b->channels % 2 == 0;
    bool colour = a->channels > 2 || b->channels > 2;
    int channels = !colour && !alpha ? 1 : alpha ? 4 : 3;
    size_t pixels = (size_t)a->width * (size_t)a->height;
    *out_a = *a;
    *out_b = *b;
    out_a->channels = out_b->channels = channels;
    out_a->pixels = ARENA_ARRAY(arena, float, pixels *(size_t)channels);
    out_b->pixels = ARENA_ARRAY(arena, float, pixels *(size_t)channels);
    for (size_t i = 0; i < pixels; i++) {
        for (int c = 0; c < channels; c++) {
            float x = channel_of(a->pixels + i * (size_t)a->channels, a->channels, c);
            float y = channel_of(b->pixels + i * (size_t)b->channels, b->channels, c);
            if (!isfinite(x) || !isfinite(y)) {
                bool same = (isnan(x) && isnan(y)) || x == y;
                x = same ? 0.0f : 1.0f;
                y = 0.0f;
            }
            out_a->pixels[i * (size_t)channels + (size_t)c] = x;
            out_b->pixels[i * (size_t)channels + (size_t)c] = y;
        }
    }
}

static void require_same_size(const Image *a, const Image *b) {
    if (a->width != b->width || a->height != b->height)
        die("the pictures have different sizes: %d x %d and %d x %d", a->width, a->height, b->width,
            b->height);
}

Image *image_difference(Arena *arena, const Image *a, const Image *b) {
    require_same_size(a, b);
    Arena *scratch = arena_create();
    Image one, two;
    make_alike(scratch, a, b, &one, &two);
    size_t pixels = (size_t)a->width * (size_t)a->height;
    Image *out = ARENA_NEW(arena, Image);
    *out = (Image){.width = a->width, .height = a->height, .channels = 1, .bits = 32};
    out->pixels = ARENA_ARRAY(arena, float, pixels);
    for (size_t i = 0; i < pixels; i++) {
        for (int c = 0; c < one.channels; c++) {
            size_t at = i * (size_t)one.channels + (size_t)c;
            float off = fabsf(one.pixels[at] - two.pixels[at]);
            if (off > out->pixels[i])
                out->pixels[i] = off;
        }
    }
    arena_destroy(scratch);
    return out;
}

Image *image_cut(Arena *arena, const Image *image, int left, int top, int width, int height) {
    Image *cut = ARENA_NEW(arena, Image);
    *cut = *image;
    cut->width = width < image->width - left ? width : image->width - left;
    cut->height = height < image->height - top ? height : image->height - top;
    size_t channels = (size_t)image->channels, row = (size_t)cut->width * channels;
    cut->pixels = ARENA_ARRAY(arena, float, row *(size_t)cut->height);
    for (int j = 0; j < cut->height; j++) {
        size_t from = ((size_t)(top + j) * (size_t)image->width + (size_t)left) * channels;
        memcpy(cut->pixels + (size_t)j * row, image->pixels + from, row * sizeof(float));
    }
    return cut;
}

ImageDifference image_compare(const Image *a, const Image *b, double fail, double warn) {
    require_same_size(a, b);
    Arena *scratch = arena_create();
    Image one, two;
    make_alike(scratch, a, b, &one, &two);
    ImageDifference result = {.pixels = (uint64_t)a->width * (uint64_t)a->height};
    char why[OIIO_WHY];
    bool ok = oiio_library()->compare(&one, &two, fail, warn, &result, why);

    // One step of 8 bits is 1/255; values read from files carry the rounding of a float.
    const float step = 1.0f / 255.0f * (1.0f + 1e-4f);
    const Image *off = image_difference(scratch, &one, &two);
    for (uint64_t i = 0; i < result.pixels; i++)
        result.different += off->pixels[i] > step;
    arena_destroy(scratch);
    if (!ok)
        die("cannot compare the pictures: %s", why);
    return result;
}

Image *image_false_color(Arena *arena, const Image *values) {
    Image *colors = ARENA_NEW(arena, Image);
    *colors = (Image){.width = values->width, .height = values->height, .channels = 3, .bits = 32};
    colors->pixels = ARENA_ARRAY(arena, float, (size_t)values->width *(size_t)values->height * 3);
    char why[OIIO_WHY];
    if (!oiio_library()->false_color(values, colors, why))
        die("cannot colour the differences: %s", why);
    return colors;
}

unsigned char *image_encode_png(Arena *arena, const Image *image, size_t *size) {
    char *bytes = NULL, why[OIIO_WHY];
    FILE *out = open_memstream(&bytes, size);
    if (!out)
        die("out of memory");
    const ImageWriteOptions options = image_write_options_default();
    bool ok = png_encode(image, &options, out, why);
    ok = fclose(out) == 0 && ok;
    unsigned char *copy = ok ? arena_copy(arena, bytes, *size) : NULL;
    array_release(bytes);
    if (!ok)
        die("cannot encode a picture: %s", why[0] ? why : "out of memory");
    return copy;
}
