// SPDX-License-Identifier: MIT
// Pigments: a point becomes a colour.
#ifndef TEXTURE_PIGMENT_H
#define TEXTURE_PIGMENT_H

#include "model/scene.h"

// Where a texture is evaluated. p is the point in the space of the texture's owner: the hit in the
// world, or (u, v, 0) where the object or the texture has uv_mapping.
typedef struct {
    Vec3 p;
    double u, v; // of the hit, for pigments that have uv_mapping themselves
    bool quick;  // quality 0..5: a quick_color stands for its pigment
} TexturePoint;

// The colour of scene->pigments[pigment] there. False: the pigment says nothing at this point (an
// image map used once, outside the image); the colour is then fully transparent.
bool pigment_color(const Scene *scene, uint32_t pigment, const TexturePoint *at, Color *color);

// Nothing anywhere in the pigment filters or transmits, so that it stops a shadow ray wherever it
// is met.
bool pigment_is_opaque(const Scene *scene, uint32_t pigment);

#endif
