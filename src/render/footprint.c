// SPDX-License-Identifier: MIT
#include "render/footprint.h"

#include <math.h>

// Rays this far apart over the picture are looked at: cameras change slowly.
enum { GRID = 16 };
static const double LARGEST_SHARE = 1e-3; // beyond that the shape is lost

static double least(double a, double b) { return b < a ? b : a; } // b may be NaN

Footprint footprint_create(const CameraView *view, double pixels) {
    Footprint f = {
        .eye = view->camera->location, .angle = INFINITY, .width = INFINITY, .share = pixels};
    for (int j = 0; j <= GRID; j++)
        for (int i = 0; i <= GRID; i++) {
            double x = view->width * i / GRID, y = view->height * j / GRID;
            Ray ray, beside[2];
            if (!camera_ray(view, x, y, &ray) || !camera_ray(view, x + 1.0, y, &beside[0]) ||
                !camera_ray(view, x, y + 1.0, &beside[1]))
                continue;
            for (int k = 0; k < 2; k++) {
                f.angle = least(f.angle, vec_length(vec_sub(beside[k].dir, ray.dir)));
                f.width = least(f.width, vec_length(vec_sub(beside[k].org, ray.org)));
            }
        }
    return f;
}

double footprint_tolerance(const void *footprint, Box box) {
    const Footprint *f = footprint;
    Vec3 near = vec_min(vec_max(f->eye, box.low), box.high);
    double distance = vec_length(vec_sub(near, f->eye));
    double pixel = fmax(f->angle * distance, f->width);
    double most = LARGEST_SHARE * vec_length(vec_sub(box.high, box.low));
    double tolerance = f->share * pixel;
    return isfinite(tolerance) ? fmin(tolerance, most) : 0.0;
}
