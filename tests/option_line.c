// SPDX-License-Identifier: MIT
#include "option_line.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <string.h>

RenderOptions options_of_line(Arena *arena, const char *line) {
    char *words[16] = {arena_strdup(arena, "qirender")}, *save = NULL;
    int count = 1;
    for (char *w = strtok_r(arena_strdup(arena, line), " ", &save); w;
         w = strtok_r(NULL, " ", &save)) {
        assert_true(count < 16);
        words[count++] = w;
    }
    RenderOptions o = options_default();
    if (!options_parse(PROGRAM_QIRENDER, count, words, arena, &o))
        fail_msg("refused: %s", line);
    o.verbose = false;
    return o;
}
