// SPDX-License-Identifier: MIT
// A sample of the sheet of all standard textures (make sheet): one of each include and kind, by the
// script that does them all, with the program under the sanitizers. And that the script finds them
// all, and fails when a picture differs.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "pictures.h"
#include "reference.h"

#include <string.h>

static const char SAMPLE[] =
    "Blood_Marble P_Brass1 T_Gold_2C T_Wood12 T_Stone1 T_Stone30 Stone7 F_Glass5 T_Cloud2 "
    "Starfield3 Dull M_Water S_Cloud2";

static void sample(void **state) {
    (void)state;
    if (!reference_available())
        skip();
    const char *log;
    int status = run_command(&log,
                             "QIRENDER=$PWD/build/test/qirender SIZE='+W80 +H60' "
                             "tests/texture_sheet.sh %s",
                             SAMPLE);
    if (status != 0)
        fail_msg("%s", log);
    assert_non_null(strstr(log, "13 declarations, 0 of them over 0.1 %"));
}

// The grain of crand is drawn otherwise than in POV-Ray: only without it they agree.
static void crand_is_excused(void **state) {
    (void)state;
    if (!reference_available())
        skip();
    const char *log;
    int status = run_command(&log, "QIRENDER=$PWD/build/test/qirender SIZE='+W80 +H60' "
                                   "tests/texture_sheet.sh EMBWood1");
    assert_int_equal(status, 0);
    assert_non_null(strstr(log, "%, without crand 0 %"));
    assert_non_null(strstr(log, "1 declarations, 0 of them over 0.1 %"));
}

// A program that leaves out the lights.
static void a_difference_is_told(void **state) {
    (void)state;
    if (!reference_available())
        skip();
    const char *log;
    int status = run_command(&log,
                             "printf '#!/bin/sh\\nexec %%s/build/test/qirender \"$@\" +Q0\\n' "
                             "\"$PWD\" >%s/dark && chmod +x %s/dark && QIRENDER=%s/dark "
                             "SIZE='+W80 +H60' tests/texture_sheet.sh Dull",
                             scratch_folder(), scratch_folder(), scratch_folder());
    assert_int_equal(status, 1);
    assert_non_null(strstr(log, "1 declarations, 1 of them over 0.1 %"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sample),
        cmocka_unit_test(crand_is_excused),
        cmocka_unit_test(a_difference_is_told),
    };
    return cmocka_run_group_tests_name("texture_sheet", tests, NULL, NULL);
}
