// SPDX-License-Identifier: MIT
// PNG by libpng, row by row. Its errors come back by longjmp: what they jump over is one frame
// here, with nothing in it that has to be freed but libpng's own.
#include "image/png_read.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

// A picture may have so many pixels. Its values take 16 bytes each at most.
static const uint64_t MOST_PIXELS = 1u << 28;

static void on_error(png_structp png, png_const_charp message) {
    snprintf(png_get_error_ptr(png), OIIO_WHY, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static void read_encoding(png_structp png, png_infop info, StoredPicture *picture) {
    double gamma;
    if (png_get_valid(png, info, PNG_INFO_sRGB)) {
        picture->encoding = ENCODING_SRGB;
    } else if (png_get_gAMA(png, info, &gamma)) {
        picture->encoding = ENCODING_POWER;
        picture->gamma = (float)gamma;
    }
}

// The colours of a palette, or the levels of a grey picture of up to 8 bits as one.
static void read_palette(png_structp png, png_infop info, StoredPicture *picture, bool grey) {
    png_colorp colors = NULL;
    png_bytep alphas = NULL;
    int count = 1 << png_get_bit_depth(png, info), alpha_count = 0;
    if (!grey)
        png_get_PLTE(png, info, &colors, &count);
    // The transparent level of a grey picture is no list of alphas: POV-Ray takes none from it.
    if (!grey && png_get_tRNS(png, info, &alphas, &alpha_count, NULL) == 0)
        alpha_count = 0;
    picture->grey_palette = grey;
    picture->palette_size = count;
    picture->channels = alpha_count > 0 ? 4 : 3;
    for (int i = 0; i < count; i++) {
        uint8_t *entry = picture->palette[i];
        uint8_t level = (uint8_t)(i * 255 / (count - 1 > 0 ? count - 1 : 1));
        entry[0] = grey ? level : colors[i].red;
        entry[1] = grey ? level : colors[i].green;
        entry[2] = grey ? level : colors[i].blue;
        entry[3] = i < alpha_count ? alphas[i] : 255;
    }
    png_set_packing(png);
}

static void keep_row(StoredPicture *picture, size_t row, const png_byte *bytes) {
    size_t count = (size_t)picture->width;
    if (picture->palette_size > 0) {
        uint8_t *places = picture->places + row * count;
        for (size_t i = 0; i < count; i++) {
            int last = picture->palette_size - 1;
            places[i] = bytes[i] > last ? (uint8_t)last : bytes[i];
        }
        return;
    }
    count *= (size_t)picture->channels;
    float *values = picture->values + row * count;
    for (size_t i = 0; i < count; i++)
        values[i] = picture->bits == 8 ? (float)bytes[i] / 255.0f
                                       : (float)(bytes[2 * i] << 8 | bytes[2 * i + 1]) / 65535.0f;
}

static void read_rows(png_structp png, Arena *arena, StoredPicture *picture, size_t row_bytes) {
    size_t rows = (size_t)picture->height, pixels = (size_t)picture->width * rows;
    if (picture->palette_size > 0)
        picture->places = ARENA_ARRAY(arena, uint8_t, pixels);
    else
        picture->values = ARENA_ARRAY(arena, float, pixels *(size_t)picture->channels);
    png_byte *bytes = ARENA_ARRAY(arena, png_byte, row_bytes * rows);
    png_bytepp pointers = ARENA_ARRAY(arena, png_bytep, rows);
    for (size_t i = 0; i < rows; i++)
        pointers[i] = bytes + i * row_bytes;
    png_read_image(png, pointers);
    for (size_t i = 0; i < rows; i++)
        keep_row(picture, i, pointers[i]);
}

static void read_all(png_structp png, png_infop info, Arena *arena, StoredPicture *picture) {
    png_read_info(png, info);
    png_uint_32 width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    if ((uint64_t)width * height > MOST_PIXELS)
        png_error(png, "the picture is too large");
    int type = png_get_color_type(png, info), depth = png_get_bit_depth(png, info);
    *picture = (StoredPicture){.width = (int)width, .height = (int)height};
    picture->bits = depth > 8 ? 16 : 8;
    picture->channels = png_get_channels(png, info);
    read_encoding(png, info, picture);
    bool grey = type == PNG_COLOR_TYPE_GRAY && depth <= 8;
    if (grey || type == PNG_COLOR_TYPE_PALETTE)
        read_palette(png, info, picture, grey);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    read_rows(png, arena, picture, png_get_rowbytes(png, info));
}

bool png_read_picture(Arena *arena, const char *path, StoredPicture *picture, char why[OIIO_WHY]) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        snprintf(why, OIIO_WHY, "%s", strerror(errno));
        return false;
    }
    why[0] = '\0';
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, why, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool good = false;
    if (info != NULL && setjmp(png_jmpbuf(png)) == 0) {
        png_init_io(png, file);
        read_all(png, info, arena, picture);
        good = true;
    }
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    return good;
}
