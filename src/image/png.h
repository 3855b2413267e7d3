// SPDX-License-Identifier: MIT
// PNG files, written by libpng itself: it loads in no time, OpenImageIO does not (oiio.h).
#ifndef IMAGE_PNG_H
#define IMAGE_PNG_H

#include "image/oiio.h"

// Encodes the picture and writes the bytes to out. False also when out does not take them; then
// errno says why and `why` is empty.
bool png_encode(const Image *image, const ImageWriteOptions *options, FILE *out,
                char why[OIIO_WHY]);

#endif
