// SPDX-License-Identifier: MIT
// Tokens and their places, against the rules of the language; and that no bytes make the lexer read
// outside its text (the sanitizer watches).
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/rng.h"
#include "converter/language.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    Arena *arena;
    Converter cv;
    TokenList list;
} Lexed;

// The text is copied to the heap without anything behind its NUL, so that reading on is seen.
static Lexed lex_bytes(const char *text, size_t size, bool scene) {
    Lexed l = {.arena = arena_create()};
    l.cv = (Converter){.arena = l.arena, .version = 370};
    l.cv.language = ARENA_NEW(l.arena, Language);
    l.cv.language->limits[LIMIT_STRING] = 1000;
    char *copy = arena_alloc(l.arena, size + 1);
    memcpy(copy, text, size);
    Source *source = ARENA_NEW(l.arena, Source);
    *source = (Source){.name = "t", .text = copy, .size = size};
    source->utf8 = scene && size > 0 && (unsigned char)text[0] > 127;
    l.list = lexer_tokenize(&l.cv, source);
    assert_true(l.list.count > 0);
    assert_int_equal(l.list.items[l.list.count - 1].code, TOK_EOF);
    return l;
}

static Lexed lex(const char *text) { return lex_bytes(text, strlen(text), false); }
static void done(Lexed *l) { arena_destroy(l->arena); }

static void expect_codes(const char *text, const int *codes, size_t count) {
    Lexed l = lex(text);
    for (size_t i = 0; i < count && i < l.list.count; i++)
        assert_int_equal(l.list.items[i].code, codes[i]);
    assert_int_equal(l.list.count, count + 1);
    done(&l);
}
#define EXPECT_CODES(text, ...)                                                                    \
    expect_codes(text, (const int[]){__VA_ARGS__}, sizeof((const int[]){__VA_ARGS__}) / sizeof(int))

static void expect_number(const char *text, double value, size_t tokens) {
    Lexed l = lex(text);
    assert_int_equal(l.list.items[0].code, TOK_NUMBER);
    assert_true(l.list.items[0].number == value);
    assert_int_equal(l.list.count, tokens + 1);
    done(&l);
}

static void expect_error(const char *text, int line, int column, const char *fragment) {
    Lexed l = lex(text);
    const Token *t = &l.list.items[l.list.count >= 2 ? l.list.count - 2 : 0];
    assert_int_equal(t->code, TOK_ERROR);
    assert_non_null(strstr(t->text, fragment));
    assert_int_equal(t->line, line);
    assert_int_equal(t->column, column);
    done(&l);
}

static void test_symbols(void **state) {
    (void)state;
    EXPECT_CODES("{}()[]<>,;:.+-*/=!?&|#", '{', '}', '(', ')', '[', ']', '<', '>', ',', ';', ':',
                 '.', '+', '-', '*', '/', '=', '!', '?', '&', '|', '#');
    EXPECT_CODES("@`\\$^%~'", '@', '`', '\\', '$', '^', '%', '~', '\'');
    EXPECT_CODES("<= >= != == =<", TOK_LE, TOK_GE, TOK_NE, '=', '=', '=', '<');
    EXPECT_CODES("3>=2", TOK_NUMBER, TOK_GE, TOK_NUMBER);
    EXPECT_CODES("<1,2>=x", '<', TOK_NUMBER, ',', TOK_NUMBER, TOK_GE, KW_x);
}

static void test_numbers(void **state) {
    (void)state;
    expect_number("5", 5, 1);
    expect_number("5.", 5, 1);
    expect_number(".5", 0.5, 1);
    expect_number("1e", 1, 1);
    expect_number("1e+", 1, 1);
    expect_number("1E-3", 1e-3, 1);
    expect_number("007", 7, 1);
    expect_number("0.1", 0.1, 1);
    expect_number("4503599627370497.5", 4503599627370497.5, 1);
    expect_number("1e400", (double)INFINITY, 1);
    expect_number("0x10", 0, 2); // 0 and the identifier x10
    expect_number("0.x", 0, 2);
    expect_number("5.x", 5, 2);
    expect_number("1e5e5", 1e5, 2);
    expect_error("1..2", 1, 3, "additional '.'");
    expect_error("1.5.x", 1, 4, "additional '.'");
    expect_error("1e5.5", 1, 4, "additional '.'");
    EXPECT_CODES("-5", '-', TOK_NUMBER);
    EXPECT_CODES("V.x", TOK_IDENTIFIER, '.', KW_x);
}

static void test_words(void **state) {
    (void)state;
    // Every reserved word is found, and no word near it.
    for (int code = KW_FIRST; code < KW_END; code++) {
        char word[64];
        EXPECT_CODES(keyword_name(code), code);
        snprintf(word, sizeof word, "%s_", keyword_name(code));
        EXPECT_CODES(word, TOK_IDENTIFIER);
        if (code + 1 < KW_END)
            assert_true(strcmp(keyword_name(code), keyword_name(code + 1)) < 0);
    }
    assert_int_equal(KW_END - KW_FIRST, 498);
    EXPECT_CODES("Sphere grey _a a1 xx", TOK_IDENTIFIER, TOK_IDENTIFIER, TOK_IDENTIFIER,
                 TOK_IDENTIFIER, TOK_IDENTIFIER);
    Lexed l = lex("one two one");
    assert_int_equal(l.list.items[0].name, l.list.items[2].name);
    assert_int_not_equal(l.list.items[0].name, l.list.items[1].name);
    assert_string_equal(l.list.items[1].text, "two");
    done(&l);
}

static void test_strings(void **state) {
    (void)state;
    Lexed l = lex("\"a\\\"b\" \"\" \"c\\\\\" \"// /* \"");
    assert_int_equal(l.list.count, 5);
    assert_string_equal(l.list.items[0].text, "a\\\"b"); // escapes are not interpreted yet
    assert_string_equal(l.list.items[1].text, "");
    assert_string_equal(l.list.items[2].text, "c\\\\");
    assert_string_equal(l.list.items[3].text, "// /* ");
    done(&l);
    expect_error("x \"abc", 1, 3, "No end quote");
    expect_error("\"abc\\\"", 1, 1, "No end quote");
    expect_error("\"abc\\", 1, 1, "No end quote");
    l = lex_bytes("\"a\0b\"", 5, false);
    assert_int_equal(l.list.items[0].code, TOK_ERROR);
    done(&l);
}

static void test_comments(void **state) {
    (void)state;
    EXPECT_CODES("a // b\nc", TOK_IDENTIFIER, TOK_IDENTIFIER);
    EXPECT_CODES("a // b", TOK_IDENTIFIER);
    EXPECT_CODES("a /* b /* c */ d */ e", TOK_IDENTIFIER, TOK_IDENTIFIER);
    EXPECT_CODES("/**//***/a", TOK_IDENTIFIER);
    EXPECT_CODES("/* // */ a", TOK_IDENTIFIER);
    EXPECT_CODES("/*/ */ a", TOK_IDENTIFIER);
    EXPECT_CODES("8 / *2", TOK_NUMBER, '/', '*', TOK_NUMBER);
    expect_error("a\n /* /* */ b", 2, 2, "never ends");
    expect_error("/*", 1, 1, "never ends");
}

static void test_places(void **state) {
    (void)state;
    // LF, CRLF and CR end a line; a string may span lines.
    Lexed l = lex("a\n bb\r\n\tc\rd \"x\ny\" e");
    static const int places[][2] = {{1, 1}, {2, 2}, {3, 2}, {4, 1}, {4, 3}, {5, 4}};
    assert_int_equal(l.list.count, 7);
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(l.list.items[i].line, places[i][0]);
        assert_int_equal(l.list.items[i].column, places[i][1]);
    }
    done(&l);
}

static void test_bytes(void **state) {
    (void)state;
    Lexed l = lex_bytes("a\0b\x1A"
                        "c",
                        5, false); // NUL and Ctrl-Z are blanks
    assert_int_equal(l.list.count, 4);
    done(&l);
    l = lex_bytes("\xEF\xBB\xBF"
                  "a",
                  4, true);
    assert_int_equal(l.list.count, 2);
    assert_int_equal(l.list.items[0].column, 1);
    done(&l);
    expect_error("\xEF\xBB\xBF"
                 "a",
                 1, 1, "value is ef");
    expect_error("a \xC3\xA9", 1, 3, "value is c3");
    expect_error("\x01", 1, 1, "value is 01");
    EXPECT_CODES("// \xC3\xA9 \x01\na /* \xFF */ \"\xFF\"", TOK_IDENTIFIER, TOK_STRING);
    l = lex("");
    assert_int_equal(l.list.count, 1);
    done(&l);
}

// Random texts from an alphabet that opens strings, comments and numbers often.
static void test_random(void **state) {
    (void)state;
    static const char alphabet[] = "\"\"//**\n\r\\.eE+-019xu# a<>=!\xC3\x01";
    for (uint64_t n = 0; n < 20000; n++) {
        Rng r = {n};
        char text[48];
        size_t size = (size_t)(rng_next(&r) % sizeof text);
        for (size_t i = 0; i < size; i++) {
            uint64_t pick = rng_next(&r);
            text[i] = pick % 16 == 0 ? (char)(pick >> 8) : alphabet[(pick >> 8) % sizeof alphabet];
        }
        Lexed l = lex_bytes(text, size, n % 2 == 0);
        for (size_t i = 0; i < l.list.count; i++)
            assert_true(l.list.items[i].line >= 1 && l.list.items[i].column >= 1);
        done(&l);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_symbols),  cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_words),    cmocka_unit_test(test_strings),
        cmocka_unit_test(test_comments), cmocka_unit_test(test_places),
        cmocka_unit_test(test_bytes),    cmocka_unit_test(test_random),
    };
    return cmocka_run_group_tests_name("lexer", tests, NULL, NULL);
}
