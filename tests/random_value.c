// SPDX-License-Identifier: MIT
#include "random_value.h"

#include <math.h>
#include <string.h>

double random_double(Rng *rng) {
    switch (rng_next(rng) % 8) {
    case 0:
        return 0.0;
    case 1:
        return -0.0;
    case 2:
        return (double)(int64_t)(rng_next(rng) % 2001) - 1000;
    case 3:
        return 4.9406564584124654e-324 * (double)(rng_next(rng) % 5000);
    case 4:
        return rng_range(rng, -1, 1) * pow(10, rng_range(rng, -300, 60));
    case 5:
        return floor(rng_unit(rng) * 1000) / 1000;
    default:
        return rng_range(rng, -10, 10);
    }
}

float random_float(Rng *rng) {
    if (rng_next(rng) % 2)
        return (float)(floor(rng_unit(rng) * 100) / 100);
    for (;;) {
        uint32_t bits = (uint32_t)rng_next(rng);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value))
            return value;
    }
}

bool random_bool(Rng *rng) { return rng_next(rng) % 2; }
uint32_t random_below(Rng *rng, uint32_t count) { return (uint32_t)(rng_next(rng) % count); }
uint32_t random_index_or_none(Rng *rng, uint32_t count) {
    return random_bool(rng) ? NO_INDEX : random_below(rng, count);
}
Vec3 random_vec3(Rng *rng) {
    double x = random_double(rng), y = random_double(rng);
    return vec3(x, y, random_double(rng));
}
Vec3 random_unit(Rng *rng) {
    double x = rng_range(rng, -1, 1), y = rng_range(rng, -1, 1);
    return vec_normalize(vec3(x, y, rng_range(rng, 0.1, 1)));
}
Rgb random_rgb(Rng *rng) {
    float r = random_float(rng), g = random_float(rng);
    return rgb(r, g, random_float(rng));
}
Color random_color(Rng *rng) {
    Rgb c = random_rgb(rng);
    bool opaque = random_bool(rng);
    float filter = opaque ? 0 : random_float(rng), transmit = opaque ? 0 : random_float(rng);
    return (Color){c.r, c.g, c.b, filter, transmit};
}

Transform random_transform(Rng *rng) {
    Transform all = transform_identity();
    int count = (int)random_below(rng, 4);
    for (int i = 0; i < count; i++) {
        double x = rng_range(rng, 0.1, 9), y = rng_range(rng, -9, -0.1), z = rng_range(rng, 1, 90);
        Transform t = transform_translate(vec3(x, y, z));
        uint32_t kind = random_below(rng, 4);
        if (kind == 0)
            t = transform_scale(vec3(x, y, z));
        else if (kind == 1)
            t = transform_rotate(vec3(x, y, z));
        else if (kind == 2)
            (void)transform_matrix((const double[4][3]){{x, y, 0}, {0, z, x}, {y, 0, x}, {1, 2, z}},
                                   &t);
        all = transform_compose(&all, &t);
    }
    all.inv[3][3] = 1; // not in the file: nothing looks at it
    return all;
}
