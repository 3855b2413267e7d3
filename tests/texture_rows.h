// SPDX-License-Identifier: MIT
// For tests of whole textures: each row is one texture on a curved patch, rendered by POV-Ray and
// by us with POV-Ray's triangles, so that both meet the surface at the same points. What may differ
// is a pixel on an edge between two triangles or two colours, where the last bit of the point
// decides.
#ifndef TESTS_TEXTURE_ROWS_H
#define TESTS_TEXTURE_ROWS_H

#include <stddef.h>

typedef struct {
    const char *include; // a file name, or ""
    const char *text;    // what stands in the patch
} TextureRow;

// Ends the test when a picture differs, or shows nothing, or we warn of something. Skips it when
// there is no povray.
void texture_rows_check(const TextureRow *rows, size_t count);

#endif
