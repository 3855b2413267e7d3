// SPDX-License-Identifier: MIT
// What a program prints with #debug, from the converter and from povray. Only lines that begin with
// '@' count; povray breaks lines at 80 columns, so they must be shorter.
#ifndef TESTS_DEBUG_OUTPUT_H
#define TESTS_DEBUG_OUTPUT_H

#include <stdbool.h>

bool debug_has_povray(void);
// The folder of a program is a library path. Both: the lines, in the heap, after them a "!" and the
// message if the program is wrong (povray: only the "!"). path: of the program.
char *debug_of_povray(const char *path);
char *debug_of_converter(const char *path);

// Fails the running test where the lines differ, naming the line of the program that begins with
// the same word ("@17 ..." is looked for as `"@17 `), and prints both.
// The program may be wrong for both, unless it must be right.
void assert_debug_equal(const char *path, bool right);

#endif
