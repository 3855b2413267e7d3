// SPDX-License-Identifier: MIT
// Primary rays. The order of the operations is POV-Ray's, since the last bit of a direction decides
// on which side of an edge a sample falls.
#include "render/camera.h"

// base + a right + b up, summed from left to right.
static Vec3 span(Vec3 base, double a, Vec3 right, double b, Vec3 up) {
    return vec3(base.x + a * right.x + b * up.x, base.y + a * right.y + b * up.y,
                base.z + a * right.z + b * up.z);
}

Ray camera_ray(const Camera *camera, int width, int height, double x, double y) {
    // The middle of a pixel lies half a pixel to the right of its corner and half a pixel below.
    double a = (x + 0.5) / width - 0.5;
    double b = ((double)(height - 1) - (y - 0.5)) / height - 0.5;

    if (camera->type == CAMERA_ORTHOGRAPHIC)
        return (Ray){span(camera->location, a, camera->right, b, camera->up),
                     vec_normalize(camera->direction)};
    return (Ray){camera->location,
                 vec_normalize(span(camera->direction, a, camera->right, b, camera->up))};
}
