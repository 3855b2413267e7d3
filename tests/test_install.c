// SPDX-License-Identifier: MIT
// What `make install` puts somewhere works there: programs that find their library, manual pages
// without a complaint of groff's, completions that bash takes.
#include "pictures.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static int install_it(void **state) {
    (void)state;
    return run_command(NULL, "make --no-print-directory install DESTDIR='%s' PREFIX=/usr",
                       scratch_folder());
}

// A format that needs OpenImageIO, so that the library beside bin/ is found.
static void programs_run(void **state) {
    (void)state;
    const char *log;
    int status = run_command(
        &log,
        "cd '%s' && echo 'sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 } } camera { location "
        "<0,0,-3> }' >a.pov && usr/bin/qirender a.pov +W8 +H6 +Oa.exr -V && usr/bin/pov2qi a.pov "
        "&& "
        "usr/bin/qirender a.qi.json +W8 +H6 +Ob.exr -V && cmp a.exr b.exr",
        scratch_folder());
    if (status != 0)
        fail_msg("%s", log);
}

static const char *const programs[] = {"pov2qi", "qirender", "qicompare", "qibench"};

static void manual_pages(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        const char *log;
        char path[4400];
        snprintf(path, sizeof path, "%s/usr/share/man/man1/%s.1", scratch_folder(), programs[i]);
        assert_int_equal(run_command(&log, "cat '%s'", path), 0);
        assert_non_null(strstr(log, ".SH NAME"));
        assert_non_null(strstr(log, "\\fB\\-\\-completion\\fR"));
        assert_non_null(strstr(log, ".SH EXIT STATUS"));
        if (run_command(NULL, "command -v groff") != 0) {
            print_message("skipped: groff is not installed\n");
            continue;
        }
        assert_int_equal(run_command(&log, "groff -man -ww -Tascii '%s' 2>&1 >/dev/null", path), 0);
        assert_string_equal(log, "");
    }
}

// In a bash that has read the script the words that begin like the given one are offered.
static void completions(void **state) {
    (void)state;
    const char *log;
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        int status = run_command(
            &log,
            "bash -c \"source '%s/usr/share/bash-completion/completions/%s'; COMP_WORDS=(%s --ver);"
            " COMP_CWORD=1; _%s; echo \\${COMPREPLY[@]}\"",
            scratch_folder(), programs[i], programs[i], programs[i]);
        assert_int_equal(status, 0);
        assert_non_null(strstr(log, "--version"));
        assert_null(strstr(log, "--strict"));
    }
}

// README's example, compiled against what was installed, by the flags that pkg-config gives; with
// DESTDIR as the root, as a package's files are before they are in place.
static void library_is_found(void **state) {
    (void)state;
    const char *log;
    int status = run_command(
        &log,
        "awk '/^<!-- example: /{found=1} found && /^```$/{exit} inside{print} found && "
        "/^```c$/{inside=1}' README.md >'%s/example.c' && cd '%s' && "
        "export PKG_CONFIG_PATH=\"$PWD/usr/lib/pkgconfig\" PKG_CONFIG_SYSROOT_DIR=\"$PWD\" "
        "PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1 && "
        "cc -std=c11 -Wall -Wextra -Werror $(pkg-config --cflags qipatch) -o example example.c "
        "$(pkg-config --libs qipatch) && ./example && pkg-config --modversion qipatch",
        scratch_folder(), scratch_folder());
    if (status != 0)
        fail_msg("%s", log);
    // Twelve lines of 24 characters, then the version.
    assert_true(strlen(log) > 12 * 25 && log[6 * 25 + 12] == '@' && log[12 * 25] >= '0');
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_run),
        cmocka_unit_test(manual_pages),
        cmocka_unit_test(completions),
        cmocka_unit_test(library_is_found),
    };
    return cmocka_run_group_tests(tests, install_it, NULL);
}
