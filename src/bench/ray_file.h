// SPDX-License-Identifier: MIT
// The text that `qibench trace` reads: patches, then rays.
//
//     patches N
//     x y z                     16 lines a patch, the first index weighted with u
//     rays M
//     ox oy oz dx dy dz         M lines
//
// A line holds its numbers and nothing else; empty lines may stand anywhere. Numbers are read as C
// reads them. The numbers of a patch must be finite; those of a ray need not be (such a ray meets
// nothing). Anything else ends the program with file:line:col.
#ifndef BENCH_RAY_FILE_H
#define BENCH_RAY_FILE_H

#include "base/arena.h"
#include "base/vec.h"

#include <stddef.h>
#include <stdint.h>

typedef struct RayFile RayFile;

// Opens a file and reads its patches. The rays follow in pieces, so that a file larger than memory
// can be read. Everything lies in the arena but the file, which ray_file_close gives back.
RayFile *ray_file_open(Arena *arena, const char *path);
void ray_file_close(RayFile *file);

uint32_t ray_file_patch_count(const RayFile *file);
const Vec3 *ray_file_points(const RayFile *file); // 16 a patch
uint64_t ray_file_ray_count(const RayFile *file);

// The next rays, at most `capacity`; returns how many. 0: there are no more, and nothing follows.
size_t ray_file_next(RayFile *file, Ray *rays, size_t capacity);

#endif
