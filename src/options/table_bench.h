// SPDX-License-Identifier: MIT
// What the values of qibench's own options mean (OptionRow.apply).
#ifndef OPTIONS_TABLE_BENCH_H
#define OPTIONS_TABLE_BENCH_H

#include "options/table.h"

bool bench_apply_rounds(Parse *parse, const OptionRow *row, bool on, const char *value);
bool bench_apply_size(Parse *parse, const OptionRow *row, bool on, const char *value);
bool bench_apply_within(Parse *parse, const OptionRow *row, bool on, const char *value);
bool bench_apply_whole(Parse *parse, const OptionRow *row, bool on, const char *value);
bool bench_apply_povray(Parse *parse, const OptionRow *row, bool on, const char *value);
bool bench_apply_view(Parse *parse, const OptionRow *row, bool on, const char *value);

#endif
