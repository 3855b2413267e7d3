// SPDX-License-Identifier: MIT
// Small seeded generator (splitmix64) for tests and benchmarks: Rng r = {case_number} replays a
// case.
#ifndef BASE_RNG_H
#define BASE_RNG_H

#include <stdint.h>

typedef struct {
    uint64_t state;
} Rng;

static inline uint64_t rng_next(Rng *r) {
    uint64_t z = (r->state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}
// Uniform in [0,1).
static inline double rng_unit(Rng *r) { return (double)(rng_next(r) >> 11) * 0x1p-53; }
static inline double rng_range(Rng *r, double low, double high) {
    return low + (high - low) * rng_unit(r);
}

#endif
