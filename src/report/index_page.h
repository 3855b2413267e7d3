// SPDX-License-Identifier: MIT
// The page over several comparisons: a row a scene, each with a link to its own page.
#ifndef REPORT_INDEX_PAGE_H
#define REPORT_INDEX_PAGE_H

#include "report/compare_page.h"

typedef struct {
    const char *link;  // of the scene's page, relative to this one
    const char *title; // the scene
    const char *verdict;
    const char *failed; // why there is no comparison; NULL: there is one
    ImageDifference difference;
    double seconds[2];       // POV-Ray, ours
    int causes[CAUSE_COUNT]; // of the worst places
    const Image *picture;    // ours, small; NULL: none
} IndexRow;

// Writes the page whole or not at all; dies with a message if it cannot.
void index_page_write(const IndexRow *rows, size_t count, const char *machine, const char *path);

#endif
