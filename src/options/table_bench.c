// SPDX-License-Identifier: MIT
#include "options/table_bench.h"

#include <stdio.h>
#include <string.h>

bool bench_apply_rounds(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    int *rounds = &parse->options->bench.rounds;
    return (option_integer(value, rounds) && *rounds >= 1 && *rounds <= 21 && *rounds % 2) ||
           option_complain(parse, "an odd number up to 21");
}

bool bench_apply_size(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    RenderOptions *o = parse->options;
    char rest;
    if (sscanf(value, "%dx%d%c", &o->width, &o->height, &rest) == 2 && o->width >= 8 &&
        o->height >= 8 && o->width <= 8192 && o->height <= 8192)
        return true;
    return option_complain(parse, "width and height, 8x8 to 8192x8192");
}

// A number that must lie in the row's range.
bool bench_apply_within(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)on;
    double number;
    if (!option_number(value, &number) || number < row->low || number > row->high) {
        snprintf(parse->why, sizeof parse->why, "a number from %g to %g", row->low, row->high);
        return false;
    }
    *(double *)(void *)((char *)parse->options + row->offset) = number;
    return true;
}

// The same for a whole number.
bool bench_apply_whole(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)on;
    int number;
    if (!option_integer(value, &number) || number < row->low || number > row->high) {
        snprintf(parse->why, sizeof parse->why, "a whole number from %.9g to %.9g", row->low,
                 row->high);
        return false;
    }
    *(int *)(void *)((char *)parse->options + row->offset) = number;
    return true;
}

bool bench_apply_povray(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    parse->options->bench.povray = strcmp(value, "on") == 0;
    return parse->options->bench.povray || strcmp(value, "off") == 0 ||
           option_complain(parse, "on or off");
}

bool bench_apply_view(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    parse->options->bench.view = value;
    return strcmp(value, "full") == 0 || strcmp(value, "zoom") == 0 ||
           strcmp(value, "scattered") == 0 ||
           option_complain(parse, "the views are full, zoom, scattered");
}
