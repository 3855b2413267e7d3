// SPDX-License-Identifier: MIT
// From a place in the picture to the ray that looks through it (facts: rendering 1.3).
#ifndef RENDER_CAMERA_H
#define RENDER_CAMERA_H

#include "model/scene.h"

// A camera made ready for a picture of one size.
typedef struct {
    const Camera *camera;
    double width, height;
    Vec3 direction, right, up; // of unit length for the cameras that want them so
    double right_length, up_length;
} CameraView;

// camera must outlive the view.
CameraView camera_view(const Camera *camera, int width, int height);

// The ray through pixel coordinates (x, y), x to the right and y down. Whole numbers name pixel
// centres; fractions and places outside are legal. dir has unit length (NaN if the camera's vectors
// cancel out, which scene_validate cannot know). False: the camera sees nothing there.
bool camera_ray(const CameraView *view, double x, double y, Ray *ray);

// The same before dir is made a unit vector; (*a, *b) is the place as the camera's type measures
// it.
bool camera_aim(const CameraView *view, double x, double y, Ray *ray, double *a, double *b);

#endif
