// SPDX-License-Identifier: MIT
// What an undeclared identifier may have meant: a name of nearly the same spelling that is known
// here, or one that a file of the library declares. Only asked for on the way to an error message.
#include "converter/language.h"

#include "base/file.h"

#include <ctype.h>
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MAX_WORD = 64 };

// Insertions, deletions, replacements and swaps of neighbours between a and b; at most `limit` + 1.
static int distance(const char *a, const char *b, int limit) {
    int rows[3][MAX_WORD + 1], length_a = (int)strlen(a), length_b = (int)strlen(b);
    if (length_a > MAX_WORD || length_b > MAX_WORD || abs(length_a - length_b) > limit)
        return limit + 1;
    int *before = rows[0], *last = rows[1], *row = rows[2];
    for (int j = 0; j <= length_b; j++)
        last[j] = before[j] = j;
    for (int i = 1; i <= length_a; i++) {
        row[0] = i;
        for (int j = 1; j <= length_b; j++) {
            int best = last[j - 1] + (a[i - 1] != b[j - 1]);
            best = last[j] + 1 < best ? last[j] + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                before[j - 2] + 1 < best)
                best = before[j - 2] + 1;
            row[j] = best;
        }
        int *free_row = before;
        before = last;
        last = row;
        row = free_row;
    }
    return last[length_b];
}

static void consider(const char *word, const char *candidate, int *best, const char **nearest) {
    int d = distance(word, candidate, *best - 1);
    if (d < *best) {
        *best = d;
        *nearest = candidate;
    }
}

// One slip in a short word, two in a long one.
static const char *nearest_name(Converter *cv, const char *word) {
    int best = strlen(word) < 4 ? 1 : strlen(word) < 8 ? 2 : 3;
    const char *nearest = NULL;
    for (uint32_t n = 1; n < name_count(cv); n++) {
        const Symbol *symbol = name_symbol(cv, n);
        if (symbol && symbol->value.type != VALUE_NONE)
            consider(word, name_text(cv, n), &best, &nearest);
    }
    for (int code = KW_FIRST; code < KW_END; code++)
        consider(word, keyword_name(code), &best, &nearest);
    return nearest;
}

// Does the text contain `declare WORD` or `macro WORD`?
static bool declares(const char *text, const char *word) {
    size_t length = strlen(word);
    for (const char *p = text; (p = strstr(p, word)); p += length) {
        if (isalnum((unsigned char)p[length]) || p[length] == '_')
            continue;
        const char *q = p;
        while (q > text && isspace((unsigned char)q[-1]))
            q--;
        if (q < p && ((q - text >= 7 && strncmp(q - 7, "declare", 7) == 0) ||
                      (q - text >= 5 && strncmp(q - 5, "macro", 5) == 0)))
            return true;
    }
    return false;
}

// The first file of the library, in the order of names, that declares the word.
static const char *declaring_file(Converter *cv, const char *word) {
    const char *found = NULL;
    for (size_t i = 0; i < cv->language->library.count; i++) {
        DIR *dir = opendir(cv->language->library.items[i]);
        for (struct dirent *e; dir && (e = readdir(dir));) {
            const char *dot = strrchr(e->d_name, '.');
            if (!dot || strcmp(dot, ".inc") != 0 || (found && strcmp(e->d_name, found) > 0))
                continue;
            const char *path =
                arena_printf(cv->arena, "%s/%s", cv->language->library.items[i], e->d_name);
            const char *text = file_read(cv->arena, path, NULL, NULL);
            if (text && declares(text, word))
                found = arena_strdup(cv->arena, e->d_name);
        }
        if (dir)
            closedir(dir);
    }
    return found;
}

const char *spelling_hint(Converter *cv, const Token *token) {
    if (token->code != TOK_IDENTIFIER || name_symbol(cv, token->name))
        return "";
    for (int code = KW_FIRST; code < KW_END; code++) {
        if (strcasecmp(keyword_name(code), token->text) == 0)
            return arena_printf(cv->arena, " (reserved words are in small letters: '%s')",
                                keyword_name(code));
    }
    const char *file = declaring_file(cv, token->text);
    if (file)
        return arena_printf(cv->arena, " (%s declares it: #include \"%s\")", file, file);
    const char *nearest = nearest_name(cv, token->text);
    return nearest ? arena_printf(cv->arena, " (did you mean '%s'?)", nearest) : "";
}
