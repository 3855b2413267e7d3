// SPDX-License-Identifier: MIT
// Pigments: a point becomes a colour.
#ifndef TEXTURE_PIGMENT_H
#define TEXTURE_PIGMENT_H

#include "texture/textures.h"

// The colour of scene->pigments[pigment] at p, the point in the space of the pigment's owner.
// False: the pigment says nothing at this point (an image map used once, outside the image); the
// colour is then fully transparent.
bool pigment_color(const Textures *textures, uint32_t pigment, const TextureHit *hit, Vec3 p,
                   Color *color);

// Nothing anywhere in the pigment filters or transmits, so that it stops a shadow ray wherever it
// is met.
bool pigment_is_opaque(const Textures *textures, uint32_t pigment);

#endif
