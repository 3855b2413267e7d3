// SPDX-License-Identifier: MIT
// The options of a line of switches.
#ifndef TESTS_OPTION_LINE_H
#define TESTS_OPTION_LINE_H

#include "options/options.h"

// As qirender reads them, but silent. Memory in arena. Fails the running cmocka test if a word is
// refused; there are at most 15.
RenderOptions options_of_line(Arena *arena, const char *line);

#endif
