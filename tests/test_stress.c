// SPDX-License-Identifier: MIT
// A share of `make stress` that takes seconds, under the sanitizers.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "stress.h"

// All cases, judged by the oracle. Times mean nothing under the sanitizers.
static void every_case_holds(void **state) {
    (void)state;
    StressOptions options = stress_options_default();
    options.seed = 2;
    options.rays = 15000;
    options.watertight = 50000;
    options.only_method = "qi";
    options.times = false;
    assert_int_equal(stress_run(&options), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_case_holds),
    };
    return cmocka_run_group_tests_name("stress", tests, NULL, NULL);
}
