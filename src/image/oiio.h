// SPDX-License-Identifier: MIT
// What image.c needs of OpenImageIO, in C terms. Nothing here ends the program: failure is false
// and a reason in `why`, so that no C++ object is ever jumped over.
//
// OpenImageIO and what it links to are some 250 libraries, and the linker needs 0.25 s to bring
// them in: as long as many a picture takes. So image_oiio.cpp is a library of its own, loaded by
// oiio_library.c when something is first read, compared or written in a format other than PNG and
// PPM.
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

// A picture being read: the header first, so that the caller can make room.
typedef struct OiioReader OiioReader;

typedef struct {
    // Encodes the picture in memory and writes the bytes to out. False also when out does not take
    // them; then errno says why and `why` is empty.
    bool (*encode)(const Image *image, const ImageWriteOptions *options, FILE *out,
                   char why[OIIO_WHY]) OIIO_BORDER;

    bool (*encode_layers)(const ImageLayers *layers, const char *software, FILE *out,
                          char why[OIIO_WHY]) OIIO_BORDER; // likewise, EXR

    OiioReader *(*open)(const char *path, int *width, int *height, int *channels, int *bits,
                        char why[OIIO_WHY])OIIO_BORDER; // NULL: why says
    // The first `channels` channels of every pixel, then closes in any case.
    bool (*read)(OiioReader *reader, int channels, float *pixels, char why[OIIO_WHY]) OIIO_BORDER;
    void (*close)(OiioReader *reader) OIIO_BORDER;

    // Fills all but `different`. The pictures have the same size and number of channels.
    bool (*compare)(const Image *a, const Image *b, double fail, double warn,
                    ImageDifference *result, char why[OIIO_WHY]) OIIO_BORDER;
    // One channel of values to three of colour.
    bool (*false_color)(const Image *values, Image *colors, char why[OIIO_WHY]) OIIO_BORDER;
} OiioTable;

extern const OiioTable oiio_table; // in the library
#define OIIO_TABLE_NAME "oiio_table"

#ifdef __cplusplus
}
#else
// Loads the library at the first call; dies when it cannot be had. Any thread.
const OiioTable *oiio_library(void);
#endif

#endif
