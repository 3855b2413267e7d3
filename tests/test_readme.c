// SPDX-License-Identifier: MIT
// README is kept true: every command in it (a line indented by four blanks) is run, in order.
// `make` lines are only looked up, since this test runs inside one of them.
#include "pictures.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void every_command_works(void **state) {
    (void)state;
    FILE *in = fopen("README.md", "r");
    assert_non_null(in);
    char line[1024];
    int commands = 0, makes = 0;
    while (fgets(line, sizeof line, in)) {
        line[strcspn(line, "\n#")] = '\0';
        if (strncmp(line, "    ", 4) != 0 || line[4] == ' ' || line[4] == '\0')
            continue;
        const char *command = line + 4, *log;
        bool make = strncmp(command, "make ", 5) == 0;
        if (!make && strncmp(command, "build/", 6) != 0)
            continue;
        int status = run_command(&log, "%s%s", make ? "make -n " : "", command + (make ? 5 : 0));
        if (status != 0)
            fail_msg("README: '%s' ended with %d:\n%s", command, status, log);
        (*(make ? &makes : &commands))++;
    }
    fclose(in);
    assert_true(commands >= 6 && makes >= 2);
}

// Every picture that README shows is there.
static void every_picture_is_there(void **state) {
    (void)state;
    FILE *in = fopen("README.md", "r");
    assert_non_null(in);
    char line[2048];
    int pictures = 0;
    while (fgets(line, sizeof line, in)) {
        for (char *at = line; (at = strstr(at, "](scenes/")) != NULL; pictures++) {
            at += 2;
            char path[512];
            snprintf(path, sizeof path, "%.*s", (int)strcspn(at, ")"), at);
            FILE *picture = fopen(path, "rb");
            if (!picture)
                fail_msg("README shows '%s', which is not there", path);
            fclose(picture);
        }
    }
    fclose(in);
    assert_true(pictures >= 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_command_works),
        cmocka_unit_test(every_picture_is_there),
    };
    return cmocka_run_group_tests_name("readme", tests, NULL, NULL);
}
