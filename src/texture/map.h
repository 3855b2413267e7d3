// SPDX-License-Identifier: MIT
// Looking a value up in a map (facts: textures 4.1).
#ifndef TEXTURE_MAP_H
#define TEXTURE_MAP_H

#include <stddef.h>
#include <stdint.h>

// Where a value falls: the entries on both sides, the same one twice when no blending is needed.
typedef struct {
    uint32_t before, at;
} MapPlace;

// positions: the first of count floats that are stride bytes apart. Entries keep the order of the
// file; at a position written twice the first counts, but at the last one the last.
static inline MapPlace map_find(const float *positions, size_t stride, uint32_t count, double v) {
    const char *bytes = (const char *)positions;
    uint32_t last = count - 1, i = 0;
#define POSITION(i) (*(const float *)(const void *)(bytes + (size_t)(i)*stride))
    if (v >= POSITION(last))
        return (MapPlace){last, last};
    while (i < last && v > POSITION(i))
        i++;
    return (MapPlace){i == 0 || v == POSITION(i) ? i : i - 1, i};
#undef POSITION
}

#endif
