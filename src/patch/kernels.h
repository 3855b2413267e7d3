// SPDX-License-Identifier: MIT
// The fast path of METHOD_QI, compiled once per instruction set (src/kernel). All of them give the
// same bits.
#ifndef PATCH_KERNELS_H
#define PATCH_KERNELS_H

#include "patch/walk.h"

typedef struct {
    const char *name; // scalar, avx2, avx512
    // Answers walk->query; accel, query and nothing else of *walk are set.
    void (*query)(Walk *walk);
} Kernel;

// The one in use: the best that this machine can run, or what was chosen.
const Kernel *kernels_chosen(void);

#endif
