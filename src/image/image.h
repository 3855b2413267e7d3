// SPDX-License-Identifier: MIT
// Pictures in and out through OpenImageIO: the only C++ of the project is behind this header.
#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include "base/arena.h"

#include <stdbool.h>
#include <stdint.h>

// Rows from the top, `channels` floats a pixel, as decoded by OpenImageIO (no colour conversion).
typedef struct {
    int width, height, channels; // 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
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
    int bits;        // 1..16, per channel; stored as 8 or 16 (float formats ignore it)
    bool compressed; // TGA
    double gamma;    // for the header: what the pixels are encoded with; 0: say nothing
    bool srgb;       // for the header: the sRGB curve, whatever gamma says
    const char *software, *comment; // metadata, may be NULL
} ImageWriteOptions;

ImageWriteOptions image_write_options_default(void); // PNG, 8 bits, sRGB

// Integer formats: pixels are values 0..1 already encoded and quantised by the caller (k / (2^bits
// - 1)); written without change (odd numbers of bits are spread over 8 or 16 by repeating the upper
// bits, as POV-Ray does). Alpha is not multiplied in. Float formats: linear values, premultiplied.
// "-" writes to standard output. Dies with a message on failure; the file appears whole or not at
// all.
void image_write(const char *path, const Image *image, const ImageWriteOptions *options);
// Any number of named channels, as floats: an EXR file of 32 bits. Dies and appears as image_write.
typedef struct {
    int width, height, channels;
    const char *const *names; // "Z", "N.X", ...
    float *pixels;            // row by row, channels together
} ImageLayers;
void image_write_layers(const char *path, const ImageLayers *layers, const char *software);
// Dies with a message when the file cannot be read. More than four channels: the first four.
Image *image_read(Arena *arena, const char *path);

// Comparison by OpenImageIO's compare(): differences in units of 1 = full range, over all channels.
typedef struct {
    double mean, rms, psnr, max; // psnr is infinite for equal pictures
    int max_x, max_y, max_channel;
    uint64_t warned, failed; // pixels over the two limits
    uint64_t different;      // pixels off by more than one step of 8 bits in some channel
    uint64_t pixels;
    // Pixels in which an eye would see it: Hector Yee's metric as OpenImageIO has it, values taken
    // for sRGB (32 bits: for linear). -1: not known (grey pictures, pictures of a few pixels).
    int64_t perceptible;
} ImageDifference;
// Sizes must be equal (dies if not). fail, warn: limits on the absolute difference. A grey picture
// counts as three equal channels, a missing alpha as 1. A NaN in one picture only is a difference
// of 1.
ImageDifference image_compare(const Image *a, const Image *b, double fail, double warn);

// The part from column left and row top; as much of it as there is.
Image *image_cut(Arena *arena, const Image *image, int left, int top, int width, int height);

// The largest difference over the channels of each pixel, as a picture of one channel.
Image *image_difference(Arena *arena, const Image *a, const Image *b);
// False colours for values 0..1 of a one-channel picture: black over violet and orange to pale
// yellow, each step lighter than the one before. Linear values, 32 bits.
Image *image_false_color(Arena *arena, const Image *values);

// A picture as PNG bytes in memory (8 bits), for data: URLs.
unsigned char *image_encode_png(Arena *arena, const Image *image, size_t *size);

#endif
