// SPDX-License-Identifier: MIT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "digits.h"

#include "base/diag.h"
#include "base/rng.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct Digits {
    Arena *arena;
    FILE *script;
    char *text;
    size_t size, asked;
    int wrong;
};

Vec3 digits_point(int i) {
    Rng rng = {(uint64_t)i};
    rng_next(&rng);
    static const double scales[] = {1.0, 4.0, 30.0, 20000.0, 1e-3};
    double c[3];
    for (int k = 0; k < 3; k++) {
        double x = rng_range(&rng, -1.0, 1.0) * scales[i % 5];
        c[k] = i % 3 == 0 ? floor(x * 8.0) / 8.0 : i % 7 == 0 ? floor(x) : floor(x * 1e6) / 1e6;
    }
    return vec3(c[0], c[1], c[2]);
}

Digits *digits_create(const char *head) {
    Arena *arena = arena_create();
    Digits *d = ARENA_NEW(arena, Digits);
    d->arena = arena;
    d->script = open_memstream(&d->text, &d->size);
    if (d->script == NULL)
        die("out of memory");
    fprintf(d->script,
            "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n%s#fopen V \"values\" write\n",
            head);
    return d;
}

void digits_function(Digits *d, const char *function, const char *after) {
    fprintf(d->script, "#declare F = %s\n", function);
    for (int i = 0; i < DIGITS_POINTS; i++) {
        Vec3 p = digits_point(i);
        // 40 decimals hold every bit that can matter.
        fprintf(d->script, "#write(V, str(F(%.17g, %.17g, %.17g)%s, 1, 40), \"\\n\")\n", p.x, p.y,
                p.z, after);
    }
    fprintf(d->script, "#undef F\n");
    d->asked += DIGITS_POINTS;
}

const double *digits_run(Digits *d) {
    if (system("command -v povray >/dev/null 2>&1") != 0) {
        printf("skipped: no povray to compare with\n");
        skip();
    }
    fclose(d->script);
    char folder[] = "/tmp/qipov-test-XXXXXX";
    if (mkdtemp(folder) == NULL)
        die("cannot make a temporary folder");
    FILE *out = fopen(arena_printf(d->arena, "%s/scene.pov", folder), "w");
    if (out == NULL || fputs(d->text, out) < 0 || fclose(out) != 0)
        die("cannot write the script");
    int status = system(
        arena_printf(d->arena, "cd %s && povray +Iscene.pov +W1 +H1 -F -D >log.txt 2>&1", folder));
    if (status != 0 && system(arena_printf(d->arena, "cat %s/log.txt >&2", folder)) != 0)
        fprintf(stderr, "no log\n");
    double *values = ARENA_ARRAY(d->arena, double, d->asked);
    FILE *in = fopen(arena_printf(d->arena, "%s/values", folder), "r");
    size_t got = 0;
    while (in != NULL && got < d->asked && fscanf(in, "%lf", &values[got]) == 1)
        got++;
    if (in != NULL)
        fclose(in);
    if (system(arena_printf(d->arena, "rm -r %s", folder)) != 0)
        fprintf(stderr, "%s was left behind\n", folder);
    assert_int_equal(status, 0);
    assert_int_equal(got, d->asked);
    return values;
}

void digits_equal(Digits *d, double have, double want, const char *what, int i) {
    if (have != want && !(isnan(have) && isnan(want)) && d->wrong++ < 20) {
        Vec3 p = digits_point(i);
        fprintf(stderr, "%s at %g, %g, %g: %.17g, povray %.17g\n", what, p.x, p.y, p.z, have, want);
    }
}

void digits_finish(Digits *d) {
    int wrong = d->wrong;
    free(d->text);
    arena_destroy(d->arena);
    assert_int_equal(wrong, 0);
}
