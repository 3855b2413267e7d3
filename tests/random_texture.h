// SPDX-License-Identifier: MIT
// Random pigments, pictures, normals, textures and interiors that use every member.
#ifndef TESTS_RANDOM_TEXTURE_H
#define TESTS_RANDOM_TEXTURE_H

#include "base/rng.h"
#include "model/scene.h"

Turbulence random_turbulence(Rng *rng);
// Fills these pools; those of pigments, textures and interiors have their counts already.
void random_textures(Rng *rng, Arena *arena, Scene *scene);

#endif
