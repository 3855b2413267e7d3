// SPDX-License-Identifier: MIT
// Rows of stored values, as libpng wants them. Its errors come back by longjmp: what they jump over
// is one stack frame here, with nothing in it that has to be freed but libpng's own.
#include "image/png.h"

#include "image/stored.h"

#include <png.h>
#include <setjmp.h>
#include <string.h>

typedef struct {
    FILE *out;
    char *why;
    bool full; // out takes no more
} Writer;

static void on_error(png_structp png, png_const_charp message) {
    Writer *writer = png_get_error_ptr(png);
    if (!writer->full)
        snprintf(writer->why, OIIO_WHY, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static void put(png_structp png, png_bytep bytes, size_t size) {
    Writer *writer = png_get_io_ptr(png);
    if (fwrite(bytes, 1, size, writer->out) != size) {
        writer->full = true;
        png_error(png, "the file takes no more");
    }
}

static void flush(png_structp png) { (void)png; }

static void put_text(png_structp png, png_infop info, const char *key, const char *value) {
    char name[32], text[256];
    snprintf(name, sizeof name, "%s", key);
    snprintf(text, sizeof text, "%s", value);
    png_text entry = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = name, .text = text};
    png_set_text(png, info, &entry, 1);
}

static void put_header(png_structp png, png_infop info, const Image *image,
                       const ImageWriteOptions *options) {
    static const int types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                PNG_COLOR_TYPE_RGB_ALPHA};
    // A fifth of the time of zlib's usual level 6 with all of libpng's filters, and files of 0.8 to
    // 1.15 times the size.
    png_set_compression_level(png, 2);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height,
                 options->bits > 8 ? 16 : 8, types[image->channels - 1], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (options->srgb)
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    else if (options->gamma > 0.0)
        png_set_gAMA(png, info, 1.0 / options->gamma);
    if (options->software)
        put_text(png, info, "Software", options->software);
    if (options->comment)
        put_text(png, info, "Description", options->comment);
    png_write_info(png, info);
}

static void put_row(const float *in, size_t count, int bits, png_bytep row) {
    if (bits > 8) {
        for (size_t i = 0; i < count; i++) {
            unsigned value = image_stored(in[i], bits, 16);
            row[2 * i] = (png_byte)(value >> 8);
            row[2 * i + 1] = (png_byte)(value & 255u);
        }
    } else if (bits == 8) {
        // As image_stored does it, in a form that becomes vectors.
        for (size_t i = 0; i < count; i++) {
            float clipped = in[i] > 0.0f ? in[i] : 0.0f, scaled;
            scaled = (clipped < 1.0f ? clipped : 1.0f) * 255.0f;
            int k = (int)scaled;
            row[i] = (png_byte)(k + (scaled - (float)k >= 0.5f ? 1 : 0));
        }
    } else {
        for (size_t i = 0; i < count; i++)
            row[i] = (png_byte)image_stored(in[i], bits, 8);
    }
}

static bool write_all(png_structp png, png_infop info, const Image *image,
                      const ImageWriteOptions *options, png_bytep row) {
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    put_header(png, info, image, options);
    size_t count = (size_t)image->width * (size_t)image->channels;
    for (int y = 0; y < image->height; y++) {
        put_row(image->pixels + (size_t)y * count, count, options->bits, row);
        png_write_row(png, row);
    }
    png_write_end(png, info);
    return true;
}

bool png_encode(const Image *image, const ImageWriteOptions *options, FILE *out,
                char why[OIIO_WHY]) {
    Writer writer = {.out = out, .why = why};
    why[0] = '\0';
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_write_struct(&png, NULL);
        snprintf(why, OIIO_WHY, "out of memory");
        return false;
    }
    png_set_write_fn(png, &writer, put, flush);
    // libpng refuses more than a million pixels a side unless told.
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    Arena *scratch = arena_create();
    png_bytep row =
        ARENA_ARRAY(scratch, png_byte, (size_t)image->width * (size_t)image->channels * 2);
    bool ok = write_all(png, info, image, options, row);
    arena_destroy(scratch);
    png_destroy_write_struct(&png, &info);
    return ok;
}
