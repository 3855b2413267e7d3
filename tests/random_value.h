// SPDX-License-Identifier: MIT
// Random values of the members of a scene.
#ifndef TESTS_RANDOM_VALUE_H
#define TESTS_RANDOM_VALUE_H

#include "base/rng.h"
#include "model/scene.h"

double random_double(Rng *rng); // of any size up to 1e60, signed zeros and denormals too
float random_float(Rng *rng);   // any finite one
bool random_bool(Rng *rng);
uint32_t random_below(Rng *rng, uint32_t count);
uint32_t random_index_or_none(Rng *rng, uint32_t count); // of a pool, or NO_INDEX
Vec3 random_vec3(Rng *rng);
Vec3 random_unit(Rng *rng);
Rgb random_rgb(Rng *rng);
Color random_color(Rng *rng);
Transform random_transform(Rng *rng); // of up to three, that can be inverted

#endif
