// SPDX-License-Identifier: MIT
// The page of qicompare: two pictures, where and how far they differ, and how they were made. One
// HTML file without anything outside it.
#ifndef REPORT_COMPARE_PAGE_H
#define REPORT_COMPARE_PAGE_H

#include "image/image.h"

typedef struct {
    const char *name;    // "POV-Ray", or the picture's file
    const char *command; // the exact command line; NULL: it was only read
    const char *log;     // what the program said; NULL: nothing
    double seconds;      // of processor time in user mode; < 0: not known
    double elapsed;      // on the wall
    const Image *image;
} CompareSide;

typedef struct {
    const char *title;   // the scene, or "a and b"
    const char *machine; // for the times; NULL: none
    CompareSide side[2]; // the first is the reference
    ImageDifference difference;
    double fail, fail_percent;
    const char *verdict; // PASS, WARNING, FAILURE
} ComparePage;

// Writes the page whole or not at all; dies with a message if it cannot.
void compare_page_write(const ComparePage *page, const char *path);

#endif
