// SPDX-License-Identifier: MIT
// How large a pixel is where the camera looks: for tolerances that are given in pixels.
#ifndef RENDER_FOOTPRINT_H
#define RENDER_FOOTPRINT_H

#include "render/camera.h"

typedef struct {
    Vec3 eye;
    double angle; // between neighbouring pixels, the least of the picture, radians
    double width; // between the starts of their rays, likewise
    double share; // of a pixel's width that is asked for
} Footprint;

// pixels: the tolerance, 0.1 for a tenth of a pixel.
Footprint footprint_create(const CameraView *view, double pixels);

// The tolerance for a patch in that box, scene units: so many pixels at the box's nearest point,
// but no more than 1/1000 of the box's diagonal; 0 when the camera is inside.
double footprint_tolerance(const void *footprint, Box box);

#endif
