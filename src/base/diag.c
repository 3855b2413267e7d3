// SPDX-License-Identifier: MIT
// Messages are built whole in memory, then printed or handed to the innermost catch. State is per
// thread where it must be (the catch), per program else (flags set once by main or a test).
#include "base/diag.h"

#include "base/console.h"
#include "base/hash.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Catch {
    jmp_buf jump;
    char *message;
    struct Catch *outer;
} Catch;

static _Thread_local Catch *innermost;
static bool strict, verbose, quiet;
static const char *program = "qipov";
static size_t warnings;

void diag_strict(bool on) { strict = on; }
void diag_verbose(bool on) { verbose = on; }
void diag_quiet(bool on) { quiet = on; }
void diag_program(const char *name) { program = name; }
size_t diag_warning_count(void) { return warnings; }

enum { CARET_WIDTH = 160 }; // longer source lines are shown only around the caret

// The source line of loc and a caret below its column. Bytes that a terminal could take for
// commands are shown as '?', tabs as blanks.
static void print_excerpt(FILE *out, const Loc *loc) {
    if (!loc->text || loc->line < 1)
        return;
    const char *line = loc->text;
    for (int n = 1; n < loc->line && *line; line++) {
        if (*line == '\n' || (*line == '\r' && line[1] != '\n'))
            n++;
    }
    int length = (int)strcspn(line, "\r\n"), caret = loc->column > 0 ? loc->column - 1 : 0;
    if (caret > length)
        caret = length;
    int start = caret > CARET_WIDTH - 20 ? caret - (CARET_WIDTH - 20) : 0;
    int end = length - start > CARET_WIDTH ? start + CARET_WIDTH : length;
    fputs("\n  ", out);
    for (int i = start; i < end; i++) {
        unsigned char c = (unsigned char)line[i];
        fputc(c == '\t' ? ' ' : (c < 32 || c == 127) ? '?' : c, out);
    }
    fprintf(out, "\n  %*s^", caret - start, "");
}

static void print_message(FILE *out, const Loc *loc, const char *kind, const char *format,
                          va_list args) {
    if (loc && loc->file)
        fprintf(out, "%s:%d:%d: %s: ", loc->file, loc->line, loc->column, kind);
    else
        fprintf(out, "%s: %s: ", program, kind);
    vfprintf(out, format, args);
    if (!loc || !loc->file)
        return;
    print_excerpt(out, loc);
    int depth = 0;
    for (const Loc *from = loc->from, *at = loc; from && depth < 8;
         at = from, from = from->from, depth++)
        fprintf(out, "\n%s:%d:%d: note: %s here", from->file, from->line, from->column,
                at->what ? at->what : "included");
}

static char *build_message(const Loc *loc, const char *kind, const char *format, va_list args) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        fputs("out of memory\n", stderr);
        exit(1);
    }
    print_message(out, loc, kind, format, args);
    fclose(out);
    return text;
}

_Noreturn static void raise_message(char *message) {
    if (innermost) {
        innermost->message = message;
        longjmp(innermost->jump, 1);
    }
    console_print(CONSOLE_FATAL, "%s\n", message);
    exit(1);
}

void die(const char *format, ...) {
    va_list args;
    va_start(args, format);
    char *message = build_message(NULL, "error", format, args);
    va_end(args);
    raise_message(message);
}

void die_at(const Loc *loc, const char *format, ...) {
    va_list args;
    va_start(args, format);
    char *message = build_message(loc, "error", format, args);
    va_end(args);
    raise_message(message);
}

// What a loop or a macro would say a thousand times is said once: hashes of what was printed. When
// the table is full, all is printed.
static bool said_before(const char *message) {
    enum { SLOTS = 4096, PROBES = 64 };
    static uint64_t said[SLOTS];
    uint64_t hash = hash_bytes(HASH_START, message, strlen(message)) | 1; // 0 is a free slot
    for (uint64_t i = 0; i < PROBES; i++) {
        uint64_t *slot = &said[(hash / 2 + i) % SLOTS];
        if (*slot == hash)
            return true;
        if (*slot == 0) {
            *slot = hash;
            return false;
        }
    }
    return false;
}

static void warn_with(const Loc *loc, bool each, const char *format, va_list args) {
    warnings++;
    char *message = build_message(loc, strict ? "error" : "warning", format, args);
    if (strict)
        raise_message(message);
    if (!quiet && (each || !said_before(message)))
        console_print(CONSOLE_WARNING, "%s\n", message);
    free(message);
}

void warn_at(const Loc *loc, const char *format, ...) {
    va_list args;
    va_start(args, format);
    warn_with(loc, false, format, args);
    va_end(args);
}

void warn_each_at(const Loc *loc, const char *format, ...) {
    va_list args;
    va_start(args, format);
    warn_with(loc, true, format, args);
    va_end(args);
}

void warn(const char *format, ...) {
    va_list args;
    va_start(args, format);
    warn_with(NULL, true, format, args);
    va_end(args);
}

void note_at(const Loc *loc, const char *format, ...) {
    if (!verbose || quiet)
        return;
    va_list args;
    va_start(args, format);
    char *message = build_message(loc, "note", format, args);
    va_end(args);
    console_print(CONSOLE_RENDER, "%s\n", message);
    free(message);
}

bool diag_catch(void (*body)(void *), void *arg, char **message) {
    Catch frame = {.outer = innermost};
    innermost = &frame;
    if (setjmp(frame.jump) == 0) {
        body(arg);
        innermost = frame.outer;
        return true;
    }
    innermost = frame.outer;
    if (message)
        *message = frame.message;
    else
        free(frame.message);
    return false;
}

void diag_rethrow(char *message) { raise_message(message); }
