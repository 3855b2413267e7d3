// SPDX-License-Identifier: MIT
// POV-Ray's methods with its own oddities, so that files agree: diffusion in one direction goes on
// from the end of a row to the beginning of the next, and the first pixel of a row still takes its
// share from the row before the last one, since the rows change places only behind it.
#include "render/dither.h"

#include <string.h>

typedef struct {
    float c[DITHER_CHANNELS];
} Share;

struct Dither {
    DitherMethod method;
    int width;
    Share carried;      // DITHER_D1
    Share *now, *below; // of this row and of the next, one pixel wider at each side
};

// Thresholds from 1 to the square of the side, by column and row.
static const uint8_t bayer_2[2][2] = {{1, 3}, {4, 2}};
static const uint8_t bayer_3[3][3] = {{3, 7, 4}, {6, 1, 9}, {2, 8, 5}};
static const uint8_t bayer_4[4][4] = {
    {1, 9, 3, 11}, {13, 5, 15, 7}, {4, 12, 2, 10}, {16, 8, 14, 6}};

Dither *dither_create(DitherMethod method, int width, Arena *arena) {
    if (method == DITHER_NONE)
        return NULL;
    Dither *d = ARENA_NEW(arena, Dither);
    *d = (Dither){.method = method, .width = width};
    if (method == DITHER_D2 || method == DITHER_FS) {
        d->now = ARENA_ARRAY(arena, Share, (size_t)width + 2);
        d->below = ARENA_ARRAY(arena, Share, (size_t)width + 2);
    }
    return d;
}

static float bayer(DitherMethod method, unsigned x, unsigned y) {
    switch (method) {
    case DITHER_B2:
        return (float)(bayer_2[x % 2][y % 2] / 4.0 - 0.5);
    case DITHER_B3:
        return (float)(bayer_3[x % 3][y % 3] / 9.0 - 0.5);
    default:
        return (float)(bayer_4[x % 4][y % 4] / 16.0 - 0.5);
    }
}

void dither_offsets(Dither *d, int x, int y, float linear[DITHER_CHANNELS], float *steps) {
    Share share = {0};
    *steps = 0.0f;
    switch (d->method) {
    case DITHER_D1:
        share = d->carried;
        break;
    case DITHER_D2:
    case DITHER_FS:
        share = d->now[x + 1];
        break;
    default:
        *steps = bayer(d->method, (unsigned)x, (unsigned)y);
    }
    memcpy(linear, share.c, sizeof share.c);
}

static void give(Share *to, const float lost[DITHER_CHANNELS], float part) {
    for (int i = 0; i < DITHER_CHANNELS; i++)
        to->c[i] += lost[i] * part;
}

void dither_lost(Dither *d, int x, const float lost[DITHER_CHANNELS]) {
    if (d->method == DITHER_D1)
        memcpy(d->carried.c, lost, sizeof d->carried.c);
    if (!d->now)
        return;
    if (x == 0) {
        Share *last = d->now;
        d->now = d->below;
        d->below = last;
        memset(last, 0, sizeof *last * ((size_t)d->width + 2));
    }
    // now[x + 1] is this pixel's own.
    if (d->method == DITHER_D2) {
        give(d->now + x + 2, lost, 2 / 4.0f);
        give(d->below + x + 1, lost, 1 / 4.0f);
        give(d->below + x + 2, lost, 1 / 4.0f);
    } else {
        give(d->now + x + 2, lost, 7 / 16.0f);
        give(d->below + x, lost, 3 / 16.0f);
        give(d->below + x + 1, lost, 5 / 16.0f);
        give(d->below + x + 2, lost, 1 / 16.0f);
    }
}
