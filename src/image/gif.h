// SPDX-License-Identifier: MIT
// GIF files by the indices into their palette, which OpenImageIO does not give.
#ifndef IMAGE_GIF_H
#define IMAGE_GIF_H

#include "base/arena.h"

#include <stdint.h>

// The indices of the first picture, rows from the top; NULL: the file is no GIF, or not a whole
// one.
uint8_t *gif_read(Arena *arena, const char *path, int *width, int *height);

#endif
