// SPDX-License-Identifier: MIT
// #fopen, #read, #write, #fclose (facts: sdl 3.5). Reading a scene must not write files: what is
// written stays in memory and can be read or included again in the same run. Below the folders of
// --allow-write it becomes a file when it is closed; elsewhere there is a warning instead.
#include "base/file.h"
#include "converter/language.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <unistd.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- written files ----------------------------------------------------------------------------

static UserFile *find_written(Converter *cv, const char *name) {
    for (UserFile *f = cv->language->written; f; f = f->next) {
        if (strcmp(f->name, name) == 0)
            return f;
    }
    return NULL;
}

const Source *written_source(Converter *cv, const char *name) {
    const UserFile *f = find_written(cv, name);
    if (!f)
        return NULL;
    Source *source = ARENA_NEW(cv->arena, Source);
    char *text = arena_alloc(cv->arena, f->size + 1);
    if (f->size)
        memcpy(text, f->text, f->size);
    *source = (Source){.name = f->name, .text = text, .size = f->size};
    return source;
}

static void append_bytes(Converter *cv, UserFile *f, const char *bytes, size_t count) {
    while (f->size + count > f->capacity)
        f->text = list_grow(cv, f->text, f->size, &f->capacity, 1);
    memcpy(f->text + f->size, bytes, count);
    f->size += count;
}

static void append_text(Converter *cv, UserFile *f, const char *text) {
    append_bytes(cv, f, text, strlen(text));
}

// Does the file's folder, with all links followed, lie in one that the user has opened?
static bool may_write(Converter *cv, const char *name) {
    char where[PATH_MAX], allowed[PATH_MAX];
    if (!realpath(file_folder(cv->arena, name), where))
        return false;
    for (size_t i = 0; i < cv->options->write_folder_count; i++) {
        if (!realpath(cv->options->write_folders[i], allowed))
            continue;
        size_t length = strlen(allowed);
        bool root = strcmp(allowed, "/") == 0;
        if (root || (strncmp(where, allowed, length) == 0 &&
                     (where[length] == '/' || where[length] == '\0')))
            return true;
    }
    return false;
}

static bool put_bytes(int fd, const char *bytes, size_t count) {
    while (count) {
        ssize_t written = write(fd, bytes, count);
        if (written < 0 && errno != EINTR)
            return false;
        if (written > 0) {
            bytes += written;
            count -= (size_t)written;
        }
    }
    return true;
}

// The file as it stands in memory, if the user lets it be one. A link in its place is not followed.
static void save_file(Converter *cv, UserFile *f) {
    f->writing = false;
    if (!may_write(cv, f->name))
        return;
    int fd = open(f->name, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    bool done = fd >= 0 && put_bytes(fd, f->text, f->size);
    int why = errno;
    if (fd >= 0 && close(fd) != 0 && done) {
        done = false;
        why = errno;
    }
    if (!done)
        die_at(f->loc, "Cannot write '%s': %s", f->name, strerror(why));
}

void save_open_files(Converter *cv) {
    for (UserFile *f = cv->language->written; f; f = f->next)
        if (f->writing)
            save_file(cv, f);
}

// ---- #fopen, #fclose --------------------------------------------------------------------------

static void open_for_reading(Converter *cv, UserFile *f, const Loc *loc) {
    const Source *source = source_open(cv, f->name, FILE_TEXT, loc);
    f->tokens = lexer_tokenize(cv, source);
}

static UserFile *open_for_writing(Converter *cv, const char *name, bool append, const Loc *loc) {
    UserFile *f = find_written(cv, name);
    if (!f) {
        if (!may_write(cv, name))
            warn_at(loc,
                    "'%s' is not written: a scene may only write below the folders of "
                    "--allow-write. What goes there is kept in memory until the scene is read",
                    name);
        f = ARENA_NEW(cv->arena, UserFile);
        f->loc = arena_copy(cv->arena, loc, sizeof *loc);
        f->name = name;
        f->next = cv->language->written;
        cv->language->written = f;
        if (append && source_find(cv, name, FILE_TEXT)) {
            const Source *old = source_open(cv, name, FILE_TEXT, loc);
            append_bytes(cv, f, old->text, old->size);
        }
    }
    if (!append)
        f->size = 0;
    f->writing = true;
    return f;
}

// NAME S (read | write | append)
void run_fopen(Converter *cv, const Token *word) {
    Loc loc = token_loc(cv, word);
    bool held = hold_directives(cv);
    const Token *name = peek_token(cv);
    if (name->code != TOK_IDENTIFIER || name_symbol(cv, name->name))
        die_expected(cv, "an undeclared identifier as the file's handle");
    next_token(cv);
    restore_directives(cv, held);
    UserFile *f = ARENA_NEW(cv->arena, UserFile);
    f->name = parse_file_name(cv);
    if (accept(cv, KW_read))
        open_for_reading(cv, f, &loc);
    else if (accept(cv, KW_write))
        f = open_for_writing(cv, f->name, false, &loc);
    else if (accept(cv, KW_append))
        f = open_for_writing(cv, f->name, true, &loc);
    else
        die_expected(cv, "read, write or append");
    symbol_add(cv, name->name, 0)->value = (Value){.type = VALUE_FILE, .node = f};
}

static Symbol *expect_handle(Converter *cv, UserFile **out) {
    const Place *place = ahead_place(cv);
    if (!place || place->value->type != VALUE_FILE)
        die_expected(cv, "a file identifier (made by #fopen)");
    Symbol *symbol = place->symbol;
    *out = place->value->node;
    next_token(cv);
    return symbol;
}

void run_fclose(Converter *cv) {
    UserFile *f;
    if (next_is(cv, TOK_IDENTIFIER) && !ahead_place(cv)) {
        next_token(cv); // #read has closed it at the end of the file
        return;
    }
    symbol_remove(cv, expect_handle(cv, &f));
    if (f->writing)
        save_file(cv, f);
}

// ---- #read ------------------------------------------------------------------------------------

static const Token *data_token(UserFile *f) {
    const Token *token = &f->tokens.items[f->at];
    if (token->code != TOK_EOF)
        f->at++;
    return token;
}

_Noreturn static void die_data(Converter *cv, const Token *token, const char *what) {
    Loc loc = {.file = token->source->name,
               .text = token->source->text,
               .line = token->line,
               .column = token->column};
    Loc *from = ARENA_NEW(cv->arena, Loc);
    *from = token_loc(cv, cv->language->last);
    loc.from = from;
    loc.what = "read";
    if (token->code == TOK_ERROR)
        die_at(&loc, "%s", token->text);
    die_at(&loc, "Expected %s, %s found instead", what, token_describe(cv, token));
}

static double data_float(Converter *cv, UserFile *f, const Token *token) {
    double sign = 1;
    if (token->code == '+' || token->code == '-') {
        sign = token->code == '-' ? -1 : 1;
        token = data_token(f);
    }
    if (token->code != TOK_NUMBER)
        die_data(cv, token, "float");
    return sign * token->number;
}

static void data_comma(UserFile *f) {
    if (f->tokens.items[f->at].code == ',')
        f->at++;
}

static void data_vector(Converter *cv, UserFile *f, Value *out) {
    double e[5] = {0};
    int width = 0;
    for (const Token *token; (token = data_token(f))->code != '>' || width < 2;) {
        if (width == 5)
            die_data(cv, token, "'>': a vector has at most five components");
        e[width++] = data_float(cv, f, token);
        data_comma(f);
    }
    *out = value_number(e, width);
}

// One item, unless the file has ended. *ended when no token follows it. The token after an item is
// lost even if it is no comma, as in POV-Ray: "1 2 3 4" gives 1 and 3.
static bool read_item(Converter *cv, UserFile *f, Value *out, bool *ended) {
    const Token *token = data_token(f);
    switch (token->code) {
    case TOK_EOF:
        *ended = true;
        return false;
    case TOK_STRING:
        *out = (Value){.type = VALUE_STRING, .string = string_from_literal(cv, token, false)};
        break;
    case '<':
        data_vector(cv, f, out);
        break;
    default:
        *out = (Value){.type = VALUE_FLOAT, .c = {data_float(cv, f, token)}};
    }
    *ended = data_token(f)->code == TOK_EOF;
    return true;
}

static bool is_readable(ValueType type) {
    return type == VALUE_NONE || type == VALUE_STRING || (value_width(type) && type != VALUE_COLOR);
}

// ( HANDLE , NAME , NAME ... )
void run_read(Converter *cv) {
    UserFile *f;
    expect(cv, '(', "#read");
    Symbol *handle = expect_handle(cv, &f);
    if (f->writing) {
        Loc loc = token_loc(cv, cv->language->last);
        die_at(&loc, "Cannot read from '%s': it is open for writing only", f->name);
    }
    optional_comma(cv);
    bool ended = false;
    while (!accept(cv, ')')) {
        const Token *token = peek_token(cv);
        const Place *ahead = ahead_place(cv);
        if (token->code != TOK_IDENTIFIER || (ahead && !is_readable(ahead->value->type)))
            die_expected(cv, "an identifier to read into (a float, vector or string)");
        Place place = ahead ? *ahead : (Place){0};
        next_token(cv);
        Value value;
        if (!ended && read_item(cv, f, &value, &ended)) {
            if (!place.symbol) {
                place.symbol = symbol_add(cv, token->name, 0);
                place.value = &place.symbol->value;
            }
            Loc loc = token_loc(cv, token);
            place_assign(cv, &place, &value, &loc);
        }
        optional_comma(cv);
    }
    if (ended)
        symbol_remove(cv, handle);
}

// ---- #write -----------------------------------------------------------------------------------

// ORDER as keywords: bytes, signed, big-endian
static const struct {
    int code, bytes;
    bool is_signed, big_endian;
} formats[] = {
    {KW_sint8, 1, true, false},    {KW_uint8, 1, false, false},   {KW_sint16be, 2, true, true},
    {KW_sint16le, 2, true, false}, {KW_uint16be, 2, false, true}, {KW_uint16le, 2, false, false},
    {KW_sint32be, 4, true, true},  {KW_sint32le, 4, true, false},
};

static void write_binary(Converter *cv, UserFile *f, size_t format) {
    int bytes = formats[format].bytes;
    double range = ldexp(1, 8 * bytes - (formats[format].is_signed ? 1 : 0));
    double low = formats[format].is_signed ? -range : 0, high = range - 1;
    while (starts_expression(cv)) {
        double e[5] = {0};
        int width = parse_add(cv, e, 1);
        for (int i = 0; i < width; i++) {
            int64_t v = (int64_t)(e[i] <= low ? low : e[i] >= high ? high : floor(e[i] + 0.5));
            for (int k = 0; k < bytes; k++) {
                int shift = 8 * (formats[format].big_endian ? bytes - 1 - k : k);
                char byte = (char)(v >> shift & 0xFF);
                append_bytes(cv, f, &byte, 1);
            }
        }
    }
}

static void write_numbers(Converter *cv, UserFile *f) {
    double e[5] = {0};
    int width = parse_add(cv, e, 1);
    if (width == 1) {
        append_text(cv, f, arena_printf(cv->arena, "%g", e[0]));
        return;
    }
    for (int i = 0; i < width; i++)
        append_text(cv, f, arena_printf(cv->arena, "%s%g", i ? "," : "<", e[i]));
    append_text(cv, f, "> ");
}

// ( HANDLE , item ... )
void run_write(Converter *cv) {
    UserFile *f;
    expect(cv, '(', "#write");
    expect_handle(cv, &f);
    if (!f->writing) {
        Loc loc = token_loc(cv, cv->language->last);
        die_at(&loc, "Cannot write to '%s': it is open for reading only", f->name);
    }
    while (!accept(cv, ')')) {
        size_t format = 0, count = sizeof formats / sizeof *formats;
        while (format < count && !next_is(cv, formats[format].code))
            format++;
        if (format < count) {
            next_token(cv);
            write_binary(cv, f, format);
        } else if (starts_string(cv)) {
            append_text(cv, f, string_for_output(cv, parse_string(cv)));
        } else if (starts_expression(cv)) {
            write_numbers(cv, f);
        } else if (!accept(cv, ',')) {
            die_expected(cv, "a string, number or vector to write");
        }
    }
}
