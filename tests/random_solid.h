// SPDX-License-Identifier: MIT
// Random data of the larger primitives and of what they share, and their comparison bit by bit.
#ifndef TESTS_RANDOM_SOLID_H
#define TESTS_RANDOM_SOLID_H

#include "base/rng.h"
#include "model/scene.h"

// Before the objects: fills the pools.
void random_pools(Rng *rng, Arena *arena, Scene *scene);
// The shape of an object of a type from OBJECT_QUADRIC on.
void random_solid(Rng *rng, Arena *arena, const Scene *scene, Object *object);
// The first member that differs, or NULL.
const char *solid_difference(const Object *a, const Object *b);
const char *pool_difference(const Scene *a, const Scene *b);

#endif
