// SPDX-License-Identifier: MIT
// Inside the room: numbers as short as they can be, and JSON laid out for reading.
#ifndef MODEL_JSON_LAYOUT_H
#define MODEL_JSON_LAYOUT_H

#include <stdio.h>

enum { JSON_NUMBER_SIZE = 32 };

// The shortest text that reads back to the same bits; value must be finite.
void json_double(char out[JSON_NUMBER_SIZE], double value);
void json_float(char out[JSON_NUMBER_SIZE], float value);

// Writes the compact JSON text (valid, no blanks outside strings) with line breaks: what fits in a
// line stays on it, except the document itself; arrays of numbers, and arrays inside arrays (rows
// of control points), are never broken. Ends with a newline.
void json_layout(const char *compact, FILE *out);

#endif
