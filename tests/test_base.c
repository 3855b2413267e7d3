// SPDX-License-Identifier: MIT
// The room below all others: memory, messages, whole files, affine maps.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/arena.h"
#include "base/array.h"
#include "base/color.h"
#include "base/diag.h"
#include "base/file.h"
#include "base/progress.h"
#include "base/rng.h"
#include "base/usage.h"
#include "base/vec.h"

#include <float.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/qipov-base-XXXXXX";

static int set_up(void **state) {
    (void)state;
    diag_program("test");
    return mkdtemp(folder) ? 0 : 1;
}

// Fails if a test left a file behind.
static int tear_down(void **state) {
    (void)state;
    return rmdir(folder);
}

static char *path_of(Arena *arena, const char *name) {
    return arena_printf(arena, "%s/%s", folder, name);
}

// ---- arena, array ---------------------------------------------------------------------------

static void test_arena_pieces(void **state) {
    (void)state;
    Arena *arena = arena_create();
    static const size_t SIZES[] = {0, 1, 63, 64, 65, 5000, 1 << 16, 1 << 20, 3};
    unsigned char *pieces[200];
    for (int i = 0; i < 200; i++) {
        size_t size = SIZES[i % 9];
        pieces[i] = arena_alloc(arena, size);
        assert_int_equal((uintptr_t)pieces[i] % 64, 0);
        for (size_t j = 0; j < size; j++)
            assert_int_equal(pieces[i][j], 0);
        memset(pieces[i], i, size);
    }
    for (int i = 0; i < 200; i++) // nobody else wrote there
        for (size_t j = 0; j < SIZES[i % 9]; j++)
            assert_int_equal(pieces[i][j], (unsigned char)i);
    assert_true(arena_bytes(arena) >= 22 * ((1 << 20) + (1 << 16)));
    arena_destroy(arena);
}

static void test_arena_text(void **state) {
    (void)state;
    Arena *arena = arena_create();
    assert_string_equal(arena_strdup(arena, "teapot"), "teapot");
    assert_string_equal(arena_printf(arena, "%s-%03d", "spout", 7), "spout-007");
    assert_memory_equal(arena_copy(arena, "lid", 4), "lid", 4);
    assert_string_equal(arena_printf(arena, "%s", ""), "");
    arena_destroy(arena);
}

static void alloc_too_much(void *arena) { arena_alloc(arena, SIZE_MAX - 10); }
static void array_too_much(void *arena) { arena_array(arena, SIZE_MAX / 4, 8); }

static void test_arena_overflow(void **state) {
    (void)state;
    Arena *arena = arena_create();
    char *message;
    assert_false(diag_catch(alloc_too_much, arena, &message));
    assert_non_null(strstr(message, "test: error: out of memory"));
    free(message);
    assert_false(diag_catch(array_too_much, arena, &message));
    assert_non_null(strstr(message, "elements of 8 bytes wanted"));
    free(message);
    arena_destroy(arena);
}

static void test_array(void **state) {
    (void)state;
    ARRAY(uint64_t) numbers = {0};
    for (uint64_t i = 0; i < 5000; i++) {
        array_push(&numbers, i * i);
        assert_true(numbers.capacity >= numbers.count);
    }
    assert_int_equal(numbers.count, 5000);
    for (uint64_t i = 0; i < 5000; i++)
        assert_int_equal(numbers.items[i], i * i);
    array_free(&numbers);
    assert_null(numbers.items);
    assert_int_equal(numbers.count + numbers.capacity, 0);
}

// ---- diag -----------------------------------------------------------------------------------

static const char SOURCE[] = "sphere {\n\t0, rad\n}\n";

static void die_in_include(void *arg) {
    (void)arg;
    const Loc top = {.file = "main.pov", .line = 3, .column = 1, .what = "included"};
    const Loc loc = {"part.inc", SOURCE, 2, 5, &top, "included"};
    die_at(&loc, "undeclared identifier '%s'", "rad");
}

static void test_die_shows_place(void **state) {
    (void)state;
    char *message;
    assert_false(diag_catch(die_in_include, NULL, &message));
    assert_string_equal(message, "part.inc:2:5: error: undeclared identifier 'rad'\n"
                                 "   0, rad\n"
                                 "      ^\n"
                                 "main.pov:3:1: note: included here");
    free(message);
}

// Lines end in \n, \r\n or \r; control characters never reach the terminal.
static void die_on_third_line(void *arg) {
    const Loc loc = {.file = "x", .text = arg, .line = 3, .column = 2};
    die_at(&loc, "here");
}

static void test_line_ends(void **state) {
    (void)state;
    static const char *const TEXTS[] = {"a\nb\nc\33d\n", "a\r\nb\r\nc\33d\r\n", "a\rb\rc\33d\r"};
    for (int i = 0; i < 3; i++) {
        char *message;
        assert_false(diag_catch(die_on_third_line, (void *)(uintptr_t)TEXTS[i], &message));
        assert_string_equal(message, "x:3:2: error: here\n  c?d\n   ^");
        free(message);
    }
}

typedef struct {
    int steps;
    char *inner;
} Nested;

static void die_twice(void *arg) {
    Nested *nested = arg;
    nested->steps = 1;
    assert_false(diag_catch(die_in_include, NULL, &nested->inner));
    nested->steps = 2;
    diag_rethrow(nested->inner);
}

static void live(void *arg) { ((Nested *)arg)->steps = 3; }

static void test_catch_nests(void **state) {
    (void)state;
    Nested nested = {0};
    char *message = NULL;
    assert_false(diag_catch(die_twice, &nested, &message));
    assert_int_equal(nested.steps, 2);
    assert_ptr_equal(message, nested.inner);
    free(message);
    message = NULL;
    assert_true(diag_catch(live, &nested, &message));
    assert_int_equal(nested.steps, 3);
    assert_null(message);
}

static void warn_once(void *arg) {
    (void)arg;
    warn("the %s is missing", "lid");
}

static void test_warnings(void **state) {
    (void)state;
    size_t before = diag_warning_count();
    char *message = NULL;
    diag_quiet(true);
    assert_true(diag_catch(warn_once, NULL, &message));
    assert_int_equal(diag_warning_count(), before + 1);
    diag_strict(true);
    assert_false(diag_catch(warn_once, NULL, &message));
    assert_string_equal(message, "test: error: the lid is missing");
    free(message);
    diag_strict(false);
    diag_quiet(false);
}

// ---- file -----------------------------------------------------------------------------------

static void test_file_read(void **state) {
    (void)state;
    Arena *arena = arena_create();
    const char *why;
    size_t size;
    assert_null(file_read(arena, "/nowhere/at/all", &size, &why));
    assert_string_equal(why, "No such file or directory");
    assert_null(file_read(arena, "/tmp", NULL, &why));
    assert_string_equal(why, "is a directory");
    assert_false(file_exists("/tmp"));

    // A file that does not know its size.
    char *status = file_read(arena, "/proc/self/status", &size, &why);
    assert_non_null(status);
    assert_int_equal(strlen(status), size);
    assert_non_null(strstr(status, "Pid:"));
    arena_destroy(arena);
}

static void test_file_commit(void **state) {
    (void)state;
    Arena *arena = arena_create();
    char *path = path_of(arena, "picture.png");
    size_t size;
    for (int round = 0; round < 2; round++) { // new, and over the old one
        OutputFile *out = file_begin(path);
        const char *dot = strrchr(file_temporary_path(out), '.');
        assert_string_equal(dot, ".png"); // libraries go by the extension
        fprintf(file_stream(out), "round %d", round);
        if (round == 0)
            assert_false(file_exists(path));
        file_commit(out);
        char *text = file_read(arena, path, &size, NULL);
        assert_string_equal(text, round ? "round 1" : "round 0");
        assert_int_equal(size, 7);
    }
    OutputFile *out = file_begin(path);
    char *temporary = arena_strdup(arena, file_temporary_path(out));
    assert_true(file_exists(temporary));
    file_abandon(out);
    assert_false(file_exists(temporary));
    assert_string_equal(file_read(arena, path, NULL, NULL), "round 1");
    assert_int_equal(unlink(path), 0);
    arena_destroy(arena);
}

static void begin(void *path) { file_abandon(file_begin(path)); }

static void test_file_unwritable(void **state) {
    (void)state;
    char *message;
    assert_false(diag_catch(begin, (void *)(uintptr_t) "/nowhere/x.png", &message));
    assert_string_equal(message,
                        "test: error: cannot write '/nowhere/x.png': No such file or directory");
    free(message);
    assert_false(diag_catch(begin, folder, &message));
    assert_non_null(strstr(message, "': is a directory"));
    free(message);
}

static void write_too_much(void *path) {
    OutputFile *out = file_begin(path);
    for (int i = 0; i < 100000; i++)
        fputc('x', file_stream(out));
    file_commit(out);
}

// What a child process does: it ends in one of three ways while its output is unfinished.
static int end_badly(const char *path, const char *way) {
    diag_program("test");
    if (strcmp(way, "full") == 0) { // the disk is full: writes stop at 1000 bytes
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){1000, 1000});
        char *message = NULL;
        bool good = diag_catch(write_too_much, (void *)(uintptr_t)path, &message);
        _exit(good || !strstr(message, "cannot write") ? 1 : 0);
    }
    OutputFile *out = file_begin(path);
    fputs("half a picture", file_stream(out));
    fflush(file_stream(out));
    if (strcmp(way, "signal") == 0)
        raise(SIGTERM);
    return 0;
}

// The exit status of this program started anew: after a fork alone, libraries wait at their exit
// for threads that the child does not have.
static int end_child(const char *path, const char *way) {
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        execl("/proc/self/exe", "test_base", path, way, (char *)NULL);
        _exit(127);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void test_nothing_half_done_stays(void **state) {
    (void)state;
    Arena *arena = arena_create();
    char *path = path_of(arena, "half.png");
    assert_int_equal(end_child(path, "full"), 0);
    assert_int_equal(end_child(path, "signal"), 2);
    assert_int_equal(end_child(path, "exit"), 0);
    assert_false(file_exists(path));
    arena_destroy(arena);
    // tear_down sees whether the folder is empty
}

// ---- vectors and maps -----------------------------------------------------------------------

static Vec3 random_vec(Rng *rng) {
    double x = rng_range(rng, -5, 5), y = rng_range(rng, -5, 5);
    return vec3(x, y, rng_range(rng, -5, 5));
}

static void assert_close(Vec3 a, Vec3 b, double tolerance) {
    if (!(vec_length(vec_sub(a, b)) <= tolerance))
        fail_msg("<%.17g, %.17g, %.17g> is not <%.17g, %.17g, %.17g>", a.x, a.y, a.z, b.x, b.y,
                 b.z);
}

// Each map below has numbers of size up to 10^3; a product of two sums 4 terms, so that an image
// of a point of size 10 is off by a few roundings of 10^7.
static const double TOLERANCE = 1e7 * 64 * DBL_EPSILON;

static Transform random_map(Rng *rng) {
    Vec3 v = random_vec(rng);
    switch (rng_next(rng) % 4) {
    case 0:
        return transform_translate(v);
    case 1:
        return transform_rotate(vec_scale(v, 100));
    case 2:
        return transform_scale(vec3(v.x + 6, v.y - 6, v.z + 6)); // 1..11, and mirrored in y
    default:
        break;
    }
    Transform t;
    const double rows[4][3] = {{2, v.x / 5, 0}, {0, 3, v.y / 5}, {v.z / 5, 0, 2}, {1, v.x, v.y}};
    assert_true(transform_matrix(rows, &t)); // determinant at least 12 - 1
    return t;
}

static void test_maps(void **state) {
    (void)state;
    Rng rng = {2};
    for (int i = 0; i < 3000; i++) {
        Transform a = random_map(&rng), b = random_map(&rng), both = transform_compose(&a, &b);
        Vec3 p = random_vec(&rng), d = random_vec(&rng);
        assert_close(transform_point(&both, p), transform_point(&b, transform_point(&a, p)),
                     TOLERANCE);
        assert_close(transform_inv_point(&both, transform_point(&both, p)), p, TOLERANCE);
        assert_close(transform_inv_dir(&both, transform_dir(&both, d)), d, TOLERANCE);
        assert_close(transform_dir(&both, d),
                     vec_sub(transform_point(&both, vec_add(p, d)), transform_point(&both, p)),
                     TOLERANCE);
        Transform back = transform_inverse(&both);
        assert_close(transform_point(&back, transform_point(&both, p)), p, TOLERANCE);

        // A normal stays at right angles to the surface's directions.
        Vec3 n = random_vec(&rng), along = vec_cross(n, d);
        assert_true(fabs(vec_dot(transform_normal(&both, n), transform_dir(&both, along))) <=
                    TOLERANCE);
    }
}

static void test_special_maps(void **state) {
    (void)state;
    Transform t = transform_identity();
    assert_true(transform_is_identity(&t));
    t = transform_translate(vec3(1, 2, 3));
    assert_false(transform_is_identity(&t));
    assert_close(transform_point(&t, vec3(1, 1, 1)), vec3(2, 3, 4), 0);
    assert_close(transform_dir(&t, vec3(1, 1, 1)), vec3(1, 1, 1), 0);
    t = transform_scale(vec3(2, 4, -8));
    assert_close(transform_inv_point(&t, vec3(2, 4, 8)), vec3(1, 1, -1), 0);

    // Left-handed, x before y before z: y goes to z, z to x, and so on.
    t = transform_rotate(vec3(90, 0, 0));
    assert_close(transform_point(&t, vec3(0, 1, 0)), vec3(0, 0, 1), DBL_EPSILON);
    t = transform_rotate(vec3(0, 90, 0));
    assert_close(transform_point(&t, vec3(0, 0, 1)), vec3(1, 0, 0), DBL_EPSILON);
    t = transform_rotate(vec3(0, 0, 90));
    assert_close(transform_point(&t, vec3(1, 0, 0)), vec3(0, 1, 0), DBL_EPSILON);
    t = transform_rotate(vec3(90, 90, 0));
    assert_close(transform_point(&t, vec3(0, 1, 0)), vec3(1, 0, 0), DBL_EPSILON);

    Transform untouched = t;
    const double flat[4][3] = {{1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    const double bad[4][3] = {{(double)NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    const double tiny[4][3] = {{1e-110, 0, 0}, {0, 1e-110, 0}, {0, 0, 1e-110}, {0, 0, 0}};
    assert_false(transform_matrix(flat, &t));
    assert_false(transform_matrix(bad, &t));
    assert_false(transform_matrix(tiny, &t)); // its determinant is no double
    assert_memory_equal(&t, &untouched, sizeof t);
}

// The numbers that POV-Ray itself computes, to its last printed digit.
static void test_rotation_is_povs(void **state) {
    (void)state;
    Arena *arena = arena_create();
    char *path = path_of(arena, "rotate.pov");
    FILE *scene = fopen(path, "w");
    assert_non_null(scene);
    fputs("#version 3.7; global_settings { assumed_gamma 1 }\n", scene);
    enum { CASES = 20 };
    Vec3 points[CASES], angles[CASES];
    Rng rng = {5};
    for (int i = 0; i < CASES; i++) {
        points[i] = random_vec(&rng);
        angles[i] = vec_scale(random_vec(&rng), 100);
        fprintf(scene,
                "#debug concat(\"got \", vstr(3, vrotate(<%.17g, %.17g, %.17g>,"
                " <%.17g, %.17g, %.17g>), \" \", 0, 15), \"\\n\")\n",
                points[i].x, points[i].y, points[i].z, angles[i].x, angles[i].y, angles[i].z);
    }
    fclose(scene);
    char *command = arena_printf(arena, "povray +I%s +W1 +H1 -D -F 2>&1", path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    char line[512];
    int found = 0;
    while (fgets(line, sizeof line, pipe)) {
        Vec3 theirs;
        if (sscanf(line, "got %lf %lf %lf", &theirs.x, &theirs.y, &theirs.z) != 3)
            continue;
        assert_true(found < CASES);
        Transform t = transform_rotate(angles[found]);
        // 15 decimals were printed.
        assert_close(transform_point(&t, points[found]), theirs, 2e-15);
        found++;
    }
    assert_int_equal(pclose(pipe), 0);
    assert_int_equal(found, CASES);
    unlink(path);
    arena_destroy(arena);
}

static void test_boxes(void **state) {
    (void)state;
    Box box = box_empty();
    assert_true(box.low.x > box.high.x);
    box = box_extend(box_extend(box, vec3(1, 5, -2)), vec3(3, 4, 0));
    assert_close(box.low, vec3(1, 4, -2), 0);
    assert_close(box.high, vec3(3, 5, 0), 0);
    box = box_union(box, box_empty());
    assert_close(box.low, vec3(1, 4, -2), 0);
    for (int axis = 0; axis < 3; axis++)
        assert_true(vec_get(vec3(0, 1, 2), axis) == axis);
    assert_false(vec_is_finite(vec3(0, (double)INFINITY, 0)));
    assert_false(vec_is_finite(vec_normalize(vec3(0, 0, 0))));
    assert_true(fabs(rgb_grey(rgb(1, 1, 1)) - 1) <= FLT_EPSILON);
}

static void test_progress(void **state) {
    (void)state;
    Progress progress = progress_begin("counting", 1000, false);
#pragma omp parallel for
    for (int i = 0; i < 1000; i++)
        progress_add(&progress, 1);
    assert_int_equal(progress.done, 1000);
    progress_end(&progress);
}

// Work moves all three clocks; those of the wall and of the process by no less than the thread's.
static void test_usage(void **state) {
    (void)state;
    double wall = usage_clock(), process = usage_process(), thread = usage_thread();
    while (usage_thread() - thread < 0.01)
        ;
    thread = usage_thread() - thread;
    process = usage_process() - process;
    wall = usage_clock() - wall;
    assert_true(process >= 0.01 && wall >= 0.01);
    assert_true(thread < process + 0.001 && thread < wall + 0.001);
    double megabytes = usage_peak_megabytes();
    assert_true(megabytes > 1 && megabytes < 1e6);
}

int main(int argc, char **argv) {
    if (argc == 3)
        return end_badly(argv[1], argv[2]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arena_pieces),
        cmocka_unit_test(test_arena_text),
        cmocka_unit_test(test_arena_overflow),
        cmocka_unit_test(test_array),
        cmocka_unit_test(test_die_shows_place),
        cmocka_unit_test(test_line_ends),
        cmocka_unit_test(test_catch_nests),
        cmocka_unit_test(test_warnings),
        cmocka_unit_test(test_file_read),
        cmocka_unit_test(test_file_commit),
        cmocka_unit_test(test_file_unwritable),
        cmocka_unit_test(test_nothing_half_done_stays),
        cmocka_unit_test(test_maps),
        cmocka_unit_test(test_special_maps),
        cmocka_unit_test(test_rotation_is_povs),
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_progress),
        cmocka_unit_test(test_usage),
    };
    return cmocka_run_group_tests_name("base", tests, set_up, tear_down);
}
