// SPDX-License-Identifier: MIT
// Animations: which frames there are, what each is told, how its file is named. POV-Ray is the
// judge: the same INI file gives both programs the same files, equal to the last bit.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "arena_state.h"
#include "base/diag.h"
#include "image/image.h"
#include "options/animation.h"
#include "option_line.h"
#include "tests/reference.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// What POV-Ray 3.7 rendered for each line.
static void frames(void **state) {
    Arena *arena = *state;
    static const struct {
        const char *line;
        int first, last, step, initial, final, digits;
        double clock; // of the second frame, or of the only one
    } cases[] = {
        {"+KFF3", 1, 3, 1, 1, 3, 1, 0.5},
        {"+KFF3 +K0.7", 1, 3, 1, 1, 3, 1, 0.5},
        {"+KFF3 +KC", 1, 3, 1, 1, 4, 1, 1.0 / 3},
        {"+KFF9 +KC +SF8", 8, 9, 1, 1, 10, 2, 8.0 / 9},
        {"+KFF10 +SF0.5 +EF0.7", 5, 7, 1, 1, 10, 2, 5.0 / 9},
        {"+KFF10 +SF8.5", 8, 10, 1, 1, 10, 2, 8.0 / 9},
        {"+KFF10 +SF8 +EF20", 8, 20, 1, 1, 10, 2, 8.0 / 9},
        {"+KFF10 +STP4 +KI1 +KF2", 1, 10, 4, 1, 10, 2, 1 + 4.0 / 9},
        {"+KFI-3 +KFF2", 0, 2, 1, 0, 2, 1, 0.5},
        {"+KFF100 +KFI99", 99, 100, 1, 99, 100, 3, 1},
        {"+KFF3 +SF5", 5, 5, 1, 1, 3, 1, 2},
        {"+KFF3 +STP-2", 1, 3, 1, 1, 3, 1, 0.5},
        {"+KFF1", 1, 1, 1, 1, 1, 1, NAN},
        {"+KFI5 +KFF3", 5, 5, 1, 5, 5, 1, NAN},
        {"+KFI2", 2, 2, 1, 2, 2, 1, NAN},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        RenderOptions o = options_of_line(arena, cases[i].line);
        Animation a;
        assert_true(animation_of(&o, &a));
        if (a.first != cases[i].first || a.last != cases[i].last || a.step != cases[i].step ||
            a.frame.initial != cases[i].initial || a.frame.final != cases[i].final ||
            a.frame.digits != cases[i].digits)
            fail_msg("%s: %d to %d by %d, of %d to %d, %d digits", cases[i].line, a.first, a.last,
                     a.step, a.frame.initial, a.frame.final, a.frame.digits);
        int number = a.first + a.step <= a.last ? a.first + a.step : a.first;
        animation_set_frame(&a, number, &o);
        bool same =
            isnan(cases[i].clock) ? isnan(o.clock) : o.clock == (double)(float)cases[i].clock;
        if (!same || !o.clock_given || o.frame.number != number)
            fail_msg("%s: the clock of frame %d is %.17g", cases[i].line, number, o.clock);
    }
}

static void single_pictures(void **state) {
    Arena *arena = *state;
    static const char *const lines[] = {"+W3",         "+K2",           "+KFI1 +KFF1",    "+KFF0",
                                        "+KFI0 +KFF0", "+KC +KI3 +KF4", "+SF3 +EF4 +STP2"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        RenderOptions o = options_of_line(arena, lines[i]);
        Animation a;
        if (animation_of(&o, &a))
            fail_msg("%s is no animation", lines[i]);
    }
}

static void names(void **state) {
    Arena *arena = *state;
    static const struct {
        const char *line, *extension, *expected;
    } cases[] = {
        {"s.pov", "png", "s07.png"},
        {"a.b/s.pov", "png", "a.b/s07.png"},
        {"s.pov +Oout/", "png", "out/s07.png"},
        {"s.pov +Oxx7", "png", "xx707.png"},
        {"s.pov +Oxx.PNG", "png", "xx07.PNG"},
        {"s.pov +Obaz.xyz", "jpg", "baz.xyz07.jpg"},
        {"s.pov +Ox.jpeg", "jpg", "x07.jpeg"},
        {"s.pov +O-", "png", "-"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        RenderOptions o = options_of_line(arena, cases[i].line);
        Animation a;
        o.final_frame = 10;
        assert_true(animation_of(&o, &a));
        animation_set_frame(&a, 7, &o);
        assert_string_equal(options_output_path(&o, arena, cases[i].extension), cases[i].expected);
    }
}

// ---- POV-Ray ------------------------------------------------------------------------------------

// Every variable shows in the picture: each column of pixels is the digits of one of them.
static const char scene[] =
    "#version 3.7;\n"
    "global_settings { assumed_gamma 1 }\n"
    "#ifndef (Extra) #declare Extra = 0; #end\n"
    "#declare V = array[9] { clock, clock_on, frame_number, initial_frame, final_frame,\n"
    "                        initial_clock, final_clock, clock_delta, Shift+Extra }\n"
    "camera { orthographic location <4.5, 2, -5> right 9*x up 4*y direction z }\n"
    "#for (I, 0, 8)\n"
    "  #for (J, 0, 3)\n"
    "    #local D = mod(floor(abs(V[I]) * pow(100, J)), 100) / 100;\n"
    "    box { <I, J, 0>, <I + 1, J + 1, 1> pigment { rgb D } finish { ambient 1 diffuse 0 } }\n"
    "  #end\n"
    "#end\n";

static int count_files(const char *folder) {
    DIR *dir = opendir(folder);
    int count = 0;
    assert_non_null(dir);
    for (struct dirent *e = readdir(dir); e; e = readdir(dir))
        count += e->d_name[0] != '.';
    closedir(dir);
    return count;
}

static int shell(const char *command) { return system(command); }

static void equal_to_povray(void **state) {
    Arena *arena = *state;
    const char *own = "build/test/qirender";
    if (!reference_available() || access(own, X_OK) != 0) {
        print_message("skipped: povray or %s is missing\n", own);
        skip();
    }
    static const struct {
        const char *ini, *word;
        int first, last, files;
        const char *format; // of the names
    } cases[] = {
        {"Include_Header=h\nFinal_Frame=3\nInitial_Clock=0.123456789\nFinal_Clock = 0.7\n", "t", 1,
         3, 3, "s%d.png"},
        {"Final_Frame=9\n+KC +STP4\nSubset_Start_Frame=2\nOutput_File_Name=out/pic.png\n"
         "[none]\nWidth=1\n",
         "t.ini", 2, 6, 2, "out/pic%02d.png"},
        {"Height=2\n[Part]\nInitial_Frame=98\nFinal_Frame=107\nHeight=4\nSubset_End_Frame=0.25\n"
         "+KI-3 +KF1e3 +SF99\n",
         "t[part]", 99, 99, 1, "s%03d.png"},
        {"[Short]\nFinal_Frame=3\n[Long]\nFinal_Frame=10\nFinal_Clock=5\n", "t.ini[Long]", 1, 10,
         10, "s%02d.png"},
    };
    char here[4096], folder[] = "/tmp/qipov-animation-XXXXXX";
    assert_non_null(getcwd(here, sizeof here));
    assert_non_null(mkdtemp(folder));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *programs[2] = {"povray", arena_printf(arena, "%s/%s", here, own)};
        for (int k = 0; k < 2; k++) {
            const char *dir = arena_printf(arena, "%s/%zu%d", folder, i, k);
            assert_int_equal(mkdir(dir, 0777), 0);
            mkdir(arena_printf(arena, "%s/out", dir), 0777);
            FILE *out = fopen(arena_printf(arena, "%s/s.pov", dir), "w");
            assert_true(out && fputs(scene, out) >= 0 && fclose(out) == 0);
            out = fopen(arena_printf(arena, "%s/h.inc", dir), "w");
            assert_true(out && fputs("#declare Extra = 12.345;\n", out) >= 0 && fclose(out) == 0);
            out = fopen(arena_printf(arena, "%s/t.ini", dir), "w");
            assert_true(out &&
                        fprintf(out,
                                "Input_File_Name=s.pov\nWidth=9\nHeight=4\n"
                                "Declare=Shift=0.987654321\nBits_Per_Color=16\n%s",
                                cases[i].ini) > 0 &&
                        fclose(out) == 0);
            const char *command =
                arena_printf(arena, "cd %s && %s '%s' -D >log.txt 2>&1 </dev/null", dir,
                             programs[k], cases[i].word);
            if (shell(command) != 0)
                fail_msg("%s", command);
        }
        for (const char *const *sub = (const char *const[]){"", "/out", NULL}; *sub; sub++)
            assert_int_equal(count_files(arena_printf(arena, "%s/%zu0%s", folder, i, *sub)),
                             count_files(arena_printf(arena, "%s/%zu1%s", folder, i, *sub)));
        int found = 0;
        for (int number = cases[i].first; number <= cases[i].last; number++) {
            char name[64], where[160];
            snprintf(name, sizeof name, cases[i].format, number);
            const char *theirs = arena_printf(arena, "%s/%zu0/%s", folder, i, name);
            if (access(theirs, F_OK) != 0)
                continue;
            found++;
            Image *a = image_read(arena, theirs);
            Image *b = image_read(arena, arena_printf(arena, "%s/%zu1/%s", folder, i, name));
            size_t different = reference_mismatches(a, b, where, sizeof where);
            if (different)
                fail_msg("%s (case %zu): %zu values differ, first %s", name, i, different, where);
        }
        assert_int_equal(found, cases[i].files);
    }
    shell(arena_printf(arena, "rm -r %s", folder));
}

// A scene of the distribution that is meant to be an animation, and writes pages about itself: both
// leave the same files with the same bytes.
static void allobjects(void **state) {
    Arena *arena = *state;
    static const char from[] = "/usr/share/doc/povray/examples/portfolio/";
    const char *own = "build/test/qirender";
    if (!reference_available() || access(own, X_OK) != 0 || access(from, R_OK) != 0) {
        print_message("skipped: povray, its examples or %s is missing\n", own);
        skip();
    }
    char here[4096], folder[] = "/tmp/qipov-animation-XXXXXX";
    assert_non_null(getcwd(here, sizeof here));
    assert_non_null(mkdtemp(folder));
    const char *programs[2] = {
        "povray", arena_printf(arena, "%s/%s --allow-write . --method facets", here, own)};
    for (int k = 0; k < 2; k++) {
        const char *command = arena_printf(
            arena,
            "mkdir %s/%d && cd %s/%d && cp %sallobjects.pov %s*.inc . && "
            "%s +Iallobjects.pov +KFF2 +SF1 +EF1 +W32 +H24 -D >../log.txt 2>&1 </dev/null",
            folder, k, folder, k, from, from, programs[k]);
        if (shell(command) != 0)
            fail_msg("%s", command);
    }
    Image *a = image_read(arena, arena_printf(arena, "%s/0/allobjects1.png", folder));
    Image *b = image_read(arena, arena_printf(arena, "%s/1/allobjects1.png", folder));
    char where[160];
    size_t different = reference_mismatches(a, b, where, sizeof where);
    if (different)
        fail_msg("%zu values differ, first %s", different, where);
    assert_true(count_files(arena_printf(arena, "%s/1", folder)) > 7);
    assert_int_equal(shell(arena_printf(arena, "diff -r -x '*.png' %s/0 %s/1", folder, folder)), 0);
    assert_int_equal(shell(arena_printf(arena, "rm -r %s", folder)), 0);
}

// Of two cameras the first one is meant; before version 3.5 as it was before the second changed it.
static void clockless(void **state) {
    Arena *arena = *state;
    static const char *const scenes[] = {
        "#version 3.7; global_settings { assumed_gamma 1 }\n"
        "camera { location -5*z look_at 0 } camera { location 5*y look_at 0 }\n",
        "#version 3.1; camera { location -5*z look_at 0 } camera { location 5*y }\n",
        "#version 3.7; global_settings { assumed_gamma 1 } camera { location 5*y look_at 0 }\n"};
    if (!reference_available() || access("build/test/qirender", X_OK) != 0) {
        print_message("skipped: povray or qirender is missing\n");
        skip();
    }
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        const char *text = arena_printf(
            arena, "%s box { -1, 1 pigment { gradient z } finish { ambient 1 } }", scenes[i]);
        Reference *theirs = reference_begin(arena, text, "+W16 +H12 Clockless_Animation=on");
        FILE *out = fopen("build/test/clockless.pov", "w");
        assert_true(out && fputs(text, out) >= 0 && fclose(out) == 0);
        assert_int_equal(shell("build/test/qirender build/test/clockless.pov +W16 +H12 +KLA -GA"),
                         0);
        char where[160];
        Image *ours = image_read(arena, "build/test/clockless.png");
        size_t different = reference_mismatches(reference_end(theirs), ours, where, sizeof where);
        if (different)
            fail_msg("scene %zu: %zu values differ, first %s", i, different, where);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        ARENA_TEST(frames),          ARENA_TEST(single_pictures), ARENA_TEST(names),
        ARENA_TEST(equal_to_povray), ARENA_TEST(allobjects),      ARENA_TEST(clockless),
    };
    return cmocka_run_group_tests_name("animation", tests, NULL, NULL);
}
