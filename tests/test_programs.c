// SPDX-License-Identifier: MIT
// The programs from outside, in the build with sanitizers: bad input ends with a clear message, the
// right status and no output file; the scene file gives the same picture as the scene.
#include "pictures.h"

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

#define CAMERA "camera { location <0,0,-5> look_at 0 }\n"
#define PATCH_START "bicubic_patch { type 1 u_steps 3 v_steps 3\n"
#define FOUR "<0,0,0> <1,0,0> <2,0,0> <3,0,0>\n"

static void write_text(const char *name, const char *text, size_t size) {
    char path[4400];
    snprintf(path, sizeof path, "%s/%s", scratch_folder(), name);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, size, out), size);
    fclose(out);
}

typedef struct {
    const char *name;
    const char *text;     // of bad.pov; NULL: no file
    const char *switches; // NULL: +W16 +H12
    int status;
    const char *says; // a part of the message
} Bad;

static const Bad BAD[] = {
    {"missing file", NULL, NULL, 1, "bad.pov"},
    {"empty file", "", NULL, 1, "bad.pov' is empty"},
    {"blank file", " \n\t\r\n", NULL, 1, "bad.pov' is empty"},
    {"unclosed brace", CAMERA "sphere { 0, 1\n", NULL, 1, "bad.pov:3:1: error: "},
    {"endless loop", "#while (1)\n#end\n", NULL, 1, "bad.pov:1:"},
    {"endless recursion", "#macro A() A() #end A()\n", NULL, 1, "bad.pov:1:"},
    {"self-include", "#include \"bad.pov\"\n", NULL, 1, "bad.pov:1:"},
    {"15 points", PATCH_START FOUR FOUR FOUR "<0,0,0> <1,0,0> <2,0,0> pigment { rgb 1 } }\n", NULL,
     1, "bad.pov:5:"},
    {"point with 0/0", PATCH_START FOUR FOUR FOUR "<0,0,0> <1,0,0> <2,0,0> <0/0,0,0> }\n", NULL, 1,
     "bad.pov:5:"},
    {"point with 1/0", PATCH_START FOUR FOUR FOUR "<0,0,0> <1,0,0> <2,0,0> <1/0,0,0> }\n", NULL, 1,
     "bad.pov:5:"},
    {"no camera is POV-Ray's camera", "sphere { 4*z, 1 pigment { rgb 1 } }\n", NULL, 0, ""},
    // What can be read can be rendered. Before: more than 200 were refused.
    {"a tree 900 deep",
     CAMERA "#declare S = sphere { 0, 1 pigment { rgb 1 } }\n"
            "#for (I, 1, 900) #declare S = difference { object { S } sphere { 9, 1 } } #end S\n",
     "+W4 +H3", 0, ""},
    // POV-Ray's picture is black; so may be the first frames of an animation. Before, there was
    // none.
    {"nothing to see", CAMERA, "+W4 +H3", 0, "the picture is black"},
    {"only a light", CAMERA "light_source { 9, 1 }\n", "+W4 +H3", 0, "no objects"},
    {"only a sky", "sky_sphere { pigment { rgb 1 } }\n", NULL, 0, "no objects"},
    {"width 0", CAMERA, "+W0 +H12", 1, "must be at least 1"},
    {"too large", CAMERA, "+W1000000 +H1000000", 1, "1000000"},
    {"unknown switch", CAMERA, "+W16 +H12 --methd qi", 2, "--method"},
    {"unknown method", CAMERA, "+W16 +H12 --method fast", 2, "qi-paper"},
    {"include that is not there", "#include \"nowhere.inc\"\n", NULL, 1, "nowhere.inc"},
    {"strict", CAMERA "julia_fractal { <1,0,0,0> }\n", "+W16 +H12 --strict", 1,
     "bad.pov:2:1: error: "},
};

// The picture must be there exactly when the status is 0.
static void check_output(int status) {
    char out[4400];
    snprintf(out, sizeof out, "%s/out.png", scratch_folder());
    assert_int_equal(file_exists(out), status == 0);
    assert_int_equal(run_command(NULL, "ls '%s'/*.part* 2>/dev/null", scratch_folder()), 2);
    unlink(out);
}

static int render_bad(const char **log, const char *input, const char *switches) {
    char cwd[2048];
    assert_non_null(getcwd(cwd, sizeof cwd));
    return run_command(log, "cd '%s' && timeout 100 '%s/build/test/qirender' '+I%s' +Oout.png %s",
                       scratch_folder(), cwd, input, switches ? switches : "+W16 +H12");
}

static void refuses_bad_input(void **state) {
    const Bad *bad = *state;
    char path[4400];
    snprintf(path, sizeof path, "%s/bad.pov", scratch_folder());
    unlink(path);
    if (bad->text)
        write_text("bad.pov", bad->text, strlen(bad->text));
    snprintf(path, sizeof path, "%s/out.png", scratch_folder());
    unlink(path);
    const char *log;
    int status = render_bad(&log, "bad.pov", bad->switches);
    if (status != bad->status || !strstr(log, bad->says))
        fail_msg("status %d, wanted %d and '%s'; it said:\n%s", status, bad->status, bad->says,
                 log);
    check_output(status);
}

static void refuses_directory_and_binary(void **state) {
    (void)state;
    const char *log;
    char path[4400];
    snprintf(path, sizeof path, "%s/folder.pov", scratch_folder());
    assert_int_equal(run_command(NULL, "mkdir -p '%s'", path), 0);
    assert_int_equal(render_bad(&log, "folder.pov", NULL), 1);
    assert_non_null(strstr(log, "directory"));
    check_output(1);
    char bytes[4096];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (char)(i * 2654435761u >> 13);
    write_text("bad.pov", bytes, sizeof bytes);
    assert_int_equal(render_bad(&log, "bad.pov", NULL), 1);
    assert_non_null(strstr(log, "bad.pov:"));
    check_output(1);
}

static void refuses_deep_nesting(void **state) {
    (void)state;
    static const char *const OPENERS[] = {"union{", "(", "#if(1)", "/*", "texture{", "<"};
    for (size_t k = 0; k < sizeof OPENERS / sizeof *OPENERS; k++) {
        size_t length = strlen(OPENERS[k]), count = 10000;
        char *text = malloc(length * count + 64);
        assert_non_null(text);
        strcpy(text, OPENERS[k][0] == '(' || OPENERS[k][0] == '<' ? "#declare A = " : "");
        for (size_t i = 0; i < count; i++)
            strcat(text + length * i, OPENERS[k]);
        write_text("bad.pov", text, strlen(text));
        free(text);
        const char *log;
        int status = render_bad(&log, "bad.pov", NULL);
        if (status != 1 || !strstr(log, "bad.pov:1:"))
            fail_msg("10,000 times %s: status %d\n%s", OPENERS[k], status, log);
        check_output(1);
    }
}

static void refuses_unwritable_places(void **state) {
    (void)state;
    const char *log;
    write_text("good.pov", CAMERA "sphere { 0, 1 }\n", strlen(CAMERA "sphere { 0, 1 }\n"));
    char cwd[2048];
    assert_non_null(getcwd(cwd, sizeof cwd));
    int status = run_command(&log,
                             "'%s/build/test/qirender' '+I%s/good.pov' +W16 +H12 "
                             "+O/nowhere/at/all/out.png",
                             cwd, scratch_folder());
    assert_int_equal(status, 1);
    assert_non_null(strstr(log, "/nowhere/at/all/out.png"));
    // A full disk: the device that is always full, behind the name of the part file.
    status = run_command(&log, "mkdir -p '%s/tiny' && mount -t tmpfs -o size=64k tmpfs '%s/tiny'",
                         scratch_folder(), scratch_folder());
    if (status != 0) {
        print_message("skipped: no small file system can be mounted here\n");
        return;
    }
    status =
        run_command(&log,
                    "'%s/build/test/qirender' '+I%s/good.pov' +W300 +H300 +FP "
                    "'+O%s/tiny/out.ppm'; code=$?; ls '%s/tiny'; umount '%s/tiny'; exit $code",
                    cwd, scratch_folder(), scratch_folder(), scratch_folder(), scratch_folder());
    assert_int_equal(status, 1);
    assert_null(strstr(log, "\nout."));
    assert_non_null(strstr(log, "out.ppm"));
}

// The name decides the format, though the machine's povray.ini says PNG. Before: out.exr.png.
static void name_decides_the_format(void **state) {
    (void)state;
    static const char *const NAMES[] = {"exr", "tif", "jpg", "ppm", "tga", "bmp", "hdr", "png"};
    write_text("good.pov", CAMERA "sphere { 0, 1 pigment { rgb 1 } }\n",
               strlen(CAMERA "sphere { 0, 1 pigment { rgb 1 } }\n"));
    char cwd[2048];
    assert_non_null(getcwd(cwd, sizeof cwd));
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++) {
        const char *log;
        int status = run_command(&log,
                                 "cd '%s' && '%s/build/qirender' +Igood.pov +W16 +H12 -V "
                                 "+Oformat.%s && oiiotool --info format.%s",
                                 scratch_folder(), cwd, NAMES[i], NAMES[i]);
        if (status != 0 || !strstr(log, "16 x   12"))
            fail_msg("%s: status %d\n%s", NAMES[i], status, log);
    }
}

// pov2qi x.pov && qirender x.qi.json is the same picture, byte for byte, as qirender x.pov.
static void scene_file_gives_same_bytes(void **state) {
    (void)state;
    static const char *const SCENES[] = {
        EXAMPLES "objects/bezier.pov", EXAMPLES "advanced/teapot/teapot.pov",
        CORPUS "cephalopov/bicubicpatch_basic.pov", CORPUS "eaglemode/Splitter.pov"};
    char cwd[2048];
    assert_non_null(getcwd(cwd, sizeof cwd));
    for (size_t i = 0; i < sizeof SCENES / sizeof *SCENES; i++) {
        if (!file_exists(SCENES[i])) {
            print_message("skipped: %s is not here\n", SCENES[i]);
            continue;
        }
        const char *slash = strrchr(SCENES[i], '/'), *log;
        char folder[512];
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - SCENES[i]), SCENES[i]);
        int status = run_command(
            &log,
            "cd '%s' && Q='%s/build/test' T='%s' && \"$Q\"/pov2qi %s -o \"$T\"/x.qi.json && "
            "\"$Q\"/pov2qi %s --binary -o \"$T\"/y.qi.json && "
            "for x in '+I%s +Oa.png' '+I'\"$T\"'/x.qi.json +Ob.png' '+I'\"$T\"'/y.qi.json "
            "+Oc.png'; "
            "do set -- $x; \"$Q\"/qirender \"$1\" \"+O$T/${2#+O}\" +W80 +H60 +A0.3 || exit 9; "
            "done; "
            "cmp \"$T\"/a.png \"$T\"/b.png && cmp \"$T\"/a.png \"$T\"/c.png",
            folder, cwd, scratch_folder(), slash + 1, slash + 1, slash + 1);
        if (status != 0)
            fail_msg("%s: status %d\n%s", SCENES[i], status, log);
    }
}

int main(void) {
    enum { COUNT = sizeof BAD / sizeof *BAD };
    struct CMUnitTest tests[COUNT + 5];
    for (int i = 0; i < COUNT; i++)
        tests[i] = (struct CMUnitTest){BAD[i].name, refuses_bad_input, NULL, NULL,
                                       (void *)(uintptr_t)&BAD[i]};
    tests[COUNT] = (struct CMUnitTest)cmocka_unit_test(refuses_directory_and_binary);
    tests[COUNT + 1] = (struct CMUnitTest)cmocka_unit_test(refuses_deep_nesting);
    tests[COUNT + 2] = (struct CMUnitTest)cmocka_unit_test(refuses_unwritable_places);
    tests[COUNT + 3] = (struct CMUnitTest)cmocka_unit_test(scene_file_gives_same_bytes);
    tests[COUNT + 4] = (struct CMUnitTest)cmocka_unit_test(name_decides_the_format);
    return cmocka_run_group_tests_name("programs", tests, NULL, NULL);
}
