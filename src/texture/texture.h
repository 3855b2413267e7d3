// SPDX-License-Identifier: MIT
// Textures: stacks of layers, as far as they can be judged without light.
#ifndef TEXTURE_TEXTURE_H
#define TEXTURE_TEXTURE_H

#include "texture/pigment.h"

// A shadow ray that meets this texture ends there: some layer is opaque everywhere. NO_INDEX, the
// built-in black, is.
bool texture_is_opaque(const Scene *scene, uint32_t texture);

// Where the layers of this texture are evaluated for a hit at p with texture coordinates (u, v).
TexturePoint texture_point(const Texture *texture, bool object_uv_mapping, Vec3 p, double u,
                           double v, bool quick);

#endif
