// SPDX-License-Identifier: MIT
// Vectors of rays: as many lanes as a register of the instruction set has. Each lane is computed by
// itself with the operations of the code for one ray, so the same bits come out at every width.
// Comparisons give one bit a lane. As simd.h this file holds the intrinsics, and no other.
#ifndef KERNEL_WIDE_H
#define KERNEL_WIDE_H

#include "kernel/simd.h"

#include <math.h>

#if defined __AVX512F__ && defined __AVX512VL__ && defined __AVX512DQ__
enum { FLOATS = 16 };
#elif defined __AVX__
enum { FLOATS = 8 };
#else
enum { FLOATS = 4 };
#endif
enum { DOUBLES = FLOATS / 2 };

typedef float WF __attribute__((vector_size(4 * FLOATS)));
typedef int32_t WI __attribute__((vector_size(4 * FLOATS)));
typedef double WD __attribute__((vector_size(8 * DOUBLES)));
typedef int64_t WL __attribute__((vector_size(8 * DOUBLES)));
typedef float HalfWF __attribute__((vector_size(4 * DOUBLES)));

static inline WF wf_load(const float *p) {
    WF v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline void wf_store(float *p, WF v) { memcpy(p, &v, sizeof v); }
static inline WF wf_all(float x) { return x - (WF){0}; }
static inline WD wd_load(const double *p) {
    WD v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline void wd_store(double *p, WD v) { memcpy(p, &v, sizeof v); }
static inline WD wd_all(double x) { return x - (WD){0}; }

// Between precisions, DOUBLES at a time.
static inline WD wd_from_floats(const float *p) {
    HalfWF v;
    memcpy(&v, p, sizeof v);
    return __builtin_convertvector(v, WD);
}
static inline void wd_to_floats(float *p, WD a) {
    HalfWF v = __builtin_convertvector(a, HalfWF);
    memcpy(p, &v, sizeof v);
}

static inline WF wf_abs(WF a) { return (WF)((WI)a & INT32_MAX); }
// a with its sign turned where b has one.
static inline WF wf_turn(WF a, WF b) { return (WF)((WI)a ^ ((WI)b & INT32_MIN)); }
static inline WD wd_abs(WD a) { return (WD)((WL)a & INT64_MAX); }
// The size of a, which has no sign, with that of b.
static inline WD wd_sign(WD a, WD b) { return (WD)((WL)a | ((WL)b & INT64_MIN)); }

// min, max: a < b ? a : b and a > b ? a : b. le and so on: a <= b, false for what is not a number.
// pick: where a bit is set a, else b. least, most: of all lanes, which are numbers.
#if defined __AVX512F__ && defined __AVX512VL__ && defined __AVX512DQ__
static inline WF wf_min(WF a, WF b) { return (WF)_mm512_min_ps((__m512)a, (__m512)b); }
static inline WF wf_max(WF a, WF b) { return (WF)_mm512_max_ps((__m512)a, (__m512)b); }
static inline WD wd_min(WD a, WD b) { return (WD)_mm512_min_pd((__m512d)a, (__m512d)b); }
static inline WD wd_max(WD a, WD b) { return (WD)_mm512_max_pd((__m512d)a, (__m512d)b); }
static inline WD wd_sqrt(WD a) { return (WD)_mm512_sqrt_pd((__m512d)a); }
static inline unsigned wf_le(WF a, WF b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
}
static inline unsigned wf_lt(WF a, WF b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}
static inline unsigned wd_le(WD a, WD b) {
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LE_OQ);
}
static inline unsigned wd_lt(WD a, WD b) {
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
}
static inline unsigned wd_eq(WD a, WD b) {
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_EQ_OQ);
}
static inline WF wf_pick(unsigned bits, WF a, WF b) {
    return (WF)_mm512_mask_blend_ps((__mmask16)bits, (__m512)b, (__m512)a);
}
static inline float wf_least(WF a) { return _mm512_reduce_min_ps((__m512)a); }
static inline float wf_most(WF a) { return _mm512_reduce_max_ps((__m512)a); }
static inline WD wd_pick(unsigned bits, WD a, WD b) {
    return (WD)_mm512_mask_blend_pd((__mmask8)bits, (__m512d)b, (__m512d)a);
}
#else
static inline unsigned wi_bits(WI a);
static inline unsigned wl_bits(WL a);
#if defined __AVX__
static inline WF wf_min(WF a, WF b) { return (WF)_mm256_min_ps((__m256)a, (__m256)b); }
static inline WF wf_max(WF a, WF b) { return (WF)_mm256_max_ps((__m256)a, (__m256)b); }
static inline WD wd_min(WD a, WD b) { return (WD)_mm256_min_pd((__m256d)a, (__m256d)b); }
static inline WD wd_max(WD a, WD b) { return (WD)_mm256_max_pd((__m256d)a, (__m256d)b); }
static inline WD wd_sqrt(WD a) { return (WD)_mm256_sqrt_pd((__m256d)a); }
static inline unsigned wi_bits(WI a) { return (unsigned)_mm256_movemask_ps((__m256)a); }
static inline unsigned wl_bits(WL a) { return (unsigned)_mm256_movemask_pd((__m256d)a); }
#elif defined __SSE2__
static inline WF wf_min(WF a, WF b) { return (WF)_mm_min_ps((__m128)a, (__m128)b); }
static inline WF wf_max(WF a, WF b) { return (WF)_mm_max_ps((__m128)a, (__m128)b); }
static inline WD wd_min(WD a, WD b) { return (WD)_mm_min_pd((__m128d)a, (__m128d)b); }
static inline WD wd_max(WD a, WD b) { return (WD)_mm_max_pd((__m128d)a, (__m128d)b); }
static inline WD wd_sqrt(WD a) { return (WD)_mm_sqrt_pd((__m128d)a); }
static inline unsigned wi_bits(WI a) { return (unsigned)_mm_movemask_ps((__m128)a); }
static inline unsigned wl_bits(WL a) { return (unsigned)_mm_movemask_pd((__m128d)a); }
#else
static inline unsigned wi_bits(WI a) {
    unsigned bits = 0;
    for (int i = 0; i < FLOATS; i++)
        bits |= (a[i] < 0 ? 1u : 0u) << i;
    return bits;
}
static inline unsigned wl_bits(WL a) {
    unsigned bits = 0;
    for (int i = 0; i < DOUBLES; i++)
        bits |= (a[i] < 0 ? 1u : 0u) << i;
    return bits;
}
static inline WF wf_min(WF a, WF b) {
    WI less = a < b;
    return (WF)((less & (WI)a) | (~less & (WI)b));
}
static inline WF wf_max(WF a, WF b) {
    WI more = a > b;
    return (WF)((more & (WI)a) | (~more & (WI)b));
}
static inline WD wd_min(WD a, WD b) {
    WL less = a < b;
    return (WD)((less & (WL)a) | (~less & (WL)b));
}
static inline WD wd_max(WD a, WD b) {
    WL more = a > b;
    return (WD)((more & (WL)a) | (~more & (WL)b));
}
static inline WD wd_sqrt(WD a) {
    for (int i = 0; i < DOUBLES; i++)
        a[i] = sqrt(a[i]);
    return a;
}
#endif
static inline unsigned wf_le(WF a, WF b) { return wi_bits(a <= b); }
static inline unsigned wf_lt(WF a, WF b) { return wi_bits(a < b); }
static inline unsigned wd_le(WD a, WD b) { return wl_bits(a <= b); }
static inline unsigned wd_lt(WD a, WD b) { return wl_bits(a < b); }
static inline unsigned wd_eq(WD a, WD b) { return wl_bits(a == b); }
static inline WF wf_pick(unsigned bits, WF a, WF b) {
    static const _Alignas(32) int32_t lanes[8] = {1, 2, 4, 8, 16, 32, 64, 128};
    WI bit;
    memcpy(&bit, lanes, sizeof bit);
    WI set = (bit & (int32_t)bits) != 0;
    return (WF)((set & (WI)a) | (~set & (WI)b));
}
static inline float wf_least(WF a) {
    float least = a[0];
    for (int i = 1; i < FLOATS; i++)
        least = a[i] < least ? a[i] : least;
    return least;
}
static inline float wf_most(WF a) {
    float most = a[0];
    for (int i = 1; i < FLOATS; i++)
        most = a[i] > most ? a[i] : most;
    return most;
}
static inline WD wd_pick(unsigned bits, WD a, WD b) {
    static const _Alignas(32) int64_t lanes[4] = {1, 2, 4, 8};
    WL bit;
    memcpy(&bit, lanes, sizeof bit);
    WL set = (bit & (int64_t)bits) != 0;
    return (WD)((set & (WL)a) | (~set & (WL)b));
}
#endif

#endif
