// SPDX-License-Identifier: MIT
// The places where two pictures of one scene differ most, and why: qicompare's evidence.
//
// The proof is by rendering again. Our renderer with POV-Ray's own triangles (`facets`) shares
// everything with ours but the geometry of the patches. Where its picture is POV-Ray's, only that
// geometry can be the reason; and with the triangles cut finer the difference must shrink. Where it
// is not, and both renderers agree as soon as anti-aliasing is off, the reason is where the samples
// of a pixel go. Where a picture whose rays are moved by a billionth of a pixel is POV-Ray's, the
// reason is the last digit of a sum: the ray meets an edge of something as exactly as doubles tell.
// Where POV-Ray's own picture is ours as soon as it sorts the objects otherwise, its boxes, which
// are of single precision, have lost the ray. And where POV-Ray agrees with us on the eight rays a
// third of a pixel away it has lost, or made up, a single ray. Else it is the shading, or an object
// that is not a patch.
#ifndef REPORT_PLACES_H
#define REPORT_PLACES_H

#include "image/image.h"

// ORDER place_cause (names in places.c)
typedef enum {
    CAUSE_UNKNOWN, // not looked into
    CAUSE_GEOMETRY,
    CAUSE_SAMPLING,
    CAUSE_ROUNDING,
    CAUSE_BOUNDING,
    CAUSE_LONE_RAY,
    CAUSE_SHADING,
    CAUSE_COUNT,
} PlaceCause;

typedef struct {
    int x, y;          // the pixel that is farthest off
    double difference; // there, 1 = full range; the rest: the largest within PLACE_REACH pixels
    double facets;     // POV-Ray and our picture of its triangles; < 0: not rendered
    double coarse;     // our picture of its triangles and ours; < 0: not rendered
    double fine;       // the same with the triangles cut finer; < 0: not rendered
    double plain;      // both without anti-aliasing; < 0: not rendered
    double nudged; // POV-Ray and, of each pixel, the nearest of ours with triangles and moved rays
    double sorted; // POV-Ray with another sorting, and ours with triangles; < 0: not rendered
    double lone, beside; // the pixel, and the rays a third of a pixel away; < 0: not rendered
    PlaceCause cause;
    const char *story[2]; // how ours comes about, and how POV-Ray's triangles do; NULL: not told
} Place;

enum { PLACE_NUDGES = 4 }; // a billionth of a pixel to each corner
#define PLACE_NUDGE 1e-9
enum { PLACE_REACH = 2, PLACE_MOST = 100 };

const char *place_cause_name(PlaceCause cause);

// Up to `most` places whose pixels are off by more than limit, the worst first, no two of them
// within a tile of 16 x 16 of each other. differences: one channel (image_difference). Returns
// their number.
int places_find(const Image *differences, double limit, int most, Place *places);

// The pictures that prove it; NULL: not rendered.
typedef struct {
    const Image *povray, *ours;
    const Image *facets, *finer;       // ours, with POV-Ray's triangles
    const Image *nudged[PLACE_NUDGES]; // with POV-Ray's triangles and moved rays
    const Image *povray_sorted;        // with +BM2
    const Image *povray_plain, *plain; // without anti-aliasing: POV-Ray's, and ours with triangles
} PlaceProof;

// Of each place that is shading so far: POV-Ray's picture and ours, with its triangles, of that
// pixel alone, cut into 3 x 3 rays, the middle one the pixel's own.
typedef struct {
    const Image *povray, *facets; // 3 x 3 pixels; NULL: not rendered
} PlaceThirds;

// limit as below.
void places_judge_thirds(const PlaceThirds *thirds, double limit, Place *place);

// Fills facets .. cause of the places. limit: differences up to it count as none.
void places_judge(const PlaceProof *proof, double limit, Place *places, int count);

#endif
