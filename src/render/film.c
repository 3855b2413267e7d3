// SPDX-License-Identifier: MIT
// Colours arrive premultiplied by their opacity. Files of whole numbers keep alpha apart, so the
// colour is divided by it; where the colour is brighter than its opacity allows, the opacity is
// raised first. Everything in float: 16-bit files show the difference.
#include "render/film.h"

#include <math.h>

static const float LEAST_ALPHA = 1.0e-6f; // stands in for an alpha of 0 in the division

Film film_create(const Settings *settings, ImageFormat format, int bits, bool grayscale, bool alpha,
                 double file_gamma) {
    Film film = {.bits = grayscale ? 16 : bits, .grayscale = grayscale, .alpha = alpha};
    film.floats = format == IMAGE_EXR || format == IMAGE_HDR;
    Curve working = curve_working(settings), file;
    if (film.floats) {
        file = curve_power(1.0f);
        film.header_gamma = 1.0;
    } else {
        file = file_gamma > 0.0 ? curve_power((float)file_gamma) : curve_srgb();
        film.header_srgb = file.type == CURVE_SRGB;
        film.header_gamma = film.header_srgb ? 2.2 : file_gamma;
    }
    // Without an assumed gamma, old scenes are written as they are, whatever the header says.
    film.transfer = transfer_between(working, settings->gamma_mode == GAMMA_NONE ? working : file);
    return film;
}

int film_channels(const Film *film) { return (film->grayscale ? 1 : 3) + (film->alpha ? 1 : 0); }

// POV-Ray's luminance as its picture files have it: in float throughout, unlike rgb_grey().
static float grey_of(Rgb c) { return 0.297f * c.r + 0.589f * c.g + 0.114f * c.b; }

static float quantise(const Film *film, float x) {
    float most = (float)((1 << film->bits) - 1);
    float clipped = x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f; // NaN: 0
    return floorf(clipped * most + 0.5f) / most;
}

void film_develop(const Film *film, Color color, float *values) {
    Rgb c = color_rgb(color);
    int count = film->grayscale ? 1 : 3;
    float channel[3] = {c.r, c.g, c.b}, grey = grey_of(c);
    if (film->grayscale)
        channel[0] = grey;

    float alpha = film->alpha ? 1.0f - color.transmit : 1.0f;
    if (film->alpha && !film->floats) {
        if (grey > alpha)
            alpha = grey < 1.0f ? grey : 1.0f;
        for (int i = 0; i < count; i++)
            channel[i] /= alpha != 0.0f ? alpha : LEAST_ALPHA;
    }
    for (int i = 0; i < count; i++) {
        float encoded = transfer_apply(&film->transfer, channel[i]);
        values[i] = film->floats ? encoded : quantise(film, encoded);
    }
    if (film->alpha)
        values[count] = film->floats ? alpha : quantise(film, alpha);
}
