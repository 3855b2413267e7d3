// SPDX-License-Identifier: MIT
// GIF files by their palette and the places in it, which OpenImageIO does not give.
#ifndef IMAGE_GIF_H
#define IMAGE_GIF_H

#include "image/picture.h"

// The first picture of the file into out->places, palette and size. False: the file is no GIF, or
// not a whole one.
bool gif_read(Arena *arena, const char *path, StoredPicture *out);

#endif
