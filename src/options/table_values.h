// SPDX-License-Identifier: MIT
// What the values of options mean that are more than a number or a text (OptionRow.apply).
#ifndef OPTIONS_TABLE_VALUES_H
#define OPTIONS_TABLE_VALUES_H

#include "options/table.h"

bool option_apply_antialias(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_antialias_flag(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_jitter(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_format(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_format_keyword(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_file_gamma(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_declare(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_library(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_allow_write(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_clock(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_float(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_include_ini(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_command(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_console(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_all_console(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_block_size(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_version(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_display(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_dither_method(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_dither(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_method(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_region(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_pixel(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_nudge(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_aov(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_tolerance(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_accuracy(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_prepare(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_isa(Parse *parse, const OptionRow *row, bool on, const char *value);
bool option_apply_limit(Parse *parse, const OptionRow *row, bool on, const char *value);

#endif
