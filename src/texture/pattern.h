// SPDX-License-Identifier: MIT
// Patterns: a point in space becomes a number. noise_prepare() must have run.
#ifndef TEXTURE_PATTERN_H
#define TEXTURE_PATTERN_H

#include "model/scene.h"

// The point after the pattern's chain of warps, each coordinate clamped to +-1e17.
Vec3 pattern_point(const Pattern *pattern, Vec3 p);

// The pattern's value at a point that went through pattern_point(): after frequency, phase and
// wave. Not for PATTERN_PLAIN, which has none. settings: the scene's, for its noise generator and
// number of waves.
double pattern_value(const Settings *settings, const Pattern *pattern, Vec3 warped);

#endif
