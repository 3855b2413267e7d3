// SPDX-License-Identifier: MIT
// POV-Ray's noise, bit for bit: scalar, vector, their turbulence, and its tables of random numbers.
// Every function is pure once noise_prepare() has run.
#ifndef NOISE_NOISE_H
#define NOISE_NOISE_H

#include "base/vec.h"

#include <stdint.h>

// Builds the tables, once per program whatever the number of calls and threads.
void noise_prepare(void);

// generator: 1 the original, 2 with its range corrected, 3 Perlin's. Within [0,1].
double noise_value(Vec3 p, int generator);
// The same for all generators; each component about -1..1.
Vec3 noise_vector(Vec3 p);

// The sum of octaves: the i-th at lambda^i times the frequency with omega^i times the strength.
typedef struct {
    int octaves;         // 1..10
    float lambda, omega; // POV-Ray's defaults: 6 octaves, 2, 0.5
} NoiseOctaves;

double noise_turbulence(Vec3 p, const NoiseOctaves *octaves, int generator);
Vec3 noise_turbulence_vector(Vec3 p, const NoiseOctaves *octaves);

// The number 0..4095 of a cell of the integer lattice, and the random numbers in [0,1) that such
// numbers index (index and index + 1, + 2 too).
uint32_t noise_cell(int x, int y, int z);
double noise_random(uint32_t index);

// The i-th of the waves that ripples and waves add up: its centre (at distance 1 from the origin)
// and its frequency.
void noise_wave(uint32_t i, Vec3 *center, double *frequency);

// x rounded as POV-Ray's (int): what does not fit becomes INT_MIN instead of undefined.
int noise_int(double x);

#endif
