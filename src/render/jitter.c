// SPDX-License-Identifier: MIT
// POV-Ray's jitter (facts: rendering 2.5): a place is hashed through a permutation of 4096 numbers
// to one of 256 offsets. Both tables are worked out once, before the threads start.
#include "render/sample.h"

#include <math.h>
#include <pthread.h>

enum { PERMUTATION = 4096, OFFSETS = 256 };

static struct {
    int16_t permutation[PERMUTATION];
    float offset[OFFSETS];
} tables;

// Bits 0..14 of the CRC-16/ARC of one byte (polynomial 0x8005, reflected 0xA001).
static int crc15(int byte) {
    unsigned crc = (unsigned)byte;
    for (int bit = 0; bit < 8; bit++)
        crc = crc & 1u ? (crc >> 1) ^ 0xA001u : crc >> 1;
    return (int)(crc & 0x7FFFu);
}

static void fill_tables(void) {
    for (int i = 0; i < PERMUTATION; i++)
        tables.permutation[i] = (int16_t)i;
    uint32_t seed = 0;
    for (int i = PERMUTATION - 1; i >= 0; i--) {
        seed = seed * 1812433253u + 12345u;
        int j = (int)((seed >> 16) & 0x7FFFu) % PERMUTATION;
        int16_t keep = tables.permutation[i];
        tables.permutation[i] = tables.permutation[j];
        tables.permutation[j] = keep;
    }
    // The offsets have six decimals; halves are rounded away from zero.
    for (int i = 0; i < OFFSETS; i++)
        tables.offset[i] = (float)(round((crc15(i) / 32768.0 - 0.5) * 1e6) / 1e6);
}

static void prepare(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill_tables);
}

static double offset(int first, int second) {
    int hashed = tables.permutation[first & (PERMUTATION - 1)] ^ second;
    return tables.offset[tables.permutation[hashed & (PERMUTATION - 1)] & (OFFSETS - 1)];
}

void sample_jitter(double x, double y, double *jx, double *jy) {
    prepare();
    *jx = offset((int)(1021.0 * x), (int)(1019.0 * y));
    *jy = offset((int)(1019.0 * x), (int)(1021.0 * y));
}

int sample_permutation(int i) {
    prepare();
    return tables.permutation[i & (PERMUTATION - 1)];
}
