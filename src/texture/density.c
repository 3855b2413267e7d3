// SPDX-License-Identifier: MIT
#include "texture/density.h"

#include "base/diag.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- the file: three sizes of 16 bits, then the numbers, all with the highest byte first --------

static uint32_t read_number(const uint8_t *bytes, int count) {
    uint32_t n = 0;
    for (int i = 0; i < count; i++)
        n = n << 8 | bytes[i];
    return n;
}

static uint8_t *read_bytes(const char *path, Arena *arena, size_t *size) {
    FILE *file = fopen(path, "rb");
    if (!file)
        die("cannot read '%s': %s", path, strerror(errno));
    long end = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    *size = end > 0 ? (size_t)end : 0;
    uint8_t *bytes = ARENA_ARRAY(arena, uint8_t, *size);
    rewind(file);
    bool good = end >= 0 && fread(bytes, 1, *size, file) == *size;
    fclose(file);
    if (!good)
        die("cannot read '%s'", path);
    return bytes;
}

Density density_make(const char *path, Arena *arena) {
    size_t size;
    const uint8_t *bytes = read_bytes(path, arena, &size);
    if (size < 6)
        die("'%s' is no density file: it is too short", path);
    Density d = {.bytes = 0};
    size_t count = 1;
    for (int i = 0; i < 3; i++) {
        d.size[i] = read_number(bytes + 2 * (size_t)i, 2);
        count *= d.size[i];
    }
    for (int width = 1; width <= 4; width *= 2)
        if (count * (size_t)width == size - 6)
            d.bytes = width;
    if (d.bytes == 0 || count == 0)
        die("'%s' is no density file: %u x %u x %u numbers do not take %zu bytes", path, d.size[0],
            d.size[1], d.size[2], size - 6);
    uint8_t *numbers = ARENA_ARRAY(arena, uint8_t, size - 6);
    for (size_t i = 0; i < count; i++) {
        uint32_t n = read_number(bytes + 6 + i * (size_t)d.bytes, d.bytes);
        uint16_t half = (uint16_t)n;
        uint8_t byte = (uint8_t)n;
        const void *from = d.bytes == 4 ? (void *)&n : d.bytes == 2 ? (void *)&half : (void *)&byte;
        memcpy(numbers + i * (size_t)d.bytes, from, (size_t)d.bytes);
    }
    d.numbers = numbers;
    return d;
}

// ---- its values -------------------------------------------------------------------------------

static double number_at(const Density *d, size_t x, size_t y, size_t z) {
    size_t at = (z * d->size[1] + y) * d->size[0] + x;
    switch (d->bytes) {
    case 1:
        return (double)((const uint8_t *)d->numbers)[at] / 255.0;
    case 2:
        return (double)((const uint16_t *)d->numbers)[at] / 65535.0;
    default:
        return (double)((const uint32_t *)d->numbers)[at] / 4294967295.0;
    }
}

// Where a coordinate falls along an axis.
typedef struct {
    size_t at, size;
    double part; // of the way to the next
} Place;

static Place place_of(double x, uint32_t size) {
    double scaled = x * (double)size;
    size_t at = (size_t)scaled;
    return (Place){at < size ? at : size - 1, size, scaled - floor(scaled)};
}

static double linear(const Density *d, const Place p[3]) {
    size_t next[3];
    for (int i = 0; i < 3; i++)
        next[i] = (p[i].at + 1) % p[i].size;
    double f[2][2][2];
    for (int k = 0; k < 8; k++)
        f[k >> 2][k >> 1 & 1][k & 1] = number_at(
            d, k & 1 ? next[0] : p[0].at, k & 2 ? next[1] : p[1].at, k & 4 ? next[2] : p[2].at);
    double x = p[0].part, y = p[1].part, z = p[2].part, rx = 1.0 - x, ry = 1.0 - y;
    return ((f[0][0][0] * rx + f[0][0][1] * x) * ry + (f[0][1][0] * rx + f[0][1][1] * x) * y) *
               (1.0 - z) +
           ((f[1][0][0] * rx + f[1][0][1] * x) * ry + (f[1][1][0] * rx + f[1][1][1] * x) * y) * z;
}

// In single precision, as POV-Ray has it.
static float cubic_between(float t, float a, float b, float c, float d) {
    float slope_b = (c - a) * 0.5f, slope_c = (d - b) * 0.5f;
    float e = (float)(2.0 * (b - c) + slope_b + slope_c);
    float f = (float)(-3.0 * (b - c) - 2.0 * slope_b - slope_c);
    return ((e * t + f) * t + slope_b) * t + b;
}

// The number `step` - 1 after the place, around the end. The one before the first is reckoned in
// whole numbers of 64 bits without sign, and so falls where 2^64 - 1 does.
static size_t around(const Place *p, uint64_t step) {
    return (size_t)(((uint64_t)p->at + step - 1) % p->size);
}

static double cubic(const Density *d, const Place p[3]) {
    float rows[4][4], across[4];
    size_t z[4];
    for (uint64_t k = 0; k < 4; k++)
        z[k] = around(&p[2], k);
    for (uint64_t i = 0; i < 4; i++)
        for (uint64_t j = 0; j < 4; j++) {
            size_t x = around(&p[0], i), y = around(&p[1], j);
            rows[i][j] = cubic_between(
                (float)p[2].part, (float)number_at(d, x, y, z[0]), (float)number_at(d, x, y, z[1]),
                (float)number_at(d, x, y, z[2]), (float)number_at(d, x, y, z[3]));
        }
    for (int i = 0; i < 4; i++)
        across[i] = cubic_between((float)p[1].part, rows[i][0], rows[i][1], rows[i][2], rows[i][3]);
    return cubic_between((float)p[0].part, across[0], across[1], across[2], across[3]);
}

static bool inside(double x) { return x >= 0.0 && x < 1.0; }

double density_value(const Density *d, int between, Vec3 p) {
    if (!inside(p.x) || !inside(p.y) || !inside(p.z))
        return 0.0;
    const Place at[3] = {place_of(p.x, d->size[0]), place_of(p.y, d->size[1]),
                         place_of(p.z, d->size[2])};
    double value = between == 0   ? number_at(d, at[0].at, at[1].at, at[2].at)
                   : between == 1 ? linear(d, at)
                                  : cubic(d, at);
    return value < 0.0 ? 0.0 : value;
}
