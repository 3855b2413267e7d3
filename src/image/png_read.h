// SPDX-License-Identifier: MIT
// Inside the room: PNG files with their palettes, which OpenImageIO does not give.
#ifndef IMAGE_PNG_READ_H
#define IMAGE_PNG_READ_H

#include "image/oiio.h"
#include "image/picture.h"

// False: why says what is wrong.
bool png_read_picture(Arena *arena, const char *path, StoredPicture *picture, char why[OIIO_WHY]);

#endif
