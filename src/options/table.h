// SPDX-License-Identifier: MIT
// The one table of all options: parsing, help and suggestions are driven by it.
#ifndef OPTIONS_TABLE_H
#define OPTIONS_TABLE_H

#include "options/options.h"

// ORDER option_kind (apply_row in options.c)
typedef enum {
    OPTION_HEADING, // a line of the help
    OPTION_FLAG,    // bool: +X on, -X off; a word --x without value: on
    OPTION_INT,     // clipped to low..high
    OPTION_NUMBER,  // clipped to low..high
    OPTION_TEXT,    // const char *
    OPTION_SPECIAL, // `apply` decides
    OPTION_IGNORED, // POV-Ray's; changes no picture of ours
} OptionKind;

// Programs that take an option.
enum {
    IN_QIRENDER = 1 << PROGRAM_QIRENDER,
    IN_POV2QI = 1 << PROGRAM_POV2QI,
    IN_QICOMPARE = 1 << PROGRAM_QICOMPARE,
    IN_QIBENCH = 1 << PROGRAM_QIBENCH,
    IN_ALL = IN_QIRENDER | IN_POV2QI | IN_QICOMPARE, // all that take POV-Ray's words
    IN_EVERY = IN_ALL | IN_QIBENCH,
    // Commands of qibench.
    FOR_TRACE = 1 << BENCH_TRACE,
    FOR_SPEED = 1 << BENCH_SPEED,
    FOR_SWEEP = 1 << BENCH_SWEEP,
};

typedef struct Parse Parse;
typedef struct OptionRow OptionRow;

struct OptionRow {
    OptionKind kind;
    const char *letters; // after '+' or '-', upper case; NULL: no switch
    const char *keyword; // before '='; NULL: no INI form
    const char *word;    // after "--"; NULL: none
    const char *value;   // what follows, as the help shows it; NULL: nothing (INI: on, off)
    unsigned programs;
    size_t offset; // of the field in RenderOptions
    double low, high;
    // OPTION_SPECIAL: value is never NULL; on is false after '-'. Fills parse->why and returns
    // false when the value cannot be meant.
    bool (*apply)(Parse *parse, const OptionRow *row, bool on, const char *value);
    const char *help;  // NULL: not shown
    unsigned commands; // of qibench that take it; 0: all
};

extern const OptionRow option_rows[];
extern const size_t option_row_count;

// One command line being read.
struct Parse {
    OptionsProgram program;
    RenderOptions *options;
    Arena *arena;
    Loc loc;         // of the word in an INI file; no file: it stands on the command line
    int depth;       // INI files that name INI files
    bool povray_ini; // POV-Ray's own, of which nothing is remarked
    char why[160];   // what is wrong with a value
};

// One word each. A wrong one is refused (option_refuse). next: the word behind it, or NULL; *used
// counts the words taken.
bool option_switch(Parse *parse, const char *word, const char *next, int *used); // +X, -X
bool option_word(Parse *parse, const char *word, const char *next, int *used);   // --word
// keyword=value; length: that of the keyword. Quotes around the value are removed.
bool option_assign(Parse *parse, const char *word, size_t length, const char *value);
bool option_name(Parse *parse, const char *word); // a scene, a folder, a picture, an INI file
bool option_ini(Parse *parse, const char *word);  // file, file.ini, file.ini[Section]

// The row of a keyword, or NULL.
const OptionRow *option_keyword(const Parse *parse, const char *name, size_t length);

// On the command line prints the message and returns false; in an INI file dies there.
bool option_refuse(const Parse *parse, const char *word, const char *why);
// Says what is wrong with a value (parse->why); false.
bool option_complain(Parse *parse, const char *what);
// For options_report.
void option_remark(Parse *parse, bool warning, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// The whole text as a number; false (and *out untouched) if it is none, or not finite.
bool option_number(const char *text, double *out);
bool option_integer(const char *text, int *out); // out of range: the nearest int
// True for what begins as on, true, yes or 1 do, up to the end of the shorter: "onward", "t" and
// nothing at all are true as well, as for POV-Ray.
bool option_truth(const char *text);
const char *option_dither_code(DitherMethod method); // "FS"
const char *option_program_name(OptionsProgram program);

#endif
