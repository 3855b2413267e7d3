// SPDX-License-Identifier: MIT
// What image.c needs of OpenImageIO, in C terms. Nothing here ends the program: failure is false
// and a reason in `why`, so that no C++ object is ever jumped over.
#ifndef IMAGE_OIIO_H
#define IMAGE_OIIO_H

#include "image/image.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#define OIIO_BORDER noexcept
#else
#define OIIO_BORDER
#endif

enum { OIIO_WHY = 256 };

// The stored value, in `stored` bits, of k / (2^bits - 1): its bits from the top, repeated
// downwards. Clipped to 0..1; NaN is 0. (image.c)
unsigned image_stored(float value, int bits, int stored) OIIO_BORDER;

// Encodes the picture in memory and writes the bytes to out. False also when out does not take
// them; then errno says why and `why` is empty.
bool oiio_encode(const Image *image, const ImageWriteOptions *options, FILE *out,
                 char why[OIIO_WHY]) OIIO_BORDER;

// A picture being read: the header first, so that the caller can make room.
typedef struct OiioReader OiioReader;
OiioReader *oiio_open(const char *path, int *width, int *height, int *channels, int *bits,
                      char why[OIIO_WHY]) OIIO_BORDER; // NULL: why says
// The first `channels` channels of every pixel, then closes in any case.
bool oiio_read(OiioReader *reader, int channels, float *pixels, char why[OIIO_WHY]) OIIO_BORDER;
void oiio_close(OiioReader *reader) OIIO_BORDER;

// Fills all but `different`. The pictures have the same size and number of channels.
bool oiio_compare(const Image *a, const Image *b, double fail, double warn, ImageDifference *result,
                  char why[OIIO_WHY]) OIIO_BORDER;
// One channel of values to three of colour.
bool oiio_false_color(const Image *values, Image *colors, char why[OIIO_WHY]) OIIO_BORDER;

#ifdef __cplusplus
}
#endif

#endif
