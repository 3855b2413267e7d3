// SPDX-License-Identifier: MIT
// jansson can indent too, but then puts every coordinate on a line of its own, and writes 0.1 with
// 17 digits. So the scene is written as compact text first and laid out here: for each bracket,
// look ahead whether its inside still fits in the line.
#include "model/json_layout.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_WIDTH = 100, INDENT = 2 };

// "-0" would be read as an integer and lose its sign.
static bool negative_zero(char out[JSON_NUMBER_SIZE], double value) {
    if (value != 0 || !signbit(value))
        return false;
    strcpy(out, "-0.0");
    return true;
}

void json_double(char out[JSON_NUMBER_SIZE], double value) {
    if (negative_zero(out, value))
        return;
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, JSON_NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return;
    }
}

// Read back as scene_read does: as a double first.
void json_float(char out[JSON_NUMBER_SIZE], float value) {
    if (negative_zero(out, (double)value))
        return;
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(out, JSON_NUMBER_SIZE, "%.*g", digits, (double)value);
        if ((float)strtod(out, NULL) == value)
            return;
    }
}

// The end of the string that begins at p (at its quote).
static const char *string_end(const char *p) {
    for (p++; *p != '"'; p++)
        if (*p == '\\')
            p++;
    return p + 1;
}

static const char *token_end(const char *p) {
    return *p == '"' ? string_end(p) : p + strcspn(p, ",:[]{}\"");
}

// Does the value at p, with blanks after its commas and colons, take at most room columns?
static bool fits(const char *p, int room) {
    int depth = 0;
    do {
        if (*p == ',' || *p == ':') {
            room -= 2;
            p++;
        } else if (strchr("[]{}", *p)) {
            depth += *p == '[' || *p == '{' ? 1 : -1;
            room--;
            p++;
        } else {
            const char *end = token_end(p);
            room -= (int)(end - p);
            p = end;
        }
    } while (depth > 0 && room >= 0);
    return room >= 0;
}

static void new_line(FILE *out, int indent) { fprintf(out, "\n%*s", indent, ""); }

typedef enum { BREAK_ALWAYS, BREAK_IF_LONG, BREAK_NEVER } Breaking;

static bool is_broken(const char *p, Breaking breaking, int indent, int column) {
    bool numbers = p[0] == '[' && strchr("-0123456789", p[1]);
    if (breaking == BREAK_NEVER || numbers || p[1] == ']' || p[1] == '}')
        return false;
    // One more column for the comma or bracket that follows.
    int start = column > indent ? column : indent;
    return breaking == BREAK_ALWAYS || !fits(p, LINE_WIDTH - start - 1);
}

// Writes the value at p, which stands at `column` of a line indented by `indent`; returns its end.
static const char *lay_out(const char *p, FILE *out, int indent, int column, Breaking breaking) {
    if (*p != '[' && *p != '{') {
        const char *end = token_end(p);
        fwrite(p, 1, (size_t)(end - p), out);
        return end;
    }
    bool broken = is_broken(p, breaking, indent, column), array = *p == '[';
    int inner = indent + INDENT;
    Breaking below = !broken || (array && p[1] == '[') ? BREAK_NEVER : BREAK_IF_LONG;
    fputc(*p++, out);
    for (bool first = true; *p != ']' && *p != '}'; first = false) {
        if (!first) {
            p++; // the comma
            fputc(',', out);
        }
        if (broken)
            new_line(out, inner);
        else if (!first)
            fputc(' ', out);
        column = inner;
        if (!array) {
            const char *colon = string_end(p);
            fwrite(p, 1, (size_t)(colon - p), out);
            fputs(": ", out);
            column += (int)(colon - p) + 2;
            p = colon + 1;
        }
        p = lay_out(p, out, inner, column, below);
    }
    if (broken)
        new_line(out, indent);
    fputc(*p, out);
    return p + 1;
}

void json_layout(const char *compact, FILE *out) {
    lay_out(compact, out, 0, 0, BREAK_ALWAYS);
    fputc('\n', out);
}
