// SPDX-License-Identifier: MIT
// From a place in the picture to the ray that looks through it (facts: rendering 1.3).
#ifndef RENDER_CAMERA_H
#define RENDER_CAMERA_H

#include "texture/textures.h"

// A camera made ready for a picture of one size.
typedef struct {
    const Camera *camera;
    const Textures *textures;
    double width, height;
    Vec3 direction, right, up; // of unit length for the cameras that want them so
    double right_length, up_length;
} CameraView;

// camera and textures must outlive the view; these serve the camera's normal, and may be NULL where
// it has none.
CameraView camera_view(const Camera *camera, const Textures *textures, int width, int height);

// The ray through pixel coordinates (x, y), x to the right and y down. Whole numbers name pixel
// centres; fractions and places outside are legal. dir has unit length (NaN if the camera's vectors
// cancel out, which scene_validate cannot know). False: the camera sees nothing there.
bool camera_ray(const CameraView *view, double x, double y, Ray *ray);

// The same in two steps. The ray before dir is made a unit vector; (*a, *b) is the place as the
// camera's type measures it. Then what the normal makes of dir, and a unit vector of it.
bool camera_aim(const CameraView *view, double x, double y, Ray *ray, double *a, double *b);
Vec3 camera_bend(const CameraView *view, Vec3 dir, double a, double b);

#endif
