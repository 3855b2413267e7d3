// SPDX-License-Identifier: MIT
// Random valid scenes that use every member of scene.h, and the comparison of two scenes bit by
// bit. The members are listed here once more, apart from the product's own tables, so that a member
// which those forget shows as a difference.
#ifndef TESTS_RANDOM_SCENE_H
#define TESTS_RANDOM_SCENE_H

#include "base/rng.h"
#include "model/scene.h"

// Every object type, pattern, light, ... appears for some seed. Objects are numbered as a walk of
// the trees meets them.
Scene *random_scene(Rng *rng, Arena *arena);

// NULL if all members are the same, else the name of one that differs.
const char *scene_difference(const Scene *a, const Scene *b);

#endif
