// SPDX-License-Identifier: MIT
// Density files (facts: textures 2.3): a block of numbers over the unit cube.
#ifndef TEXTURE_DENSITY_H
#define TEXTURE_DENSITY_H

#include "model/scene.h"

typedef struct Density {
    uint32_t size[3];
    int bytes; // of each number: 1, 2, 4
    const void *numbers;
} Density;

// Reads a DF3 file; dies with a message if it is none.
Density density_make(const char *path, Arena *arena);

// 0 outside of the cube. between: 0 the nearest number, 1 linear, 2 cubic.
double density_value(const Density *density, int between, Vec3 p);

#endif
