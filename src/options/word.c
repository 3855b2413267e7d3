// SPDX-License-Identifier: MIT
// One word of the command line or of an INI file: looked up in the table, its value put into its
// field, and refused by name, with the nearest known one, when it is wrong.
#include "options/table.h"

#include "base/diag.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static double clip(double value, double low, double high) { return fmin(fmax(value, low), high); }

// Gives the row's field its value. False: parse->why says what is wrong.
static bool apply_row(Parse *parse, const OptionRow *row, bool on, const char *value) {
    // An INI file names POV-Ray's picture; that is not what these programs write.
    if (parse->loc.file && parse->program != PROGRAM_QIRENDER &&
        row->offset == offsetof(RenderOptions, output) && row->kind == OPTION_TEXT)
        return true;
    if (!parse->loc.file && !(row->programs & (1u << parse->program)))
        option_remark(parse, false, "POV-Ray's %s has no effect in this program",
                      row->keyword ? row->keyword : row->letters);
    void *field = (char *)parse->options + row->offset;
    double number;
    int whole;
    switch (row->kind) {
    case OPTION_FLAG:
        *(bool *)field = on;
        return true;
    case OPTION_INT:
        if (option_integer(value, &whole)) {
            *(int *)field = (int)clip(whole, row->low, row->high);
            return true;
        }
        snprintf(parse->why, sizeof parse->why, "a whole number must follow");
        return false;
    case OPTION_NUMBER:
        if (option_number(value, &number)) {
            *(double *)field = clip(number, row->low, row->high);
            return true;
        }
        snprintf(parse->why, sizeof parse->why, "a number must follow");
        return false;
    case OPTION_TEXT:
        *(const char **)field = value;
        snprintf(parse->why, sizeof parse->why, "a name must follow");
        return *value != '\0';
    case OPTION_SPECIAL:
        return row->apply(parse, row, on, value);
    case OPTION_IGNORED:
        if (!parse->povray_ini)
            option_remark(parse, false, "POV-Ray's %s has no effect here",
                          row->keyword ? row->keyword : row->letters);
        break;
    case OPTION_HEADING:
        break;
    }
    return true;
}

// ---- messages --------------------------------------------------------------------------------

bool option_refuse(const Parse *parse, const char *word, const char *why) {
    if (parse->loc.file)
        die_at(&parse->loc, "'%s': %s", word, why);
    const char *name = option_program_name(parse->program);
    fprintf(stderr, "%s: error: '%s': %s (try %s --help)\n", name, word, why, name);
    return false;
}

void option_remark(Parse *parse, bool warning, const char *format, ...) {
    char text[240];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    RenderOptions *o = parse->options;
    OptionRemark *grown = ARENA_ARRAY(parse->arena, OptionRemark, o->remark_count + 1);
    if (o->remark_count)
        memcpy(grown, o->remarks, o->remark_count * sizeof *grown);
    grown[o->remark_count++] =
        (OptionRemark){parse->loc, arena_strdup(parse->arena, text), warning};
    o->remarks = grown;
}

// Edit distance, letters in any case. Names are short; longer ones than the table has are far.
static size_t distance(const char *a, size_t a_length, const char *b) {
    enum { LONGEST = 40 };
    size_t b_length = strlen(b), row[LONGEST + 1];
    if (a_length > LONGEST || b_length > LONGEST)
        return LONGEST;
    for (size_t j = 0; j <= b_length; j++)
        row[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            bool same = tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 1]);
            size_t change = diagonal + !same;
            diagonal = row[j];
            size_t least = row[j] < row[j - 1] ? row[j] + 1 : row[j - 1] + 1;
            row[j] = change < least ? change : least;
        }
    }
    return row[b_length];
}

// An INI file may be meant for another program: all of POV-Ray's options are known in it. So they
// are to pov2qi, which takes the line that renders a scene.
static bool belongs(const Parse *parse, const OptionRow *row) {
    if (parse->program == PROGRAM_QIBENCH && row->commands &&
        !(row->commands & (1u << parse->options->bench.command)))
        return false;
    if ((row->programs & (1u << parse->program)) != 0)
        return true;
    bool povray = row->letters || row->keyword;
    return povray && (parse->loc.file || parse->program == PROGRAM_POV2QI);
}

// The forms a word can have: the field of the row that names it.
typedef enum { FORM_SWITCH, FORM_KEYWORD, FORM_WORD } Form;

static const char *row_name(const OptionRow *row, Form form) {
    return form == FORM_SWITCH ? row->letters : form == FORM_KEYWORD ? row->keyword : row->word;
}

// name: the part of the word that should have been in the table.
static bool refuse_unknown(const Parse *parse, const char *word, Form form, const char *name,
                           size_t length) {
    const char *nearest = NULL;
    size_t best = length; // all letters replaced is no likeness
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        const char *known = row_name(row, form);
        if (!known || !belongs(parse, row))
            continue;
        size_t d = distance(name, length, known);
        if (d < best || (d == best && !nearest && d < strlen(known))) {
            best = d;
            nearest = known;
        }
    }
    char why[160];
    if (nearest)
        snprintf(why, sizeof why, "no such option; the nearest is %s%s%s",
                 form == FORM_SWITCH ? "+"
                 : form == FORM_WORD ? "--"
                                     : "",
                 nearest, form == FORM_KEYWORD ? "=" : "");
    else
        snprintf(why, sizeof why, "no such option");
    return option_refuse(parse, word, why);
}

// ---- words -----------------------------------------------------------------------------------

// A copy of value without the quotes around it.
static const char *unquoted(Parse *parse, const char *value) {
    size_t length = strlen(value);
    if (length >= 2 && (*value == '"' || *value == '\'') && value[length - 1] == *value) {
        char *inside = arena_strdup(parse->arena, value + 1);
        inside[length - 2] = '\0';
        return inside;
    }
    return value;
}

// Can rest follow the letters of this row? If not, the word means some other switch.
static bool may_follow(const OptionRow *row, const char *rest) {
    if (!*rest)
        return true;
    if (row->kind == OPTION_INT || row->kind == OPTION_NUMBER)
        return strchr("+-.0123456789", *rest) != NULL;
    if (row->kind == OPTION_FLAG)
        return false;
    return row->kind == OPTION_SPECIAL || row->value != NULL;
}

// +X..., -X...: the longest letters that fit. Of pov2qi's and qicompare's -o the name may be the
// next word. *used counts the words taken.
bool option_switch(Parse *parse, const char *word, const char *next, int *used) {
    const OptionRow *found = NULL;
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        if (row->letters && belongs(parse, row) &&
            strncasecmp(word + 1, row->letters, strlen(row->letters)) == 0 &&
            may_follow(row, word + 1 + strlen(row->letters)) &&
            (!found || strlen(row->letters) > strlen(found->letters)))
            found = row;
    }
    if (!found)
        return refuse_unknown(
            parse, word, FORM_SWITCH, word + 1,
            strspn(word + 1, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"));

    const char *value = word + 1 + strlen(found->letters);
    if (!*value && strcmp(found->letters, "O") == 0 && parse->program != PROGRAM_QIRENDER && next) {
        value = next;
        *used = 2;
    }
    bool missing = !*value && (found->kind == OPTION_INT || found->kind == OPTION_NUMBER ||
                               found->kind == OPTION_TEXT);
    if (missing) {
        bool loose = next && *next && !strchr("+-", *next); // "+W 640": show it as it should be
        char why[160];
        snprintf(why, sizeof why, "the value is glued to the switch, as in +%s%s", found->letters,
                 loose                        ? next
                 : found->kind == OPTION_TEXT ? "name"
                                              : "3");
        return option_refuse(parse, word, why);
    }
    if (!apply_row(parse, found, word[0] == '+', unquoted(parse, value)))
        return option_refuse(parse, word, parse->why);
    return true;
}

const OptionRow *option_keyword(const Parse *parse, const char *name, size_t length) {
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        if (row->keyword && belongs(parse, row) && strlen(row->keyword) == length &&
            strncasecmp(name, row->keyword, length) == 0)
            return row;
    }
    return NULL;
}

bool option_assign(Parse *parse, const char *word, size_t length, const char *value) {
    const OptionRow *row = option_keyword(parse, word, length);
    if (!row)
        return refuse_unknown(parse, word, FORM_KEYWORD, word, length);
    value = unquoted(parse, value);
    if (!apply_row(parse, row, row->kind != OPTION_FLAG || option_truth(value), value))
        return option_refuse(parse, word, parse->why);
    return true;
}

// --word, --word=value, --word value.
bool option_word(Parse *parse, const char *word, const char *next, int *used) {
    size_t length = strcspn(word + 2, "=");
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        if (!row->word || !belongs(parse, row) || strlen(row->word) != length ||
            strncmp(word + 2, row->word, length) != 0)
            continue;
        const char *value = word[2 + length] ? word + 3 + length : NULL;
        if (row->kind == OPTION_FLAG && value)
            return option_refuse(parse, word, "it takes no value");
        if (row->kind != OPTION_FLAG && !value) {
            if (!next)
                return option_refuse(parse, word, "a value must follow");
            value = next;
            *used = 2;
        }
        if (apply_row(parse, row, true, value ? value : ""))
            return true;
        if (*used == 2)
            word = arena_printf(parse->arena, "%s %s", word, value);
        return option_refuse(parse, word, parse->why);
    }
    return refuse_unknown(parse, word, FORM_WORD, word + 2, length);
}
