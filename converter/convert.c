// SPDX-License-Identifier: MIT
// From options to a scene: sets up the Converter, declares what exists before the first line, reads
// all statements, hands over to emit.c.
#include "converter/convert.h"

#include "base/file.h"
#include "converter/language.h"
#include "converter/probing.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

// The first declaration of a name stays: the command line can replace what is built in.
static void declare_value(Converter *cv, const char *name, Value value) {
    uint32_t n = name_intern(cv, name, strlen(name));
    if (!name_symbol(cv, n))
        symbol_add(cv, n, 0)->value = value;
}

// A number of the front end: it comes in single precision and with six significant digits.
static void declare_float(Converter *cv, const char *name, double value) {
    char digits[64];
    snprintf(digits, sizeof digits, "%g", (double)(float)value);
    declare_value(cv, name, (Value){.type = VALUE_FLOAT, .c = {strtod(digits, NULL)}});
}

static bool is_name(const char *s) {
    if (!*s || (*s >= '0' && *s <= '9'))
        return false;
    return s[strspn(s, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")] == '\0';
}

static void declare_option(Converter *cv, const OptionDeclare *declare) {
    if (!is_name(declare->name))
        die("Declare=%s: not a name", declare->name);
    for (int code = KW_FIRST; code < KW_END; code++) {
        if (strcmp(keyword_name(code), declare->name) == 0)
            die("Declare=%s: a reserved word cannot be declared", declare->name);
    }
    declare_float(cv, declare->name, declare->value);
}

static void declare_initial(Converter *cv) {
    const RenderOptions *o = cv->options;
    const OptionFrame *f = &o->frame;
    for (size_t i = 0; i < o->declare_count; i++)
        declare_option(cv, &o->declares[i]);
    declare_float(cv, "image_width", o->width);
    declare_float(cv, "image_height", o->height);
    declare_float(cv, "frame_number", f->number);
    declare_float(cv, "initial_frame", f->initial);
    declare_float(cv, "final_frame", f->final);
    declare_float(cv, "initial_clock", f->initial_clock);
    declare_float(cv, "final_clock", f->final_clock);
    declare_float(cv, "clock_delta", f->clock_delta);
    declare_value(cv, "input_file_name",
                  (Value){.type = VALUE_STRING, .string = file_name(o->input)});
}

static Converter *start(const RenderOptions *options, Arena *arena) {
    Converter *cv = ARENA_NEW(arena, Converter);
    cv->arena = arena;
    cv->options = options;
    cv->language = ARENA_NEW(arena, Language);
    limits_start(cv);
    cv->version = options->version ? options->version : 370;
    cv->version_set = options->version != 0;
    cv->noise_generator = cv->version >= 350 ? 2 : 1;
    return cv;
}

Scene *convert_scene(const RenderOptions *options, Arena *arena) {
    return convert_scene_listing(options, arena, NULL);
}

static Scene *convert_source(Converter *cv, const Source *source) {
    const Loc start_of_file = {.file = source->name, .line = 1, .column = 1};
    cv->utf8 = source->utf8;
    push_file(cv, source, NULL);
    if (cv->options->include_header)
        push_file(cv, source_open(cv, cv->options->include_header, FILE_INCLUDE, &(Loc){0}), NULL);
    parse_scene_statements(cv);
    save_open_files(cv);
    if (!cv->version_set)
        note_at(&start_of_file,
                "no #version: read as version 3.62 where the picture depends on it");
    Scene *scene = emit_scene(cv);
    probing_end(cv);
    return scene;
}

Scene *convert_scene_listing(const RenderOptions *options, Arena *arena, MissingList *missing) {
    if (!options->input)
        die("no input file");
    catch_interrupt();
    Converter *cv = start(options, arena);
    cv->missing = missing;
    declare_initial(cv);
    return convert_source(cv, source_open(cv, options->input, FILE_SCENE, &(Loc){0}));
}

Scene *convert_bytes(const RenderOptions *options, Arena *arena, const void *bytes, size_t size,
                     MissingList *missing) {
    Converter *cv = start(options, arena);
    cv->missing = missing;
    declare_initial(cv);
    char *text = arena_alloc(arena, size + 1);
    if (size)
        memcpy(text, bytes, size);
    return convert_source(cv, source_create(cv, options->input, text, size, FILE_SCENE));
}
