// SPDX-License-Identifier: MIT
#include "model/field_path.h"

#include "base/diag.h"

#include <stdarg.h>
#include <stdio.h>

enum { MAX_TEXT = 400 }; // of a path and of a message; longer ones are cut

// Appends the path's text from its top; returns the length so far.
static int append(char *out, int length, const FieldPath *path) {
    if (path->up)
        length = append(out, length, path->up);
    if (length >= MAX_TEXT - 1)
        return length;
    size_t room = (size_t)(MAX_TEXT - length);
    const char *name = path->name ? path->name : "", *dot = path->name && length > 0 ? "." : "";
    int more = path->index < 0
                   ? snprintf(out + length, room, "%s%s", dot, name)
                   : snprintf(out + length, room, "%s%s[%lld]", dot, name, (long long)path->index);
    length += more;
    return length < MAX_TEXT ? length : MAX_TEXT - 1;
}

void path_die(const char *file, const FieldPath *path, const char *format, ...) {
    char where[MAX_TEXT] = "", message[MAX_TEXT];
    if (path)
        append(where, 0, path);
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    die("%s: %s%s%s", file, where, where[0] ? ": " : "", message);
}
