// SPDX-License-Identifier: MIT
// The page of qicompare: two pictures, where and how far they differ, and how they were made. One
// HTML file without anything outside it.
#ifndef REPORT_COMPARE_PAGE_H
#define REPORT_COMPARE_PAGE_H

#include "image/image.h"
#include "report/places.h"
#include "report/run.h"

typedef struct {
    const char *name; // "POV-Ray", or the picture's file
    Run run;          // command NULL: it was only read; seconds < 0: not known
    const Image *image;
} CompareSide;

typedef struct {
    const char *title;   // the scene, or "a and b"
    const char *machine; // for the times; NULL: none
    CompareSide side[2]; // the first is the reference
    int left, top;       // of the part that is compared
    ImageDifference difference;
    double fail, fail_percent;
    const char *verdict; // PASS, WARNING, FAILURE
    int place_count;
    Place places[PLACE_MOST];
} ComparePage;

// Writes the page whole or not at all; dies with a message if it cannot.
void compare_page_write(const ComparePage *page, const char *path);

#endif
