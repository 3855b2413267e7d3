// SPDX-License-Identifier: MIT
// Four floats or two doubles side by side, with what every machine of the family has (SSE2), or one
// by one: the same bits either way. The kernel, which is compiled per instruction set, has its own
// (simd.h).
#ifndef BASE_LANES_H
#define BASE_LANES_H

#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

typedef float Lanes __attribute__((vector_size(16)));
typedef double Lanes2 __attribute__((vector_size(16)));

static inline Lanes lanes_load(const float *p) {
    Lanes v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline Lanes lanes_all(float x) { return (Lanes){x, x, x, x}; }
static inline Lanes2 lanes2_load(const double *p) {
    Lanes2 v;
    memcpy(&v, p, sizeof v);
    return v;
}

#ifdef __SSE2__
// a < b ? a : b, so b where one is not a number; and the same with >.
static inline Lanes lanes_min(Lanes a, Lanes b) { return (Lanes)_mm_min_ps((__m128)a, (__m128)b); }
static inline Lanes lanes_max(Lanes a, Lanes b) { return (Lanes)_mm_max_ps((__m128)a, (__m128)b); }
static inline Lanes2 lanes2_min(Lanes2 a, Lanes2 b) {
    return (Lanes2)_mm_min_pd((__m128d)a, (__m128d)b);
}
static inline Lanes2 lanes2_max(Lanes2 a, Lanes2 b) {
    return (Lanes2)_mm_max_pd((__m128d)a, (__m128d)b);
}
static inline Lanes2 lanes2_abs(Lanes2 a) {
    return (Lanes2)_mm_andnot_pd(_mm_set1_pd(-0.0), (__m128d)a);
}
// One bit a lane: a <= b.
static inline unsigned lanes_at_most(Lanes a, Lanes b) {
    return (unsigned)_mm_movemask_ps(_mm_cmple_ps((__m128)a, (__m128)b));
}
#else
static inline Lanes lanes_min(Lanes a, Lanes b) {
    for (int i = 0; i < 4; i++)
        a[i] = a[i] < b[i] ? a[i] : b[i];
    return a;
}
static inline Lanes lanes_max(Lanes a, Lanes b) {
    for (int i = 0; i < 4; i++)
        a[i] = a[i] > b[i] ? a[i] : b[i];
    return a;
}
static inline Lanes2 lanes2_min(Lanes2 a, Lanes2 b) {
    return (Lanes2){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}
static inline Lanes2 lanes2_max(Lanes2 a, Lanes2 b) {
    return (Lanes2){a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
}
static inline Lanes2 lanes2_abs(Lanes2 a) {
    return (Lanes2){a[0] < 0.0 ? -a[0] : a[0], a[1] < 0.0 ? -a[1] : a[1]};
}
static inline unsigned lanes_at_most(Lanes a, Lanes b) {
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; i++)
        bits |= (a[i] <= b[i] ? 1U : 0U) << i;
    return bits;
}
#endif

#endif
