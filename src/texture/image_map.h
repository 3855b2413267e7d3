// SPDX-License-Identifier: MIT
// Pictures laid over space (facts: textures 2.9): where a point falls, and what is there.
#ifndef TEXTURE_IMAGE_MAP_H
#define TEXTURE_IMAGE_MAP_H

#include "model/scene.h"

// A picture decoded: its values are light, or light in the working space.
typedef struct ImageMap {
    const Picture *layout;
    int width, height;
    float across, down; // what the unit square is long and high, in pixels
    Vec2 offset;        // in pixels
    int channels;       // of the values: 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
    const float *values;
    const uint8_t *places; // of a palette; then the colours are
    Color *colors;
    bool indexed;       // had a palette, even if only its colours are known
    bool premultiplied; // the values are multiplied by alpha
    bool opaque;        // everywhere
} ImageMap;

// Reads the file; dies with a message if it cannot.
ImageMap image_map_make(const Settings *settings, const Picture *picture, Arena *arena);

// image_map: false outside of a picture laid once.
bool image_map_color(const ImageMap *map, Vec3 p, Color *color);
// image_pattern: 0..1, 0 outside.
double image_map_value(const ImageMap *map, Vec3 p);
// bump_map: n as it is bent there.
Vec3 image_map_bump(const ImageMap *map, double amount, Vec3 p, Vec3 n);
// material_map: which of count entries.
uint32_t image_map_material(const ImageMap *map, uint32_t count, Vec3 p);

#endif
