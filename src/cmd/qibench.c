// SPDX-License-Identifier: MIT
// qibench: `trace` answers rays from a text file, `speed` measures rays against patches, `sweep`
// measures what accuracy costs in whole scenes.
#include "base/diag.h"
#include "base/version.h"
#include "bench/speed.h"
#include "bench/sweep_report.h"
#include "bench/trace.h"

#include <errno.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char usage[] =
    "usage: qibench trace [options] FILE\n"
    "       qibench speed [options] methods | picture | lattices | threads ...\n"
    "       qibench sweep [options] scene.pov ...\n"
    "\n"
    "trace: rays against bicubic patches. FILE is text: `patches N`, then 16 lines `x y z` a "
    "patch;\n"
    "`rays M`, then M lines `ox oy oz dx dy dz`. One line a ray: `t u v patch bound` of the\n"
    "nearest hit (t in lengths of the direction, patches counted from 0), or `miss`. A hit within "
    "its\n"
    "bound of the ray's origin is the surface that the ray leaves, and is not reported.\n"
    "speed: measures rays against the teapot of POV-Ray's examples, in turn with Embree's "
    "triangles\n"
    "where Embree is installed, and prints tables in Markdown.\n"
    "\n"
    "sweep: renders each scene by every method at several tolerances, with POV-Ray's triangles "
    "cut\n"
    "more and more, and by POV-Ray itself, and prints what each costs and how far it is from the\n"
    "truth, which is qi at 1e-14.\n"
    "\n"
    "  --method name       qi (default), or another one of the list that a wrong name shows\n"
    "  --tolerance x       hits lie within x times the patch's diameter of the patch (1e-9)\n"
    "  --isa name          scalar, avx2 or avx512 for qi: the best there is, unless given\n"
    "  --prepare how       sub-patches for qi: full (default), light (few), none (the paper's)\n"
    "  --threads n         0 (default): as many as there are cores\n"
    "  --rounds n          speed: the median of n rounds, odd (5)\n"
    "  --size WxH          sweep: of the pictures (320x240)\n"
    "  --include folder    sweep: where includes are looked for; may be repeated\n"
    "  --html folder       sweep: also writes index.html, sweep.csv and sweep.json there\n"
    "  --patience s        sweep: gives a point up after so many seconds (60)\n"
    "  --povray on|off     sweep: run POV-Ray too (on)\n"
    "  --share x           speed methods: this share of the rays (1)\n"
    "  --view name         speed methods: full, zoom or scattered alone\n"
    "  --patches n         speed lattices: up to n patches (1000000)\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 done, 1 wrong input, 2 wrong usage.\n";

// ORDER command
typedef enum { COMMAND_TRACE, COMMAND_SPEED, COMMAND_SWEEP, COMMAND_COUNT } Command;
static const char *const commands[COMMAND_COUNT] = {"trace", "speed", "sweep"};
enum { MAX_WORDS = 64 };

typedef struct {
    Command command;
    PatchSetOptions set;
    SpeedOptions speed;
    int threads, word_count;
    const char *words[MAX_WORDS];
    SweepOptions sweep;
    const char *libraries[MAX_WORDS];
    const char *html; // sweep: a folder; NULL: none
} Options;

static void complain(const char *format, const char *word) {
    fputs("qibench: error: ", stderr);
    fprintf(stderr, format, word);
    fputs(" (qibench --help)\n", stderr);
}

static bool apply_method(Options *o, const char *value) {
    if (patch_method_parse(value, &o->set.method)) {
        o->speed.method = (int)o->set.method;
        return true;
    }
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
    o->set.tolerance = o->speed.tolerance = strtod(value, &stop);
    if (stop != value && !*stop && o->set.tolerance >= 1e-15 && o->set.tolerance <= 1.0)
        return true;
    complain("the tolerance is a share of the patch's diameter, 1e-15 to 1, not '%s'", value);
    return false;
}

static bool apply_prepare(Options *o, const char *value) {
    if (!patch_prepare_parse(value, &o->set.prepare)) {
        complain("the ways to prepare are full, light and none, not '%s'", value);
        return false;
    }
    o->speed.prepare = (int)o->set.prepare;
    return true;
}

static bool whole_number(const char *value, long least, long most, long *number) {
    char *stop;
    *number = strtol(value, &stop, 10);
    return stop != value && !*stop && *number >= least && *number <= most;
}

static bool apply_threads(Options *o, const char *value) {
    long threads;
    if (!whole_number(value, 0, 512, &threads)) {
        complain("--threads takes a number from 0 to 512, not '%s'", value);
        return false;
    }
    o->threads = (int)threads;
    return true;
}

static bool apply_rounds(Options *o, const char *value) {
    long rounds;
    if (!whole_number(value, 1, 21, &rounds) || rounds % 2 == 0) {
        complain("--rounds takes an odd number up to 21, not '%s'", value);
        return false;
    }
    o->speed.rounds = o->sweep.rounds = (int)rounds;
    return true;
}

static bool apply_share(Options *o, const char *value) {
    char *stop;
    o->speed.share = strtod(value, &stop);
    if (stop != value && !*stop && o->speed.share >= 1e-4 && o->speed.share <= 1.0)
        return true;
    complain("--share takes a number from 1e-4 to 1, not '%s'", value);
    return false;
}

static bool apply_view(Options *o, const char *value) {
    for (int view = 0; view < VIEW_COUNT; view++) {
        if (strcmp(value, view_name((View)view)) == 0) {
            o->speed.view = view;
            return true;
        }
    }
    complain("the views are full, zoom and scattered, not '%s'", value);
    return false;
}

static bool apply_patches(Options *o, const char *value) {
    long patches;
    if (!whole_number(value, 32, 100000000, &patches)) {
        complain("--patches takes a number from 32 on, not '%s'", value);
        return false;
    }
    o->speed.max_patches = (size_t)patches;
    return true;
}

static bool apply_isa(Options *o, const char *value) {
    (void)o;
    if (patch_isa_choose(value) == PATCH_ISA_CHOSEN)
        return true;
    complain("--isa takes scalar, avx2 or avx512, one that this machine has, not '%s'", value);
    return false;
}

static bool apply_size(Options *o, const char *value) {
    char rest;
    if (sscanf(value, "%dx%d%c", &o->sweep.width, &o->sweep.height, &rest) == 2 &&
        o->sweep.width >= 8 && o->sweep.height >= 8 && o->sweep.width <= 8192 &&
        o->sweep.height <= 8192)
        return true;
    complain("--size takes a width and a height, 8x8 to 8192x8192, not '%s'", value);
    return false;
}

static bool apply_include(Options *o, const char *value) {
    if (o->sweep.library_path_count == MAX_WORDS) {
        complain("too many folders: '%s'", value);
        return false;
    }
    o->libraries[o->sweep.library_path_count++] = value;
    return true;
}

static bool apply_html(Options *o, const char *value) {
    o->html = value;
    return true;
}

static bool apply_patience(Options *o, const char *value) {
    char *stop;
    o->sweep.patience = strtod(value, &stop);
    if (stop != value && !*stop && o->sweep.patience >= 1.0 && o->sweep.patience <= 1e6)
        return true;
    complain("--patience takes seconds from 1 on, not '%s'", value);
    return false;
}

static bool apply_povray(Options *o, const char *value) {
    o->sweep.povray = strcmp(value, "on") == 0;
    if (o->sweep.povray || strcmp(value, "off") == 0)
        return true;
    complain("--povray takes on or off, not '%s'", value);
    return false;
}

// --word value or --word=value.
static bool apply_option(Options *o, const char *word, const char *value) {
    static const struct {
        const char *name;
        unsigned commands; // 1 << Command
        bool (*apply)(Options *o, const char *value);
    } rows[] = {{"--method", 3, apply_method},     {"--tolerance", 3, apply_tolerance},
                {"--isa", 7, apply_isa},           {"--prepare", 3, apply_prepare},
                {"--threads", 1, apply_threads},   {"--rounds", 6, apply_rounds},
                {"--share", 2, apply_share},       {"--view", 2, apply_view},
                {"--patches", 2, apply_patches},   {"--size", 4, apply_size},
                {"--include", 4, apply_include},   {"--html", 4, apply_html},
                {"--patience", 4, apply_patience}, {"--povray", 4, apply_povray}};
    size_t length = strcspn(word, "=");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strlen(rows[i].name) != length || strncmp(word, rows[i].name, length) != 0)
            continue;
        if (!(rows[i].commands & (1u << o->command)))
            break;
        if (!value) {
            complain("%s needs a value", word);
            return false;
        }
        return rows[i].apply(o, value);
    }
    complain("there is no option '%s' here", word);
    return false;
}

static bool parse(int argc, char **argv, Options *o) {
    for (int i = 0; i < argc; i++) {
        const char *word = argv[i], *equals = strchr(word, '=');
        if (strncmp(word, "--", 2) != 0) {
            if (o->word_count == (o->command == COMMAND_TRACE ? 1 : MAX_WORDS)) {
                complain("what is '%s'?", word);
                return false;
            }
            o->words[o->word_count++] = word;
        } else if (equals) {
            if (!apply_option(o, word, equals + 1))
                return false;
        } else {
            if (!apply_option(o, word, i + 1 < argc ? argv[i + 1] : NULL))
                return false;
            i++;
        }
    }
    return true;
}

static int trace(const Options *o) {
    if (o->word_count == 0) {
        complain("%s", "no file given");
        return 2;
    }
    Arena *arena = arena_create();
    RayFile *file = ray_file_open(arena, o->words[0]);
    int threads = o->threads > 0 ? o->threads : omp_get_num_procs();
    omp_set_num_threads(threads);
    PatchSet *set = set_of_points(ray_file_points(file), ray_file_patch_count(file), &o->set);
    patchset_commit(set);
    trace_rays(file, set, threads, stdout);
    patchset_destroy(set);
    ray_file_close(file);
    arena_destroy(arena);
    return 0;
}

static int speed(const Options *o) {
    static const struct {
        const char *name;
        void (*run)(const SpeedOptions *options);
    } tables[] = {{"methods", speed_methods},
                  {"picture", speed_picture},
                  {"lattices", speed_lattices},
                  {"threads", speed_threads}};
    enum { TABLES = sizeof tables / sizeof tables[0] };
    for (int i = 0; i < o->word_count; i++) {
        int k = 0;
        while (k < TABLES && strcmp(o->words[i], tables[k].name) != 0)
            k++;
        if (k == TABLES) {
            complain("the tables are methods, picture, lattices and threads, not '%s'",
                     o->words[i]);
            return 2;
        }
    }
    bool any = false;
    for (int k = 0; k < TABLES; k++) {
        bool wanted = o->word_count == 0;
        for (int i = 0; i < o->word_count; i++)
            wanted |= strcmp(o->words[i], tables[k].name) == 0;
        if (!wanted)
            continue;
        if (any)
            printf("\n");
        any = true;
        tables[k].run(&o->speed);
        fflush(stdout);
    }
    return 0;
}

static void make_folder(const char *path) {
    struct stat st;
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        die("cannot make the folder '%s': %s", path, strerror(errno));
    if (stat(path, &st) != 0 || !S_ISDIR(st.st_mode))
        die("'%s' is not a folder", path);
}

static int sweep(Options *o, int argc, char **argv) {
    if (o->word_count == 0) {
        complain("%s", "no scene given");
        return 2;
    }
    Arena *arena = arena_create();
    const Sweep *sweeps[MAX_WORDS];
    if (o->html)
        make_folder(o->html); // before the work
    o->sweep.library_paths = o->libraries;
    for (int i = 0; i < o->word_count; i++) {
        o->sweep.scene = o->words[i];
        sweeps[i] = sweep_run(&o->sweep, arena);
        if (i)
            putchar('\n');
        sweep_print(sweeps[i], stdout);
        fflush(stdout);
    }
    if (o->html) {
        char *command = arena_strdup(arena, "qibench");
        for (int i = 1; i < argc; i++)
            command = arena_printf(arena, "%s %s", command, argv[i]);
        sweep_write(sweeps, (size_t)o->word_count, o->html, command);
        printf("\n%s/index.html\n", o->html);
    }
    arena_destroy(arena);
    return 0;
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
    Options o = {.set = patchset_options_default(),
                 .speed = speed_options_default(),
                 .sweep = sweep_options_default()};
    while (o.command < COMMAND_COUNT && (argc < 2 || strcmp(argv[1], commands[o.command]) != 0))
        o.command++;
    if (o.command == COMMAND_COUNT) {
        complain("%s", "the first word says what to do: trace, speed or sweep");
        return 2;
    }
    if (!parse(argc - 2, argv + 2, &o))
        return 2;
    switch (o.command) {
    case COMMAND_TRACE:
        return trace(&o);
    case COMMAND_SPEED:
        return speed(&o);
    default:
        return sweep(&o, argc, argv);
    }
}
