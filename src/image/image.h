// SPDX-License-Identifier: MIT
// Pictures in and out through OpenImageIO: the only C++ of the project is behind this header.
#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include "base/arena.h"

#include <stdbool.h>
#include <stdint.h>

// Rows from the top, `channels` floats a pixel, as decoded by OpenImageIO (no colour conversion).
typedef struct {
    int width, height, channels; // 1 grey, 3 RGB, 4 RGBA
    int bits;                    // per channel in the file read: 8, 16, 32 (float)
    float *pixels;
} Image;

// ORDER image_format: POV-Ray's letters for +F
typedef enum {
    IMAGE_PNG,  // N
    IMAGE_TGA,  // T, C (compressed)
    IMAGE_PPM,  // P
    IMAGE_BMP,  // B
    IMAGE_JPEG, // J
    IMAGE_EXR,  // E
    IMAGE_HDR,  // H
    IMAGE_TIFF, // by extension only
} ImageFormat;

const char *image_extension(ImageFormat format);             // "png", ...
bool image_format_of(const char *path, ImageFormat *format); // by extension; false: unknown

typedef struct {
    ImageFormat format;
    int bits; // 1..16, per channel; stored as 8 or 16 (float formats ignore it)
    bool grayscale;
    bool compressed; // TGA
    double gamma; // for the header: 2.2 sRGB is written as sRGB chunk; 1.0 linear; 0: say nothing
    const char *software, *comment; // metadata, may be NULL
} ImageWriteOptions;

// Integer formats: pixels are values 0..1 already encoded and quantised by the caller (k / (2^bits
// - 1)); written without change. Float formats: linear values. "-" writes to standard output. Dies
// with a message on failure; the file appears whole or not at all.
void image_write(const char *path, const Image *image, const ImageWriteOptions *options);
// Dies with a message when the file cannot be read.
Image *image_read(Arena *arena, const char *path);

// Comparison by OpenImageIO's compare(): differences in units of 1 = full range, over all channels.
typedef struct {
    double mean, rms, psnr, max;
    int max_x, max_y, max_channel;
    uint64_t warned, failed; // pixels over the two limits
    uint64_t different;      // pixels off by more than one step of 8 bits in some channel
} ImageDifference;
// Sizes must be equal (dies if not). fail, warn: limits on the absolute difference.
ImageDifference image_compare(const Image *a, const Image *b, double fail, double warn);

// A picture as PNG bytes in memory (8 bits), for data: URLs.
unsigned char *image_encode_png(Arena *arena, const Image *image, size_t *size);

#endif
