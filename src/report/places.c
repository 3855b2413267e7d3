// SPDX-License-Identifier: MIT
#include "report/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { APART = 16 };

// ORDER place_cause
static const char *const names[CAUSE_COUNT] = {
    "not looked into", "geometry", "sampling", "rounding", "bounding", "a lone ray", "shading"};

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

// The largest difference within `reach` pixels of the place; -1 when a picture is not there.
static double within(const Image *a, const Image *b, const Place *place, int reach) {
    if (!a || !b)
        return -1.0;
    int side = 2 * reach + 1, left = place->x - reach, top = place->y - reach;
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

static double around(const Image *a, const Image *b, const Place *place) {
    return within(a, b, place, PLACE_REACH);
}

// Of each pixel the nearest to POV-Ray's of the pictures that differ by rounding, so that each may
// need another way; the farthest of the pixels around the place.
static double nearest_around(const PlaceProof *proof, const Place *place) {
    double most = 0.0;
    Place one = *place;
    for (one.y = place->y - PLACE_REACH; one.y <= place->y + PLACE_REACH; one.y++)
        for (one.x = place->x - PLACE_REACH; one.x <= place->x + PLACE_REACH; one.x++) {
            if (one.x < 0 || one.y < 0 || one.x >= proof->povray->width ||
                one.y >= proof->povray->height)
                continue;
            double least = within(proof->povray, proof->facets, &one, 0);
            for (int k = 0; k < PLACE_NUDGES; k++)
                least = fmin(least, within(proof->povray, proof->nudged[k], &one, 0));
            most = fmax(most, least);
        }
    return most;
}

static PlaceCause cause_of(const Place *place, double limit) {
    if (place->facets < 0.0)
        return CAUSE_UNKNOWN;
    if (place->facets <= limit && place->coarse > limit)
        return CAUSE_GEOMETRY;
    if (place->plain >= 0.0 && place->plain <= limit)
        return CAUSE_SAMPLING;
    if (place->nudged >= 0.0 && place->nudged <= limit)
        return CAUSE_ROUNDING;
    if (place->sorted >= 0.0 && place->sorted <= limit)
        return CAUSE_BOUNDING;
    return CAUSE_SHADING;
}

void places_judge(const PlaceProof *proof, double limit, Place *places, int count) {
    for (int i = 0; i < count; i++) {
        Place *place = &places[i];
        place->facets = around(proof->povray, proof->facets, place);
        place->coarse = around(proof->facets, proof->ours, place);
        place->fine = around(proof->finer, proof->ours, place);
        place->plain = around(proof->povray_plain, proof->plain, place);
        place->nudged = proof->nudged[0] ? nearest_around(proof, place) : -1.0;
        place->sorted = around(proof->povray_sorted, proof->facets, place);
        place->lone = place->beside = -1.0;
        place->cause = cause_of(place, limit);
    }
}

void places_judge_thirds(const PlaceThirds *thirds, double limit, Place *place) {
    place->beside = 0.0;
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3; x++) {
            const Place at = {.x = x, .y = y};
            double off = within(thirds->povray, thirds->facets, &at, 0);
            if (x == 1 && y == 1)
                place->lone = off;
            else
                place->beside = fmax(place->beside, off);
        }
    if (place->cause == CAUSE_SHADING && place->lone > limit && place->beside <= limit)
        place->cause = CAUSE_LONE_RAY;
}
