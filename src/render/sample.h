// SPDX-License-Identifier: MIT
// Where the camera rays of a tile go, and how their colours become its pixels: POV-Ray's
// anti-aliasing (facts: rendering 2).
#ifndef RENDER_SAMPLE_H
#define RENDER_SAMPLE_H

#include "render/camera.h"
#include "render/gamma.h"

#include <stdint.h>

typedef struct {
    int method;               // 0: the middle of each pixel; 1, 2: POV-Ray's sampling methods
    int depth;                // 1..9
    double threshold;         // 0..1: colours that differ by it or more are supersampled
    double jitter;            // 0..1: 0 for none
    double nudge[2];          // all camera rays are moved by so many pixels, right and down
    Transfer eye;             // the space in which colours are compared
    const Textures *textures; // for a camera with a normal
} SampleOptions;

// Columns left .. right - 1, rows top .. bottom - 1 of the picture.
typedef struct {
    int left, top, right, bottom;
} PixelRect;

// The colour along a ray of unit length; must not depend on what was asked before.
typedef Color (*SampleTrace)(void *context, const Ray *ray);

// Told ahead which rays will be traced: `down` rows of `across` rays, in this order, among others.
// They stay until the next call.
typedef void (*SampleForesee)(void *context, const Ray *rays, size_t across, size_t down);

// One per thread: scratch memory for a tile.
typedef struct Sampler Sampler;

// Tiles will be at most `block` pixels wide and high. camera must outlive the sampler.
Sampler *sampler_create(const SampleOptions *options, const Camera *camera, int width, int height,
                        int block);
void sampler_destroy(Sampler *sampler);

// Fills the pixels of tile in the picture (width x height colours, row by row from the top). With
// method 1 the result depends on where the tile lies, as POV-Ray's does; never on other tiles.
void sampler_tile(Sampler *sampler, PixelRect tile, SampleTrace trace, void *context,
                  Color *picture);

// For all tiles from now on; gets the context of sampler_tile.
void sampler_foresee(Sampler *sampler, SampleForesee foresee);

uint64_t sampler_rays(const Sampler *sampler);   // camera rays so far
uint64_t sampler_pixels(const Sampler *sampler); // pixels that were supersampled (methods 1, 2)

// POV-Ray's jitter: a repeatable pair of numbers in [-0.5, 0.5) for a place.
void sample_jitter(double x, double y, double *jx, double *jy);
// Entry i (0..4095) of the permutation behind it.
int sample_permutation(int i);

#endif
