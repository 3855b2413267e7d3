// SPDX-License-Identifier: MIT
// qibench: rays against patches, without pictures. `qibench trace` answers rays from a text file.
#include "base/diag.h"
#include "base/version.h"
#include "bench/trace.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "usage: qibench trace [options] FILE\n"
    "Rays against bicubic patches. FILE is text: `patches N`, then 16 lines `x y z` a patch;\n"
    "`rays M`, then M lines `ox oy oz dx dy dz`. One line a ray: `t u v patch bound` of the "
    "nearest\n"
    "hit (t in lengths of the direction, patches counted from 0), or `miss`. A hit within its "
    "bound\n"
    "of the ray's origin is the surface that the ray leaves, and is not reported.\n"
    "\n"
    "  --method name       qi (default), or another one of the list that a wrong name shows\n"
    "  --tolerance x       hits lie within x times the patch's diameter of the patch (1e-9)\n"
    "  --threads n         0 (default): as many as there are cores\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 done, 1 wrong input, 2 wrong usage.\n";

typedef struct {
    PatchSetOptions set;
    int threads;
    const char *file;
} Options;

static void complain(const char *format, const char *word) {
    fputs("qibench: error: ", stderr);
    fprintf(stderr, format, word);
    fputs(" (qibench --help)\n", stderr);
}

static bool apply_method(Options *o, const char *value) {
    if (patch_method_parse(value, &o->set.method))
        return true;
    char text[512];
    int at = snprintf(text, sizeof text, "there is no method '%.40s'; the methods are", value);
    for (int i = 0; i < METHOD_COUNT; i++)
        at +=
            snprintf(text + at, sizeof text - (size_t)at, " %s", patch_method_name((PatchMethod)i));
    complain("%s", text);
    return false;
}

static bool apply_tolerance(Options *o, const char *value) {
    char *stop;
    o->set.tolerance = strtod(value, &stop);
    if (stop != value && !*stop && o->set.tolerance >= 1e-15 && o->set.tolerance <= 1.0)
        return true;
    complain("the tolerance is a share of the patch's diameter, 1e-15 to 1, not '%s'", value);
    return false;
}

static bool apply_threads(Options *o, const char *value) {
    char *stop;
    long threads = strtol(value, &stop, 10);
    if (stop != value && !*stop && threads >= 0 && threads <= 512) {
        o->threads = (int)threads;
        return true;
    }
    complain("--threads takes a number from 0 to 512, not '%s'", value);
    return false;
}

// --word value or --word=value.
static bool apply_option(Options *o, const char *word, const char *value) {
    static const struct {
        const char *name;
        bool (*apply)(Options *o, const char *value);
    } rows[] = {
        {"--method", apply_method}, {"--tolerance", apply_tolerance}, {"--threads", apply_threads}};
    size_t length = strcspn(word, "=");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strlen(rows[i].name) != length || strncmp(word, rows[i].name, length) != 0)
            continue;
        if (!value) {
            complain("%s needs a value", word);
            return false;
        }
        return rows[i].apply(o, value);
    }
    complain("there is no option '%s'", word);
    return false;
}

static bool parse_trace(int argc, char **argv, Options *o) {
    for (int i = 0; i < argc; i++) {
        const char *word = argv[i], *equals = strchr(word, '=');
        if (strncmp(word, "--", 2) != 0) {
            if (o->file) {
                complain("one file at a time: what is '%s'?", word);
                return false;
            }
            o->file = word;
        } else if (equals) {
            if (!apply_option(o, word, equals + 1))
                return false;
        } else {
            if (!apply_option(o, word, i + 1 < argc ? argv[i + 1] : NULL))
                return false;
            i++;
        }
    }
    if (!o->file)
        complain("%s", "no file given");
    return o->file != NULL;
}

static void trace(const Options *o) {
    Arena *arena = arena_create();
    RayFile *file = ray_file_open(arena, o->file);
    int threads = o->threads > 0 ? o->threads : omp_get_num_procs();
    omp_set_num_threads(threads);
    PatchSet *set = patchset_create(&o->set);
    const Vec3 *points = ray_file_points(file);
    for (uint32_t i = 0; i < ray_file_patch_count(file); i++) {
        // u_steps and v_steps are POV-Ray's largest useful ones; only facets look at them.
        PatchDef def = {.degree_u = 3,
                        .degree_v = 3,
                        .points = points + (size_t)16 * i,
                        .id = i,
                        .mask = 1,
                        .u_steps = 5,
                        .v_steps = 5};
        patchset_add(set, &def);
    }
    patchset_commit(set);
    trace_rays(file, set, threads, stdout);
    patchset_destroy(set);
    ray_file_close(file);
    arena_destroy(arena);
}

int main(int argc, char **argv) {
    diag_program("qibench");
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            fputs(usage, stdout);
            return 0;
        }
        if (strcmp(argv[i], "--version") == 0) {
            puts("qibench " QIPOV_VERSION);
            return 0;
        }
    }
    Options o = {.set = patchset_options_default()};
    if (argc < 2 || strcmp(argv[1], "trace") != 0) {
        complain("%s", "the first word says what to do: trace");
        return 2;
    }
    if (!parse_trace(argc - 2, argv + 2, &o))
        return 2;
    trace(&o);
    return 0;
}
