// SPDX-License-Identifier: MIT
// The fast path of METHOD_QI, compiled once per instruction set (src/kernel). All of them give the
// same bits.
#ifndef PATCH_KERNELS_H
#define PATCH_KERNELS_H

#include "patch/walk.h"

// Up to PATCH_PACKET rays, their ranges (or NULL, as in patch.h), and what to ask: nearest or any.
typedef struct {
    const Accel *accel;
    const Ray *rays;
    const PatchRange *ranges;
    int count;
    QueryKind kind;
    PatchStats *stats; // added to, all but hits
    PatchHit *hits;    // written where found, for QUERY_NEAREST
} Packet;

// One bit a ray: what hits, and what must be asked ray by ray.
typedef struct {
    unsigned found, left;
} PacketAnswer;

typedef struct {
    const char *name; // scalar, avx2, avx512
    // Answers walk->query; accel, query and nothing else of *walk are set.
    void (*query)(Walk *walk);
    // Answers for a packet what can be answered for it at once; takes any numbers.
    PacketAnswer (*packet)(const Packet *packet);
} Kernel;

// The one in use: the best that this machine can run, or what was chosen.
const Kernel *kernels_chosen(void);

#endif
