// SPDX-License-Identifier: MIT
// State is per program: main sets it once, before there are threads.
#include "base/console.h"

#include "base/diag.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { COPIES = 2 }; // its own file, and the one of all streams

static bool hidden[CONSOLE_COUNT];
static FILE *copies[CONSOLE_COUNT][COPIES];

// Files that are open, by name: streams that share one write to it in turn.
static struct {
    const char *path;
    FILE *file;
} open_files[CONSOLE_COUNT + 1];

void console_show(Console console, bool on) { hidden[console] = !on; }

static FILE *file_of(const char *path, bool append) {
    int i = 0;
    for (; open_files[i].path; i++)
        if (strcmp(open_files[i].path, path) == 0)
            return open_files[i].file;
    FILE *file = fopen(path, append ? "a" : "w");
    if (!file)
        die("cannot write '%s': %s", path, strerror(errno));
    setvbuf(file, NULL, _IOLBF, 0); // complete lines, however the program ends
    open_files[i].path = path;
    open_files[i].file = file;
    return file;
}

void console_copy(Console console, const char *path, bool append) {
    FILE *file = file_of(path, append);
    int i = 0;
    while (copies[console][i] && copies[console][i] != file)
        i++;
    copies[console][i] = file;
}

void console_print(Console console, const char *format, ...) {
    va_list args;
    if (!hidden[console]) {
        va_start(args, format);
        vfprintf(stderr, format, args);
        va_end(args);
    }
    for (int i = 0; i < COPIES && copies[console][i]; i++) {
        va_start(args, format);
        vfprintf(copies[console][i], format, args);
        va_end(args);
    }
}
