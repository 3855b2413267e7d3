// SPDX-License-Identifier: MIT
// build/csg_trees [FIRST COUNT [bounds] [keep]]: see tests/csg_trees.h. Exit status 1 when a tree
// is not good.
#include "tests/csg_trees.h"

#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
    CsgTreesOptions options = {.first = argc > 2 ? atoi(argv[1]) : 1,
                               .count = argc > 2 ? atoi(argv[2]) : 1000,
                               .width = 96,
                               .height = 72,
                               .program = "build/qirender",
                               .bounded = argc > 3 && strcmp(argv[3], "bounds") == 0,
                               .keep = strcmp(argv[argc - 1], "keep") == 0};
    CsgTreesResult result;
    if (!csg_trees_run(&options, stdout, &result)) {
        fprintf(stderr, "povray is not installed: nothing to compare with\n");
        return 1;
    }
    return result.over > 0 || result.wronger > 0;
}
