// SPDX-License-Identifier: MIT
// Which of the kernels runs: the best one that the machine can, or the one asked for.
#include "patch/kernels.h"

#include <string.h>

extern const Kernel kernel_scalar, kernel_avx2, kernel_avx512;

static const Kernel *chosen;

static bool usable(const char *name) {
    if (strcmp(name, "scalar") == 0)
        return true;
#ifdef __x86_64__
    __builtin_cpu_init();
    if (strcmp(name, "avx2") == 0)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
               __builtin_cpu_supports("bmi2");
    if (strcmp(name, "avx512") == 0)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#endif
    return false;
}

// Best first.
static const Kernel *const kernels[] = {
#ifdef __x86_64__
    &kernel_avx512,
    &kernel_avx2,
#endif
    &kernel_scalar,
};
enum { COUNT = sizeof kernels / sizeof kernels[0] };

PatchIsa patch_isa_choose(const char *name) {
    for (int i = 0; i < COUNT; i++) {
        if (name && strcmp(name, kernels[i]->name) != 0)
            continue;
        if (usable(kernels[i]->name)) {
            chosen = kernels[i];
            return PATCH_ISA_CHOSEN;
        }
        if (name)
            return PATCH_ISA_UNUSABLE;
    }
    return PATCH_ISA_UNKNOWN;
}

const char *patch_isa_name(void) { return kernels_chosen()->name; }

const Kernel *kernels_chosen(void) {
    if (!chosen)
        patch_isa_choose(NULL);
    return chosen;
}
