// SPDX-License-Identifier: MIT
// INI files: what each line sets, which lines count, what is refused and where; which povray.ini is
// read. POV-Ray itself says what the traps mean: the same files are given to it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "arena_state.h"
#include "base/diag.h"
#include "base/file.h"
#include "options/options.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/qipov-ini-XXXXXX"; // the working directory of all tests

static void write_file(const char *name, const char *text) {
    FILE *out = fopen(name, "wb");
    assert_non_null(out);
    assert_true(fputs(text, out) >= 0 && fclose(out) == 0);
}

// One command line, parsed under diag_catch.
typedef struct {
    OptionsProgram program;
    const char *words[8];
    Arena *arena;
    RenderOptions options;
    bool ok;
} Command;

static void parse_body(void *arg) {
    Command *c = arg;
    char *argv[10] = {arena_strdup(c->arena, "program")};
    int argc = 1;
    for (; c->words[argc - 1]; argc++)
        argv[argc] = arena_strdup(c->arena, c->words[argc - 1]);
    c->options = options_default();
    c->ok = options_parse(c->program, argc, argv, c->arena, &c->options);
}

// The options after t.ini with this text, and then one more word unless it is NULL.
static RenderOptions read_ini(Arena *arena, const char *text, const char *word) {
    Command c = {.words = {"t.ini", word}, .arena = arena};
    char *message = NULL;
    write_file("t.ini", text);
    if (!diag_catch(parse_body, &c, &message))
        fail_msg("%s\n%s", text, message);
    assert_true(c.ok);
    return c.options;
}

static void lines(void **state) {
    Arena *arena = *state;
    RenderOptions o = read_ini(arena,
                               "; a comment\n"
                               "# another\r\n"
                               "Width = 640   ; pixels\n"
                               "\theight=480# glued\n"
                               "Input_File_Name='my scene.pov'\n"
                               "Output_File_Name=\"a;b#c.png\"\n"
                               "+A0.25 -J +Q5;switches\n"
                               "+L\"an inc\" other/\n\"third folder/\"\n"
                               "Library_Path = fourth, \"fifth one\" , sixth ; and so on\n"
                               "Declare=A=1, B=2.5\n"
                               "ANTIALIAS_DEPTH=4",
                               NULL);
    assert_true(o.width == 640 && o.height == 480);
    assert_string_equal(o.input, "my scene.pov");
    assert_string_equal(o.output, "a;b#c.png");
    assert_true(o.antialias && o.antialias_threshold == 0.25 && !o.jitter && o.quality == 5);
    assert_int_equal(o.antialias_depth, 4);
    static const char *const folders[] = {"an inc", "other/",    "third folder/",
                                          "fourth", "fifth one", "sixth"};
    assert_int_equal(o.library_path_count, 6);
    for (int i = 0; i < 6; i++)
        assert_string_equal(o.library_paths[i], folders[i]);
    assert_int_equal(o.declare_count, 2);
    assert_string_equal(o.declares[1].name, "B");
    assert_true(o.declares[1].value == 2.5);
    assert_int_equal(o.remark_count, 0);
}

// Later wins: the INI file stands before the word, or the other way round.
static void order(void **state) {
    Arena *arena = *state;
    assert_int_equal(read_ini(arena, "Width=10\nWidth=20\n", "+W30").width, 30);
    Command c = {.words = {"+W30", "t.ini"}, .arena = arena};
    parse_body(&c);
    assert_int_equal(c.options.width, 20);
}

// One keyword a line: what follows is not read, and that is said.
static void rest_of_line(void **state) {
    Arena *arena = *state;
    RenderOptions o = read_ini(arena, "Width=4 Height=6\nQuality=3 +A ; x\n", NULL);
    assert_true(o.width == 4 && o.height == 600 && o.quality == 3 && !o.antialias);
    assert_int_equal(o.remark_count, 2);
    assert_true(o.remarks[0].warning && o.remarks[0].loc.line == 1);
    assert_int_equal(o.remarks[0].loc.column, 9);
    o = read_ini(arena, "Output_File_Name=my own file.png  ; c\n", NULL);
    assert_string_equal(o.output, "my own file.png");
    assert_int_equal(o.remark_count, 1);
    // A minus that begins no switch belongs to the value.
    o = read_ini(arena, "Output_File_Name=a - b\n", NULL);
    assert_string_equal(o.output, "a - b");
}

static void booleans(void **state) {
    Arena *arena = *state;
    static const struct {
        const char *value;
        bool truth;
    } cases[] = {{"on", true},     {"ON", true},   {"yes", true},    {"true", true},
                 {"1", true},      {"t", true},    {"o", true},      {"onward", true},
                 {"1x", true},     {"", true},     {"off", false},   {"no", false},
                 {"0", false},     {"2", false},   {"false", false}, {"x", false},
                 {"\"on\"", true}, {"'no'", false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        RenderOptions o =
            read_ini(arena, arena_printf(arena, "Antialias=%s\n", cases[i].value), NULL);
        if (o.antialias != cases[i].truth)
            fail_msg("Antialias=%s", cases[i].value);
    }
}

static void sections(void **state) {
    Arena *arena = *state;
    write_file("s.ini", "Width=1\n[Low]\nWidth=2\nnonsense here = 3\n\n[high]Width=3\n[Low]\n"
                        "Height=7\n");
    static const struct {
        const char *word;
        int width, height;
        size_t remarks;
    } cases[] = {{"s.ini", 1, 600, 0},       {"s", 1, 600, 0},
                 {"s[HIGH]", 3, 600, 0},     {"s.ini[High]", 3, 600, 0},
                 {"s.ini[none]", 1, 600, 1}, {"Include_Ini=s[high]", 3, 600, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Command c = {.words = {cases[i].word}, .arena = arena};
        parse_body(&c);
        assert_true(c.ok);
        assert_int_equal(c.options.width, cases[i].width);
        assert_int_equal(c.options.height, cases[i].height);
        assert_int_equal(c.options.remark_count, cases[i].remarks);
    }
}

static void nested(void **state) {
    Arena *arena = *state;
    write_file("n.ini", "Width=6\nHeight=6\n[B]\nQuality=1\n");
    mkdir("lib", 0777);
    write_file("lib/far.ini", "Quality=2\n");
    static const char *const ways[] = {"n.ini", "n", "\"n.ini\"", "Include_Ini=n",
                                       "Include_Ini=\"n.ini\""};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        RenderOptions o =
            read_ini(arena, arena_printf(arena, "Height=4\nWidth=4\n%s\nHeight=5", ways[i]), NULL);
        assert_true(o.width == 6 && o.height == 5 && o.quality == 9);
    }
    RenderOptions o = read_ini(arena, "'n.ini[B]' +Llib far +J a.pov\n", NULL);
    assert_true(o.width == 6 && o.quality == 2);
    assert_string_equal(o.input, "a.pov");
}

static void wrong_lines(void **state) {
    Arena *arena = *state;
    static const struct {
        const char *text;
        int line, column;
        const char *hint;
    } wrong[] = {
        {"Width=3\nWidht=4\n", 2, 1, "Width="},
        {"  Widht = 4\n", 1, 3, "Width="},
        {"Width=\n", 1, 7, "whole number"},
        {"Width = x4\n", 1, 9, "whole number"},
        {"Width=\"4\n", 1, 7, "quote"},
        {"\n\n+W4 +Zz\n", 3, 5, "+"},
        {"\r\n\r\n-Antialias\r\n", 3, 1, "+A0.3"},
        {"+W 640\n", 1, 1, "glued"},
        {"[High\nWidth=3\n", 1, 1, "]"},
        {"--method qi\n", 1, 1, "dashes"},
        {"Width 640\n", 1, 1, "INI file"},
        {"Declare=X\n", 1, 9, "Declare=Name=number"},
        {"=5\n", 1, 1, ""},
        {", x\n", 1, 1, "expected"},
        {"Quality=3\nt.ini\n", 2, 1, "nested"},
        {"nosuch.ini\n", 1, 1, "neither"},
        {"Dither_Method=F\n", 1, 15, "dithering"},
        {"+FX\n", 1, 1, "PNG"},
        {"Antialias=on\n\001\n", 2, 1, ""},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        Command c = {.words = {"t.ini"}, .arena = arena};
        char *message = NULL;
        write_file("t.ini", wrong[i].text);
        if (diag_catch(parse_body, &c, &message))
            fail_msg("accepted: %s", wrong[i].text);
        const char *place =
            arena_printf(arena, "t.ini:%d:%d: error: ", wrong[i].line, wrong[i].column);
        if (strncmp(message, place, strlen(place)) != 0 || !strstr(message, wrong[i].hint) ||
            !strstr(message, "^"))
            fail_msg("%s should say %s...%s:\n%s", wrong[i].text, place, wrong[i].hint, message);
        free(message);
    }
}

// No bytes may crash the reader: texts of a few characters that mean something to it.
static void any_bytes(void **state) {
    (void)state;
    static const char letters[] = "[]=\"';#,+-A \nt.\\";
    enum { LETTERS = sizeof letters - 1, LENGTH = 4 };
    int count = 1;
    for (int i = 0; i < LENGTH; i++)
        count *= LETTERS;
    for (int n = 0; n < count; n += 53) { // 53 is prime to the number of letters
        char text[LENGTH + 12] = "Width=1";
        for (int i = 0, rest = n; i < LENGTH; i++, rest /= LETTERS)
            text[7 + i] = letters[rest % LETTERS];
        Arena *arena = arena_create();
        for (int tail = 0; tail <= 7; tail += 7) {
            Command c = {.words = {"x.ini"}, .arena = arena};
            char *message = NULL;
            write_file("x.ini", text + tail);
            if (!diag_catch(parse_body, &c, &message))
                free(message);
        }
        arena_destroy(arena);
    }
}

// The first that exists is read, and only that.
static void which_povray_ini(void **state) {
    Arena *arena = *state;
    setenv("HOME", folder, 1);
    unsetenv("POVINI");
    mkdir(".povray", 0777);
    mkdir(".povray/3.7", 0777);
    write_file(".povray/3.7/povray.ini", "Width=11\nLibrary_Path=home\nBounding_Threshold=3\n");
    RenderOptions o = options_default();
    options_read_povray_ini(PROGRAM_POV2QI, arena, &o);
    assert_true(o.width == 11 && o.height == 120 && o.library_path_count == 1);
    assert_int_equal(o.remark_count, 0);

    write_file("povray.ini", "Height=22\nOutput_File_Type=N8\nOutput_File_Name=theirs\n");
    o = options_default();
    options_read_povray_ini(PROGRAM_QICOMPARE, arena, &o);
    assert_true(o.width == 160 && o.height == 22 && o.library_path_count == 0);
    assert_null(o.output); // a folder for qicompare, a picture for POV-Ray
    assert_int_equal(o.remark_count, 0);

    write_file("mine.ini", "+W33 +H44\n");
    setenv("POVINI", "mine.ini", 1);
    o = options_default();
    options_read_povray_ini(PROGRAM_QIRENDER, arena, &o);
    assert_true(o.width == 33 && o.height == 44);
    assert_string_equal(o.povray_ini, "mine.ini");

    setenv("POVINI", "nowhere.ini", 1);
    o = options_default();
    options_read_povray_ini(PROGRAM_QIRENDER, arena, &o);
    assert_true(o.height == 22 && o.remark_count == 1 && o.remarks[0].warning);
    unsetenv("POVINI");
    unlink("povray.ini");
}

// A file for qirender is no trouble to the others; an INI file is a word for both renderers.
static void other_programs(void **state) {
    Arena *arena = *state;
    write_file("t.ini", "Antialias=On\nOutput_File_Name=pic\n+O\"other\"\n+Ia.pov\n");
    Command c = {.program = PROGRAM_POV2QI, .words = {"t", "+W9"}, .arena = arena};
    parse_body(&c);
    assert_true(c.ok);
    assert_null(c.options.output);
    assert_string_equal(c.options.input, "a.pov");
    c = (Command){.program = PROGRAM_QICOMPARE, .words = {"t[x]", "-o", "dir"}, .arena = arena};
    parse_body(&c);
    assert_true(c.ok && c.options.shared_count == 1);
    assert_string_equal(c.options.shared[0], "t[x]");
    assert_string_equal(c.options.output, "dir");
}

// What has no effect is said, but not of POV-Ray's own file.
static void remarks(void **state) {
    Arena *arena = *state;
    RenderOptions o =
        read_ini(arena,
                 "Bounding=off\nContinue_Trace=on\nPost_Frame_Command=rm \"a;b\" ; c\n"
                 "Output_File_Type=N16\nContinue_Trace=off\n",
                 "+MB3");
    static const bool warnings[] = {false, true, true, false};
    assert_int_equal(o.remark_count, 4);
    for (int i = 0; i < 4; i++)
        assert_int_equal(o.remarks[i].warning, warnings[i]);
    assert_int_equal(o.remarks[1].loc.line, 3);
    assert_null(o.remarks[3].loc.file);
    assert_false(o.continue_trace);
    assert_int_equal(o.bits, 8);
}

// The INI file that +GI writes gives the same options again.
static void written(void **state) {
    Arena *arena = *state;
    static const char *const texts[] = {
        "+Ia.pov\n",
        "+I'my scene.pov' +O\"it's.png\" +W64 +H48 +FC +UA -J +A0.15 +R5 +AM2 +AG1.7 +Q4 +BS16 "
        "+WT2\n"
        "+SC0.1 +EC33 +SR2 +ER0.9 File_Gamma=1.8\n+KFI2\n+KFF7\n+KI0.1\n+KF1e-7\n+KC\n+SF0.3\n"
        "+EF6\n+STP2\n+K0.3\n+MV3.62\n-V\n-D\n+P\nInclude_Header='h.inc'\n"
        "Library_Path=a, 'b c'\nDeclare=X=0.123456789, Y=-3e10\n",
        "+FP -F\nGrayscale_Output=on\nBits_Per_Color=12\n+Ix.pov\n",
        "+FNg\nFile_Gamma=sRGB\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        RenderOptions a = read_ini(arena, texts[i], NULL);
        options_write_ini(&a, "w.ini");
        RenderOptions b = read_ini(arena, file_read(arena, "w.ini", NULL, NULL), NULL);
        const char *const *strings[2][3] = {{&a.input, &a.output, &a.include_header},
                                            {&b.input, &b.output, &b.include_header}};
        for (int k = 0; k < 3; k++)
            if (*strings[0][k])
                assert_string_equal(*strings[0][k], *strings[1][k]);
            else
                assert_null(*strings[1][k]);
        assert_int_equal(a.library_path_count, b.library_path_count);
        for (size_t k = 0; k < a.library_path_count; k++)
            assert_string_equal(a.library_paths[k], b.library_paths[k]);
        assert_int_equal(a.declare_count, b.declare_count);
        for (size_t k = 0; k < a.declare_count; k++) {
            assert_string_equal(a.declares[k].name, b.declares[k].name);
            assert_true(a.declares[k].value == b.declares[k].value);
        }
        // Pointers differ; the rest must not.
        for (RenderOptions *o = &a; o; o = o == &a ? &b : NULL) {
            o->input = o->output = o->include_header = NULL;
            o->library_paths = o->shared = o->own = o->scenes = NULL;
            o->declares = NULL;
            o->remarks = NULL;
            o->remark_count = 0;
        }
        if (memcmp(&a, &b, sizeof a) != 0)
            fail_msg("%s\n%s", texts[i], file_read(arena, "w.ini", NULL, NULL));
    }
    unlink("w.ini");
}

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state) {
    (void)state;
    static const char *const files[] = {
        "t.ini",       "s.ini",   "n.ini",    "lib/far.ini", "lib", ".povray/3.7/povray.ini",
        ".povray/3.7", ".povray", "mine.ini", "x.ini"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        remove(files[i]);
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        ARENA_TEST(lines),          ARENA_TEST(order),
        ARENA_TEST(rest_of_line),   ARENA_TEST(booleans),
        ARENA_TEST(sections),       ARENA_TEST(nested),
        ARENA_TEST(wrong_lines),    ARENA_TEST(which_povray_ini),
        ARENA_TEST(other_programs), ARENA_TEST(remarks),
        ARENA_TEST(written),        ARENA_TEST(any_bytes),
    };
    return cmocka_run_group_tests_name("ini", tests, enter, leave);
}
