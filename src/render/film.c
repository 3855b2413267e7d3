// SPDX-License-Identifier: MIT
// Colours arrive premultiplied by their opacity. Files of whole numbers keep alpha apart, so the
// colour is divided by it; where the colour is brighter than its opacity allows, the opacity is
// raised first. Everything in float: 16-bit files show the difference.
#include "render/film.h"

#include <math.h>
#include <string.h>

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

static float clipped(float x) { return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f; } // NaN: 0

static float quantise(const Film *film, float x) {
    float most = (float)((1 << film->bits) - 1);
    return floorf(clipped(x) * most + 0.5f) / most;
}

// ---- table --------------------------------------------------------------------------------------

// The curve and the rounding are a staircase: step k begins at edge[k]. Positive floats sort as
// their bits do, so the upper bits lead to the step at the beginning of a short run of floats.
enum { TABLE_BITS = 8, SHIFT = 15, ONE = 0x3f800000, RUNS = (ONE >> SHIFT) + 1 };

typedef struct FilmTable {
    float edge[(1 << TABLE_BITS) + 1]; // the last one: never reached
    float value[1 << TABLE_BITS];
    uint8_t step[RUNS];
} FilmTable;

static uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static float float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static float encode_and_round(const Film *film, float x) {
    return quantise(film, transfer_apply(&film->transfer, x));
}

// The least positive float (as bits) whose value is at least that of step k; 1 has the highest.
static uint32_t first_of_step(const Film *film, int k) {
    float most = (float)((1 << film->bits) - 1), value = (float)k / most;
    uint32_t low = 0, high = ONE;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (encode_and_round(film, float_of(middle)) >= value)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

void film_prepare(Film *film, Arena *arena) {
    int steps = 1 << film->bits;
    if (film->floats || film->bits > TABLE_BITS || encode_and_round(film, 0.0f) > 0.0f ||
        encode_and_round(film, 1.0f) < 1.0f)
        return;
    FilmTable *table = ARENA_NEW(arena, FilmTable);
    for (int k = 0; k < steps; k++)
        table->edge[k] = float_of(first_of_step(film, k));
    for (int k = 0; k < steps; k++)
        table->value[k] = (float)k / (float)(steps - 1);
    table->edge[steps] = INFINITY;
    int k = 0;
    for (uint32_t run = 0; run < RUNS; run++) {
        while (float_of(run << SHIFT) >= table->edge[k + 1])
            k++;
        table->step[run] = (uint8_t)k;
    }
    film->table = table;
}

static inline float look_up(const FilmTable *table, float x) {
    if (!(x > 0.0f)) // NaN: 0
        return 0.0f;
    if (x >= 1.0f)
        return 1.0f;
    int k = table->step[bits_of(x) >> SHIFT];
    while (x >= table->edge[k + 1])
        k++;
    return table->value[k];
}

static float develop_channel(const Film *film, float x) {
    if (film->floats)
        return transfer_apply(&film->transfer, x);
    return film->table ? look_up(film->table, x) : encode_and_round(film, x);
}

// The linear values of a pixel's channels, as they are to be encoded. The last one is its opacity,
// if the film has it.
static void separate(const Film *film, Color color, float channel[4]) {
    Rgb c = color_rgb(color);
    int count = film->grayscale ? 1 : 3;
    float grey = grey_of(c);
    channel[0] = film->grayscale ? grey : c.r;
    channel[1] = c.g;
    channel[2] = c.b;
    if (!film->alpha)
        return;
    float alpha = 1.0f - color.transmit;
    if (!film->floats) {
        if (grey > alpha)
            alpha = grey < 1.0f ? grey : 1.0f;
        for (int i = 0; i < count; i++)
            channel[i] /= alpha != 0.0f ? alpha : LEAST_ALPHA;
    }
    channel[count] = alpha;
}

void film_develop(const Film *film, Color color, float *values) {
    if (film->table && !film->grayscale && !film->alpha) { // nothing to separate
        values[0] = look_up(film->table, color.r);
        values[1] = look_up(film->table, color.g);
        values[2] = look_up(film->table, color.b);
        return;
    }
    float channel[4];
    int count = film->grayscale ? 1 : 3;
    separate(film, color, channel);
    for (int i = 0; i < count; i++)
        values[i] = develop_channel(film, channel[i]);
    if (film->alpha)
        values[count] = film->floats ? channel[count] : quantise(film, channel[count]);
}

void film_develop_dithered(const Film *film, Dither *dither, int x, int y, Color color,
                           float *values) {
    float channel[4], offset[DITHER_CHANNELS], lost[DITHER_CHANNELS] = {0}, steps;
    int count = film_channels(film), colors = film->grayscale ? 1 : 3;
    separate(film, color, channel);
    dither_offsets(dither, x, y, offset, &steps);
    steps /= (float)((1 << film->bits) - 1);
    for (int i = 0; i < count; i++) {
        float wanted = channel[i] + offset[i];
        if (i < colors) {
            values[i] = quantise(film, transfer_apply(&film->transfer, wanted) + steps);
            lost[i] = clipped(wanted) - transfer_undo(&film->transfer, values[i]);
        } else {
            values[i] = quantise(film, wanted + steps);
            lost[i] = clipped(wanted) - values[i];
        }
    }
    dither_lost(dither, x, lost);
}
