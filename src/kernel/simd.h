// SPDX-License-Identifier: MIT
// Eight floats or four doubles side by side, the same bits on every instruction set: arithmetic is
// GCC's on vector types, which it splits where registers are shorter; nothing is fused, estimated
// or summed across lanes. What vector types have no operators for is below, and only here
// intrinsics are used.
#ifndef KERNEL_SIMD_H
#define KERNEL_SIMD_H

#include <stdint.h>
#include <string.h>

#ifdef __SSE2__
#include <immintrin.h>
#endif

typedef float F8 __attribute__((vector_size(32)));
typedef int32_t I8 __attribute__((vector_size(32)));
typedef double D4 __attribute__((vector_size(32)));
typedef int64_t L4 __attribute__((vector_size(32)));
typedef float F4 __attribute__((vector_size(16)));

// What will be asked for soon, `bytes` long: all of its lines at once.
static inline void prefetch(const void *p, int bytes) {
    for (int at = 0; at < bytes; at += 64)
        __builtin_prefetch((const char *)p + at);
}

static inline F8 f8_load(const float *p) {
    F8 v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline void f8_store(float *p, F8 v) { memcpy(p, &v, sizeof v); }
static inline F8 f8_all(float x) { return (F8){x, x, x, x, x, x, x, x}; }
// Four times low, four times high; and the halves.
static inline F8 f8_pair(float low, float high) {
    return (F8){low, low, low, low, high, high, high, high};
}
static inline F4 f8_low(F8 a) { return __builtin_shufflevector(a, a, 0, 1, 2, 3); }
static inline F4 f8_high(F8 a) { return __builtin_shufflevector(a, a, 4, 5, 6, 7); }
// The fourth and the eighth become 0.
static inline F8 f8_first_three(F8 a) { return (F8)((I8)a & (I8){-1, -1, -1, 0, -1, -1, -1, 0}); }
static inline D4 d4_load(const double *p) {
    D4 v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline D4 d4_all(double x) { return (D4){x, x, x, x}; }
static inline F4 f4_load(const float *p) {
    F4 v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline F4 f4_all(float x) { return (F4){x, x, x, x}; }

static inline F8 f8_abs(F8 a) { return (F8)((I8)a & 0x7fffffff); }
// a with its sign turned where b has one.
static inline F8 f8_turn(F8 a, F8 b) { return (F8)((I8)a ^ ((I8)b & INT32_MIN)); }

// a < b ? a : b, so b where one is not a number; and the same with >.
#if defined __AVX__
static inline F8 f8_min(F8 a, F8 b) { return (F8)_mm256_min_ps((__m256)a, (__m256)b); }
static inline F8 f8_max(F8 a, F8 b) { return (F8)_mm256_max_ps((__m256)a, (__m256)b); }
// One bit a lane: a comparison's result.
static inline unsigned i8_bits(I8 a) { return (unsigned)_mm256_movemask_ps((__m256)a); }
#elif defined __SSE2__
typedef struct {
    __m128 low, high;
} Halves;
static inline Halves halves(F8 a) {
    Halves h;
    memcpy(&h, &a, sizeof h);
    return h;
}
static inline F8 whole(Halves h) {
    F8 a;
    memcpy(&a, &h, sizeof a);
    return a;
}
static inline F8 f8_min(F8 a, F8 b) {
    Halves x = halves(a), y = halves(b);
    return whole((Halves){_mm_min_ps(x.low, y.low), _mm_min_ps(x.high, y.high)});
}
static inline F8 f8_max(F8 a, F8 b) {
    Halves x = halves(a), y = halves(b);
    return whole((Halves){_mm_max_ps(x.low, y.low), _mm_max_ps(x.high, y.high)});
}
static inline unsigned i8_bits(I8 a) {
    Halves h = halves((F8)a);
    return (unsigned)_mm_movemask_ps(h.low) | (unsigned)_mm_movemask_ps(h.high) << 4;
}
#else
static inline F8 f8_min(F8 a, F8 b) {
    I8 less = a < b;
    return (F8)((less & (I8)a) | (~less & (I8)b));
}
static inline F8 f8_max(F8 a, F8 b) {
    I8 more = a > b;
    return (F8)((more & (I8)a) | (~more & (I8)b));
}
static inline unsigned i8_bits(I8 a) {
    unsigned bits = 0;
    for (int i = 0; i < 8; i++)
        bits |= (a[i] < 0 ? 1u : 0u) << i;
    return bits;
}
#endif

#endif
