// SPDX-License-Identifier: MIT
// Normals: a texture bends the surface's normal.
#ifndef TEXTURE_NORMAL_H
#define TEXTURE_NORMAL_H

#include "texture/textures.h"

// Bends n by scene->normals[normal] at p, the point in the space of the normal's owner; n stands in
// the same space. hit->normal becomes the result.
Vec3 normal_bend(const Textures *textures, uint32_t normal, TextureHit *hit, Vec3 p, Vec3 n);

// A normal through the transforms of a pattern: from around it into its own space, and back. Unless
// no_bump_scale, it is of unit length before and after, so that scaling does not change the depth.
Vec3 normal_into(const Pattern *pattern, bool no_bump_scale, Vec3 n);
Vec3 normal_out(const Pattern *pattern, bool no_bump_scale, Vec3 n);

#endif
