// SPDX-License-Identifier: MIT
// The command line: what each switch sets, in both forms; what is refused, and how; output names.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "arena_state.h"
#include "base/file.h"
#include "options/options.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { MOST_WORDS = 32 };

// Parses the words of line, which are separated by blanks.
static bool parse(OptionsProgram program, const char *line, Arena *arena, RenderOptions *options) {
    char *words[MOST_WORDS + 2] = {arena_strdup(arena, "program")};
    int count = 1;
    char *rest = arena_strdup(arena, line), *save = NULL;
    for (char *w = strtok_r(rest, " ", &save); w; w = strtok_r(NULL, " ", &save)) {
        assert_true(count <= MOST_WORDS);
        words[count++] = w;
    }
    *options = options_default();
    return options_parse(program, count, words, arena, options);
}

static RenderOptions accept(Arena *arena, const char *line) {
    RenderOptions o;
    if (!parse(PROGRAM_QIRENDER, line, arena, &o))
        fail_msg("refused: %s", line);
    return o;
}

// What the parser prints when it refuses the line; dies if it does not.
static const char *refusal(OptionsProgram program, Arena *arena, const char *line) {
    char path[] = "/tmp/qipov-options-XXXXXX";
    int file = mkstemp(path), keep = dup(STDERR_FILENO);
    assert_true(file >= 0 && keep >= 0);
    fflush(stderr);
    dup2(file, STDERR_FILENO);
    RenderOptions o;
    bool ok = parse(program, line, arena, &o);
    fflush(stderr);
    dup2(keep, STDERR_FILENO);
    close(keep);
    close(file);
    const char *text = file_read(arena, path, NULL, NULL);
    unlink(path);
    if (ok)
        fail_msg("accepted: %s", line);
    return text;
}

static void refuses(OptionsProgram program, Arena *arena, const char *line, const char *named,
                    const char *hint) {
    const char *text = refusal(program, arena, line);
    if (!strstr(text, named) || !strstr(text, hint) || !strstr(text, "--help"))
        fail_msg("%s: '%s' and '%s' should be in: %s", line, named, hint, text);
    assert_true(strchr(text, '\n') == text + strlen(text) - 1); // one line
}

// ---- tests -----------------------------------------------------------------------------------

static void defaults(void **state) {
    Arena *arena = *state;
    RenderOptions o = accept(arena, "a.pov");
    assert_string_equal(o.input, "a.pov");
    assert_null(o.output);
    assert_true(o.width == 800 && o.height == 600 && o.block_size == 32);
    assert_true(!o.antialias && o.antialias_threshold == 0.3 && o.sampling_method == 1);
    assert_true(o.antialias_depth == 3 && o.jitter && o.jitter_amount == 1 &&
                o.antialias_gamma == 2.5);
    assert_true(o.quality == 9 && o.format == IMAGE_PNG && o.bits == 8 && o.file_gamma == 0);
    assert_true(!o.alpha && !o.grayscale && o.output_to_file && o.verbose);
    assert_true(o.start_row < 0 && o.end_row < 0 && o.start_column < 0 && o.end_column < 0);
    assert_true(!o.clock_given && o.version == 0 && o.threads == 0 && o.method == METHOD_QI);
}

// Each line of both columns must give the same options.
static void switches_and_keywords_agree(void **state) {
    Arena *arena = *state;
    const char *const pairs[][2] = {
        {"+W640 -h480", "Width=640 height=480"},
        {"+Iscene +Oout", "Input_File_Name=scene OUTPUT_FILE_NAME=out"},
        {"+A", "Antialias=On"},
        {"+A0.15", "Antialias=yes Antialias_Threshold=0.15"},
        {"-A0.15", "Antialias_Threshold=0.15 Antialias=Off"},
        {"+am2 +r5", "Sampling_Method=2 Antialias_Depth=5"},
        {"-J", "Jitter=Off"},
        {"+J0.5", "Jitter=true Jitter_Amount=0.5"},
        {"+AG1.8", "Antialias_Gamma=1.8"},
        {"+FN16", "Output_File_Type=n Bits_Per_Colour=16"},
        {"+FT", "Output_File_Type=T Bits_Per_Color=8"},
        {"-F", "Output_to_File=0"},
        {"+UA", "Output_Alpha=1"},
        {"+Q4", "Quality=4"},
        {"+WT2 +BS16", "Work_Threads=2 Render_Block_Size=16"},
        {"+K0.25", "Clock=0.25"},
        {"+MV3.1", "Version=3.1"},
        {"+SC2 +EC10.5 +SR0.25 +ER0.75",
         "Start_Column=2 End_Column=10.5 Start_Row=0.25 End_Row=0.75"},
        {"-V -D +P", "Verbose=false Display=no Pause_When_Done=on"},
        {"+W640 +W320", "Width=320"},
        {"-GA +GD +GP", "All_Console=off Debug_Console=on Append_File=on"},
        {"-GW +GS", "Warning_Console=no Statistic_Console=yes"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        RenderOptions a = accept(arena, pairs[i][0]), b = accept(arena, pairs[i][1]);
        // Pointers differ between the two; compare what they point to, then the plain rest.
        assert_int_equal(a.input != NULL, b.input != NULL);
        if (a.input)
            assert_string_equal(a.input, b.input);
        if (a.output)
            assert_string_equal(a.output, b.output);
        a.input = b.input = a.output = b.output = NULL;
        a.shared = b.shared = a.own = b.own = a.scenes = b.scenes = NULL;
        if (memcmp(&a, &b, sizeof a) != 0)
            fail_msg("%s | %s", pairs[i][0], pairs[i][1]);
    }
}

static void values(void **state) {
    Arena *arena = *state;
    RenderOptions o = accept(arena, "+A0.02 +J7 +R20 +Q11 +AM9 +FC +K0.1");
    assert_true(o.antialias && o.antialias_threshold == 0.02);
    assert_true(o.jitter_amount == 1 && o.antialias_depth == 9 && o.quality == 9);
    assert_true(o.sampling_method == 2 && o.format == IMAGE_TGA && o.compressed);
    assert_true(o.clock_given && o.clock == (double)0.1f);

    o = accept(arena, "+FE -W10 -H20 +FN3");
    assert_true(o.width == 10 && o.height == 20 && o.format == IMAGE_PNG && o.bits == 5);
    assert_true(accept(arena, "+FNg").grayscale);
    assert_int_equal(accept(arena, "+MV3.7").version, 370);
    assert_int_equal(accept(arena, "+MV3.62").version, 362);
    assert_true(accept(arena, "File_Gamma=1.0").file_gamma == 1);
    assert_true(accept(arena, "File_Gamma=sRGB").file_gamma == 0);
    assert_true(accept(arena, "--tolerance 1e-6").tolerance == 1e-6);
    assert_true(accept(arena, "--tolerance=1e-6 --strict").strict);
    assert_int_equal(accept(arena, "--method facets").method, METHOD_FACETS);
    assert_true(accept(arena, "-h").help && accept(arena, "--help").help);
    assert_true(accept(arena, "--version").show_version);
    assert_int_equal(accept(arena, "-h240").height, 240);
    assert_string_equal(accept(arena, "+O\"x.png\"").output, "x.png");
    assert_string_equal(accept(arena, "x.qi.json").input, "x.qi.json");
    assert_string_equal(accept(arena, "X.POV").input, "X.POV");
}

// The name decides the format when +F does not.
static void format_by_name(void **state) {
    Arena *arena = *state;
    assert_int_equal(accept(arena, "+Ox.exr").format, IMAGE_EXR);
    assert_int_equal(accept(arena, "+Ox.JPEG").format, IMAGE_JPEG);
    assert_int_equal(accept(arena, "+Ox.exr +FN").format, IMAGE_PNG);
    assert_int_equal(accept(arena, "+Ox.y").format, IMAGE_PNG);
}

static void libraries_and_declares(void **state) {
    Arena *arena = *state;
    RenderOptions o = accept(arena, "+Lone two/ Library_Path=three Declare=N=3 declare=X_1=-1.5e-3 "
                                    "Declare=P=0.123456789");
    assert_int_equal(o.library_path_count, 3);
    assert_string_equal(o.library_paths[0], "one");
    assert_string_equal(o.library_paths[1], "two/");
    assert_string_equal(o.library_paths[2], "three");
    assert_int_equal(o.declare_count, 3);
    assert_string_equal(o.declares[0].name, "N");
    assert_true(o.declares[0].value == 3);
    assert_string_equal(o.declares[1].name, "X_1");
    assert_true(o.declares[1].value == -1.5e-3);
    assert_true(o.declares[2].value == 0.123457); // six digits, as POV-Ray hands it on
}

// What POV-Ray takes and no picture of ours depends on.
static void harmless_switches(void **state) {
    Arena *arena = *state;
    RenderOptions o = accept(arena, "+MB25 -MB +BM1 +UR +SU -UV +UL +C +X +SP32 +EP4 +WL5 -GA "
                                    "+GSstats.txt -TH Dither=off Bounding_Threshold=3 +DGT +W7");
    assert_int_equal(o.width, 7);
}

// Streams of messages: shown or not, and where their copies go.
static void message_streams(void **state) {
    Arena *arena = *state;
    RenderOptions o = accept(arena, "-GA +GSstats.txt -GFerrors.txt +GAall.txt -GW");
    static const bool shown[CONSOLE_COUNT] = {true, true, true, true, false};
    for (int i = 0; i < CONSOLE_COUNT; i++)
        assert_int_equal(o.console[i], shown[i]);
    assert_string_equal(o.console_file[CONSOLE_STATISTIC], "stats.txt");
    assert_string_equal(o.console_file[CONSOLE_FATAL], "errors.txt");
    assert_string_equal(o.all_file, "all.txt");
    assert_null(o.console_file[CONSOLE_WARNING]);
    o = accept(arena, "-GA");
    assert_true(o.console[CONSOLE_FATAL] && !o.console[CONSOLE_DEBUG]);
    assert_false(accept(arena, "-GF").console[CONSOLE_FATAL]);
    assert_string_equal(accept(arena, "Debug_File=d.txt").console_file[CONSOLE_DEBUG], "d.txt");
}

static void wrong_words(void **state) {
    Arena *arena = *state;
    const struct {
        const char *line, *named, *hint;
    } wrong[] = {
        {"a.pov +W 640", "'+W'", "+W640"},
        {"+W", "'+W'", "glued"},
        {"+W6.5", "'+W6.5'", "whole number"},
        {"+W640x", "'+W640x'", "whole number"},
        {"+A1", "'+A1'", "+A0.3"},
        {"+A.3", "'+A.3'", "+A0.3"},
        {"+A0", "'+A0'", "+A0.3"},
        {"+A0.3x", "'+A0.3x'", "+A0.3"},
        {"+AMx", "'+AMx'", "+A"},
        {"+Jx", "'+Jx'", "+J0.5"},
        {"+FX", "'+FX'", "PNG"},
        {"+FTg", "'+FTg'", "greyscale"},
        {"+FN8g", "'+FN8g'", "bits"},
        {"-WTF", "'-WTF'", "+WT"},
        {"Widht=3", "'Widht=3'", "Width="},
        {"Antialiass=on", "'Antialiass=on'", "Antialias="},
        {"--metod qi", "'--metod'", "--method"},
        {"--method foo", "'--method foo'", "qi-paper"},
        {"--tolerance", "'--tolerance'", "value"},
        {"--tolerance nan", "'--tolerance nan'", "share"},
        {"--strict=1", "'--strict=1'", "no value"},
        {"--binary", "'--binary'", "no such option"},
        {"--fail 1", "'--fail'", "no such option"},
        {"Declare=3=4", "'Declare=3=4'", "Declare=Name=number"},
        {"Declare=N", "'Declare=N'", "Declare=Name=number"},
        {"Declare=N=x", "'Declare=N=x'", "Declare=Name=number"},
        {"File_Gamma=0", "'File_Gamma=0'", "positive"},
        {"+MV9", "'+MV9'", "3.7"},
        {"+BS3", "'+BS3'", "at least 4"},
        {"+BS", "'+BS'", "at least 4"},
        {"+Knan", "'+Knan'", "+K0.5"},
        {"+KFFx", "'+KFFx'", "number must follow"},
        {"+THX9", "'+THX9'", "dithering"},
        {"quick.ini", "'quick.ini'", "INI"},
        {"teapot", "'teapot'", "neither"},
        {"x.png", "'x.png'", "neither"},
        {"--", "'--'", "nothing may follow"},
        {"+", "'+'", "neither"},
        {"+FT Grayscale_Output=on", "'Grayscale_Output'", "PNG"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        refuses(PROGRAM_QIRENDER, arena, wrong[i].line, wrong[i].named, wrong[i].hint);
}

static void words_of_the_other_programs(void **state) {
    Arena *arena = *state;
    RenderOptions o;
    assert_true(parse(PROGRAM_POV2QI, "a.pov -o b.qi.json --binary +L/inc", arena, &o));
    assert_string_equal(o.output, "b.qi.json");
    assert_true(o.binary && o.library_path_count == 1);
    // The line that renders a scene converts it as well.
    assert_true(parse(PROGRAM_POV2QI, "a.pov -F +A0.3 +KFF3 -D +SR2 Quality=4 --check", arena, &o));
    assert_true(o.check && o.final_frame == 3);
    assert_int_equal(o.remark_count, 4);
    assert_false(o.remarks[0].warning);
    assert_string_equal(o.remarks[1].text, "POV-Ray's A has no effect in this program");
    assert_true(parse(PROGRAM_POV2QI, "a.pov --limit tokens=1e9 --limit Nesting=20", arena, &o));
    assert_true(o.limits[LIMIT_TOKENS] == 1000000000 && o.limits[LIMIT_NESTING] == 20);
    assert_true(o.limits[LIMIT_CALLS] == 0);
    refuses(PROGRAM_POV2QI, arena, "--limit token=1", "token=1", "the limits are calls, elements");
    refuses(PROGRAM_POV2QI, arena, "--limit tokens=0", "", "positive number");
    refuses(PROGRAM_POV2QI, arena, "--limit tokens", "tokens", "positive number");
    refuses(PROGRAM_POV2QI, arena, "--method qi", "'--method'", "no such option");

    assert_true(
        parse(PROGRAM_QICOMPARE, "one.png two.EXR --fail 0.01 --failpercent=2 -o dir", arena, &o));
    assert_int_equal(o.picture_count, 2);
    assert_string_equal(o.pictures[1], "two.EXR");
    assert_true(o.fail == 0.01 && o.fail_percent == 2 && o.warn == 1e-6);
    assert_string_equal(o.output, "dir");
    refuses(PROGRAM_QICOMPARE, arena, "a.png b.png c.png", "'c.png'", "third");

    // Who gets which words: both renderers, or qirender alone.
    assert_true(parse(PROGRAM_QICOMPARE,
                      "a.pov +W64 Height=48 inc/ --warn 0.1 --method facets -o out +Oout2 +Ib.pov "
                      "-- +A0.3 --tolerance 1e-6",
                      arena, &o));
    assert_int_equal(o.shared_count, 4);
    assert_string_equal(o.shared[0], "+W64");
    assert_string_equal(o.shared[1], "Height=48");
    assert_string_equal(o.shared[2], "inc/");
    assert_string_equal(o.shared[3], "+A0.3");
    assert_int_equal(o.own_count, 4);
    assert_string_equal(o.own[0], "--method");
    assert_string_equal(o.own[1], "facets");
    assert_string_equal(o.own[3], "1e-6");
    assert_int_equal(o.width, 64);
}

// ORDER as in facts: directory, base name, wrong extension kept and the right one added.
static void output_names(void **state) {
    Arena *arena = *state;
    const struct {
        const char *line, *extension, *expected;
    } names[] = {
        {"dir/scene.pov", "png", "dir/scene.png"},
        {"+Idir/scene", "png", "dir/scene.png"},
        {"a.b/scene", "png", NULL}, // no such word; see below
        {"+Ia.b/scene", "png", "a.b/scene.png"},
        {"teapot.qi.json", "png", "teapot.png"},
        {"teapot.pov", "qi.json", "teapot.qi.json"},
        {"dir/scene.pov +Oout/", "png", "out/scene.png"},
        {"dir/scene.pov +Oout", "png", "out.png"},
        {"scene.pov +Obaz.xyz", "jpg", "baz.xyz.jpg"},
        {"scene.pov +Obaz.PNG", "png", "baz.PNG"},
        {"scene.pov +Obaz.jpeg", "jpg", "baz.jpeg"},
        {"scene.pov +Obaz.png", "jpg", "baz.png.jpg"},
        {"scene.pov +Obaz.json", "qi.json", "baz.json"},
        {"scene.pov +O-", "png", "-"},
        {".pov", "png", NULL},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!names[i].expected) {
            refuses(PROGRAM_QIRENDER, arena, names[i].line, names[i].line, "neither");
            continue;
        }
        RenderOptions o = accept(arena, names[i].line);
        assert_string_equal(options_output_path(&o, arena, names[i].extension), names[i].expected);
    }
}

static void input_names(void **state) {
    Arena *arena = *state;
    char folder[] = "/tmp/qipov-options-XXXXXX";
    assert_non_null(mkdtemp(folder));
    const char *scene = arena_printf(arena, "%s/scene.pov", folder);
    OutputFile *out = file_begin(scene);
    file_commit(out);
    RenderOptions o = options_default();
    assert_null(options_input_path(&o, arena));
    o.input = arena_printf(arena, "%s/scene", folder);
    assert_string_equal(options_input_path(&o, arena), scene);
    o.input = scene;
    assert_string_equal(options_input_path(&o, arena), scene);
    o.input = "/nowhere/scene";
    assert_string_equal(options_input_path(&o, arena), "/nowhere/scene");
    unlink(scene);
    rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        ARENA_TEST(defaults),
        ARENA_TEST(switches_and_keywords_agree),
        ARENA_TEST(values),
        ARENA_TEST(format_by_name),
        ARENA_TEST(libraries_and_declares),
        ARENA_TEST(harmless_switches),
        ARENA_TEST(message_streams),
        ARENA_TEST(wrong_words),
        ARENA_TEST(words_of_the_other_programs),
        ARENA_TEST(output_names),
        ARENA_TEST(input_names),
    };
    return cmocka_run_group_tests_name("options", tests, NULL, NULL);
}
