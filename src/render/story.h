// SPDX-License-Identifier: MIT
// What --pixel prints: the rays of one pixel, what they meet and how its colour comes about. The
// shading calls these where something is decided, and only when Tracer.story is set.
#ifndef RENDER_STORY_H
#define RENDER_STORY_H

#include "render/shading.h"

#include <stdio.h>

struct Story {
    FILE *out;
    const Scene *scene;
    const uint32_t *patch_of; // of each object its number among the patches, or NO_INDEX
    int patch_count;
};

void story_ray(const Story *story, const Path *path, bool continued);
// hit NULL: nothing is met. work: what the ray has cost.
void story_hit(const Story *story, const Path *path, const WorldHit *hit, const PatchStats *work);
void story_layer(const Story *story, const Path *path, uint32_t index, Color pigment,
                 double opacity, Rgb reflectivity, Rgb light);
// How light `index` fared: "shines", "is in shadow", ... and what it added to the layer.
void story_light(const Story *story, const Path *path, uint32_t index, const LightSample *sample,
                 const char *fate, Rgb added);
void story_color(const Story *story, const Path *path, Color color);

// The camera ray through the middle of pixel (x, y), counted from 0 at the upper left: everything.
// Returns its colour in the working space.
Color story_of_pixel(const Scene *scene, const Shading *shading, int width, int height, int x,
                     int y, FILE *out);

#endif
