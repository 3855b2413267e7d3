// SPDX-License-Identifier: MIT
// From a place in the picture to the ray that looks through it (facts: rendering 1.3).
#ifndef RENDER_CAMERA_H
#define RENDER_CAMERA_H

#include "model/scene.h"

// The ray through pixel coordinates (x, y), x to the right and y down, in a picture of width x
// height. Whole numbers name pixel centres; fractions and places outside are legal. dir has unit
// length (NaN if the camera's vectors cancel out, which scene_validate cannot know).
Ray camera_ray(const Camera *camera, int width, int height, double x, double y);

#endif
