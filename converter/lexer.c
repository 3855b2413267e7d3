// SPDX-License-Identifier: MIT
// Text -> tokens (facts: sdl 1.1-1.3). One pass over the bytes; the longest token wins. Where the
// text cannot be read, the list ends with TOK_ERROR: the message must come when the program gets
// there, not before what stands in front of it has run.
#include "converter/language.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    Converter *cv;
    const Source *source;
    const char *p, *end, *line_start;
    int line;
    ARRAY(Token) tokens;
} Lexer;

static const char *const keywords[] = {
#define X(word) #word,
#include "converter/keywords.h"
#undef X
};

const char *keyword_name(int code) {
    return code >= KW_FIRST && code < KW_END ? keywords[code - KW_FIRST] : NULL;
}

static int find_keyword(const char *text, size_t length) {
    int low = 0, high = KW_END - KW_FIRST;
    while (low < high) {
        int middle = (low + high) / 2;
        int order = strncmp(text, keywords[middle], length);
        if (order == 0)
            order = keywords[middle][length] ? -1 : 0;
        if (order == 0)
            return KW_FIRST + middle;
        if (order < 0)
            high = middle;
        else
            low = middle + 1;
    }
    return 0;
}

static Token *add_token(Lexer *lx, int code, const char *at) {
    array_push(&lx->tokens, ((Token){.code = code, .source = lx->source}));
    Token *token = &lx->tokens.items[lx->tokens.count - 1];
    token->line = lx->line;
    token->column = (int)(at - lx->line_start) + 1;
    return token;
}

// The rest of the text is given up.
static void add_error(Lexer *lx, const char *at, const char *message) {
    add_token(lx, TOK_ERROR, at)->text = message;
    lx->p = lx->end;
}

// LF, CRLF and a lone CR end a line. p stands on the first byte of the line end.
static void skip_line_end(Lexer *lx) {
    if (lx->p[0] == '\r' && lx->p + 1 < lx->end && lx->p[1] == '\n')
        lx->p++;
    lx->p++;
    lx->line++;
    lx->line_start = lx->p;
}

// Of ASCII, whatever the locale.
static bool is_digit(char c) { return c >= '0' && c <= '9'; }
static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

// Comments of this kind nest.
static void skip_block_comment(Lexer *lx) {
    const char *start = lx->p, *start_line = lx->line_start;
    int line = lx->line, depth = 0;
    while (lx->p < lx->end) {
        char c = lx->p[0], next = lx->p + 1 < lx->end ? lx->p[1] : '\0';
        if (c == '/' && next == '*') {
            depth++;
            lx->p += 2;
        } else if (c == '*' && next == '/') {
            lx->p += 2;
            if (--depth == 0)
                return;
        } else if (is_line_end(c)) {
            skip_line_end(lx);
        } else {
            lx->p++;
        }
    }
    lx->line = line;
    lx->line_start = start_line;
    add_error(lx, start, "This comment never ends: no closing */ (they nest)");
}

// A decimal without an exponent whose digits make a whole number below 2^53, over a power of ten
// below 10^23: both are exact, so that their quotient is rounded once and is what strtod gives.
static bool short_number(const char *start, const char *end, double *out) {
    static const double powers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    uint64_t digits = 0;
    int count = 0, places = -1;
    for (const char *p = start; p < end; p++) {
        if (*p == '.') {
            places = 0;
            continue;
        }
        digits = digits * 10 + (uint64_t)(*p - '0');
        count++;
        places += places >= 0;
    }
    if (count > 15)
        return false;
    *out = places > 0 ? (double)digits / powers[places] : (double)digits;
    return true;
}

// digits [. digits] [e [sign] digits]; "5.", ".5" and "1e" are numbers too.
static void read_number(Lexer *lx) {
    static const char extra_period[] = "Unexpected additional '.' in floating-point number";
    const char *start = lx->p, *p = start;
    bool period = false;
    for (; p < lx->end && (is_digit(*p) || *p == '.'); p++) {
        if (*p == '.' && period) {
            add_error(lx, p, extra_period);
            return;
        }
        period = period || *p == '.';
    }
    const char *mantissa = p;
    if (p < lx->end && (*p == 'e' || *p == 'E')) {
        p++;
        if (p < lx->end && (*p == '+' || *p == '-'))
            p++;
        while (p < lx->end && is_digit(*p))
            p++;
        if (p < lx->end && *p == '.') {
            add_error(lx, p, extra_period);
            return;
        }
    }
    // strtod knows hexadecimal; the language does not: 0x10 is 0 and the identifier x10.
    bool hexadecimal = mantissa - start == 1 && *start == '0' && mantissa < lx->end &&
                       (*mantissa == 'x' || *mantissa == 'X');
    Token *token = add_token(lx, TOK_NUMBER, start);
    if (hexadecimal)
        token->number = 0;
    else if (p != mantissa || !short_number(start, mantissa, &token->number))
        token->number = strtod(start, NULL);
    lx->p = p;
}

static void read_word(Lexer *lx) {
    const char *start = lx->p, *p = start;
    while (p < lx->end && (is_letter(*p) || is_digit(*p)))
        p++;
    size_t length = (size_t)(p - start);
    if (length > MAX_IDENTIFIER) {
        add_error(lx, start, "This identifier is too long (4096 characters are the limit)");
        return;
    }
    int code = find_keyword(start, length);
    Token *token = add_token(lx, code ? code : TOK_IDENTIFIER, start);
    if (code) {
        token->text = keyword_name(code);
    } else {
        token->name = name_intern(lx->cv, start, length);
        token->text = name_text(lx->cv, token->name);
    }
    lx->p = p;
}

// Between double quotes, over lines too; a backslash keeps the quote after it inside.
static void read_string(Lexer *lx) {
    const char *start = lx->p, *line_start = lx->line_start;
    int line = lx->line;
    lx->p++;
    while (lx->p < lx->end && *lx->p != '"') {
        if (*lx->p == '\0') {
            add_error(lx, lx->p, "A NUL byte inside a string");
            return;
        }
        if (is_line_end(*lx->p)) {
            skip_line_end(lx);
        } else {
            bool escape = *lx->p == '\\' && lx->p + 1 < lx->end && !is_line_end(lx->p[1]);
            lx->p += escape && lx->p[1] != '\0' ? 2 : 1;
        }
    }
    int last_line = lx->line;
    const char *last_start = lx->line_start;
    lx->line = line;
    lx->line_start = line_start;
    size_t length = (size_t)(lx->p - start) - 1;
    if (lx->p >= lx->end) {
        add_error(lx, start, "No end quote for this string");
    } else if (length > limit_of(lx->cv, LIMIT_STRING)) {
        add_error(
            lx, start,
            arena_printf(lx->cv->arena, "String too long %s", limit_hint(lx->cv, LIMIT_STRING)));
    } else {
        char *text = arena_alloc(lx->cv->arena, length + 1);
        memcpy(text, start + 1, length);
        add_token(lx, TOK_STRING, start)->text = text;
        lx->p++;
        lx->line = last_line;
        lx->line_start = last_start;
    }
}

static void read_symbol(Lexer *lx) {
    const char *start = lx->p;
    unsigned char c = (unsigned char)*start;
    char next = start + 1 < lx->end ? start[1] : '\0';
    if (next == '=' && (c == '<' || c == '>' || c == '!')) {
        add_token(lx, c == '<' ? TOK_LE : c == '>' ? TOK_GE : TOK_NE, start);
        lx->p += 2;
    } else if (c > ' ' && c < 127) { // letters, digits and quotes have been seen to
        add_token(lx, c, start);
        lx->p++;
    } else {
        const char *hint = c > 127
                               ? " (letters outside ASCII may stand only in strings and comments)"
                               : " (is this a text file?)";
        add_error(lx, start,
                  arena_printf(lx->cv->arena, "Illegal character in input file, value is %02x%s", c,
                               hint));
    }
}

static void read_token(Lexer *lx) {
    char c = lx->p[0], next = lx->p + 1 < lx->end ? lx->p[1] : '\0';
    if (is_line_end(c)) {
        skip_line_end(lx);
    } else if (is_blank(c) || c == '\0' || c == 0x1A) {
        lx->p++;
    } else if (c == '/' && next == '/') {
        while (lx->p < lx->end && !is_line_end(*lx->p))
            lx->p++;
    } else if (c == '/' && next == '*') {
        skip_block_comment(lx);
    } else if (is_digit(c) || (c == '.' && is_digit(next))) {
        read_number(lx);
    } else if (is_letter(c)) {
        read_word(lx);
    } else if (c == '"') {
        read_string(lx);
    } else {
        read_symbol(lx);
    }
}

TokenList lexer_tokenize(Converter *cv, const Source *source) {
    Lexer lx = {.cv = cv, .source = source, .p = source->text, .line = 1};
    lx.end = source->text + source->size;
    // Only a scene may begin with bytes outside ASCII (a byte order mark): they are no text.
    while (source->utf8 && lx.p < lx.end && (unsigned char)*lx.p > 127)
        lx.p++;
    lx.line_start = lx.p;
    while (lx.p < lx.end)
        read_token(&lx);
    add_token(&lx, TOK_EOF, lx.p);
    TokenList list = {.count = lx.tokens.count};
    list.items = arena_adopt(cv->arena, lx.tokens.items, lx.tokens.count * sizeof(Token));
    return list;
}

const char *token_describe(Converter *cv, const Token *token) {
    switch (token->code) {
    case TOK_EOF:
        return "end of file";
    case TOK_NUMBER:
        return arena_printf(cv->arena, "number %g", token->number);
    case TOK_STRING:
        return arena_printf(cv->arena, "string \"%.30s%s\"", token->text,
                            strlen(token->text) > 30 ? "..." : "");
    case TOK_IDENTIFIER: {
        const Symbol *symbol = name_symbol(cv, token->name);
        if (!symbol)
            return arena_printf(cv->arena, "undeclared identifier '%s'", token->text);
        const Value *value = symbol->target ? symbol->target : &symbol->value;
        return arena_printf(cv->arena, "%s identifier '%s'", value_type_name(value->type),
                            token->text);
    }
    case TOK_LE:
        return "'<='";
    case TOK_GE:
        return "'>='";
    case TOK_NE:
        return "'!='";
    default:
        if (token->code >= KW_FIRST)
            return arena_printf(cv->arena, "'%s'", keyword_name(token->code));
        return arena_printf(cv->arena, "'%c'", token->code);
    }
}
