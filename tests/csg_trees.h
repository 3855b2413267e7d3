// SPDX-License-Identifier: MIT
// Random trees rendered by povray and by qirender with POV-Ray's triangles, and where they differ,
// who is right.
#ifndef TESTS_CSG_TREES_H
#define TESTS_CSG_TREES_H

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    int first, count; // seeds, 1 to 8999
    int width, height;
    const char *program; // path of qirender
    bool bounded;        // with bounds, which the oracle does not know: it is not asked
    bool keep;           // the folder with the texts and pictures; its name is printed
} CsgTreesOptions;

typedef struct {
    int trees;
    int over;        // trees with more than 0.5 % of their pixels different
    int wronger;     // trees where qirender is wrong at more pixels than povray
    long pixels;     // that differ
    long ours_right; // of those
    long theirs_right;
    long unknown; // neither shows what the oracle expects
} CsgTreesResult;

// Pictures with a seed's tree in a table by depth, one line for each tree that is not good.
// False when povray is not there.
bool csg_trees_run(const CsgTreesOptions *options, FILE *table, CsgTreesResult *result);

#endif
