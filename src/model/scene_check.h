// SPDX-License-Identifier: MIT
// Inside the room: scene_validate for a scene that came from a file, where one entry of the object
// list can stand for many patches.
#ifndef MODEL_SCENE_CHECK_H
#define MODEL_SCENE_CHECK_H

#include "model/scene.h"

// positions[i]: which entry of its list in the file objects[i] is; NULL: each is its own.
void scene_validate_at(const Scene *scene, const char *file, const uint32_t *positions);

#endif
