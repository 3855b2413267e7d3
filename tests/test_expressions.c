// SPDX-License-Identifier: MIT
// Random expressions and user functions: what the converter computes is what POV-Ray prints, to 17
// digits. QIPOV_EXPRESSIONS: how many of each (make expressions), QIPOV_SEED: the first seed.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "debug_output.h"
#include "random_expression.h"

#include <stdio.h>
#include <sys/stat.h>

enum { USUAL = 1000, AT_ONCE = 2500 }; // a program each

static int setting(const char *name, int usual) {
    const char *text = getenv(name);
    return text ? atoi(text) : usual;
}

static void compare(void (*generate)(FILE *, Rng *, int), const char *path) {
    if (!debug_has_povray()) {
        puts("skipped: povray is not installed");
        skip();
    }
    uint64_t seed = (uint64_t)setting("QIPOV_SEED", 1);
    for (int left = setting("QIPOV_EXPRESSIONS", USUAL); left > 0; left -= AT_ONCE, seed++) {
        FILE *out = fopen(path, "w");
        assert_non_null(out);
        Rng rng = {seed};
        generate(out, &rng, left < AT_ONCE ? left : AT_ONCE);
        fclose(out);
        assert_debug_equal(path, true);
    }
}

static void expressions(void **state) {
    (void)state;
    compare(random_expressions, "build/test/expressions.pov");
}

static void functions(void **state) {
    (void)state;
    compare(random_functions, "build/test/functions.pov");
}

int main(void) {
    mkdir("build", 0777);
    mkdir("build/test", 0777);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(expressions),
        cmocka_unit_test(functions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
