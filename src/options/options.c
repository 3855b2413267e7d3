// SPDX-License-Identifier: MIT
// Reads the words of a command line one after the other. A word is a switch (+W640), a keyword
// (Width=640), a word of ours (--method qi), or a bare name; the table says what each does.
#include "options/options.h"

#include "options/table.h"

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
        .console = {true, true, true, true, true},
        .initial_frame = FRAME_NONE,
        .final_frame = FRAME_NONE,
        .final_clock = 1.0,
        .pixel = {-1, -1},
        .places = 10,
        .subset_start = -1,
        .subset_end = -1,
        .frame_step = 1,
        .fail = 1e-6,
        .warn = 1e-6,
        .bench = {.share = 1.0, .patches = 1000000, .patience = 60.0, .povray = true},
    };
}

const char *option_program_name(OptionsProgram program) {
    // ORDER program
    static const char *const names[] = {"qirender", "pov2qi", "qicompare", "qibench"};
    return names[program];
}

// ---- values ----------------------------------------------------------------------------------

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
    static const char *const yes[] = {"on", "true", "yes", "1"};
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++) {
        size_t shorter = strlen(text) < strlen(yes[i]) ? strlen(text) : strlen(yes[i]);
        if (strncasecmp(text, yes[i], shorter) == 0)
            return true;
    }
    return false;
}

static bool ends_in(const char *text, const char *end) {
    size_t length = strlen(text), tail = strlen(end);
    return length > tail && strcasecmp(text + length - tail, end) == 0;
}

bool option_name(Parse *parse, const char *word) {
    RenderOptions *o = parse->options;
    ImageFormat format;
    if (ends_in(word, ".pov") || ends_in(word, ".json")) {
        o->input = word;
        if (parse->program == PROGRAM_QICOMPARE && !parse->loc.file)
            o->scenes[o->scene_count++] = word;
        return true;
    }
    if (*word && word[strlen(word) - 1] == '/')
        return option_assign(parse, "Library_Path", strlen("Library_Path"), word);
    bool picture = image_format_of(word, &format);
    if (parse->program == PROGRAM_QICOMPARE && picture) {
        if (o->picture_count == 2)
            return option_refuse(parse, word, "two pictures are compared, this is a third");
        o->pictures[o->picture_count++] = word;
        return true;
    }
    if (picture)
        return option_refuse(parse, word, "neither a switch, a scene nor an INI file");
    return option_ini(parse, word);
}

// Is this a word that means the same to povray?
static bool is_povray_word(const char *word) {
    return word[0] == '+' || (word[0] == '-' && word[1] != '-') || strchr(word, '=') ||
           (*word && word[strlen(word) - 1] == '/');
}

// Does it name an INI file? After option_name has taken it.
static bool is_ini_word(const char *word) {
    ImageFormat format;
    return *word != '-' && *word != '+' && !ends_in(word, ".pov") && !ends_in(word, ".json") &&
           !image_format_of(word, &format);
}

// qicompare hands its words on: to both renderers what both understand, to qirender what only it
// does; not the scene, not the folder, not the limits.
static void keep_word(Parse *parse, char **argv, int used) {
    RenderOptions *o = parse->options;
    const char *word = argv[0];
    bool judges = strncmp(word, "--fail", 6) == 0 || strncmp(word, "--warn", 6) == 0 ||
                  strncmp(word, "--region", 8) == 0 || strncmp(word, "--places", 8) == 0;
    bool named = word[0] && strchr("+-", word[0]) && strchr("iIoO", word[1]) && word[1];
    bool input = strncasecmp(word, "Input_File_Name=", 16) == 0 ||
                 strncasecmp(word, "Output_File_Name=", 17) == 0;
    if ((is_povray_word(word) || is_ini_word(word)) && !named && !input) {
        o->shared[o->shared_count++] = word;
    } else if (strncmp(word, "--", 2) == 0 && !judges && strncmp(word, "--output", 8) != 0) {
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
    // To POV-Ray -v is Verbose off, which is what pov2qi is anyway: here it means what compilers
    // mean.
    if (parse->program == PROGRAM_POV2QI && strcmp(word, "-v") == 0) {
        parse->options->verbose = true;
        return true;
    }
    if (strcasecmp(word, "-version") == 0) {
        parse->options->show_version = true;
        return true;
    }
    if (parse->program == PROGRAM_QIBENCH && word[0] != '-' && word[0] != '+') {
        BenchOptions *bench = &parse->options->bench;
        bench->words[bench->word_count++] = word;
        return true;
    }
    if (word[0] == '-' && word[1] == '-')
        return option_word(parse, word, next, used);
    if ((word[0] == '+' || word[0] == '-') && word[1])
        return option_switch(parse, word, next, used);
    const char *equals = strchr(word, '=');
    if (equals && (size_t)(equals - word) == strspn(word, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                                          "abcdefghijklmnopqrstuvwxyz"))
        return option_assign(parse, word, (size_t)(equals - word), equals + 1);
    return option_name(parse, word);
}

// qibench's first word. --help and its like stand without one.
static bool read_command(const Parse *parse, int argc, char **argv) {
    // ORDER bench_command
    static const char *const names[BENCH_COMMANDS] = {"trace", "speed", "sweep"};
    BenchOptions *bench = &parse->options->bench;
    for (int i = 0; argc > 1 && i < BENCH_COMMANDS; i++)
        if (strcmp(argv[1], names[i]) == 0) {
            bench->command = (BenchCommand)i;
            return true;
        }
    if (argc > 1 && argv[1][0] == '-')
        return true;
    return option_refuse(parse, argc > 1 ? argv[1] : "qibench",
                         "the first word says what to do: trace, speed or sweep");
}

bool options_parse(OptionsProgram program, int argc, char **argv, Arena *arena,
                   RenderOptions *options) {
    Parse parse = {.program = program, .options = options, .arena = arena};
    options->shared = ARENA_ARRAY(arena, const char *, (size_t)argc + 1);
    options->own = ARENA_ARRAY(arena, const char *, (size_t)argc + 1);
    options->scenes = ARENA_ARRAY(arena, const char *, (size_t)argc + 1);
    if (program == PROGRAM_QIBENCH)
        options->bench.words = ARENA_ARRAY(arena, const char *, (size_t)argc + 1);
    bool commanded = program == PROGRAM_QIBENCH && argc > 1 && argv[1][0] != '-';
    if (program == PROGRAM_QIBENCH && !read_command(&parse, argc, argv))
        return false;
    for (int i = commanded ? 2 : 1, used; i < argc; i += used) {
        if (strcmp(argv[i], "--") == 0) {
            if (program != PROGRAM_QICOMPARE)
                return option_refuse(&parse, argv[i], "nothing may follow it in this program");
            used = 1;
            continue;
        }
        if (!read_one(&parse, argv + i, &used))
            return false;
        if (program == PROGRAM_QICOMPARE)
            keep_word(&parse, argv + i, used);
    }
    if (options->grayscale && options->format != IMAGE_PNG && options->format != IMAGE_PPM)
        return option_refuse(&parse, "Grayscale_Output", "greyscale goes with PNG and PPM only");
    // Without +F the name decides, if it says anything.
    ImageFormat format;
    if (!options->format_given && options->output && program == PROGRAM_QIRENDER &&
        image_format_of(options->output, &format))
        options->format = format;
    return true;
}
