// SPDX-License-Identifier: MIT
// Gradient noise on the integer lattice (facts: textures 3). None of the tables is stored: the hash
// is a shuffle driven by a linear generator, the gradient table is made of checksums, Perlin's
// tables come from the same linear generator, the random numbers from a Mersenne twister.
#include "noise/noise.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HASH_SIZE = 4096, GRADIENT_SIZE = 267, PERLIN_SIZE = 2048, RANDOM_SIZE = 32768, WAVES = 32 };

static const double EPS = 1e-10; // POV-Ray's near-zero

// Written by noise_prepare(), read-only after it.
static struct {
    uint16_t hash[2 * HASH_SIZE];
    double gradient[GRADIENT_SIZE];
    double terms[GRADIENT_SIZE - 3][4]; // from each number on: half of it, and the next three
    uint16_t perlin_order[2 * PERLIN_SIZE + 2];
    Vec3 perlin_gradient[2 * PERLIN_SIZE + 2];
    double random[RANDOM_SIZE];
    Vec3 wave_center[WAVES]; // the first ones; more are made when asked for
    double wave_frequency[WAVES];
} table;
static pthread_once_t table_once = PTHREAD_ONCE_INIT;

// ---- the tables -------------------------------------------------------------------------------

// 15 bits a step.
static uint32_t linear_next(uint32_t *state) {
    *state = *state * 1812433253u + 12345u;
    return *state >> 16 & 0x7FFF;
}

static void make_hash(void) {
    uint32_t state = 0;
    for (int i = 0; i < HASH_SIZE; i++)
        table.hash[i] = (uint16_t)i;
    for (int i = HASH_SIZE - 1; i >= 0; i--) {
        uint32_t j = linear_next(&state) % HASH_SIZE;
        uint16_t swap = table.hash[i];
        table.hash[i] = table.hash[j];
        table.hash[j] = swap;
    }
    memcpy(table.hash + HASH_SIZE, table.hash, HASH_SIZE * sizeof *table.hash);
}

// CRC-16, reflected polynomial 0xA001, of the number's bytes from the highest down.
static uint32_t checksum(uint32_t crc, double v) {
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    for (int shift = 56; shift >= 0; shift -= 8) {
        crc ^= (uint32_t)(bits >> shift & 0xFF);
        for (int i = 0; i < 8; i++)
            crc = crc & 1 ? crc >> 1 ^ 0xA001 : crc >> 1;
    }
    return crc;
}

// The checksum of 0.12345 i, three times over, brought to -1..1 and cut to six digits.
static void make_gradient(void) {
    for (int i = 0; i < GRADIENT_SIZE; i++) {
        uint32_t crc = 0;
        for (int k = 0; k < 3; k++)
            crc = checksum(crc, 0.12345 * i);
        char digits[32];
        snprintf(digits, sizeof digits, "%.6g", crc * 2.0 / 65535.0 - 1.0);
        table.gradient[i] = strtod(digits, NULL);
    }
    for (int i = 0; i < GRADIENT_SIZE - 3; i++) {
        const double *g = &table.gradient[i];
        const double terms[4] = {g[0] * 0.5, g[1], g[2], g[3]};
        memcpy(table.terms[i], terms, sizeof terms);
    }
}

static void make_perlin(void) {
    uint32_t state = 1;
    for (int i = 0; i < PERLIN_SIZE; i++) {
        Vec3 v;
        double length2;
        do {
            v.x = ((int)(linear_next(&state) % 4096) - 2048) / 2048.0;
            v.y = ((int)(linear_next(&state) % 4096) - 2048) / 2048.0;
            v.z = ((int)(linear_next(&state) % 4096) - 2048) / 2048.0;
            length2 = vec_dot(v, v);
        } while (length2 < 1e-5 || length2 > 1.0);
        table.perlin_gradient[i] = vec_scale(v, 1.0 / sqrt(length2));
        table.perlin_order[i] = (uint16_t)i;
    }
    // Only every other slot is shuffled, and slot 2048, a second 0, takes part: as POV-Ray has it.
    table.perlin_order[PERLIN_SIZE] = 0;
    for (int i = PERLIN_SIZE; i > 0; i -= 2) {
        uint16_t swap = table.perlin_order[i];
        uint32_t j = linear_next(&state) % PERLIN_SIZE;
        table.perlin_order[i] = table.perlin_order[j];
        table.perlin_order[j] = swap;
    }
    for (int i = 0; i < PERLIN_SIZE + 2; i++) {
        table.perlin_order[PERLIN_SIZE + i] = table.perlin_order[i];
        table.perlin_gradient[PERLIN_SIZE + i] = table.perlin_gradient[i];
    }
}

// Mersenne twister MT19937, seed 5489.
static void make_random(void) {
    enum { N = 624, M = 397 };
    uint32_t s[N];
    s[0] = 5489;
    for (uint32_t i = 1; i < N; i++)
        s[i] = 1812433253u * (s[i - 1] ^ s[i - 1] >> 30) + i;
    for (int n = 0; n < RANDOM_SIZE; n++) {
        int i = n % N;
        uint32_t y = (s[i] & 0x80000000u) | (s[(i + 1) % N] & 0x7FFFFFFFu);
        s[i] = s[(i + M) % N] ^ y >> 1 ^ (y & 1 ? 0x9908B0DFu : 0);
        y = s[i];
        y ^= y >> 11;
        y ^= y << 7 & 0x9D2C5680u;
        y ^= y << 15 & 0xEFC60000u;
        y ^= y >> 18;
        table.random[n] = y * 0x1p-32;
    }
}

static void make_waves(void);

static void make_tables(void) {
    make_hash();
    make_gradient();
    make_perlin();
    make_random();
    make_waves();
}

void noise_prepare(void) { pthread_once(&table_once, make_tables); }

// ---- the lattice ------------------------------------------------------------------------------

int noise_int(double x) { return x > -2147483649.0 && x < 2147483648.0 ? (int)x : INT_MIN; }

// How far p is into its cell along one axis.
typedef struct {
    uint32_t cell;    // 0..4095
    double near, far; // distances from the two lattice planes: near in 0..1, far = near - 1
    double weight_near, weight_far;
} Axis;

static Axis axis_of(double x) {
    int t = x >= 0.0 ? noise_int(x) : noise_int(x - (1.0 - EPS));
    double f = x - t, s = f * f * (3.0 - 2.0 * f);
    return (Axis){((uint32_t)t + 10000u) & (HASH_SIZE - 1), f, f - 1.0, 1.0 - s, s};
}

// Two corners of the cell at a time, those that differ in x only: SSE2 has two lanes on every
// machine, and each lane rounds as a number alone does. Corner a + 2 b + 4 c is the one at a, b, c.
typedef double Pair __attribute__((vector_size(16)));

typedef struct {
    const double *gradient[8]; // the first of four numbers: a constant, and factors of x, y, z
    Pair weight[4];
    Pair x; // the distances from the two planes
    double y[2], z[2];
} Cell;

static inline Cell cell_of(Vec3 p) {
    const Axis x = axis_of(p.x), y = axis_of(p.y), z = axis_of(p.z);
    const uint16_t *hash = table.hash;
    Cell cell = {.x = {x.near, x.far}, .y = {y.near, y.far}, .z = {z.near, z.far}};
    for (uint32_t a = 0; a < 2; a++) {
        uint32_t i = hash[x.cell + a];
        for (uint32_t b = 0; b < 2; b++) {
            uint32_t j = hash[i ^ (y.cell + b)];
            for (uint32_t c = 0; c < 2; c++)
                cell.gradient[a + 2 * b + 4 * c] = table.terms[hash[j ^ (z.cell + c)] & 255];
        }
    }
    const Pair wx = {x.weight_near, x.weight_far};
    for (int b = 0; b < 2; b++) {
        Pair wxy = wx * (b ? y.weight_far : y.weight_near);
        cell.weight[b] = wxy * z.weight_near;
        cell.weight[b + 2] = wxy * z.weight_far;
    }
    return cell;
}

// What corners 2 pair and 2 pair + 1 add to that component (0..2).
static inline Pair cell_terms(const Cell *cell, int pair, int component) {
    const double *g = cell->gradient[2 * pair] + 16 * component;
    const double *h = cell->gradient[2 * pair + 1] + 16 * component;
    const Pair constant = {g[0], h[0]}, gx = {g[1], h[1]}, gy = {g[2], h[2]}, gz = {g[3], h[3]};
    return cell->weight[pair] *
           (constant + gx * cell->x + gy * cell->y[pair & 1] + gz * cell->z[pair >> 1]);
}

static double clamp01(double v) { return v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v; }

// Scalar and vector noise add their corners in different orders.
static double lattice_value(Vec3 p) {
    const Cell cell = cell_of(p);
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        Pair terms = cell_terms(&cell, i, 0);
        sum += terms[0];
        sum += terms[1];
    }
    return sum;
}

static inline double vector_component(const Cell *cell, int component) {
    const Pair t0 = cell_terms(cell, 0, component), t1 = cell_terms(cell, 1, component),
               t2 = cell_terms(cell, 2, component), t3 = cell_terms(cell, 3, component);
    return 0.0 + t0[0] + t0[1] + t1[1] + t1[0] + t3[0] + t3[1] + t2[1] + t2[0];
}

Vec3 noise_vector(Vec3 p) {
    const Cell cell = cell_of(p);
    return vec3(vector_component(&cell, 0), vector_component(&cell, 1), vector_component(&cell, 2));
}

// ---- Perlin's ---------------------------------------------------------------------------------

typedef struct {
    uint32_t low, high; // the two lattice planes, 0..2047
    double near, far, s;
} PerlinAxis;

static PerlinAxis perlin_axis(double x) {
    double t = x + 10000000.023157213; // far from the origin's symmetry
    int i = noise_int(floor(t));
    double f = t - i;
    uint32_t low = (uint32_t)i & (PERLIN_SIZE - 1);
    return (PerlinAxis){low, (low + 1) & (PERLIN_SIZE - 1), f, f - 1.0, f * f * (3.0 - 2.0 * f)};
}

static double lerp(double t, double a, double b) { return a + t * (b - a); }

static double perlin_corner(const PerlinAxis axes[3], int a, int b, int c) {
    const PerlinAxis *x = &axes[0], *y = &axes[1], *z = &axes[2];
    uint32_t i = table.perlin_order[a ? x->high : x->low];
    uint32_t j = table.perlin_order[i + (b ? y->high : y->low)];
    Vec3 g = table.perlin_gradient[j + (c ? z->high : z->low)];
    return vec_dot(vec3(a ? x->far : x->near, b ? y->far : y->near, c ? z->far : z->near), g);
}

static double perlin_value(Vec3 p) {
    const PerlinAxis axes[3] = {perlin_axis(p.x), perlin_axis(p.y), perlin_axis(p.z)};
    double v[2][2];
    for (int b = 0; b < 2; b++)
        for (int c = 0; c < 2; c++)
            v[b][c] = lerp(axes[0].s, perlin_corner(axes, 0, b, c), perlin_corner(axes, 1, b, c));
    return lerp(axes[2].s, lerp(axes[1].s, v[0][0], v[1][0]), lerp(axes[1].s, v[0][1], v[1][1]));
}

// ---- what is asked for ------------------------------------------------------------------------

double noise_value(Vec3 p, int generator) {
    assert(table.hash[0] != 0); // noise_prepare() has run
    switch (generator) {
    case 2:
        return clamp01((lattice_value(p) + 1.05242) * 0.48985582);
    case 3:
        return clamp01(0.5 * (1.59 * perlin_value(p) + 0.985));
    default:
        return clamp01(lattice_value(p) + 0.5);
    }
}

// Generators 2 and 3 are spread wider in sums: 2n - 0.5. Only the first term is clamped.
double noise_turbulence(Vec3 p, const NoiseOctaves *octaves, int generator) {
    bool wide = generator > 1;
    double n = noise_value(p, generator), value = wide ? clamp01(2.0 * n - 0.5) : n;
    double lambda = octaves->lambda, omega = octaves->omega;
    for (int i = 2; i <= octaves->octaves; i++) {
        n = noise_value(vec_scale(p, lambda), generator);
        value += omega * (wide ? 2.0 * n - 0.5 : n);
        lambda *= octaves->lambda;
        omega *= octaves->omega;
    }
    return value;
}

Vec3 noise_turbulence_vector(Vec3 p, const NoiseOctaves *octaves) {
    Vec3 value = noise_vector(p);
    double lambda = octaves->lambda, omega = octaves->omega;
    for (int i = 2; i <= octaves->octaves; i++) {
        value = vec_madd(value, omega, noise_vector(vec_scale(p, lambda)));
        lambda *= octaves->lambda;
        omega *= octaves->omega;
    }
    return value;
}

// The linear generator i steps on: x -> a x + c, squared again and again.
static uint32_t linear_jump(uint32_t state, uint32_t i) {
    uint32_t a = 1812433253u, c = 12345u;
    for (; i > 0; i >>= 1) {
        if (i & 1)
            state = state * a + c;
        c *= a + 1;
        a *= a;
    }
    return state;
}

static void make_wave(uint32_t i, Vec3 *center, double *frequency) {
    Vec3 v = noise_vector(vec3(i, 0.0, 0.0));
    double length = vec_length(v);
    *center = vec3(v.x / length, v.y / length, v.z / length);
    uint32_t state = linear_jump((uint32_t)-560851967, i);
    *frequency = linear_next(&state) * 0.000030518509476 + 0.01;
}

static void make_waves(void) {
    for (uint32_t i = 0; i < WAVES; i++)
        make_wave(i, &table.wave_center[i], &table.wave_frequency[i]);
}

void noise_wave(uint32_t i, Vec3 *center, double *frequency) {
    if (i < WAVES) {
        *center = table.wave_center[i];
        *frequency = table.wave_frequency[i];
    } else {
        make_wave(i, center, frequency);
    }
}

uint32_t noise_cell(int x, int y, int z) {
    uint32_t h = table.hash[x & (HASH_SIZE - 1)];
    h = table.hash[h ^ (uint32_t)(y & (HASH_SIZE - 1))];
    return table.hash[h ^ (uint32_t)(z & (HASH_SIZE - 1))];
}

double noise_random(uint32_t index) { return table.random[index % RANDOM_SIZE]; }
