// SPDX-License-Identifier: MIT
// What #debug prints, as POV-Ray shows it: whole lines only (what follows the last line end is
// never shown), none longer than 80 columns, and of a long text its beginning.
#include "converter/language.h"

#include "base/console.h"

#include <string.h>

enum {
    WIDTH = 80,
    BACK = WIDTH / 4, // a line is broken at a blank so near to its end, or at its end
    LONGEST = 200,    // bytes of one text; of longer ones come CUT and three dots
    CUT = 156,
};

_Static_assert(sizeof((Language *)0)->debug_line > WIDTH + 1, "a line and what does not fit on it");

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

static void show_line(Language *l, size_t length) {
    console_print(CONSOLE_DEBUG, "%.*s\n", (int)length, l->debug_line);
}

// The line is one byte too long: shows what fits, keeps the rest. A blank stays with the rest.
static void break_line(Language *l) {
    size_t at = WIDTH;
    while (at > WIDTH - BACK && !is_blank(l->debug_line[at]))
        at--;
    if (at == WIDTH - BACK)
        at = WIDTH;
    show_line(l, at);
    l->debug_used -= at;
    memmove(l->debug_line, l->debug_line + at, l->debug_used);
}

static void put_bytes(Language *l, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '\n' || text[i] == '\r') {
            show_line(l, l->debug_used);
            l->debug_used = 0;
            continue;
        }
        l->debug_line[l->debug_used++] = text[i];
        if (l->debug_used > WIDTH)
            break_line(l);
    }
}

void debug_text(Converter *cv, const char *text) {
    Language *l = cv->language;
    const char *shown = string_for_output(cv, text);
    size_t length = strlen(shown);
    put_bytes(l, shown, length > LONGEST ? CUT : length);
    if (length > LONGEST)
        put_bytes(l, "...", 3);
}
