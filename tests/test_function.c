// SPDX-License-Identifier: MIT
// The machine that runs user functions: the built-in functions against POV-Ray to the last digit,
// programs written by hand, programs made to do harm, and what the scene file keeps of them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/diag.h"
#include "base/rng.h"
#include "debug_output.h"
#include "function/function.h"
#include "model/scene.h"
#include "noise/noise.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const char folder[] = "build/test/function";

// ---- the built-in functions -----------------------------------------------------------------

static double pick(Rng *rng, const double *from, int count) {
    return from[rng_next(rng) % (uint64_t)count];
}

static double any_argument(Rng *rng) {
    static const double special[] = {0, 1, -1, 0.5, 2, 3, 45};
    return rng_next(rng) % 2 ? pick(rng, special, 7) : rng_range(rng, -2, 4);
}

// Sums of octaves: only as many as POV-Ray keeps weights for, and generators that exist.
static void tame_octaves(int number, Rng *rng, double *a) {
    static const double counts[] = {1, 2, 3, 4.5, 6};
    enum { HETERO_MF = 29, RIDGE = 58, RIDGED_MF = 59 };
    if (number == HETERO_MF || number == RIDGED_MF) {
        a[3] = 0.5; // H and lacunarity
        a[4] = 2.1;
        a[5] = number == RIDGED_MF ? 6 : pick(rng, counts, 5);
        a[7] = pick(rng, (const double[]){0, 1, 2, 0.5}, 4);
    }
    if (number == RIDGE)
        a[4] = pick(rng, counts, 5);
    if (number == HETERO_MF || number == RIDGE || number == RIDGED_MF)
        a[8] = (double)(rng_next(rng) % 4);
}

static void write_internal(FILE *out, int number, Rng *rng) {
    double a[FUNCTION_MAX_PARAMETERS];
    int count = function_internal_arguments(number);
    fprintf(out, "#declare F%d = function { internal(%d) }\n", number, number);
    for (int k = 0; k < 25; k++) {
        for (int i = 0; i < count; i++)
            a[i] = any_argument(rng);
        tame_octaves(number, rng, a);
        fprintf(out, "#debug concat(\"@%d.%d \", str(F%d(", number, k, number);
        for (int i = 0; i < count; i++)
            fprintf(out, "%s%.17g", i ? "," : "", a[i]);
        fputs("), 0, 17), \"\\n\")\n", out);
    }
}

static void internal_values(void **state) {
    (void)state;
    if (!debug_has_povray()) {
        puts("skipped: povray is not installed");
        skip();
    }
    char path[128];
    snprintf(path, sizeof path, "%s/internal.pov", folder);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    Rng rng = {5};
    fputs("#version 3.7; global_settings { assumed_gamma 1 }\n", out);
    for (int n = 0; n < FUNCTION_INTERNAL_COUNT; n++)
        write_internal(out, n, &rng);
    fputs("sphere { 0, 1 }\n", out);
    fclose(out);
    assert_debug_equal(path, true);
}

// ---- programs by hand -----------------------------------------------------------------------

#define STEP(name, ...) ((FunctionStep){.op = FUNCTION_##name, __VA_ARGS__})
#define PROGRAM(f, count, regs, ...)                                                               \
    (f) = function_default(FUNCTION_FORMULA);                                                      \
    (f).parameters = (count);                                                                      \
    (f).registers = (f).stack = (regs);                                                            \
    (f).steps = (FunctionStep[]){__VA_ARGS__};                                                     \
    (f).step_count = sizeof((FunctionStep[]){__VA_ARGS__}) / sizeof(FunctionStep)

// The sum of i * x for i from 1 to n.
#define SERIES                                                                                     \
    STEP(CONSTANT, .to = 2), STEP(CONSTANT, .to = 3, .value = 1), STEP(MOVE, .to = 4, .a = 1),     \
        STEP(WHILE, .a = 3, .b = 7), STEP(MULTIPLY, .to = 5, .a = 3, .b = 0),                      \
        STEP(ADD, .to = 2, .a = 2, .b = 5), STEP(NEXT, .a = 3, .b = 3), STEP(RETURN, .a = 2)

static Vec3 asked;

static void pigment_hook(const void *world, uint32_t pigment, Vec3 p,
                         double color[FUNCTION_WIDTH]) {
    (void)world;
    asked = p;
    for (int i = 0; i < FUNCTION_WIDTH; i++)
        color[i] = pigment + 0.5 * i;
}

static double pattern_hook(const void *world, uint32_t pigment, Vec3 p) {
    (void)world;
    return pigment + p.y;
}

static const FunctionHooks hooks = {pigment_hook, pattern_hook};

static void programs(void **state) {
    (void)state;
    Function f[5];
    const FunctionPool pool = {.functions = f, .noise_generator = 2, .hooks = &hooks};
    noise_prepare();
    PROGRAM(f[0], 2, 6, SERIES);
    assert_true(function_value(&pool, 0, (double[]){0.5, 4}) == 5.0);
    assert_true(function_value(&pool, 0, (double[]){0.5, 0}) == 0.0);
    // Calls the one before, twice, and adds what the pigment says.
    f[1] = function_default(FUNCTION_PIGMENT);
    f[1].pigment = 7;
    f[2] = function_default(FUNCTION_PATTERN);
    f[2].pigment = 3;
    PROGRAM(f[3], 3, 11, STEP(MOVE, .to = 3, .a = 0), STEP(MOVE, .to = 4, .a = 1),
            STEP(MOVE, .to = 5, .a = 2), STEP(CALL_VECTOR, .to = 6, .a = 1, .b = 3),
            STEP(CALL, .to = 3, .a = 2, .b = 3), STEP(ADD, .to = 3, .a = 3, .b = 8),
            STEP(RETURN, .a = 3));
    assert_true(function_value(&pool, 3, (double[]){1, 2, 3}) == 3 + 2 + 8.0);
    assert_true(asked.x == 1 && asked.y == 2 && asked.z == 3);
    // What runs for ever is stopped.
    assert_true(isnan(function_value(&pool, 0, (double[]){1, 1e18})));
    f[4] = function_default(FUNCTION_TRANSFORM);
    f[4].transform = transform_translate(vec3(1, 2, 3));
    double out[FUNCTION_WIDTH];
    uint64_t budget = 10;
    assert_int_equal(function_vector(&pool, 4, (double[]){1, 1, 1}, out, &budget), 3);
    assert_true(out[0] == 2 && out[1] == 3 && out[2] == 4);
}

// A NaN is larger than all, in comparisons and in select, as POV-Ray's flags have it.
static void not_a_number(void **state) {
    (void)state;
    Function f;
    const FunctionPool pool = {.functions = &f, .hooks = &hooks};
    static const struct {
        FunctionOp op;
        double want;
    } cases[] = {{FUNCTION_LESS, 0},      {FUNCTION_LESS_EQUAL, 0}, {FUNCTION_EQUAL, 0},
                 {FUNCTION_NOT_EQUAL, 1}, {FUNCTION_GREATER, 1},    {FUNCTION_GREATER_EQUAL, 1},
                 {FUNCTION_AND, 1},       {FUNCTION_MIN, 2},        {FUNCTION_MAX, NAN}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        PROGRAM(f, 2, 3, (FunctionStep){.op = cases[i].op, .to = 2, .a = 0, .b = 1},
                STEP(RETURN, .a = 2));
        double got = function_value(&pool, 0, (double[]){NAN, 2});
        assert_true(got == cases[i].want || (isnan(got) && isnan(cases[i].want)));
    }
}

// ---- the scene file -------------------------------------------------------------------------

// Sets up a scene of functions in its arena.
static Scene *scene_with(Arena *arena, const Function *functions, uint32_t count) {
    Scene *scene = ARENA_NEW(arena, Scene);
    *scene = (Scene){.settings = settings_default(), .camera = camera_default()};
    scene->pigments = ARENA_ARRAY(arena, Pigment, 1);
    scene->pigment_count = 1;
    MapEntry *entries = ARENA_ARRAY(arena, MapEntry, 1);
    entries->pigment = NO_INDEX;
    scene->pigments[0] =
        (Pigment){.pattern = pattern_default(), .entries = entries, .entry_count = 1};
    scene->pigments[0].pattern.type = PATTERN_BOZO;
    scene->functions = ARENA_ARRAY(arena, Function, count);
    memcpy(scene->functions, functions, count * sizeof *functions);
    scene->function_count = count;
    scene_collect_requires(scene, arena);
    return scene;
}

static void kept_bit_by_bit(void **state) {
    (void)state;
    Function f[5];
    PROGRAM(f[0], 2, 6, SERIES);
    f[1] = function_default(FUNCTION_PIGMENT);
    f[1].pigment = 0;
    f[2] = function_default(FUNCTION_PATTERN);
    f[2].pigment = 0;
    f[3] = function_default(FUNCTION_TRANSFORM);
    f[3].transform = transform_rotate(vec3(10, 20, 30));
    f[4] = function_default(FUNCTION_SPLINE);
    SplineKey keys[3] = {
        {.at = -1, .value = {0.1, 1}}, {.at = 0.3, .value = {1 / 3.0, 5}}, {.at = 2}};
    f[4].spline = (Spline){.kind = SPLINE_NATURAL, .width = 2, .keys = keys, .key_count = 3};
    double work[6];
    spline_prepare(&f[4].spline, work);
    Arena *arena = arena_create();
    Scene *scene = scene_with(arena, f, 5);
    char path[128];
    snprintf(path, sizeof path, "%s/kept.qi.json", folder);
    scene_write(scene, path, &(SceneWriteOptions){0});
    Scene *read = scene_read(path, arena);
    assert_int_equal(read->function_count, 5);
    for (int i = 0; i < 5; i++)
        assert_int_equal(read->functions[i].type, f[i].type);
    for (uint32_t i = 0; i < f[0].step_count; i++)
        assert_memory_equal(&read->functions[0].steps[i], &f[0].steps[i], sizeof *f->steps);
    assert_memory_equal(&read->functions[3].transform, &f[3].transform, sizeof(Transform));
    assert_memory_equal(read->functions[4].spline.keys, keys, sizeof keys);
    const FunctionPool before = {.functions = f, .hooks = &hooks};
    const FunctionPool after = {.functions = read->functions, .hooks = &hooks};
    for (double x = -2; x < 3; x += 0.1) {
        double a[FUNCTION_WIDTH], b[FUNCTION_WIDTH];
        uint64_t budget = 100;
        function_vector(&before, 4, &x, a, &budget);
        function_vector(&after, 4, &x, b, &budget);
        assert_memory_equal(a, b, 2 * sizeof *a);
        assert_true(function_value(&before, 0, (double[]){x, 5}) ==
                    function_value(&after, 0, (double[]){x, 5}));
    }
    arena_destroy(arena);
}

static void validate(void *arg) { scene_validate(arg, "x"); }

static void expect_refused(const Function *functions, uint32_t count, const char *fragment) {
    Arena *arena = arena_create();
    char *message = NULL;
    bool good = diag_catch(validate, scene_with(arena, functions, count), &message);
    if (good || !strstr(message, fragment))
        fail_msg("want '%s', got: %s", fragment, good ? "no refusal" : message);
    free(message);
    arena_destroy(arena);
}

// Each would read or write outside the registers, or never end, in a machine that trusted it.
static void hostile_programs(void **state) {
    (void)state;
    Function f[3];
    PROGRAM(f[0], 2, 6, SERIES);
#define REFUSED(fragment, regs, ...)                                                               \
    PROGRAM(f[1], 1, regs, __VA_ARGS__);                                                           \
    expect_refused(f, 2, fragment)
    REFUSED("functions[1].steps[0].a: 5, but the function has 2 registers", 2,
            STEP(RETURN, .a = 5));
    REFUSED("steps[0].a: -1, but", 2, STEP(RETURN, .a = -1));
    REFUSED("steps[0].to: 2, but", 2, STEP(CONSTANT, .to = 2), STEP(RETURN));
    REFUSED("steps[0].b: 9, but", 2, STEP(ADD, .to = 1, .b = 9), STEP(RETURN));
    REFUSED("register 1 is read before it is written", 2, STEP(RETURN, .a = 1));
    REFUSED("the last step is not 'return'", 2, STEP(CONSTANT, .to = 1));
    REFUSED("unknown operation 99", 2, (FunctionStep){.op = (FunctionOp)99}, STEP(RETURN));
    REFUSED("inf is not a finite number", 2, STEP(CONSTANT, .to = 1, .value = INFINITY),
            STEP(RETURN));
    REFUSED("registers: 2049 is not in the range 1 to 2048", 2049, STEP(RETURN));
    REFUSED("step 0 is not one of the later steps", 2, STEP(JUMP, .b = 0), STEP(RETURN));
    REFUSED("step 7 is not one of the later steps", 2, STEP(JUMP, .b = 7), STEP(RETURN));
    // Written on one of two ways only.
    REFUSED("steps[2].a: register 1 is read", 2, STEP(JUMP_NEGATIVE, .b = 2),
            STEP(CONSTANT, .to = 1), STEP(RETURN, .a = 1));
    // Into the middle of a loop, past its start.
    REFUSED("the loop begins with registers that are not written here", 4,
            STEP(JUMP_NEGATIVE, .b = 4), STEP(CONSTANT, .to = 1), STEP(CONSTANT, .to = 2),
            STEP(WHILE, .a = 0, .b = 5), STEP(NEXT, .a = 0, .b = 3), STEP(RETURN));
    REFUSED("step 0 is not the start of this loop", 2, STEP(MOVE, .to = 1), STEP(NEXT, .b = 0),
            STEP(RETURN));
    REFUSED("function 1 is not one of those before this one", 4, STEP(CALL, .to = 1, .a = 1),
            STEP(RETURN));
    REFUSED("function -1 is not", 4, STEP(CALL, .to = 1, .a = -1), STEP(RETURN));
    REFUSED("steps[0].b: register 1 is read", 4, STEP(CALL, .to = 1, .a = 0), STEP(RETURN));
    REFUSED("steps[0].b: 2147483647, but", 4, STEP(CALL, .to = 1, .a = 0, .b = INT32_MAX),
            STEP(RETURN));
    REFUSED("function 0 gives one number", 9, STEP(MOVE, .to = 1),
            STEP(CALL_VECTOR, .to = 2, .a = 0), STEP(RETURN));
    REFUSED("stack: 4 is not in the range 7 to 2048", 4, STEP(MOVE, .to = 1), STEP(MOVE, .to = 2),
            STEP(CALL, .to = 1, .a = 0, .b = 1), STEP(RETURN));
    REFUSED("internal(79) does not exist", 4, STEP(INTERNAL, .to = 1, .a = 79), STEP(RETURN));
    REFUSED("steps[0].b: register 1 is read", 4, STEP(INTERNAL, .to = 1, .a = 57), STEP(RETURN));
#undef REFUSED
    f[1] = function_default(FUNCTION_PIGMENT);
    f[1].pigment = 1;
    expect_refused(f, 2, "functions[1].pigment: 1, but there is 1 pigment");
    f[1] = function_default(FUNCTION_SPLINE);
    expect_refused(f, 2, "functions[1].spline.keys: it has no keys");
    SplineKey keys[2] = {{.at = 1}, {.at = 1}};
    f[1].spline = (Spline){.width = 2, .keys = keys, .key_count = 2};
    expect_refused(f, 2, "functions[1].spline.keys[1]: 1 is not after the key before");
}

// Two calls each, 200 deep and more: too deep, and what is allowed ends by its budget.
static void call_chains(void **state) {
    (void)state;
    enum { COUNT = FUNCTION_MAX_CALLS + 2 };
    static FunctionStep steps[COUNT][4];
    static Function f[COUNT];
    for (int i = 0; i < COUNT; i++) {
        f[i] = function_default(FUNCTION_FORMULA);
        f[i].parameters = 1;
        f[i].registers = 2;
        f[i].stack = 2 + i;
        f[i].steps = steps[i];
        f[i].step_count = i ? 4 : 1;
        steps[i][0] = i ? STEP(MOVE, .to = 1) : STEP(RETURN);
        steps[i][1] = steps[i][2] = STEP(CALL, .to = 1, .a = i - 1, .b = 1);
        steps[i][3] = STEP(RETURN, .a = 1);
    }
    expect_refused(f, COUNT, "functions[201].steps[1].a: more than 200 levels of calls");
    Arena *arena = arena_create();
    scene_validate(scene_with(arena, f, COUNT - 1), "x");
    const FunctionPool pool = {.functions = f, .hooks = &hooks};
    assert_true(isnan(function_value(&pool, COUNT - 2, (double[]){1})));
    assert_true(function_value(&pool, 10, (double[]){1}) == 1);
    arena_destroy(arena);
}

int main(void) {
    mkdir("build", 0777);
    mkdir("build/test", 0777);
    mkdir(folder, 0777);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(internal_values),  cmocka_unit_test(programs),
        cmocka_unit_test(not_a_number),     cmocka_unit_test(kept_bit_by_bit),
        cmocka_unit_test(hostile_programs), cmocka_unit_test(call_chains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
