// SPDX-License-Identifier: MIT
// A scene to a picture: world, tiles on all cores, samples, film. The bytes do not depend on the
// number of threads.
#ifndef RENDER_RENDER_H
#define RENDER_RENDER_H

#include "image/image.h"
#include "model/scene.h"
#include "options/options.h"
#include "render/footprint.h"
#include "render/sample.h"
#include "render/world.h"

#include <signal.h>
#include <stdio.h>

typedef struct {
    RayStats rays;
    uint64_t pixels, samples; // samples: camera rays traced
    uint64_t supersampled;    // pixels that got more than their first samples
    uint64_t patches, memory; // bytes of the prepared world
    double prepare_seconds, trace_seconds;
    double work_seconds; // of processor time, of all threads, while tracing
    int threads;
    ImageLayers *layers; // options->aovs (aov.h), in render_scene's arena; NULL: none asked for
    uint64_t taken_up;   // pixels that an earlier run had finished
    bool interrupted;    // by render_interrupted
    double share;        // then: of the area that is finished
    bool kept;           // then: what is finished is in options->state
} RenderStats;

// Dies with a message when the picture is too small or too large for this machine, or when the
// part to render (+SR +ER +SC +EC) lies outside. To be called before any work.
void render_check(const RenderOptions *options);

// The part of the picture to render; empty when it ends before it starts. After render_check.
PixelRect render_area(const RenderOptions *options);

// How the options ask for patches. What footprint holds must stay until the world is made.
PatchSetOptions render_patch_options(const Scene *scene, const RenderOptions *options,
                                     Footprint *footprint);

// Set by a signal handler: render_scene ends when the tiles at work are finished.
extern volatile sig_atomic_t render_interrupted;

// Prints how the pixel options->pixel comes about, by one ray through its middle. Dies when it lies
// outside the picture.
void render_pixel(const Scene *scene, const RenderOptions *options, FILE *out);

// Renders scene at options' size; the pixels are encoded and quantised for the output format
// (film.h) and live in arena, and *write gets what the file's header needs. What lies outside the
// area is black, and opaque even with +UA, as in POV-Ray. With options->state long
// renders keep their finished tiles in that file (resume.h), which the caller removes when the
// picture is written. NULL when the render was interrupted.
Image *render_scene(const Scene *scene, const RenderOptions *options, Arena *arena,
                    ImageWriteOptions *write, RenderStats *stats);

#endif
