// SPDX-License-Identifier: MIT
// Differences made visible: a false-colour picture on a logarithmic scale, counts by size, and
// enlarged cut-outs.
#ifndef REPORT_HEAT_H
#define REPORT_HEAT_H

#include "image/image.h"

// The classes of the count: equal, under one step of 8 bits, 1, 2..3, 4..7, ... 128..255.
enum { HEAT_CLASSES = 10 };

// The place of a difference d (1 = full range) on the scale: log2(1 + 255 d) / 8, 0..1. Each
// doubling of the difference is one eighth of the scale.
double heat_scale(double difference);
int heat_class(double difference);
const char *heat_class_name(int index); // "equal", "under 1", "1", "2\u20133", ... as HTML
double heat_class_middle(int index);    // a difference in the middle of the class

// differences: one channel, as image_difference() gives it.
Image *heat_map(Arena *arena, const Image *differences);
void heat_count(const Image *differences, uint64_t count[HEAT_CLASSES]);

// The square of `side` pixels around (x, y), moved inside the picture; smaller if the picture is.
// *left, *top: where it was cut.
Image *heat_cut(Arena *arena, const Image *image, int x, int y, int side, int *left, int *top);
// The picture as a screen shows it: float values get the sRGB curve, others stay.
Image *heat_shown(Arena *arena, const Image *image);

#endif
