// SPDX-License-Identifier: MIT
// qibench: `trace` answers rays from a text file, `speed` measures rays against patches, `sweep`
// measures what accuracy costs in whole scenes.
#include "base/diag.h"
#include "bench/speed.h"
#include "bench/study.h"
#include "bench/sweep_report.h"
#include "bench/trace.h"
#include "options/options.h"
#include "report/run.h"

#include <errno.h>
#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int usage(const char *format, const char *word) {
    fputs("qibench: error: ", stderr);
    fprintf(stderr, format, word);
    fputs(" (qibench --help)\n", stderr);
    return 2;
}

static int trace(const RenderOptions *o) {
    if (o->bench.word_count == 0)
        return usage("%s", "no file given");
    if (o->bench.word_count > 1)
        return usage("what is '%s'?", o->bench.words[1]);
    PatchSetOptions options = patchset_options_default();
    options.method = o->method;
    options.tolerance = o->tolerance;
    options.prepare = o->prepare;
    Arena *arena = arena_create();
    RayFile *file = ray_file_open(arena, o->bench.words[0]);
    int threads = o->threads > 0 ? o->threads : omp_get_num_procs();
    omp_set_num_threads(threads);
    PatchSet *set = set_of_points(ray_file_points(file), ray_file_patch_count(file), &options);
    patchset_commit(set);
    trace_rays(file, set, threads, stdout);
    patchset_destroy(set);
    ray_file_close(file);
    arena_destroy(arena);
    return 0;
}

// ---- speed

typedef struct {
    const char *name;
    void (*run)(const SpeedOptions *options);
} Table;
static const Table tables[] = {{"methods", speed_methods},
                               {"picture", speed_picture},
                               {"lattices", speed_lattices},
                               {"threads", speed_threads}};
enum { TABLES = sizeof tables / sizeof tables[0] };

static bool is_wanted(const BenchOptions *b, const char *table) {
    bool wanted = b->word_count == 0;
    for (size_t i = 0; i < b->word_count; i++)
        wanted |= strcmp(b->words[i], table) == 0;
    return wanted;
}

static SpeedOptions speed_options(const RenderOptions *o) {
    const BenchOptions *b = &o->bench;
    SpeedOptions speed = speed_options_default();
    speed.rounds = b->rounds ? b->rounds : speed.rounds;
    speed.share = b->share;
    speed.max_patches = (size_t)b->patches;
    speed.prepare = (int)o->prepare;
    if (b->method_given)
        speed.method = (int)o->method;
    if (b->tolerance_given)
        speed.tolerance = o->tolerance;
    for (int view = 0; view < VIEW_COUNT; view++)
        if (b->view && strcmp(b->view, view_name((View)view)) == 0)
            speed.view = view;
    return speed;
}

// What an interruption says; renewed before each table.
static char unmeasured[128];

static void on_interrupt(int number) {
    (void)number;
    ssize_t written = write(STDERR_FILENO, unmeasured, strlen(unmeasured));
    (void)written;
    _exit(2);
}

static void name_unmeasured(const BenchOptions *b, int from) {
    size_t at = (size_t)snprintf(unmeasured, sizeof unmeasured, "\nqibench: interrupted; missing:");
    for (int k = from; k < TABLES; k++)
        if (is_wanted(b, tables[k].name))
            at += (size_t)snprintf(unmeasured + at, sizeof unmeasured - at, " %s", tables[k].name);
    snprintf(unmeasured + at, sizeof unmeasured - at, "\n");
}

static int speed(const RenderOptions *o) {
    const SpeedOptions options = speed_options(o);
    for (size_t i = 0; i < o->bench.word_count; i++) {
        int k = 0;
        while (k < TABLES && strcmp(o->bench.words[i], tables[k].name) != 0)
            k++;
        if (k == TABLES)
            return usage("the tables are methods, picture, lattices and threads, not '%s'",
                         o->bench.words[i]);
    }
    bool any = false;
    for (int k = 0; k < TABLES; k++) {
        if (!is_wanted(&o->bench, tables[k].name))
            continue;
        if (any)
            printf("\n");
        any = true;
        name_unmeasured(&o->bench, k);
        signal(SIGINT, on_interrupt);
        signal(SIGTERM, on_interrupt);
        tables[k].run(&options);
        fflush(stdout);
    }
    return 0;
}

// ---- sweep

static void make_folder(const char *path) {
    struct stat st;
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        die("cannot make the folder '%s': %s", path, strerror(errno));
    if (stat(path, &st) != 0 || !S_ISDIR(st.st_mode))
        die("'%s' is not a folder", path);
}

// What is finished is written; says what is not.
static int end_interrupted(const BenchOptions *b, size_t done) {
    fputs("qibench: interrupted; not measured:", stderr);
    for (size_t i = done; i < b->word_count; i++)
        fprintf(stderr, " %s", b->words[i]);
    if (b->html && done > 0)
        fprintf(stderr, "; %s/index.html has the rest", b->html);
    putc('\n', stderr);
    return 2;
}

static int sweep(const RenderOptions *o, int argc, char **argv) {
    const BenchOptions *b = &o->bench;
    if (b->word_count == 0)
        return usage("%s", "no scene given");
    SweepOptions options = sweep_options_default();
    options.library_paths = o->library_paths;
    options.library_path_count = o->library_path_count;
    options.width = o->width;
    options.height = o->height;
    options.rounds = b->rounds ? b->rounds : options.rounds;
    options.patience = b->patience;
    options.povray = b->povray;
    Arena *arena = arena_create();
    const Sweep **sweeps = ARENA_ARRAY(arena, const Sweep *, b->word_count);
    char *command = arena_strdup(arena, "qibench");
    for (int i = 1; i < argc; i++)
        command = arena_printf(arena, "%s %s", command, argv[i]);
    if (b->html)
        make_folder(b->html); // before the work
    for (size_t i = 0; i < b->word_count; i++) {
        options.scene = b->words[i];
        sweeps[i] = sweep_run(&options, arena);
        if (!sweeps[i])
            return end_interrupted(b, i);
        if (i)
            putchar('\n');
        if (b->study)
            study_print(sweeps[i], stdout);
        else
            sweep_print(sweeps[i], stdout);
        fflush(stdout);
        // After each scene, so that an interruption loses only what it interrupts.
        if (b->html)
            sweep_write(sweeps, i + 1, b->html, command);
    }
    if (b->study)
        study_print_all(sweeps, b->word_count, stdout);
    if (b->html)
        printf("\n%s/index.html\n", b->html);
    arena_destroy(arena);
    return 0;
}

int main(int argc, char **argv) {
    diag_program("qibench");
    Arena *arena = arena_create();
    const SweepOptions size = sweep_options_default();
    RenderOptions options = options_default();
    options.width = size.width;
    options.height = size.height;
    if (!options_parse(PROGRAM_QIBENCH, argc, argv, arena, &options))
        return 2;
    if (options_inform(PROGRAM_QIBENCH, &options))
        return 0;
    int status = options.bench.command == BENCH_TRACE   ? trace(&options)
                 : options.bench.command == BENCH_SPEED ? speed(&options)
                                                        : sweep(&options, argc, argv);
    arena_destroy(arena);
    return status;
}
