// SPDX-License-Identifier: MIT
#include "options/table_values.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

bool option_complain(Parse *parse, const char *what) {
    snprintf(parse->why, sizeof parse->why, "%s", what);
    return false;
}

// +A, +A0.x: POV-Ray takes no other spelling of the threshold.
bool option_apply_antialias(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    double threshold;
    if (*value) {
        if (strncmp(value, "0.", 2) != 0 || !option_number(value, &threshold))
            return option_complain(
                parse, "the threshold must be written with a leading \"0.\", as in +A0.3");
        parse->options->antialias_threshold = threshold;
    }
    parse->options->antialias = on;
    return true;
}

bool option_apply_antialias_flag(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    parse->options->antialias = option_truth(value);
    return true;
}

bool option_apply_jitter(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    double amount;
    if (*value) {
        if (!option_number(value, &amount))
            return option_complain(parse, "the amount must be a number, as in +J0.5");
        parse->options->jitter_amount = fmin(fmax(amount, 0.0), 1.0);
    }
    parse->options->jitter = on;
    return true;
}

// [type letter][bits or 'g'], as in N16.
static bool read_format(Parse *parse, const char *value) {
    static const struct {
        char letter;
        ImageFormat format;
        bool compressed, grayscale;
    } types[] = {
        {'N', IMAGE_PNG, false, true},  {'T', IMAGE_TGA, false, false},
        {'C', IMAGE_TGA, true, false},  {'P', IMAGE_PPM, false, true},
        {'B', IMAGE_BMP, false, false}, {'J', IMAGE_JPEG, false, false},
        {'E', IMAGE_EXR, false, false}, {'H', IMAGE_HDR, false, false},
    };
    RenderOptions *o = parse->options;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (toupper((unsigned char)*value) != types[i].letter)
            continue;
        int bits = o->bits;
        bool grey = strcasecmp(value + 1, "g") == 0;
        if (grey && !types[i].grayscale)
            return option_complain(parse, "'g' (greyscale) goes with N (PNG) and P (PPM) only");
        if (value[1] && !grey && !option_integer(value + 1, &bits))
            return option_complain(
                parse, "after the type letter comes a number of bits or 'g', as in +FN16");
        o->format = types[i].format;
        o->compressed = types[i].compressed;
        o->grayscale = grey;
        o->format_given = true;
        o->bits = bits < 5 ? 5 : bits > 16 ? 16 : bits;
        return true;
    }
    return option_complain(
        parse, "the type letter is one of N (PNG), T, C (TGA), P (PPM), B (BMP), J (JPEG),"
               " E (EXR), H (HDR)");
}

bool option_apply_format(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    if (*value && !read_format(parse, value))
        return false;
    parse->options->output_to_file = on;
    return true;
}

// Of the keyword's value only the letter counts, as for POV-Ray.
bool option_apply_format_keyword(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    RenderOptions *o = parse->options;
    const RenderOptions before = *o;
    if (!read_format(parse, value))
        return false;
    if (o->bits != before.bits || o->grayscale)
        option_remark(parse, true,
                      "POV-Ray reads only the letter of Output_File_Type=%s; the rest is "
                      "Bits_Per_Color=n or Grayscale_Output=on",
                      value);
    o->bits = before.bits;
    o->grayscale = before.grayscale;
    return true;
}

bool option_apply_file_gamma(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    double gamma = 0;
    if (strcasecmp(value, "srgb") != 0 && (!option_number(value, &gamma) || gamma < 0.01))
        return option_complain(parse, "the gamma is a positive number or sRGB");
    parse->options->file_gamma = gamma;
    return true;
}

bool option_apply_declare(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    const char *equals = strchr(value, '=');
    double number;
    bool named = isalpha((unsigned char)*value) || *value == '_';
    for (const char *p = value; equals && p < equals; p++)
        named = named && (isalnum((unsigned char)*p) || *p == '_');
    if (!equals || !named || !option_number(equals + 1, &number))
        return option_complain(parse, "it is written Declare=Name=number");

    // POV-Ray hands the value on with six digits.
    char digits[40];
    snprintf(digits, sizeof digits, "%.6g", (double)(float)number);
    RenderOptions *o = parse->options;
    OptionDeclare *grown = ARENA_ARRAY(parse->arena, OptionDeclare, o->declare_count + 1);
    if (o->declare_count)
        memcpy(grown, o->declares, o->declare_count * sizeof *grown);
    char *name = arena_strdup(parse->arena, value);
    name[equals - value] = '\0';
    grown[o->declare_count++] = (OptionDeclare){name, strtod(digits, NULL)};
    o->declares = grown;
    return true;
}

static void add_path(Parse *parse, const char ***paths, size_t *count, const char *path) {
    const char **grown = ARENA_ARRAY(parse->arena, const char *, *count + 1);
    if (*count)
        memcpy(grown, *paths, *count * sizeof *grown);
    grown[(*count)++] = path;
    *paths = grown;
}

bool option_apply_library(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    RenderOptions *o = parse->options;
    if (!*value)
        return option_complain(parse, "it needs a folder, as in +Linclude");
    add_path(parse, &o->library_paths, &o->library_path_count, value);
    return true;
}

bool option_apply_allow_write(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    RenderOptions *o = parse->options;
    struct stat st;
    if (stat(value, &st) != 0 || !S_ISDIR(st.st_mode))
        return option_complain(parse, "there is no such folder");
    add_path(parse, &o->write_folders, &o->write_folder_count, value);
    return true;
}

bool option_apply_clock(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    double clock;
    if (!option_number(value, &clock))
        return option_complain(parse, "the clock must be a number, as in +K0.5");
    parse->options->clock = (double)(float)clock;
    parse->options->clock_given = true;
    return true;
}

// Single precision, as POV-Ray hands it around.
bool option_apply_float(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)on;
    double number;
    if (!option_number(value, &number))
        return option_complain(parse, "a number must follow");
    *(double *)(void *)((char *)parse->options + row->offset) = (double)(float)number;
    return true;
}

bool option_apply_include_ini(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    return option_ini(parse, value);
}

bool option_apply_command(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)on;
    if (*value)
        option_remark(parse, true, "%s: commands of the shell are not run", row->keyword);
    return true;
}

// Why a program ended is not hidden by -GA, as in POV-Ray; -GF does that.
static void show_all(RenderOptions *o, bool on) {
    for (int i = 0; i < CONSOLE_COUNT; i++)
        if (on || i != CONSOLE_FATAL)
            o->console[i] = on;
}

// +GD, -GD, +GDname, -GDname: is the stream shown, and where is its copy? The row's field is the
// name of the copy.
bool option_apply_console(Parse *parse, const OptionRow *row, bool on, const char *value) {
    RenderOptions *o = parse->options;
    const char **file = (const char **)(void *)((char *)o + row->offset);
    if (file == &o->all_file)
        show_all(o, on);
    else
        o->console[file - o->console_file] = on;
    if (*value)
        *file = value;
    return true;
}

bool option_apply_all_console(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    show_all(parse->options, option_truth(value));
    return true;
}

bool option_apply_block_size(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    int size;
    if (!option_integer(value, &size) || size < 4)
        return option_complain(parse, "tiles are at least 4 pixels wide, as in +BS32");
    parse->options->block_size = size;
    return true;
}

bool option_apply_version(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    double version;
    if (!option_number(value, &version) || version < 1.0 || version > 3.8)
        return option_complain(
            parse, "the version of the language lies between 1.0 and 3.8, as in +MV3.7");
    parse->options->version = (int)lround(100.0 * version);
    return true;
}

bool option_apply_display(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    if (strspn(value, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789") !=
        strlen(value))
        return option_complain(parse, "after +D come letters for the display");
    parse->options->display = on;
    return true;
}

static const char *const dither_codes[] = {"", "B2", "B3", "B4", "D1", "D2", "FS"}; // ORDER

const char *option_dither_code(DitherMethod method) { return dither_codes[method]; }

bool option_apply_dither_method(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    for (int i = DITHER_B2; i <= DITHER_FS; i++)
        if (strcasecmp(value, dither_codes[i]) == 0) {
            parse->options->dither_method = (DitherMethod)i;
            return true;
        }
    return option_complain(parse, "the methods of dithering are B2, B3, B4, D1, D2 and FS");
}

// +TH, -TH, +THFS: the flag, and perhaps the method.
bool option_apply_dither(Parse *parse, const OptionRow *row, bool on, const char *value) {
    parse->options->dither = on;
    return !*value || option_apply_dither_method(parse, row, on, value);
}

bool option_apply_method(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    if (patch_method_parse(value, &parse->options->method)) {
        parse->options->bench.method_given = true;
        return true;
    }
    size_t at = (size_t)snprintf(parse->why, sizeof parse->why, "the methods are");
    for (int i = 0; i < METHOD_COUNT && at < sizeof parse->why; i++)
        at += (size_t)snprintf(parse->why + at, sizeof parse->why - at, "%s %s", i ? "," : "",
                               patch_method_name((PatchMethod)i));
    return false;
}

bool option_apply_region(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    (void)on;
    char rest;
    int *r = parse->options->region, got[4];
    if (sscanf(value, "%d,%d,%d,%d%c", &got[0], &got[1], &got[2], &got[3], &rest) != 4 ||
        got[0] < 0 || got[1] < 0 || got[2] < 1 || got[3] < 1)
        return option_complain(parse,
                               "left,top,width,height in pixels, the first two counted from 0");
    memcpy(r, got, sizeof got);
    return true;
}

bool option_apply_pixel(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    (void)on;
    char rest;
    int x, y;
    if (sscanf(value, "%d,%d%c", &x, &y, &rest) != 2 || x < 0 || y < 0)
        return option_complain(parse, "column,row, both counted from 0");
    parse->options->pixel[0] = x;
    parse->options->pixel[1] = y;
    return true;
}

bool option_apply_nudge(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    (void)on;
    char rest;
    double x, y;
    if (sscanf(value, "%lf,%lf%c", &x, &y, &rest) != 2 || !(fabs(x) <= 1.0 && fabs(y) <= 1.0))
        return option_complain(parse, "right,down in pixels, -1 to 1");
    parse->options->nudge[0] = x;
    parse->options->nudge[1] = y;
    return true;
}

bool option_apply_aov(Parse *parse, const OptionRow *row, bool on, const char *value) {
    // ORDER aov
    static const char *const names[AOV_COUNT] = {"depth", "normal", "uv",    "patch",
                                                 "steps", "bound",  "object"};
    (void)row;
    (void)on;
    while (*value) {
        size_t length = strcspn(value, ",");
        int kind = 0;
        while (kind < AOV_COUNT &&
               (strlen(names[kind]) != length || strncmp(names[kind], value, length) != 0))
            kind++;
        if (kind == AOV_COUNT)
            return option_complain(parse,
                                   "the channels are depth,normal,uv,patch,steps,bound,object");
        parse->options->aovs |= 1u << kind;
        value += length + (value[length] == ',');
    }
    return true;
}

bool option_apply_tolerance(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row;
    (void)on;
    RenderOptions *o = parse->options;
    size_t length = strlen(value);
    bool pixels = length > 2 && strcmp(value + length - 2, "px") == 0;
    const char *text = pixels ? arena_printf(parse->arena, "%.*s", (int)length - 2, value) : value;
    double tolerance;
    if (!option_number(text, &tolerance) || tolerance < (pixels ? 1e-6 : 1e-15) || tolerance > 1.0)
        return option_complain(parse,
                               "a share of the patch's diameter, 1e-15 to 1, or of a pixel where "
                               "the patch is seen, 1e-6px to 1px");
    if (pixels && parse->program == PROGRAM_QIBENCH)
        return option_complain(parse,
                               "without a camera there are no pixels: a share of the patch's "
                               "diameter, 1e-15 to 1");
    o->pixels = pixels ? tolerance : 0.0;
    o->bench.tolerance_given = true;
    if (!pixels)
        o->tolerance = tolerance;
    return true;
}

const Accuracy options_accuracies[ACCURACY_COUNT] = {
    {"draft", 1e-9, 0.1}, {"pixel", 1e-9, 1e-6}, {"fine", 1e-9, 0.0}, {"exact", 1e-14, 0.0}};

bool option_apply_accuracy(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    for (int i = 0; i < ACCURACY_COUNT; i++)
        if (strcasecmp(value, options_accuracies[i].name) == 0) {
            parse->options->pixels = options_accuracies[i].pixels;
            if (options_accuracies[i].pixels == 0.0)
                parse->options->tolerance = options_accuracies[i].tolerance;
            return true;
        }
    return option_complain(parse, "draft, pixel, fine or exact");
}

bool option_apply_prepare(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    parse->options->prepare_given = true;
    return patch_prepare_parse(value, &parse->options->prepare) ||
           option_complain(parse, "the ways are full, light, none");
}

// Takes effect at once: all that trace in this program use it.
bool option_apply_isa(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    switch (patch_isa_choose(value)) {
    case PATCH_ISA_CHOSEN:
        return true;
    case PATCH_ISA_UNUSABLE:
        return option_complain(parse, "this machine does not have it");
    case PATCH_ISA_UNKNOWN:
        break;
    }
    return option_complain(parse, "the instruction sets are scalar, avx2, avx512");
}

// ORDER limit
static const char *const limit_names[] = {"calls",   "elements", "includes", "megabytes", "nesting",
                                          "objects", "seconds",  "string",   "tokens"};
_Static_assert(sizeof limit_names / sizeof *limit_names == LIMIT_COUNT, "a name for each limit");

const char *options_limit_name(Limit limit) { return limit_names[limit]; }

bool option_apply_limit(Parse *parse, const OptionRow *row, bool on, const char *value) {
    (void)row, (void)on;
    size_t length = strcspn(value, "=");
    for (int i = 0; i < LIMIT_COUNT; i++) {
        if (strlen(limit_names[i]) != length || strncasecmp(value, limit_names[i], length) != 0)
            continue;
        double number;
        if (value[length] != '=' || !option_number(value + length + 1, &number) || number < 1)
            return option_complain(parse, "a positive number must follow, as in tokens=1e9");
        parse->options->limits[i] = number < 1e15 ? (uint64_t)number : (uint64_t)1e15;
        return true;
    }
    size_t at = (size_t)snprintf(parse->why, sizeof parse->why, "the limits are");
    for (int i = 0; i < LIMIT_COUNT && at < sizeof parse->why; i++)
        at += (size_t)snprintf(parse->why + at, sizeof parse->why - at, "%s %s", i ? "," : "",
                               limit_names[i]);
    return false;
}
