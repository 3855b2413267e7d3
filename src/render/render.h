// SPDX-License-Identifier: MIT
// A scene to a picture: world, tiles on all cores, samples, film. The bytes do not depend on the
// number of threads.
#ifndef RENDER_RENDER_H
#define RENDER_RENDER_H

#include "image/image.h"
#include "model/scene.h"
#include "options/options.h"
#include "render/world.h"

typedef struct {
    RayStats rays;
    uint64_t pixels, samples; // samples: camera rays traced
    uint64_t patches, memory; // bytes of the prepared world
    double prepare_seconds, trace_seconds;
    int threads;
} RenderStats;

// Renders scene at options' size; the pixels are encoded and quantised for the output format
// (film.h) and live in arena. options->width, height must be valid.
Image *render_scene(const Scene *scene, const RenderOptions *options, Arena *arena,
                    RenderStats *stats);

#endif
