// SPDX-License-Identifier: MIT
// From options to a scene: sets up the Converter, declares what exists before the first line, reads
// all statements, hands over to emit.c.
#include "converter/convert.h"

#include "converter/language.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef HOSTILE
static const uint64_t DEFAULT_TOKENS = 5000000;
static const size_t DEFAULT_BYTES = (size_t)160 << 20;
#else
static const uint64_t DEFAULT_TOKENS = 200000000;
static const size_t DEFAULT_BYTES = (size_t)4 << 30;
#endif

static void on_interrupt(int number) {
    (void)number;
    _exit(2);
}

// Reading can take long: Ctrl-C ends it with the status of an interrupted program. Who has set his
// own handler keeps it.
static void catch_interrupt(void) {
    struct sigaction old;
    if (sigaction(SIGINT, NULL, &old) == 0 && old.sa_handler == SIG_DFL)
        signal(SIGINT, on_interrupt);
}

static void declare_float(Converter *cv, const char *name, double value) {
    uint32_t n = name_intern(cv, name, strlen(name));
    Symbol *symbol = name_symbol(cv, n);
    if (!symbol)
        symbol = symbol_add(cv, n, 0);
    symbol->value = (Value){.type = VALUE_FLOAT, .c = {value}};
}

static bool is_name(const char *s) {
    if (!*s || (*s >= '0' && *s <= '9'))
        return false;
    return s[strspn(s, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")] == '\0';
}

// Six significant digits survive on POV-Ray's command line.
static void declare_option(Converter *cv, const OptionDeclare *declare) {
    char digits[64];
    if (!is_name(declare->name))
        die("Declare=%s: not a name", declare->name);
    for (int code = KW_FIRST; code < KW_END; code++) {
        if (strcmp(keyword_name(code), declare->name) == 0)
            die("Declare=%s: a reserved word cannot be declared", declare->name);
    }
    snprintf(digits, sizeof digits, "%g", declare->value);
    declare_float(cv, declare->name, strtod(digits, NULL));
}

static void declare_initial(Converter *cv) {
    const RenderOptions *o = cv->options;
    static const char *const animation[] = {"frame_number",  "initial_frame", "final_frame",
                                            "initial_clock", "final_clock",   "clock_delta"};
    declare_float(cv, "image_width", o->width);
    declare_float(cv, "image_height", o->height);
    for (size_t i = 0; i < sizeof animation / sizeof *animation; i++)
        declare_float(cv, animation[i], 0);
    const char *slash = strrchr(o->input, '/');
    uint32_t name = name_intern(cv, "input_file_name", strlen("input_file_name"));
    symbol_add(cv, name, 0)->value =
        (Value){.type = VALUE_STRING, .string = slash ? slash + 1 : o->input};
    for (size_t i = 0; i < o->declare_count; i++)
        declare_option(cv, &o->declares[i]);
}

static uint64_t token_limit(void) {
    const char *text = getenv("QIPOV_MAX_TOKENS");
    double limit = text ? strtod(text, NULL) : 0;
    return limit >= 1 && limit < 1e18 ? (uint64_t)limit : DEFAULT_TOKENS;
}

static Converter *start(const RenderOptions *options, Arena *arena) {
    Converter *cv = ARENA_NEW(arena, Converter);
    cv->arena = arena;
    cv->options = options;
    cv->language = ARENA_NEW(arena, Language);
    cv->language->max_read = token_limit();
    cv->language->max_bytes = arena_bytes(arena) + DEFAULT_BYTES;
    cv->version = options->version ? options->version : 370;
    cv->version_set = options->version != 0;
    cv->noise_generator = cv->version >= 350 ? 2 : 1;
    return cv;
}

Scene *convert_scene(const RenderOptions *options, Arena *arena) {
    if (!options->input)
        die("no input file");
    catch_interrupt();
    Converter *cv = start(options, arena);
    declare_initial(cv);
    const Source *source = source_open(cv, options->input, FILE_SCENE, &(Loc){0});
    const Loc start_of_file = {.file = source->name, .line = 1, .column = 1};
    cv->utf8 = source->utf8;
    push_file(cv, source, NULL);
    parse_scene_statements(cv);
    if (!cv->version_set)
        note_at(&start_of_file,
                "no #version: read as version 3.62 where the picture depends on it");
    return emit_scene(cv);
}
