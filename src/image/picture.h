// SPDX-License-Identifier: MIT
// Pictures that a scene lays on its surfaces: their raw values, and what the file says of them.
#ifndef IMAGE_PICTURE_H
#define IMAGE_PICTURE_H

#include "image/image.h"

typedef enum { ENCODING_UNSAID, ENCODING_SRGB, ENCODING_POWER } PictureEncoding;

typedef struct {
    int width, height;
    int channels;    // 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; with a palette: 3 or 4
    int bits;        // per channel: 8, 16, 32 (float)
    float *values;   // rows from the top; as stored, alpha not multiplied in (float files: as they
                     // are); NULL with a palette
    uint8_t *places; // with a palette: of every pixel
    uint8_t palette[256][4];
    int palette_size;  // 0: none
    bool grey_palette; // a grey PNG of up to 8 bits: the places are its levels
    PictureEncoding encoding;
    float gamma; // ENCODING_POWER: of the file's values, 0.45 for a display's
} StoredPicture;

// Dies with a message when the file cannot be read. png: the file is one, whatever its name.
StoredPicture *picture_read(Arena *arena, const char *path, bool png);

#endif
