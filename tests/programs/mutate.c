// SPDX-License-Identifier: MIT
// Makes small scenes that are a little wrong, or right in a way that nobody writes: statements of
// tests/grammar.txt that POV-Ray reads, with numbers changed, items left out, twice, in another
// order, or taken from other statements. tests/mutations.sh asks POV-Ray and pov2qi what they say.
//
//   mutate FIRST COUNT     prints programs number FIRST and on, one a line, always the same ones
#include "base/rng.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SEEDS = 2000, MAX_TOKENS = 600, MAX_TEXT = 4096 };

typedef struct {
    const char *text;
    int length;
    bool glued; // no blank before it
} Piece;

typedef struct {
    Piece pieces[MAX_TOKENS];
    int count;
} Program;

static char *seeds[MAX_SEEDS];
static int seed_count;

static void read_seeds(const char *path) {
    char line[MAX_TEXT];
    FILE *in = fopen(path, "r");
    if (!in) {
        perror(path);
        exit(1);
    }
    while (fgets(line, sizeof line, in) && seed_count < MAX_SEEDS) {
        line[strcspn(line, "\n")] = '\0';
        if (strncmp(line, "ok ", 3) == 0)
            seeds[seed_count++] = strdup(line + 3);
    }
    fclose(in);
}

static int word_length(const char *p) {
    int n = 1;
    if (*p == '"') {
        while (p[n] && p[n] != '"')
            n++;
        return p[n] ? n + 1 : n;
    }
    if (isalpha((unsigned char)*p) || *p == '_' || *p == '#') {
        while (isalnum((unsigned char)p[n]) || p[n] == '_')
            n++;
    } else if (isdigit((unsigned char)*p)) {
        while (isdigit((unsigned char)p[n]) || p[n] == '.' || p[n] == 'e')
            n++;
    }
    return n;
}

static void split(const char *text, Program *out) {
    out->count = 0;
    bool glued = true;
    for (const char *p = text; *p && out->count < MAX_TOKENS / 2;) {
        if (isspace((unsigned char)*p)) {
            glued = false;
            p++;
            continue;
        }
        int n = word_length(p);
        out->pieces[out->count++] = (Piece){p, n, glued};
        glued = true;
        p += n;
    }
}

static bool is_number(const Piece *p) { return isdigit((unsigned char)*p->text); }
static bool is_word(const Piece *p) { return isalpha((unsigned char)*p->text); }

static int below(Rng *r, int n) { return (int)(rng_next(r) % (uint64_t)n); }

static void cut(Program *p, int at, int n) {
    memmove(p->pieces + at, p->pieces + at + n, sizeof(Piece) * (size_t)(p->count - at - n));
    p->count -= n;
    if (at < p->count)
        p->pieces[at].glued = false;
}

static void paste(Program *p, int at, const Piece *from, int n) {
    Piece copy[MAX_TOKENS];
    if (n > MAX_TOKENS - p->count)
        return;
    memcpy(copy, from, sizeof(Piece) * (size_t)n);
    memmove(p->pieces + at + n, p->pieces + at, sizeof(Piece) * (size_t)(p->count - at));
    memcpy(p->pieces + at, copy, sizeof(Piece) * (size_t)n);
    if (n > 0)
        p->pieces[at].glued = false;
    p->count += n;
    if (at + n < p->count)
        p->pieces[at + n].glued = false;
}

// How many pieces belong to the item that begins at `at`: a word with all that follows it up to the
// next word at its level, a bracket with all that it holds.
static int item_length(const Program *p, int at) {
    int depth = 0, n = 0;
    for (int i = at; i < p->count; i++, n++) {
        char c = *p->pieces[i].text;
        if (strchr("{<([", c))
            depth++;
        else if (strchr("}>)]", c) && --depth < 0)
            return n;
        else if (depth == 0 && n > 0 && is_word(&p->pieces[i]) && p->pieces[i].length > 1)
            return n;
    }
    return n;
}

// A piece of that kind, or -1.
static int find_piece(Rng *r, const Program *p, bool (*kind)(const Piece *)) {
    for (int tries = 0; tries < 50 && p->count > 0; tries++) {
        int at = below(r, p->count);
        if (kind(&p->pieces[at]))
            return at;
    }
    return -1;
}

static void replace(Program *p, int at, const char *text) {
    p->pieces[at] = (Piece){text, (int)strlen(text), false};
    if (at + 1 < p->count)
        p->pieces[at + 1].glued = false;
}

static void change_number(Rng *r, Program *p) {
    static const char *const values[] = {"0",    "-1",      "1",     "2",       "3",   "0.5",
                                         "-0.5", "4",       "300",   "1e-11",   "-2",  "1e10",
                                         "x",    "5",       "<1,2>", "<1,2,3>", "1.5", "yes",
                                         "-1e7", "rgb 0.5", "\"A\"", "1000",    "7"};
    int at = find_piece(r, p, is_number);
    if (at >= 0)
        replace(p, at, values[below(r, sizeof values / sizeof *values)]);
}

static void change(Rng *r, Program *p) {
    static Program other;
    int at = below(r, p->count), n, from;
    switch (below(r, 10)) {
    case 0:
    case 1:
    case 2:
        change_number(r, p);
        return;
    case 3:
        cut(p, at, 1);
        return;
    case 4:
        paste(p, at, &p->pieces[at], 1);
        return;
    case 5:
        n = item_length(p, at);
        cut(p, at, n > 0 ? n : 1);
        return;
    case 6:
        paste(p, at, &p->pieces[at], item_length(p, at));
        return;
    case 7: // two items in the other order
        n = item_length(p, at);
        if (at + n < p->count && n > 0) {
            Piece moved[MAX_TOKENS];
            int next = item_length(p, at + n);
            memcpy(moved, p->pieces + at, sizeof(Piece) * (size_t)n);
            cut(p, at, n);
            paste(p, at + next, moved, n);
        }
        return;
    default: // an item or a word of another statement
        split(seeds[below(r, seed_count)], &other);
        from = find_piece(r, &other, is_word);
        if (from < 0)
            return;
        if (below(r, 2) == 0)
            paste(p, at, &other.pieces[from], item_length(&other, from));
        else if ((at = find_piece(r, p, is_word)) >= 0)
            p->pieces[at] = other.pieces[from];
    }
}

static void print_program(const Program *p) {
    for (int i = 0; i < p->count; i++)
        printf("%s%.*s", p->pieces[i].glued ? "" : " ", p->pieces[i].length, p->pieces[i].text);
    putchar('\n');
}

int main(int argc, char **argv) {
    if (argc != 3)
        return 2;
    read_seeds("tests/grammar.txt");
    uint64_t first = strtoull(argv[1], NULL, 10), count = strtoull(argv[2], NULL, 10);
    for (uint64_t i = first; i < first + count; i++) {
        Rng r = {i * 7919 + 1};
        static Program program;
        split(seeds[below(&r, seed_count)], &program);
        for (int n = 1 + (below(&r, 4) == 0); n > 0 && program.count > 0; n--)
            change(&r, &program);
        print_program(&program);
    }
}
