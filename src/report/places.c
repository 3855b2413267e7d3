// SPDX-License-Identifier: MIT
#include "report/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { APART = 16 };

// ORDER place_cause
static const char *const names[CAUSE_COUNT] = {"not looked into", "geometry", "sampling",
                                               "shading"};

const char *place_cause_name(PlaceCause cause) { return names[cause]; }

static bool taken(const Place *places, int count, int x, int y) {
    for (int i = 0; i < count; i++)
        if (abs(places[i].x - x) < APART && abs(places[i].y - y) < APART)
            return true;
    return false;
}

int places_find(const Image *differences, double limit, int most, Place *places) {
    int count = 0;
    while (count < most) {
        Place worst = {.difference = limit};
        for (int y = 0; y < differences->height; y++)
            for (int x = 0; x < differences->width; x++) {
                double off =
                    (double)differences->pixels[(size_t)y * (size_t)differences->width + (size_t)x];
                if (off > worst.difference && !taken(places, count, x, y))
                    worst = (Place){.x = x, .y = y, .difference = off};
            }
        if (!(worst.difference > limit))
            break;
        places[count++] = worst;
    }
    return count;
}

// The largest difference around the place; -1 when a picture is not there.
static double around(const Image *a, const Image *b, const Place *place) {
    if (!a || !b)
        return -1.0;
    int side = 2 * PLACE_REACH + 1, left = place->x - PLACE_REACH, top = place->y - PLACE_REACH;
    int width = side + (left < 0 ? left : 0), height = side + (top < 0 ? top : 0);
    left = left > 0 ? left : 0;
    top = top > 0 ? top : 0;
    Arena *scratch = arena_create();
    const Image *one = image_cut(scratch, a, left, top, width, height);
    const Image *two = image_cut(scratch, b, left, top, width, height);
    const Image *off = image_difference(scratch, one, two);
    double most = 0.0;
    for (int i = 0; i < off->width * off->height; i++)
        most = fmax(most, (double)off->pixels[i]);
    arena_destroy(scratch);
    return most;
}

static PlaceCause cause_of(const Place *place, double limit) {
    if (place->facets < 0.0)
        return CAUSE_UNKNOWN;
    if (place->facets <= limit && place->coarse > limit)
        return CAUSE_GEOMETRY;
    if (place->plain >= 0.0 && place->plain <= limit)
        return CAUSE_SAMPLING;
    return CAUSE_SHADING;
}

void places_judge(const PlaceProof *proof, double limit, Place *places, int count) {
    for (int i = 0; i < count; i++) {
        Place *place = &places[i];
        place->facets = around(proof->povray, proof->facets, place);
        place->coarse = around(proof->facets, proof->ours, place);
        place->fine = around(proof->finer, proof->ours, place);
        place->plain = around(proof->povray_plain, proof->plain, place);
        place->cause = cause_of(place, limit);
    }
}
