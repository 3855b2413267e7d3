// SPDX-License-Identifier: MIT
// build/stress [--seed S] [--rays N] [--watertight N] [--case NAME] [--method NAME]
//              [--isa NAME] [--scene K [--ray K]]: see tests/stress.h. Exit status 1 when qi fails.
#include "tests/stress.h"

#include "patch/patch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int usage(void) {
    fprintf(stderr, "usage: build/stress [--seed S] [--rays N] [--watertight N] [--case NAME] "
                    "[--method NAME] [--isa scalar|avx2|avx512] [--scene K [--ray K]]\n");
    return 2;
}

int main(int argc, char **argv) {
    StressOptions options = stress_options_default();
    bool edges = false;
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 == argc)
            return usage();
        const char *value = argv[i + 1];
        if (strcmp(argv[i], "--seed") == 0)
            options.seed = strtoull(value, NULL, 10);
        else if (strcmp(argv[i], "--rays") == 0)
            options.rays = strtod(value, NULL);
        else if (strcmp(argv[i], "--watertight") == 0)
            options.watertight = strtod(value, NULL), edges = true;
        else if (strcmp(argv[i], "--case") == 0)
            options.only_case = value;
        else if (strcmp(argv[i], "--method") == 0)
            options.only_method = value;
        else if (strcmp(argv[i], "--isa") == 0 && patch_isa_choose(value) == PATCH_ISA_CHOSEN)
            continue;
        else if (strcmp(argv[i], "--scene") == 0)
            options.scene = strtoll(value, NULL, 10);
        else if (strcmp(argv[i], "--ray") == 0)
            options.ray = strtoll(value, NULL, 10);
        else
            return usage();
    }
    if (!edges)
        options.watertight = options.rays;
    return stress_run(&options) > 0;
}
