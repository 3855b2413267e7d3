// SPDX-License-Identifier: MIT
// The streams of messages, POV-Ray's five. Each is shown on standard error unless turned off, and
// may be copied to files.
#ifndef BASE_CONSOLE_H
#define BASE_CONSOLE_H

#include <stdarg.h>
#include <stdbool.h>

// ORDER console
typedef enum {
    CONSOLE_DEBUG,     // #debug
    CONSOLE_FATAL,     // errors
    CONSOLE_RENDER,    // notes, progress, names of what was written
    CONSOLE_STATISTIC, // counts and times at the end
    CONSOLE_WARNING,
    CONSOLE_COUNT,
} Console;

void console_show(Console console, bool on);
// Copies what follows to the file at path, which is emptied first unless append says otherwise.
// Streams may share a file. Dies if the file cannot be written.
void console_copy(Console console, const char *path, bool append);
void console_print(Console console, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
