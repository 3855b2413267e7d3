// SPDX-License-Identifier: MIT
// The language core as a whole: programs that check themselves (tests/sdl, run by POV-Ray too),
// wrong programs with the place and words of their message (tests/errors), input that is made to do
// harm, and mutations of all of them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/console.h"
#include "base/diag.h"
#include "base/file.h"
#include "base/rng.h"
#include "converter/convert.h"
#include "converter/language.h"
#include "debug_output.h"

#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const char folder[] = "build/test/language"; // for generated programs

// ---- running a program ------------------------------------------------------------------------

typedef struct {
    RenderOptions options;
    Arena *arena;
} Job;

static void convert(void *arg) {
    Job *job = arg;
    convert_scene(&job->options, job->arena);
}

static uint64_t token_limit; // 0: the default

static RenderOptions small_options(const char *path) {
    RenderOptions options = {.width = 4, .height = 3, .limits[LIMIT_TOKENS] = token_limit};
    options.input = path;
    return options;
}

// NULL if the program is right, else its message (to be freed).
static char *run_options(RenderOptions options) {
    Job job = {.options = options, .arena = arena_create()};
    char *message = NULL;
    if (diag_catch(convert, &job, &message))
        assert_null(message);
    arena_destroy(job.arena);
    return message;
}

static char *run_file(const char *path) { return run_options(small_options(path)); }

static void write_program(const char *path, const char *text, size_t size) {
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(text, 1, size, f), size);
    fclose(f);
}

static char *run_text(const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/program.pov", folder);
    write_program(path, text, strlen(text));
    return run_file(path);
}

static void expect_right(const char *text) {
    char *message = run_text(text);
    if (message)
        fprintf(stderr, "%s\n", message);
    assert_null(message);
}

static void expect_wrong(const char *text, const char *fragment) {
    char *message = run_text(text);
    assert_non_null(message);
    if (!strcasestr(message, fragment))
        fprintf(stderr, "want '%s' in: %s\n", fragment, message);
    assert_non_null(strcasestr(message, fragment));
    free(message);
}

// ---- folders of programs ------------------------------------------------------------------------

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

// The .pov files of a folder, sorted; to be freed.
static size_t list_programs(const char *where, char **paths, size_t room) {
    DIR *dir = opendir(where);
    assert_non_null(dir);
    size_t count = 0;
    for (struct dirent *e; (e = readdir(dir));) {
        const char *dot = strrchr(e->d_name, '.');
        if (!dot || strcmp(dot, ".pov") != 0)
            continue;
        assert_true(count < room);
        size_t length = strlen(where) + strlen(e->d_name) + 2;
        paths[count] = malloc(length);
        snprintf(paths[count++], length, "%s/%s", where, e->d_name);
    }
    closedir(dir);
    qsort(paths, count, sizeof *paths, compare_names);
    assert_true(count > 0);
    return count;
}

static void free_programs(char **paths, size_t count) {
    for (size_t i = 0; i < count; i++)
        free(paths[i]);
}

static void test_self_checking(void **state) {
    (void)state;
    char *paths[100];
    size_t count = list_programs("tests/sdl", paths, 100);
    console_show(CONSOLE_DEBUG, false);
    for (size_t i = 0; i < count; i++) {
        char *message = run_file(paths[i]);
        if (message)
            fprintf(stderr, "%s: %s\n", paths[i], message);
        assert_null(message);
    }
    console_show(CONSOLE_DEBUG, true);
    free_programs(paths, count);
}

// The same programs must be right for POV-Ray itself, or they prove nothing; and what they print
// in lines that begin with '@' must be the same.
static void test_povray_agrees(void **state) {
    (void)state;
    if (!debug_has_povray()) {
        puts("skipped: povray is not installed");
        return;
    }
    char *paths[100];
    size_t count = list_programs("tests/sdl", paths, 100);
    for (size_t i = 0; i < count; i++)
        assert_debug_equal(paths[i], true);
    free_programs(paths, count);
}

// First line: // LINE:COLUMN words of the message
static void check_message(const char *path, const char *message) {
    char line[512], place[64];
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    assert_non_null(fgets(line, sizeof line, f));
    fclose(f);
    line[strcspn(line, "\r\n")] = '\0';
    int row, column, used = 0;
    assert_int_equal(sscanf(line, "// %d:%d %n", &row, &column, &used), 2);
    snprintf(place, sizeof place, ":%d:%d: error: ", row, column);
    char *head = strdup(message ? message : "(no error)");
    head[strcspn(head, "\n")] = '\0';
    bool right = strstr(head, place) && strcasestr(head, line + used);
    if (!right)
        fprintf(stderr, "%s:\n  want '%s%s'\n  got  '%s'\n", path, place, line + used, head);
    assert_true(right);
    free(head);
}

static void test_errors(void **state) {
    (void)state;
    char *paths[400];
    size_t count = list_programs("tests/errors", paths, 400);
    for (size_t i = 0; i < count; i++) {
        char *message = run_file(paths[i]);
        check_message(paths[i], message);
        free(message);
    }
    free_programs(paths, count);
}

static void test_chain(void **state) {
    (void)state;
    char *message = run_text("#macro Inner() #declare A = (Missing); #end\n"
                             "#macro Outer() Inner() #end\n  Outer()\n");
    assert_non_null(strstr(message, "program.pov:1:30: error: "));
    assert_non_null(strstr(message, "program.pov:2:16: note: in macro Inner, called here"));
    assert_non_null(strstr(message, "program.pov:3:3: note: in macro Outer, called here"));
    free(message);
    message = run_file("tests/errors/include_chain.pov");
    assert_non_null(strstr(message, "errors/broken.inc:1:15: error: "));
    assert_non_null(strstr(message, "errors/include_chain.pov:2:10: note: included here"));
    free(message);
}

// ---- options ----------------------------------------------------------------------------------

static void test_options(void **state) {
    (void)state;
    char path[256];
    snprintf(path, sizeof path, "%s/options.pov", folder);
    static const char text[] =
        "#include \"check.inc\"\n"
        "Check(\"width\", image_width, 320) Check(\"height\", image_height, 200)\n"
        "#if (str(Detail, 0, 9) != \"0.123457000\") #error \"six digits\" #end\n"
        "#if (str(clock, 0, 10) != \"0.3000000119\") #error \"single precision\" #end\n"
        "Check(\"clock_on\", clock_on, 1) Check(\"version\", version, 3.5)\n"
        "CheckS(\"name\", input_file_name, \"options.pov\")\n";
    write_program(path, text, strlen(text));
    RenderOptions options = small_options(path);
    OptionDeclare declare = {"Detail", 0.123456789};
    const char *library = "tests/sdl";
    options.width = 320;
    options.height = 200;
    options.declares = &declare;
    options.declare_count = 1;
    options.library_paths = &library;
    options.library_path_count = 1;
    options.clock = 0.3;
    options.clock_given = true;
    options.version = 350;
    char *message = run_options(options);
    if (message)
        fprintf(stderr, "%s\n", message);
    assert_null(message);
    declare.name = "sphere";
    message = run_options(options);
    assert_non_null(strstr(message, "reserved word"));
    free(message);
}

static void test_files(void **state) {
    (void)state;
    char *message = run_file("no/such/file.pov");
    assert_non_null(strstr(message, "Cannot open scene file 'no/such/file.pov'"));
    free(message);
    message = run_file("tests");
    assert_non_null(strstr(message, "it is a directory"));
    free(message);
    assert_null(run_file("tests/sdl/lexical")); // .pov is tried
    expect_right("");
    expect_right("\n\n// nothing\n");
    expect_right("#include \"COLORS.INC\"\n#declare A = Red;"); // another case, as an extension
    expect_wrong("#include \"no such file.inc\"", ":1:10: error: Cannot open include file");
    char binary[512], path[256];
    for (size_t i = 0; i < sizeof binary; i++)
        binary[i] = (char)i;
    snprintf(path, sizeof path, "%s/binary.pov", folder);
    write_program(path, binary, sizeof binary);
    message = run_file(path);
    assert_non_null(strstr(message, ":1:2: error: Illegal character in input file, value is 01"));
    free(message);
    write_program(path, "\xEF\xBB\xBF#debug \"\"", 12); // a scene may begin with a BOM
    assert_null(run_file(path));
    // What a scene writes stays in memory.
    expect_right("#fopen F \"build/test/language/written.txt\" write #write(F, \"x\") #fclose F");
    assert_false(file_exists("build/test/language/written.txt"));
}

// Whole statements: what POV-Ray reads is read, what it refuses is refused.
static void test_grammar(void **state) {
    (void)state;
    FILE *in = fopen("tests/grammar.txt", "r");
    assert_non_null(in);
    char line[1024], text[1200];
    size_t right = 0, wrong = 0;
    while (fgets(line, sizeof line, in)) {
        if (line[0] == '#')
            continue;
        bool is_right = strncmp(line, "ok ", 3) == 0;
        assert_true(is_right || strncmp(line, "no ", 3) == 0);
        snprintf(text, sizeof text, "#version 3.7; global_settings { assumed_gamma 1 }\n%s",
                 line + 3);
        char *message = run_text(text);
        if (is_right == (message != NULL))
            fail_msg("POV-Ray says %s: %s", line, message ? message : "");
        free(message);
        *(is_right ? &right : &wrong) += 1;
    }
    fclose(in);
    assert_true(right > 100 && wrong > 50);
}

// ---- limits -----------------------------------------------------------------------------------

// head, then piece count times, then middle, then tail count times.
static char *repeat(const char *head, const char *piece, const char *middle, const char *tail,
                    size_t count) {
    size_t size = strlen(head) + strlen(middle) + count * (strlen(piece) + strlen(tail)) + 1;
    char *text = malloc(size), *p = stpcpy(text, head);
    for (size_t i = 0; i < count; i++)
        p = stpcpy(p, piece);
    p = stpcpy(p, middle);
    for (size_t i = 0; i < count; i++)
        p = stpcpy(p, tail);
    return text;
}

static void test_nesting(void **state) {
    (void)state;
    static const struct {
        const char *head, *piece, *middle, *tail, *message;
    } cases[] = {
        {"#declare A = ", "(", "1", ");", "Nested too deeply"},
        {"", "union {", "sphere { 0, 1 }", "}", "Nested too deeply"},
        {"#declare A = ", "-", "1;", "", "Nested too deeply"},
        {"#declare A = ", "<1,", "2", ",3>", "Nested too deeply"},
        {"#declare A = (1", "?1:1", "", ");", "Nested too deeply"},
        {"#declare A = array[2] { 1, 1 } #declare B = ", "A[", "1", "]", "Nested too deeply"},
        {"#declare A = ", "abs(", "1", ")", "Nested too deeply"},
        {"#debug ", "concat(", "\"\"", ")", "Nested too deeply"},
        {"#declare f = function(x) {", "(", "x", ")", "Nested too deeply"},
        {"#declare f = function(x) {", "sum(i, 1, 2,", "x", ")", "nested too deeply"},
        {"#macro M(A) #end ", "M(", "1", ")", "Nested too deeply"},
        {"", "#if (1) ", "", "", "has no #end"},
        {"", "#if (0) ", "", "", "has no #end"},
        {"", "/*", "", "", "never ends"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = repeat(cases[i].head, cases[i].piece, cases[i].middle, cases[i].tail, 10000);
        expect_wrong(text, cases[i].message);
        free(text);
    }
    // What people write must stay far below: POV-Ray's own limit is 199 for macros and
    // conditionals.
    expect_right("#macro M(N) #if (N < 199) M(N + 1) #end #end M(1)");
    expect_right("#macro F(N) #if (N <= 1) 1 #else (N*F(N - 1)) #end #end #declare A = (F(90));");
}

static void test_endless(void **state) {
    (void)state;
    token_limit = 100000;
    expect_wrong("\n  #while (1) #declare A = 1; #end",
                 ":2:4: error: this #while loop has run too");
    expect_wrong("#for (I, 0, 1e300) #end", "this #for loop has run too long");
    expect_wrong("#for (I, 0, 1, 1e-300) #end", "increment must be non-zero");
    expect_wrong("#for (I, 0, 1e300) #for (J, 0, 1) #end #end", ":1:2: error: this #for loop");
    token_limit = 0;
    expect_wrong("#macro M() M() #end M()", "does 'M' call itself");
    expect_wrong("#macro A() B() #end #macro B() A() #end A()", "Too many nested macro calls");
    expect_wrong("#macro M(N) (N <= 0 ? 0 : 1 + M(N - 1)) #end #declare A = M(5);", "too");
    expect_wrong("#declare S = \"0123456789abcdef\" #while (1) #declare S = concat(S, S) #end",
                 "String too long");
    expect_wrong("#declare A = array[100000][100000];", "Too many array elements");
    expect_wrong("#declare A = array[1e300];", "Too many array elements");
    expect_wrong("#while (1) #declare A = array[100000]; #end", "Too many array elements");
    expect_wrong("#declare A = array[1]; #while (1) #declare B = array[1]; #declare B[0] = A; "
                 "#declare A = B; #end",
                 "Nested too deeply");
    expect_wrong("#declare S = \"0123456789abcdef\" #for (I, 1, 14) #declare S = concat(S, S) #end "
                 "#while (1) #declare T = concat(S, \"x\") #end",
                 "needs too much memory");
    char *long_name = repeat("#declare ", "a", " = 1;", "", 5000);
    expect_wrong(long_name, "identifier is too long");
    free(long_name);
    char *long_string = repeat("#debug \"", "a", "\"", "", 2000000);
    expect_wrong(long_string, "String too long");
    free(long_string);
    char *calls = repeat("#declare f = function(x) { x } ",
                         "#declare g = function(x) { f(f(x)) } #undef f #declare f = g; #undef g ",
                         "#declare A = f(1);", "", 60);
    expect_wrong(calls, "has run too long");
    free(calls);
}

// What is built up in a loop, name by name, nests without a brace in the text, and may be copied
// more often than there are atoms. Before: stack overflows at the clips and the maps, and no end of
// the unions.
static void test_built_up(void **state) {
    (void)state;
    static const struct {
        const char *first, *step, *last, *message;
    } cases[] = {
        {"#declare S = sphere { 0, 1 }", "#declare S = merge { object { S } sphere { 0, 1 } }", "S",
         "1000 objects inside one another"},
        {"#declare S = sphere { 0, 1 }", "#declare S = sphere { 0, 1 clipped_by { S } }", "S",
         "1000 objects inside one another"},
        {"#declare S = sphere { 0, 1 }", "#declare S = sphere { 0, 1 bounded_by { S } }", "S",
         "1000 objects inside one another"},
        {"#declare S = sphere { 0, 1 }", "#declare S = union { object { S } object { S } }", "S",
         "Too many objects"},
        {"#declare S = sphere { 0, 1 }",
         "#declare S = union { object { S } object { S translate x } }", "S", "Too many objects"},
        {"#declare P = pigment { rgb 1 }",
         "#declare P = pigment { gradient x pigment_map { [0 P] [1 rgb 1] } }",
         "sphere { 0, 1 pigment { P } }", "1000 maps of patterns inside one another"},
        {"#declare P = pigment { rgb 1 }",
         "#declare P = pigment { gradient x pigment_map { [0 P] [1 P scale 2] } }", "",
         "1000 maps of patterns inside one another"},
        {"#declare P = normal { bumps }",
         "#declare P = normal { checker normal { P } normal { dents } }", "",
         "1000 maps of patterns inside one another"},
        {"#declare P = texture { }",
         "#declare P = texture { gradient x texture_map { [0 P] [1 P] } }", "",
         "1000 maps of patterns inside one another"},
        {"#declare P = texture { }", "#declare P = texture { tiles { texture { P } tile2 } }", "",
         "1000 maps of patterns inside one another"},
        {"#declare P = density { rgb 1 }",
         "#declare P = density { gradient x density_map { [0 P] [1 P] } }", "",
         "1000 maps of patterns inside one another"},
        {"#declare S = array[1] { 1 }", "#declare T = array[1]; #declare T[0] = S; #declare S = T;",
         "", "Nested too deeply"},
        {"#declare F = array[9999]; #declare F[0] = function { x }",
         "#declare F[I] = function { F[I - 1](x, y, z) + 1 }", "", "call functions too deeply"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        snprintf(text, sizeof text, "%s\n#for (I, 1, 5000) %s #end\n%s\n", cases[i].first,
                 cases[i].step, cases[i].last);
        expect_wrong(text, cases[i].message);
    }
}

// Each limit can be moved, and says which it was.
static void test_limits(void **state) {
    (void)state;
    static const struct {
        Limit limit;
        uint64_t value;
        const char *text, *message;
    } cases[] = {
        {LIMIT_CALLS, 20, "#macro M(N) #if (N) M(N - 1) #end #end M(20)",
         "Too many nested macro calls (20)"},
        {LIMIT_ELEMENTS, 99, "#declare A = array[10][10];",
         "Too many array elements: 100 here, 99"},
        {LIMIT_INCLUDES, 3, "#include \"program.pov\"", "Too many nested include files (3)"},
        {LIMIT_MEGABYTES, 1, "#for (I, 1, 1e6) sphere { I, 1 } #end", "more than 1 MB"},
        {LIMIT_NESTING, 20, "#declare A = ((((((((((((((((((((1))))))))))))))))))));",
         "Nested too deeply (20 levels"},
        {LIMIT_OBJECTS, 9, "#for (I, 1, 10) sphere { I, 1 } #end", "Too many objects: more than 9"},
        {LIMIT_SECONDS, 1, "#while (1) #end", "it has been read for 1 s"},
        {LIMIT_STRING, 5, "#declare S = concat(\"abc\", \"def\")", "more than 5 bytes"},
        {LIMIT_STRING, 5, "#declare S = \"abcdef\"", "String too long"},
        {LIMIT_TOKENS, 100, "#for (I, 1, 1e6) #end", "more than 100 tokens were read"},
        // A patch of 512 triangles for each question, all kept. Before: no limit saw them.
        {LIMIT_MEGABYTES, 2,
         "#declare P = bicubic_patch { type 1 u_steps 4 v_steps 4 0 x 2*x 3*x y x+y 2*x+y+z 3*x+y "
         "2*y x+2*y 2*x+2*y 3*x+2*y 3*y x+3*y 2*x+3*y 3*(x+y) } "
         "#for (I, 1, 200) #declare V = trace(P, x + y - 5*z, z); #declare P = object { P "
         "translate "
         "x / 1000 } #end",
         "more than 2 MB"},
    };
    char path[256];
    snprintf(path, sizeof path, "%s/program.pov", folder);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_program(path, cases[i].text, strlen(cases[i].text));
        RenderOptions options = small_options(path);
        options.limits[LIMIT_TOKENS] = (uint64_t)1e12;
        options.limits[cases[i].limit] = cases[i].value;
        char *message = run_options(options), hint[64];
        snprintf(hint, sizeof hint, "(--limit %s=", options_limit_name(cases[i].limit));
        assert_non_null(message);
        if (!strstr(message, cases[i].message) || !strstr(message, hint))
            fail_msg("want '%s' and '%s' in: %s", cases[i].message, hint, message);
        free(message);
        options.limits[cases[i].limit] *= 100;
        if (cases[i].limit == LIMIT_SECONDS || cases[i].limit == LIMIT_INCLUDES ||
            cases[i].value == 1 || cases[i].value == 2 || cases[i].limit == LIMIT_TOKENS)
            continue; // what has no end
        message = run_options(options);
        if (message)
            fail_msg("within the limit it must be right, but: %s", message);
    }
}

// What asks for much at once is refused before it has it. Before, 2 GB were filled first.
static void test_room(void **state) {
    (void)state;
    char path[256];
    snprintf(path, sizeof path, "%s/large.pov", folder);
    static const char text[] = "height_field { function 16000, 16000 { x } }";
    write_program(path, text, strlen(text));
    RenderOptions options = small_options(path);
    options.limits[LIMIT_MEGABYTES] = 64;
    struct rusage before, after;
    assert_int_equal(getrusage(RUSAGE_SELF, &before), 0);
    char *message = run_options(options);
    assert_int_equal(getrusage(RUSAGE_SELF, &after), 0);
    assert_non_null(message);
    assert_non_null(strstr(message, "more than 64 MB while it is read"));
    free(message);
    assert_true(after.ru_maxrss - before.ru_maxrss < 128 * 1024); // kilobytes
}

// However far the limit is moved, the stack does not overflow.
static void test_stack(void **state) {
    (void)state;
    char path[256], *text = repeat("#declare A = ", "(", "1", ")", 2000000);
    snprintf(path, sizeof path, "%s/deep.pov", folder);
    write_program(path, text, strlen(text));
    free(text);
    RenderOptions options = small_options(path);
    options.limits[LIMIT_NESTING] = (uint64_t)1e12;
    options.limits[LIMIT_MEGABYTES] = 100000;
    char *message = run_options(options);
    assert_non_null(message);
    if (!strstr(message, "for the stack of this program"))
        fail_msg("%s", message);
    free(message);
}

// ---- mutations --------------------------------------------------------------------------------

// Cuts, copies and swaps pieces of a right program: whatever comes out is right or has a message.
static size_t mutate(Rng *r, const char *text, size_t size, char *out, size_t room) {
    memcpy(out, text, size);
    size_t changes = 1 + (size_t)(rng_next(r) % 4);
    for (size_t i = 0; i < changes && size > 16; i++) {
        size_t at = (size_t)(rng_next(r) % (size - 8)), length = (size_t)(rng_next(r) % 8) + 1;
        size_t from = (size_t)(rng_next(r) % (size - 8));
        switch (rng_next(r) % 4) {
        case 0: // cut
            memmove(out + at, out + at + length, size - at - length);
            size -= length;
            break;
        case 1: // copy to another place
            memmove(out + at, out + from, length);
            break;
        case 2: // insert a copy
            if (size + length < room) {
                memmove(out + at + length, out + at, size - at);
                size += length;
                memmove(out + at, out + (from < size - 8 ? from : 0), length);
            }
            break;
        default:
            out[at] = (char)rng_next(r);
        }
    }
    return size;
}

static void test_mutations(void **state) {
    (void)state;
    char *paths[500], out_path[256];
    token_limit = 30000;
    console_show(CONSOLE_DEBUG, false);
    snprintf(out_path, sizeof out_path, "%s/mutation.pov", folder);
    size_t count = list_programs("tests/sdl", paths, 100), right = 0, wrong = 0;
    count += list_programs("tests/errors", paths + count, 400);
    for (size_t i = 0; i < count; i++) {
        if (strstr(paths[i], "includes.pov") || strstr(paths[i], "endless"))
            continue; // long, and run above
        Arena *arena = arena_create();
        size_t size;
        char *text = file_read(arena, paths[i], &size, NULL);
        char *out = arena_alloc(arena, size + 64);
        for (uint64_t n = 0; n < 6; n++) {
            Rng r = {n + 1000 * i};
            write_program(out_path, out, mutate(&r, text, size, out, size + 64));
            char *message = run_file(out_path);
            right += message == NULL;
            wrong += message != NULL;
            free(message);
        }
        arena_destroy(arena);
    }
    token_limit = 0;
    console_show(CONSOLE_DEBUG, true);
    free_programs(paths, count);
    assert_true(right > 0 && wrong > 0);
}

// Ctrl-C while a scene is read: the status of an interrupted program.
static void test_interrupt(void **state) {
    (void)state;
    char path[256];
    snprintf(path, sizeof path, "%s/endless.pov", folder);
    static const char text[] = "#debug \"started\\n\"\n#while (1) #end\n";
    write_program(path, text, strlen(text));
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        token_limit = 1000000000000;
        signal(SIGINT, SIG_DFL);
        dup2(ends[1], STDERR_FILENO);
        free(run_file(path));
        _exit(0);
    }
    char byte;
    assert_int_equal(read(ends[0], &byte, 1), 1); // it runs: the handler is in place
    kill(child, SIGINT);
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 2);
    close(ends[0]);
    close(ends[1]);
}

static int set_up(void **state) {
    (void)state;
    diag_quiet(true);
    mkdir("build", 0777);
    mkdir("build/test", 0777);
    return mkdir(folder, 0777) == 0 || file_exists(folder) || access(folder, W_OK) == 0 ? 0 : -1;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_self_checking), cmocka_unit_test(test_povray_agrees),
        cmocka_unit_test(test_errors),        cmocka_unit_test(test_grammar),
        cmocka_unit_test(test_chain),         cmocka_unit_test(test_options),
        cmocka_unit_test(test_files),         cmocka_unit_test(test_nesting),
        cmocka_unit_test(test_endless),       cmocka_unit_test(test_built_up),
        cmocka_unit_test(test_limits),        cmocka_unit_test(test_room),
        cmocka_unit_test(test_stack),         cmocka_unit_test(test_mutations),
        cmocka_unit_test(test_interrupt),
    };
    return cmocka_run_group_tests_name("language", tests, set_up, NULL);
}
