// SPDX-License-Identifier: MIT
// Inside the room: the side file that holds the control points of large scenes, as glTF 2.0 does
// it: a scene file names it under "buffers" and refers to bytes in it by offset. It holds nothing
// but doubles of 8 bytes, the low byte first.
#ifndef MODEL_SCENE_BINARY_H
#define MODEL_SCENE_BINARY_H

#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

// "dir/x.qi.json" -> "dir/x.qi.bin"; a name that does not end in .json gets .bin added.
char *binary_path(Arena *arena, const char *scene_path);

// Writes count doubles. Errors show in the stream, file_commit reports them.
void binary_write(FILE *out, const double *values, size_t count);

// A whole file in memory, read-only.
typedef struct {
    const unsigned char *bytes;
    size_t size;
} Mapping;

// False: *why says why not (a static text). An empty file maps to size 0.
bool binary_map(const char *path, Mapping *mapping, const char **why);
void binary_unmap(Mapping *mapping);
// Copies count doubles that start at bytes (any alignment).
void binary_read(double *out, const unsigned char *bytes, size_t count);

#endif
