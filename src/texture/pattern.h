// SPDX-License-Identifier: MIT
// Patterns: a point in space becomes a number. noise_prepare() must have run.
#ifndef TEXTURE_PATTERN_H
#define TEXTURE_PATTERN_H

#include "texture/textures.h"

// The point after the pattern's chain of warps, each coordinate clamped to +-1e17.
Vec3 pattern_point(const Pattern *pattern, Vec3 p);

// The pattern's value at a point that went through pattern_point(): after frequency, phase and
// wave. Only for patterns that have one.
double pattern_value(const Textures *textures, const Pattern *pattern, const TextureHit *hit,
                     Vec3 warped);

// Have pattern and picture a value at each point?
bool pattern_has_value(PatternType type);

// The noise generator in force: the pattern's own, or the scene's.
int pattern_generator(const Textures *textures, const Pattern *pattern);

#endif
