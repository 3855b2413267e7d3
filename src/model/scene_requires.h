// SPDX-License-Identifier: MIT
// Inside the room: the words that a scene file's "requires" may hold.
#ifndef MODEL_SCENE_REQUIRES_H
#define MODEL_SCENE_REQUIRES_H

#include <stdbool.h>

// Is this a feature that scene_collect_requires could name?
bool scene_requires_known(const char *word);

#endif
