// SPDX-License-Identifier: MIT
// The converter's face to the outside: a POV-Ray source becomes a Scene.
#ifndef CONVERTER_CONVERT_H
#define CONVERTER_CONVERT_H

#include "base/arena.h"
#include "model/scene.h"
#include "options/options.h"

// Reads options->input with options' library paths, declares, clock and sizes (image_width ...).
// Wrong input dies with file:line:col. The scene is valid, and lives in arena.
Scene *convert_scene(const RenderOptions *options, Arena *arena);

#endif
