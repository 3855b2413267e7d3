// SPDX-License-Identifier: MIT
// The streams of messages: what is shown, and what the copies hold.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/console.h"
#include "base/diag.h"
#include "base/file.h"

#include <stdio.h>
#include <unistd.h>

static char folder[] = "/tmp/qipov-console-XXXXXX";

// What print shows on standard error.
static const char *shown(Arena *arena, void (*print)(void)) {
    int keep = dup(STDERR_FILENO);
    const char *path = arena_printf(arena, "%s/stderr.txt", folder);
    FILE *out = fopen(path, "w");
    assert_true(keep >= 0 && out);
    fflush(stderr);
    dup2(fileno(out), STDERR_FILENO);
    print();
    fflush(stderr);
    dup2(keep, STDERR_FILENO);
    close(keep);
    fclose(out);
    return file_read(arena, path, NULL, NULL);
}

static void print_each(void) {
    console_print(CONSOLE_DEBUG, "debug %d\n", 1);
    console_print(CONSOLE_STATISTIC, "statistic %s\n", "two");
    warn("three");
}

static void streams(void **state) {
    (void)state;
    Arena *arena = arena_create();
    assert_non_null(mkdtemp(folder));
    const char *all = arena_printf(arena, "%s/all.txt", folder),
               *own = arena_printf(arena, "%s/own.txt", folder);
    FILE *out = fopen(own, "w");
    assert_true(out && fputs("before\n", out) >= 0 && fclose(out) == 0);
    diag_program("test");
    assert_string_equal(shown(arena, print_each), "debug 1\nstatistic two\ntest: warning: three\n");

    for (int i = 0; i < CONSOLE_COUNT; i++)
        console_copy((Console)i, all, false);
    console_copy(CONSOLE_DEBUG, own, true);
    console_copy(CONSOLE_DEBUG, own, true); // again: still one copy
    console_show(CONSOLE_DEBUG, false);
    console_show(CONSOLE_WARNING, false);
    assert_string_equal(shown(arena, print_each), "statistic two\n");
    assert_string_equal(file_read(arena, own, NULL, NULL), "before\ndebug 1\n");
    assert_string_equal(file_read(arena, all, NULL, NULL),
                        "debug 1\nstatistic two\ntest: warning: three\n");
    unlink(all);
    unlink(own);
    unlink(arena_printf(arena, "%s/stderr.txt", folder));
    rmdir(folder);
    arena_destroy(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(streams)};
    return cmocka_run_group_tests_name("console", tests, NULL, NULL);
}
