// SPDX-License-Identifier: MIT
// pov2qi from outside: what a scene requires, what is said of it and how often, #debug as POV-Ray
// shows it.
#include "pictures.h"

#include "base/arena.h"
#include "base/file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

static char project[2048];

static void write_scene(const char *name, const char *text) {
    char path[4400];
    snprintf(path, sizeof path, "%s/%s", scratch_folder(), name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    fclose(out);
}

// Runs the sanitized pov2qi with those words in the scratch folder.
static int pov2qi(const char **log, const char *words) {
    return run_command(log, "cd '%s' && '%s/build/test/pov2qi' %s", scratch_folder(), project,
                       words);
}

static size_t count_of(const char *text, const char *part) {
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, part)); at += strlen(part))
        count++;
    return count;
}

#define HEAD "#version 3.7; global_settings { assumed_gamma 1 }\n"

// The table of real scenes is as it was committed; scenes that are not here are left out.
static void table_of_real_scenes(void **state) {
    (void)state;
    if (access("tests/requires.txt", R_OK) != 0)
        fail_msg("tests/requires.txt is missing");
    Arena *arena = arena_create();
    const char *table = file_read(arena, "tests/requires.txt", NULL, NULL), *rows;
    assert_int_equal(run_command(&rows, "tests/requires.sh"), 0);
    assert_true(count_of(rows, "\n") > 1);
    for (const char *row = rows; *row;) {
        size_t length = strcspn(row, "\n") + 1;
        const char *line = arena_printf(arena, "%.*s", (int)length, row);
        if (!strstr(table, line))
            fail_msg("not in tests/requires.txt (tests/requires.sh writes it anew):\n%s", line);
        row += length;
    }
    if (access(CORPUS, R_OK) != 0)
        puts("skipped: " CORPUS " is missing, only povray-examples was looked at");
    arena_destroy(arena);
}

// What has no model of ours in any near future, so that the test holds when others get one.
static const char UNMODELLED[] = HEAD "camera { location <0,0,-5> look_at 0 }\n"
                                      "#declare Unused = julia_fractal { <0,0,0,1> }\n"
                                      "#declare I = 0;\n#while (I < 3)\n"
                                      "  julia_fractal { <-0.08,0,-0.83,-0.02> translate I*x }\n"
                                      "#declare I = I + 1; #end\nsphere { 0, 1 }\n";

static void lists_as_text(void **state) {
    (void)state;
    const char *log;
    write_scene("a.pov", UNMODELLED);
    assert_int_equal(pov2qi(&log, "--requires a.pov --strict"), 0);
    assert_string_equal(log, "perspective\nsphere\njulia_fractal: not modelled\n"
                             "    a.pov:6:3: the object is missing in the picture\n");
    assert_int_equal(pov2qi(NULL, "--requires a.pov; test -e a.qi.json"), 1); // writes nothing
}

static void lists_as_json(void **state) {
    (void)state;
    const char *log, *file;
    write_scene("a.pov", UNMODELLED);
    assert_int_equal(pov2qi(&log, "--requires --json a.pov"), 0);
    json_t *root = json_loads(log, 0, NULL);
    assert_non_null(root);
    int line, column;
    const char *feature, *first;
    assert_int_equal(json_unpack(root, "{s:[s,s],s:[{s:s,s:[{s:s,s:i,s:i}]}]}", "modelled", &first,
                                 &file, "not_modelled", "feature", &feature, "places", "file",
                                 &file, "line", &line, "column", &column),
                     0);
    assert_string_equal(feature, "julia_fractal");
    assert_string_equal(file, "a.pov");
    assert_int_equal(line, 6);
    assert_int_equal(column, 3);
    json_decref(root);
}

// One warning a place; what is declared and not used is not spoken of; --strict refuses.
static void warns_once_a_place(void **state) {
    (void)state;
    const char *log;
    write_scene("a.pov", UNMODELLED);
    assert_int_equal(pov2qi(&log, "--check a.pov"), 0);
    assert_int_equal(count_of(log, "warning:"), 1);
    assert_non_null(strstr(log, "a.pov:6:3: warning: 'julia_fractal' is not modelled"));
    assert_int_equal(pov2qi(&log, "--check --strict a.pov"), 1);
    assert_non_null(strstr(log, "a.pov:6:3: error: 'julia_fractal' is not modelled"));
    // Before: a warning for each turn of the loop.
    write_scene("b.pov", HEAD "#for (I, 1, 50) sphere { I, 1 scale <1,0,1> } #end\n"
                              "#for (I, 1, 3) #warning \"again\" #end\n");
    assert_int_equal(pov2qi(&log, "--check b.pov"), 0);
    assert_int_equal(count_of(log, "scale by 0"), 1);
    assert_int_equal(count_of(log, "#warning: again"), 3);
}

// Lines of #debug are broken as POV-Ray breaks them; long texts are cut.
static void debug_equals_povray(void **state) {
    (void)state;
    if (run_command(NULL, "command -v povray") != 0) {
        print_message("skipped: povray is missing\n");
        skip();
    }
    write_scene("debug.pov",
                HEAD "#macro Repeat(S, N) #local T = \"\"; #for (I, 1, N) #local T = concat(T, S); "
                     "#end T #end\n"
                     "#for (N, 57, 83) #debug concat(Repeat(\"x\", N), \" \", Repeat(\"y\", 30), "
                     "\"\\n\") #end\n"
                     "#debug concat(Repeat(\"word \", 30), \"\\n\")\n"
                     "#debug concat(Repeat(\"0123456789\", 15), \"\\n\")\n"
                     "#debug concat(Repeat(\"a\", 70), \"\\t\", Repeat(\"b\", 20), \"\\n\")\n"
                     "#debug concat(Repeat(\"z\", 198), \"\\n\\n\")\n"
                     "#debug concat(Repeat(\"z\", 199), \"\\n\\n\") #debug \"\\n\"\n"
                     "#debug \"pieces \" #debug \"of a line\" #debug \"\\rand\\na last one\\n\"\n"
                     "#debug \"never shown\"\nsphere { 0, 1 }\n");
    const char *log;
    if (pov2qi(&log, "--check debug.pov +GDours.txt") != 0)
        fail_msg("%s", log);
    assert_int_equal(
        pov2qi(&log, "--version >/dev/null; povray +Idebug.pov +W4 +H3 -D -F +GDtheirs.txt"), 0);
    if (pov2qi(&log, "--version >/dev/null; diff theirs.txt ours.txt") != 0)
        fail_msg("%s", log);
}

// A symbolic link that was copied as a file leads where it did; one that leads nowhere does not.
static void follows_copied_links(void **state) {
    (void)state;
    const char *log;
    write_scene("Real.inc", "#declare R = 2;\n");
    write_scene("link.inc", "Real.inc");
    write_scene("loop.inc", "loop.inc");
    write_scene("a.pov", HEAD "#include \"link.inc\"\nsphere { 0, R }\n");
    if (pov2qi(&log, "--check -v a.pov") != 0)
        fail_msg("%s", log);
    assert_non_null(strstr(log, "a.pov:2:10: note: found as 'Real.inc'"));
    write_scene("a.pov", HEAD "#include \"loop.inc\"\nsphere { 0, R }\n");
    assert_int_equal(pov2qi(&log, "--check a.pov"), 1);
    assert_non_null(strstr(log, "loop.inc:1:1: error:"));
}

// Before: the box of a blank was not a number, and Circle_Text of shapes.inc failed at each of
// them.
static void blanks_have_a_box(void **state) {
    (void)state;
    const char *log;
    write_scene("a.pov", HEAD "#declare T = text { ttf \"timrom.ttf\" \"  \" 1, 0 scale 2 }\n"
                              "#debug concat(vstr(3, min_extent(T), \",\", 0, 3), \" \",\n"
                              "              vstr(3, max_extent(T), \",\", 0, 3), \"\\n\")\n");
    assert_int_equal(pov2qi(&log, "--check a.pov -GW"), 0);
    for (char *p = (char *)(uintptr_t)log; *p; p++)
        if (strncmp(p, "-0.000", 6) == 0)
            memmove(p, p + 1, strlen(p));
    assert_string_equal(log, "0.000,0.000,0.000 0.000,0.000,2.000\n");
}

static const char WRITER[] = HEAD
    "#fopen W \"a.txt\" write #write (W, 1, \",\", <1,2.5,3>, \"x\\ty\\n\", pi, 1e20) #fclose W\n"
    "#fopen W \"a.txt\" append #write (W, \"more\\n\") #fclose W\n"
    "#fopen B \"b.bin\" write #write (B, sint8 -3, 300 uint16be 1,2 sint32le <1,-2,3.5>) #fclose "
    "B\n"
    "#fopen O \"open.txt\" write #write (O, \"never closed\")\n"
    "#fopen R \"a.txt\" read #read (R, One) #fclose R #debug concat(str(One, 0, 0), \"\\n\")\n"
    "sphere { 0, One }\n";

// Without --allow-write a scene writes nothing, and is told so; with it the files are POV-Ray's.
static void writes_where_it_may(void **state) {
    (void)state;
    const char *log;
    write_scene("a.pov", WRITER);
    assert_int_equal(pov2qi(&log, "--check a.pov"), 0);
    assert_int_equal(count_of(log, "is not written"), 3);
    assert_non_null(strstr(log, "a.pov:2:2: warning: 'a.txt' is not written"));
    assert_non_null(strstr(log, "\n1\n")); // what was written could be read again
    assert_int_not_equal(pov2qi(NULL, "--version >/dev/null; ls *.txt b.bin"), 0);
    assert_int_equal(pov2qi(&log, "--check a.pov --allow-write ."), 0);
    assert_string_equal(log, "1\n");
    if (run_command(NULL, "command -v povray") != 0) {
        print_message("skipped: povray is missing\n");
        skip();
    }
    assert_int_equal(pov2qi(&log, "--version >/dev/null; mkdir theirs && cd theirs && "
                                  "povray +I../a.pov +W4 +H3 -D -F"),
                     0);
    static const char *const files[] = {"a.txt", "b.bin", "open.txt"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (run_command(&log, "cd '%s' && cmp %s theirs/%s", scratch_folder(), files[i],
                        files[i]) != 0)
            fail_msg("%s", log);
}

// Not above the folder, not beside it under a longer name, not through a link.
static void stays_in_its_folder(void **state) {
    (void)state;
    const char *log;
    static const char *const names[] = {"../up.txt",    "in/../../up.txt",
                                        "inside/a.txt", "link.txt",
                                        "way/a.txt",    "/tmp/qipov-must-not-be-there.txt"};
    assert_int_equal(pov2qi(NULL, "--version >/dev/null; mkdir -p in inside out; cd in; "
                                  "ln -sf ../out/target.txt link.txt; ln -sfn ../out way"),
                     0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[512];
        snprintf(text, sizeof text, HEAD "#fopen W \"%s%s\" write #write (W, 1) #fclose W\n",
                 names[i][0] == '/' || strncmp(names[i], "in", 2) == 0 ? "" : "in/", names[i]);
        write_scene("a.pov", text);
        int status = pov2qi(&log, "--check a.pov --allow-write in");
        bool link = strcmp(names[i], "link.txt") == 0;
        assert_int_equal(status, link ? 1 : 0);
        assert_non_null(
            strstr(log, link ? "a.pov:2:2: error: Cannot write 'in/link.txt'" : "is not written"));
    }
    assert_int_equal(pov2qi(&log, "--version >/dev/null; ls up.txt ../up.txt inside/* out/* "
                                  "/tmp/qipov-must-not-be-there.txt 2>/dev/null"),
                     2);
    assert_string_equal(log, "");
    write_scene("a.pov", HEAD "#fopen W \"in/below/a.txt\" write #write (W, 1)\n");
    assert_int_equal(pov2qi(NULL, "--version >/dev/null; mkdir in/below"), 0);
    assert_int_equal(pov2qi(NULL, "--check a.pov --allow-write in"), 0);
    assert_int_equal(pov2qi(NULL, "--version >/dev/null; test -f in/below/a.txt"), 0);
    assert_int_equal(pov2qi(&log, "--check a.pov --allow-write nowhere"), 2);
    assert_non_null(strstr(log, "no such folder"));
}

// strings.inc parses a text by writing it to a file and including that: this works in memory.
static void parses_through_a_file(void **state) {
    (void)state;
    const char *log;
    write_scene("a.pov", HEAD "#include \"strings.inc\"\n#declare A = Parse_String(\"2*(3+4)\");\n"
                              "#declare A = Parse_String(\"A+1\");\n"
                              "#debug concat(str(A, 0, 0), \"\\n\")\n");
    assert_int_equal(pov2qi(&log, "--check a.pov -GW"), 0);
    assert_string_equal(log, "15\n");
    assert_int_not_equal(pov2qi(NULL, "--version >/dev/null; ls parse_string.tmp"), 0);
}

// Devices and pipes would never end; a scene may not name them.
static void reads_files_only(void **state) {
    (void)state;
    const char *log;
    write_scene("a.pov", HEAD "#include \"/dev/zero\"\n");
    assert_int_equal(pov2qi(&log, "--check a.pov"), 1);
    assert_non_null(strstr(log, "a.pov:2:10: error: Cannot open include file '/dev/zero'"));
    write_scene("a.pov", HEAD "#fopen F \"pipe\" read\n");
    assert_int_equal(pov2qi(&log, "--version >/dev/null; mkfifo pipe"), 0);
    assert_int_equal(pov2qi(&log, "--check a.pov"), 1);
    assert_non_null(strstr(log, "Cannot open file 'pipe'"));
}

int main(void) {
    if (!getcwd(project, sizeof project))
        abort();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_of_real_scenes), cmocka_unit_test(lists_as_text),
        cmocka_unit_test(lists_as_json),        cmocka_unit_test(warns_once_a_place),
        cmocka_unit_test(debug_equals_povray),  cmocka_unit_test(follows_copied_links),
        cmocka_unit_test(blanks_have_a_box),    cmocka_unit_test(writes_where_it_may),
        cmocka_unit_test(stays_in_its_folder),  cmocka_unit_test(parses_through_a_file),
        cmocka_unit_test(reads_files_only),
    };
    return cmocka_run_group_tests_name("pov2qi", tests, NULL, NULL);
}
