// SPDX-License-Identifier: MIT
// String expressions (facts: sdl 1.3, 2.6). POV-Ray's strings are sequences of 16-bit units; here
// each unit is one UTF-8 sequence of one to three bytes, which keeps the units countable.
#include "converter/language.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// ---- units ------------------------------------------------------------------------------------

// The unit at s and, in *length, its bytes. s is our own well-formed text.
static unsigned unit_at(const char *s, int *length) {
    const unsigned char *p = (const unsigned char *)s;
    if (p[0] < 0x80) {
        *length = 1;
        return p[0];
    }
    if (p[0] < 0xE0) {
        *length = 2;
        return (p[0] & 0x1Fu) << 6 | (p[1] & 0x3Fu);
    }
    *length = 3;
    return (p[0] & 0x0Fu) << 12 | (p[1] & 0x3Fu) << 6 | (p[2] & 0x3Fu);
}

static char *put_unit(char *p, unsigned unit) {
    if (unit < 0x80) {
        *p++ = (char)unit;
    } else if (unit < 0x800) {
        *p++ = (char)(0xC0 | unit >> 6);
        *p++ = (char)(0x80 | (unit & 0x3F));
    } else {
        *p++ = (char)(0xE0 | unit >> 12);
        *p++ = (char)(0x80 | (unit >> 6 & 0x3F));
        *p++ = (char)(0x80 | (unit & 0x3F));
    }
    return p;
}

size_t string_units(const char *s) {
    size_t count = 0;
    for (int length; *s; s += length, count++)
        unit_at(s, &length);
    return count;
}

static const char *skip_units(const char *s, size_t count) {
    for (int length; count && *s; s += length, count--)
        unit_at(s, &length);
    return s;
}

// 0, or the difference of the first units that differ.
int string_compare(const char *a, const char *b) {
    for (;;) {
        int length_a, length_b;
        unsigned ua = unit_at(a, &length_a), ub = unit_at(b, &length_b);
        if (ua != ub || ua == 0)
            return (int)ua - (int)ub;
        a += length_a;
        b += length_b;
    }
}

// Units outside ASCII are shown as blanks since version 3.5.
const char *string_for_output(Converter *cv, const char *s) {
    char *out = arena_alloc(cv->arena, strlen(s) + 1), *p = out;
    for (int length; *s; s += length) {
        unsigned unit = unit_at(s, &length);
        *p++ = unit < 128 ? (char)unit : ' ';
    }
    return out;
}

// ---- literals ---------------------------------------------------------------------------------

_Noreturn static void die_in(Converter *cv, const Token *token, const char *message) {
    Loc loc = token_loc(cv, token);
    die_at(&loc, "%s", message);
}

// One character of UTF-8 input, what cannot be a unit becomes U+FFFD.
static const char *decode_utf8(const char *s, unsigned *unit) {
    unsigned char c = (unsigned char)*s++;
    int more = c >= 0xF0 ? 3 : c >= 0xE0 ? 2 : c >= 0xC0 ? 1 : 0;
    unsigned code = more == 3 ? c & 7u : more == 2 ? c & 15u : more == 1 ? c & 31u : 0xFFFD;
    for (int i = 0; i < more; i++) {
        if (((unsigned char)*s & 0xC0) != 0x80) {
            *unit = 0xFFFD;
            return s;
        }
        code = code << 6 | ((unsigned char)*s++ & 0x3Fu);
    }
    *unit = code > 0xFFFF || code == 0 ? 0xFFFD : code;
    return s;
}

static const char *read_escape(Converter *cv, const Token *token, const char *s, unsigned *unit) {
    static const char letters[] = "abfnrtv\\'\"", meanings[] = "\a\b\f\n\r\t\v\\'\"";
    const char *known = *s ? strchr(letters, *s) : NULL;
    if (known) {
        *unit = (unsigned char)meanings[known - letters];
        return s + 1;
    }
    if (*s != 'u')
        die_in(cv, token, "Illegal escape sequence in string (a backslash is written \\\\)");
    char digits[5] = {0};
    for (int i = 0; i < 4; i++) {
        char c = s[1 + i];
        if (!c || !strchr("0123456789abcdefABCDEF", c))
            die_in(cv, token, "Unexpected end of escape sequence: \\u needs four hex digits");
        digits[i] = c;
    }
    *unit = (unsigned)strtoul(digits, NULL, 16);
    return s + 5;
}

const char *string_from_literal(Converter *cv, const Token *token, bool file_name) {
    const char *s = token->text;
    if (file_name || !strpbrk(s, "\\")) {
        const char *p = s;
        while (*p && (unsigned char)*p < 128)
            p++;
        if (!*p || file_name)
            return s;
    }
    bool warned = false;
    char *out = arena_alloc(cv->arena, 3 * strlen(s) + 1), *p = out;
    while (*s) {
        unsigned unit = (unsigned char)*s;
        if (unit == '\\') {
            s = read_escape(cv, token, s + 1, &unit);
        } else if (unit > 127 && cv->utf8) {
            s = decode_utf8(s, &unit);
        } else {
            s++;
            if (unit > 127 && cv->version >= 350) {
                if (!warned) {
                    Loc loc = token_loc(cv, token);
                    warn_at(&loc, "Letters outside ASCII in a string: each byte becomes a blank "
                                  "(global_settings { charset utf8 } reads them)");
                }
                warned = true;
                unit = ' ';
            }
        }
        if (unit)
            p = put_unit(p, unit);
    }
    return out;
}

// ---- functions --------------------------------------------------------------------------------

static void check_length(Converter *cv, size_t length) {
    if (length <= limit_of(cv, LIMIT_STRING))
        return;
    Loc loc = token_loc(cv, cv->language->last);
    die_at(&loc, "String too long: more than %llu bytes %s",
           (unsigned long long)limit_of(cv, LIMIT_STRING), limit_hint(cv, LIMIT_STRING));
}

// chr ( FULL )
static const char *parse_chr(Converter *cv) {
    const Token *start = peek_token(cv);
    double v = full_in_parentheses(cv, "chr");
    if (!(v > -1 && v < 65536))
        die_in(cv, start, "Chr() needs a number from 0 to 65535");
    char *out = arena_alloc(cv->arena, 4);
    put_unit(out, (unsigned)v);
    return out;
}

// concat ( S [,] S ... )
static const char *parse_concat(Converter *cv) {
    expect(cv, '(', "concat");
    const char *all = parse_string(cv);
    size_t length = strlen(all);
    for (;;) {
        optional_comma(cv);
        if (!starts_string(cv))
            break;
        const char *piece = parse_string(cv);
        size_t more = strlen(piece);
        check_length(cv, length + more);
        char *joined = arena_alloc(cv->arena, length + more + 1);
        memcpy(joined, all, length);
        memcpy(joined + length, piece, more);
        all = joined;
        length += more;
    }
    expect(cv, ')', "concat");
    return all;
}

// substr ( S , P , L )
static const char *parse_substr(Converter *cv) {
    const Token *start = peek_token(cv);
    expect(cv, '(', "substr");
    const char *s = parse_string(cv);
    optional_comma(cv);
    double position = parse_float(cv);
    optional_comma(cv);
    double length = parse_float(cv);
    expect(cv, ')', "substr");
    double p = trunc(position), n = trunc(length);
    size_t units = string_units(s);
    if (!(p >= 0 && n >= 0 && p + n <= (double)units + 1)) {
        Loc loc = token_loc(cv, start);
        die_at(&loc, "Illegal parameters in substr: %g characters from %g of a string of %zu", n, p,
               units);
    }
    // Position 0 is before the text; POV-Ray finds nothing there.
    const char *from = p > 0 ? skip_units(s, (size_t)p - 1) : "";
    size_t bytes = (size_t)(skip_units(from, (size_t)n) - from);
    char *out = arena_alloc(cv->arena, bytes + 1);
    memcpy(out, from, bytes);
    return out;
}

static const char *parse_case(Converter *cv, const char *where, char low, char high, int shift) {
    expect(cv, '(', where);
    char *out = arena_strdup(cv->arena, parse_string(cv));
    expect(cv, ')', where);
    for (char *p = out; *p; p++) {
        if (*p >= low && *p <= high)
            *p = (char)(*p + shift);
    }
    return out;
}

enum { MAX_NUMBER = 2048, MAX_DIGITS = 700 };

// C's "%[0]L.P" and the letter; returns how long the text is.
static int format_number(char text[MAX_NUMBER], double v, double length, double precision,
                         const char *letter) {
    int width = (int)fmin(fabs(length), MAX_DIGITS);
    char format[40], digits[16] = "", minimum[16] = "";
    if (precision >= 0)
        snprintf(digits, sizeof digits, ".%d", (int)fmin(precision, MAX_DIGITS));
    if (width)
        snprintf(minimum, sizeof minimum, "%s%d", length < 0 ? "0" : "", width);
    snprintf(format, sizeof format, "%%%s%s%s", minimum, digits, letter);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    return snprintf(text, MAX_NUMBER, format, v);
#pragma GCC diagnostic pop
}

// str ( F , L , P )
static const char *parse_str(Converter *cv) {
    expect(cv, '(', "str");
    double v = parse_float(cv);
    optional_comma(cv);
    double length = trunc(parse_float(cv));
    optional_comma(cv);
    double precision = trunc(parse_float(cv));
    expect(cv, ')', "str");
    // What does not fit into POV-Ray's 254 characters is written with an exponent.
    char text[MAX_NUMBER];
    enum { ROOM = 255 };
    if (format_number(text, v, length, precision, "f") >= ROOM &&
        format_number(text, v, length, precision, "g") >= ROOM)
        return "<invalid>";
    return arena_strdup(cv->arena, text);
}

// vstr ( n , V , separator , L , P ): a float is not repeated
static const char *parse_vstr(Converter *cv) {
    expect(cv, '(', "vstr");
    int count = (int)fmin(fmax(trunc(parse_float(cv)), 2), 5);
    optional_comma(cv);
    double e[5] = {0};
    parse_add(cv, e, 1);
    optional_comma(cv);
    const char *separator = parse_string(cv);
    optional_comma(cv);
    double length = trunc(parse_float(cv));
    optional_comma(cv);
    double precision = trunc(parse_float(cv));
    expect(cv, ')', "vstr");
    const char *all = "";
    for (int i = 0; i < count; i++) {
        char text[MAX_NUMBER];
        format_number(text, e[i], length, precision, "f");
        all = arena_printf(cv->arena, "%s%s%s", all, i ? separator : "", text);
    }
    check_length(cv, strlen(all));
    return all;
}

// datetime ( days since 2000-01-01 UTC [, format] )
static const char *parse_datetime(Converter *cv) {
    expect(cv, '(', "datetime");
    const Token *start = peek_token(cv);
    double days = parse_float(cv);
    const char *format = "%Y-%m-%d %H:%M:%SZ";
    if (accept(cv, ','))
        format = parse_string(cv);
    expect(cv, ')', "datetime");
    double seconds = floor(days * 86400 + 0.5) + 946684800; // from 1970
    if (!(fabs(seconds) < 1e15))
        die_in(cv, start, "This date is out of range");
    time_t time = (time_t)seconds;
    struct tm utc;
    char text[512];
    if (!*format || !gmtime_r(&time, &utc))
        die_in(cv, start, "Cannot write this date");
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    size_t length = strftime(text, sizeof text, format, &utc);
#pragma GCC diagnostic pop
    if (!length)
        die_in(cv, start, "The date's format is not valid or its text too long");
    return arena_strdup(cv->arena, text);
}

bool is_string_keyword(int code) {
    switch (code) {
    case KW_chr:
    case KW_concat:
    case KW_datetime:
    case KW_str:
    case KW_strlwr:
    case KW_strupr:
    case KW_substr:
    case KW_vstr:
        return true;
    default:
        return false;
    }
}

bool starts_string(Converter *cv) {
    int code = peek_token(cv)->code;
    return code == TOK_STRING || is_string_keyword(code) || peek_value_type(cv) == VALUE_STRING;
}

static const char *string_expression(Converter *cv, bool file_name) {
    const Value *value = accept_value(cv, VALUE_STRING);
    if (value)
        return value->string;
    if (!starts_string(cv))
        die_expected(cv, "string expression");
    const Token *token = next_token(cv);
    switch (token->code) {
    case KW_chr:
        return parse_chr(cv);
    case KW_concat:
        return parse_concat(cv);
    case KW_datetime:
        return parse_datetime(cv);
    case KW_str:
        return parse_str(cv);
    case KW_strlwr:
        return parse_case(cv, "strlwr", 'A', 'Z', 'a' - 'A');
    case KW_strupr:
        return parse_case(cv, "strupr", 'a', 'z', 'A' - 'a');
    case KW_substr:
        return parse_substr(cv);
    case KW_vstr:
        return parse_vstr(cv);
    default:
        return string_from_literal(cv, token, file_name);
    }
}

static const char *parse_string_kind(Converter *cv, bool file_name) {
    enter_level(cv);
    const char *s = string_expression(cv, file_name);
    leave_level(cv);
    return s;
}

const char *parse_string(Converter *cv) { return parse_string_kind(cv, false); }
const char *parse_file_name(Converter *cv) { return parse_string_kind(cv, true); }
