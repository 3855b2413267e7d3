// SPDX-License-Identifier: MIT
// From the colours of the shading to the values of a file: transfer curve, alpha, rounding (facts:
// rendering 3.2, 3.4).
#ifndef RENDER_FILM_H
#define RENDER_FILM_H

#include "image/image.h"
#include "model/scene.h"
#include "render/dither.h"
#include "render/gamma.h"

typedef struct {
    Transfer transfer; // working space to the file's
    bool floats;       // EXR, HDR: linear, premultiplied, neither clipped nor rounded
    int bits;          // 1..16
    bool grayscale;
    bool alpha;
    const struct FilmTable *table; // of film_prepare
    double header_gamma;           // for ImageWriteOptions: 0 unknown
    bool header_srgb;
} Film;

// file_gamma 0 is the sRGB curve. grayscale takes 16 bits whatever bits says, as in POV-Ray.
Film film_create(const Settings *settings, ImageFormat format, int bits, bool grayscale, bool alpha,
                 double file_gamma);
// Makes the same values come faster, for files of up to 8 bits; the film uses arena from then on.
void film_prepare(Film *film, Arena *arena);
int film_channels(const Film *film); // 1 to 4
// One pixel: film_channels() values k / (2^bits - 1), or linear floats.
void film_develop(const Film *film, Color color, float *values);
// The same of one pixel of a file of whole numbers with dithering: those of a row from left to
// right, and the rows in the order of the file.
void film_develop_dithered(const Film *film, Dither *dither, int x, int y, Color color,
                           float *values);

#endif
