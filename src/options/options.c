// SPDX-License-Identifier: MIT
// Reads the words of a command line one after the other. A word is a switch (+W640), a keyword
// (Width=640), a word of ours (--method qi), or a bare name; the table says what each does.
#include "options/options.h"

#include "options/table.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

RenderOptions options_default(void) {
    return (RenderOptions){
        .output_to_file = true,
        // What the distribution's povray.ini says.
        .width = 800,
        .height = 600,
        .start_row = -1,
        .end_row = -1,
        .start_column = -1,
        .end_column = -1,
        .block_size = 32,
        .antialias_threshold = 0.3,
        .sampling_method = 1,
        .antialias_depth = 3,
        .jitter = true,
        .jitter_amount = 1.0,
        .antialias_gamma = 2.5,
        .quality = 9,
        .format = IMAGE_PNG,
        .bits = 8,
        .verbose = true,
        .method = METHOD_QI,
        .tolerance = patchset_options_default().tolerance,
        .fail = 1e-6,
        .warn = 1e-6,
    };
}

const char *option_program_name(OptionsProgram program) {
    // ORDER program
    static const char *const names[] = {"qirender", "pov2qi", "qicompare"};
    return names[program];
}

// ---- values
// ---------------------------------------------------------------------------------------

bool option_number(const char *text, double *out) {
    // strtod also takes "inf", "nan", hexadecimals and leading blanks.
    if (!*text || text[strspn(text, "+-.0123456789eE")])
        return false;
    char *end;
    double value = strtod(text, &end);
    if (*end || !isfinite(value))
        return false;
    *out = value;
    return true;
}

bool option_integer(const char *text, int *out) {
    if (!*text || text[strspn(text, "+-0123456789")])
        return false;
    char *end;
    long value = strtol(text, &end, 10);
    if (*end)
        return false;
    *out = value < INT_MIN ? INT_MIN : value > INT_MAX ? INT_MAX : (int)value;
    return true;
}

bool option_truth(const char *text) {
    static const char *const yes[] = {"on", "yes", "true", "1"};
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++)
        if (strncasecmp(text, yes[i], strlen(yes[i])) == 0)
            return true;
    return false;
}

static double clip(double value, double low, double high) { return fmin(fmax(value, low), high); }

// Gives the row's field its value. False: parse->why says what is wrong.
static bool apply_row(Parse *parse, const OptionRow *row, bool on, const char *value) {
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
    case OPTION_UNSUPPORTED:
        snprintf(parse->why, sizeof parse->why, "POV-Ray's %s is not supported",
                 row->keyword ? row->keyword : row->letters);
        return false;
    case OPTION_IGNORED:
    case OPTION_HEADING:
        break;
    }
    return true;
}

// ---- messages
// -------------------------------------------------------------------------------------

static bool refuse(const Parse *parse, const char *word, const char *why) {
    const char *name = option_program_name(parse->program);
    fprintf(stderr, "%s: error: '%s': %s (try %s --help)\n", name, word, why, name);
    return false;
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
        if (!known || !(row->programs & (1u << parse->program)) || row->kind == OPTION_UNSUPPORTED)
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
    return refuse(parse, word, why);
}

// ---- words
// ----------------------------------------------------------------------------------------

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

static bool belongs(const Parse *parse, const OptionRow *row) {
    return (row->programs & (1u << parse->program)) != 0;
}

// Can rest follow the letters of this row? If not, the word means some other switch.
static bool may_follow(const OptionRow *row, const char *rest) {
    if (!*rest)
        return true;
    if (row->kind == OPTION_INT || row->kind == OPTION_NUMBER)
        return strchr("+-.0123456789", *rest) != NULL;
    if (row->kind == OPTION_FLAG)
        return false;
    return row->kind == OPTION_SPECIAL || row->value != NULL || row->kind == OPTION_UNSUPPORTED;
}

// +X..., -X...: the longest letters that fit. Of pov2qi's and qicompare's -o the name may be the
// next word. *used counts the words taken.
static bool read_switch(Parse *parse, const char *word, const char *next, int *used) {
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
        return refuse(parse, word, why);
    }
    if (!apply_row(parse, found, word[0] == '+', unquoted(parse, value)))
        return refuse(parse, word, parse->why);
    return true;
}

static bool read_keyword(Parse *parse, const char *word, const char *equals) {
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        size_t length = (size_t)(equals - word);
        if (!row->keyword || !belongs(parse, row) || strlen(row->keyword) != length ||
            strncasecmp(word, row->keyword, length) != 0)
            continue;
        const char *value = unquoted(parse, equals + 1);
        if (!apply_row(parse, row, row->kind != OPTION_FLAG || option_truth(value), value))
            return refuse(parse, word, parse->why);
        return true;
    }
    return refuse_unknown(parse, word, FORM_KEYWORD, word, (size_t)(equals - word));
}

// --word, --word=value, --word value.
static bool read_word(Parse *parse, const char *word, const char *next, int *used) {
    size_t length = strcspn(word + 2, "=");
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        if (!row->word || !belongs(parse, row) || strlen(row->word) != length ||
            strncmp(word + 2, row->word, length) != 0)
            continue;
        const char *value = word[2 + length] ? word + 3 + length : NULL;
        if (row->kind == OPTION_FLAG && value)
            return refuse(parse, word, "it takes no value");
        if (row->kind != OPTION_FLAG && !value) {
            if (!next)
                return refuse(parse, word, "a value must follow");
            value = next;
            *used = 2;
        }
        if (!apply_row(parse, row, true, value ? value : ""))
            return refuse(parse, word, parse->why);
        return true;
    }
    return refuse_unknown(parse, word, FORM_WORD, word + 2, length);
}

static bool ends_in(const char *text, const char *end) {
    size_t length = strlen(text), tail = strlen(end);
    return length > tail && strcasecmp(text + length - tail, end) == 0;
}

static bool read_name(Parse *parse, const char *word) {
    RenderOptions *o = parse->options;
    ImageFormat format;
    if (ends_in(word, ".pov") || ends_in(word, ".json")) {
        o->input = word;
        return true;
    }
    if (*word && word[strlen(word) - 1] == '/') {
        for (size_t i = 0; i < option_row_count; i++)
            if (option_rows[i].letters && strcmp(option_rows[i].letters, "L") == 0)
                return apply_row(parse, &option_rows[i], true, word);
    }
    if (parse->program == PROGRAM_QICOMPARE && image_format_of(word, &format)) {
        if (o->picture_count == 2)
            return refuse(parse, word, "two pictures are compared, this is a third");
        o->pictures[o->picture_count++] = word;
        return true;
    }
    if (ends_in(word, ".ini"))
        return refuse(parse, word,
                      "INI files are not read yet; give its lines as words, Width=640");
    if (parse->program == PROGRAM_QICOMPARE)
        return refuse(parse, word,
                      "neither a scene (.pov, .qi.json) nor a picture (.png, .exr ...)");
    return refuse(parse, word, "neither a switch nor a scene (.pov, .qi.json)");
}

// Is this a word that means the same to povray?
static bool is_povray_word(const char *word) {
    return word[0] == '+' || (word[0] == '-' && word[1] != '-') || strchr(word, '=') ||
           (*word && word[strlen(word) - 1] == '/');
}

// qicompare hands its words on: to both renderers what both understand, to qirender what only it
// does; not the scene, not the folder, not the limits.
static void keep_word(Parse *parse, char **argv, int used) {
    RenderOptions *o = parse->options;
    const char *word = argv[0];
    bool limit = strncmp(word, "--fail", 6) == 0 || strncmp(word, "--warn", 6) == 0;
    bool named = word[0] && strchr("+-", word[0]) && strchr("iIoO", word[1]) && word[1];
    bool input = strncasecmp(word, "Input_File_Name=", 16) == 0 ||
                 strncasecmp(word, "Output_File_Name=", 17) == 0;
    if (is_povray_word(word) && !named && !input) {
        o->shared[o->shared_count++] = word;
    } else if (strncmp(word, "--", 2) == 0 && !limit && strncmp(word, "--output", 8) != 0) {
        for (int i = 0; i < used; i++)
            o->own[o->own_count++] = argv[i];
    }
}

static bool read_one(Parse *parse, char **argv, int *used) {
    const char *word = argv[0], *next = argv[1];
    *used = 1;
    if (strcmp(word, "-h") == 0 || strcmp(word, "-?") == 0 || strcasecmp(word, "-help") == 0) {
        parse->options->help = true;
        return true;
    }
    if (strcasecmp(word, "-version") == 0) {
        parse->options->show_version = true;
        return true;
    }
    if (word[0] == '-' && word[1] == '-')
        return read_word(parse, word, next, used);
    if ((word[0] == '+' || word[0] == '-') && word[1])
        return read_switch(parse, word, next, used);
    const char *equals = strchr(word, '=');
    if (equals && (size_t)(equals - word) == strspn(word, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                                          "abcdefghijklmnopqrstuvwxyz"))
        return read_keyword(parse, word, equals);
    return read_name(parse, word);
}

bool options_parse(OptionsProgram program, int argc, char **argv, Arena *arena,
                   RenderOptions *options) {
    Parse parse = {.program = program, .options = options, .arena = arena};
    options->shared = ARENA_ARRAY(arena, const char *, (size_t)argc + 1);
    options->own = ARENA_ARRAY(arena, const char *, (size_t)argc + 1);
    for (int i = 1, used; i < argc; i += used) {
        if (strcmp(argv[i], "--") == 0) {
            if (program != PROGRAM_QICOMPARE)
                return refuse(&parse, argv[i], "nothing may follow it in this program");
            used = 1;
            continue;
        }
        if (!read_one(&parse, argv + i, &used))
            return false;
        if (program == PROGRAM_QICOMPARE)
            keep_word(&parse, argv + i, used);
    }
    if (options->grayscale && options->format != IMAGE_PNG && options->format != IMAGE_PPM)
        return refuse(&parse, "Grayscale_Output", "greyscale goes with PNG and PPM only");
    // Without +F the name decides, if it says anything.
    ImageFormat format;
    if (!options->format_given && options->output && program == PROGRAM_QIRENDER &&
        image_format_of(options->output, &format))
        options->format = format;
    return true;
}
