// SPDX-License-Identifier: MIT
// From a camera ray to its colour: POV-Ray's shading (facts: rendering 4..6). One Tracer per
// thread.
#ifndef RENDER_TRACE_H
#define RENDER_TRACE_H

#include "model/scene.h"
#include "render/world.h"
#include "texture/textures.h"

// The parts of the options that the shading needs.
typedef struct {
    int quality;             // POV-Ray's 0..9
    bool alpha;              // +UA: the background stays transparent
    PatchSetOptions patches; // for what lights are projected through; zeroes: the default
} TraceOptions;

// What is worked out once per scene: opaque flags, light directions, ... Shared by all threads.
typedef struct Shading Shading;
Shading *shading_create(const Scene *scene, const World *world, const TraceOptions *options);
void shading_destroy(Shading *shading);
const Textures *shading_textures(const Shading *shading); // lives as long

typedef struct Tracer Tracer;
Tracer *tracer_create(const Shading *shading);
void tracer_destroy(Tracer *tracer);
RayStats tracer_stats(const Tracer *tracer);

// The colour seen along ray (dir of unit length): r, g, b linear in the working space, transmit the
// transparency of the pixel (0 without alpha), filter 0.
Color tracer_trace(Tracer *tracer, const Ray *ray);

// The rays that tracer_trace will be asked for next, in that order, others between them: `down`
// rows of `across` rays of neighbouring pixels, which must stay until then. A matter of speed
// alone.
void tracer_foresee(Tracer *tracer, const Ray *rays, size_t across, size_t down);

#endif
