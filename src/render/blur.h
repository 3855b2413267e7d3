// SPDX-License-Identifier: MIT
// Focal blur: a pixel seen from many points of the lens (facts: rendering 1.4).
#ifndef RENDER_BLUR_H
#define RENDER_BLUR_H

#include "base/arena.h"
#include "render/camera.h"
#include "render/sample.h"

// The points of the lens and the limits of the statistics; read-only once made.
typedef struct Blur Blur;

// camera->has_blur must be true; both it and arena must outlive the result.
const Blur *blur_create(const Camera *camera, Arena *arena);

// The mean over the lens at pixel coordinates (x, y); *rays counts what was traced.
Color blur_trace(const Blur *blur, const CameraView *view, double x, double y, SampleTrace trace,
                 void *context, uint64_t *rays);

#endif
