// SPDX-License-Identifier: MIT
// Inside the room: names of files in a scene file, which start at where that stands.
#ifndef MODEL_FILE_PATH_H
#define MODEL_FILE_PATH_H

#include "base/arena.h"

// path (absolute, or from the working directory) as it is called from the folder of `file`.
// Absolute ones stay.
char *path_from_file(Arena *arena, const char *path, const char *file);
// The reverse.
char *path_beside_file(Arena *arena, const char *path, const char *file);

#endif
