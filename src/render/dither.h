// SPDX-License-Identifier: MIT
// Dithering of files of whole numbers: what is lost by rounding one value is added to its
// neighbours, or a pattern is added before rounding. Pixels must come row by row, in the order of
// the file.
#ifndef RENDER_DITHER_H
#define RENDER_DITHER_H

#include "base/arena.h"
#include "options/options.h"

typedef struct Dither Dither;

enum { DITHER_CHANNELS = 4 };

// NULL if method is DITHER_NONE. Memory in arena.
Dither *dither_create(DitherMethod method, int width, Arena *arena);
// What is to be added to each channel of a pixel: in linear values, and in steps of the file right
// before rounding.
void dither_offsets(Dither *dither, int x, int y, float linear[DITHER_CHANNELS], float *steps);
// What was lost of each channel of the pixel that was asked about last, in linear values.
void dither_lost(Dither *dither, int x, const float lost[DITHER_CHANNELS]);

#endif
