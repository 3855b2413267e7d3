// SPDX-License-Identifier: MIT
#include "tests/csg_trees.h"

#include "base/diag.h"
#include "tests/csg_oracle.h"
#include "tests/povray_pictures.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// Seeds become frame numbers, which all have four digits.
enum { FRAME = 1000, DEPTHS = 5, AT_ONCE = 20 };
static const double LIMIT = 0.0041, MOST = 0.5; // a step of 8 bits; percent

typedef struct {
    const CsgTreesOptions *options;
    char folder[64];
    uint16_t *ours, *theirs;
    CsgTreesResult sums[DEPTHS + 1]; // the last: all
    double worst[DEPTHS + 1];
    FILE *table;
} Run;

static int depth_of(int seed) { return 1 + (seed - 1) % DEPTHS; }

static CsgTree *tree_of(const Run *run, int seed, Arena *arena) {
    Rng rng = {(uint64_t)seed * 7919};
    return csg_tree_random(&rng, arena, depth_of(seed), run->options->bounded);
}

static FILE *open_file(const Run *run, const char *name) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", run->folder, name);
    FILE *file = fopen(path, "w");
    if (!file)
        die("cannot write %s", path);
    return file;
}

static void write_scenes(const Run *run) {
    FILE *file = open_file(run, "tree.pov");
    fprintf(file, "%s#include concat(\"t\", str(frame_number, -4, 0), \".inc\")\n",
            CSG_ORACLE_SCENE);
    fclose(file);
    for (int i = 0; i < run->options->count; i++) {
        int seed = run->options->first + i;
        Arena *arena = arena_create();
        char name[32];
        snprintf(name, sizeof name, "t%04d.inc", FRAME + seed);
        file = open_file(run, name);
        csg_tree_write(tree_of(run, seed, arena), file);
        fclose(file);
        arena_destroy(arena);
    }
}

// povray mostly waits, so many run at once, each with its share of the frames.
static bool render(const Run *run) {
    const CsgTreesOptions *o = run->options;
    char command[1024];
    int first = FRAME + o->first, last = first + o->count - 1;
    int share = (o->count + AT_ONCE - 1) / AT_ONCE;
    snprintf(command, sizeof command,
             "cd %s && for f in $(seq %d %d %d); do povray +Itree.pov +Op_.ppm +FP16 +W%d +H%d -D "
             "-A +WT1 File_Gamma=1.0 +KFI%d +KFF%d +SF$f +EF$(( f + %d < %d ? f + %d : %d )) "
             ">povray$f.log 2>&1 & done; wait",
             run->folder, first, share, last, o->width, o->height, first, last, share - 1, last,
             share - 1, last);
    if (system(command) != 0)
        return false;
    snprintf(command, sizeof command,
             "q=$(realpath %s) && cd %s && $q +Itree.pov +Oq_.ppm +FP16 +W%d +H%d -A +WT2 "
             "File_Gamma=1.0 +KFI%d +KFF%d --method facets >qirender.log 2>&1",
             o->program, run->folder, o->width, o->height, first, last);
    return system(command) == 0;
}

static double curve(double v) { return pow(fmin(fmax(v, 0.0), 1.0), 1.0 / 2.2); }

static double off(const uint16_t *a, const double b[3]) {
    double most = 0;
    for (int k = 0; k < 3; k++)
        most = fmax(most, fabs(curve(a[k] / 65535.0) - curve(b[k])));
    return most;
}

static void judge(Run *run, int seed, int x, int y, CsgOracle *oracle, CsgTreesResult *tree) {
    const CsgTreesOptions *o = run->options;
    size_t at = 3 * ((size_t)y * (size_t)o->width + (size_t)x);
    const uint16_t *ours = &run->ours[at], *theirs = &run->theirs[at];
    const double seen[3] = {theirs[0] / 65535.0, theirs[1] / 65535.0, theirs[2] / 65535.0};
    double truth[3];
    if (off(ours, seen) <= LIMIT)
        return;
    tree->pixels++;
    if (o->bounded)
        return;
    csg_oracle_pixel(oracle, x, y, o->width, o->height, truth);
    bool we = off(ours, truth) <= LIMIT, they = off(theirs, truth) <= LIMIT;
    tree->ours_right += we && !they;
    tree->theirs_right += they && !we;
    tree->unknown += we == they;
    if (o->keep)
        printf("seed %d pixel %d,%d: ours %.4f %.4f %.4f povray %.4f %.4f %.4f truth %.4f %.4f "
               "%.4f\n",
               seed, x, y, ours[0] / 65535.0, ours[1] / 65535.0, ours[2] / 65535.0, seen[0],
               seen[1], seen[2], truth[0], truth[1], truth[2]);
}

static void add(CsgTreesResult *sum, const CsgTreesResult *tree) {
    sum->trees += tree->trees;
    sum->over += tree->over;
    sum->wronger += tree->wronger;
    sum->pixels += tree->pixels;
    sum->ours_right += tree->ours_right;
    sum->theirs_right += tree->theirs_right;
    sum->unknown += tree->unknown;
}

static void compare(Run *run, int seed) {
    const CsgTreesOptions *o = run->options;
    char path[128];
    snprintf(path, sizeof path, "%s/p_%04d.ppm", run->folder, FRAME + seed);
    bool there = povray_read_ppm(path, o->width, o->height, run->theirs);
    snprintf(path, sizeof path, "%s/q_%04d.ppm", run->folder, FRAME + seed);
    if (!there || !povray_read_ppm(path, o->width, o->height, run->ours))
        die("%s or povray's counterpart is missing", path);
    Arena *arena = arena_create();
    CsgOracle *oracle = csg_oracle_create(tree_of(run, seed, arena), arena);
    CsgTreesResult tree = {.trees = 1};
    for (int y = 0; y < o->height; y++)
        for (int x = 0; x < o->width; x++)
            judge(run, seed, x, y, oracle, &tree);
    arena_destroy(arena);
    double percent = 100.0 * (double)tree.pixels / (o->width * o->height);
    tree.over = percent > MOST;
    tree.wronger = tree.theirs_right > tree.ours_right;
    if (tree.over || tree.wronger)
        fprintf(run->table, "| tree %d | %d | %.2f | %ld | %ld | %ld | %ld |\n", seed,
                depth_of(seed), percent, tree.pixels, tree.ours_right, tree.theirs_right,
                tree.unknown);
    int row = depth_of(seed) - 1;
    add(&run->sums[row], &tree);
    add(&run->sums[DEPTHS], &tree);
    run->worst[row] = fmax(run->worst[row], percent);
    run->worst[DEPTHS] = fmax(run->worst[DEPTHS], percent);
}

static void print_sums(const Run *run) {
    const CsgTreesOptions *o = run->options;
    fprintf(run->table, "\n%d random trees%s, seeds from %d, %dx%d\n\n", o->count,
            o->bounded ? " with bounds" : "", o->first, o->width, o->height);
    fprintf(run->table,
            "| depth | trees | over %.1f %% of the pixels | worst, %% | pixels that "
            "differ | qirender right | povray right | neither |\n"
            "|---|---|---|---|---|---|---|---|\n",
            MOST);
    for (int row = 0; row <= DEPTHS; row++) {
        const CsgTreesResult *sum = &run->sums[row];
        char name[16] = "all";
        if (row < DEPTHS)
            snprintf(name, sizeof name, "%d", row + 1);
        fprintf(run->table, "| %s | %d | %d | %.2f | %ld | %ld | %ld | %ld |\n", name, sum->trees,
                sum->over, run->worst[row], sum->pixels, sum->ours_right, sum->theirs_right,
                sum->unknown);
    }
}

bool csg_trees_run(const CsgTreesOptions *options, FILE *table, CsgTreesResult *result) {
    if (system("command -v povray >/dev/null") != 0)
        return false;
    Run run = {.options = options, .folder = "/tmp/qipov_trees_XXXXXX", .table = table};
    size_t numbers = 3 * (size_t)options->width * (size_t)options->height;
    run.ours = calloc(numbers, sizeof *run.ours);
    run.theirs = calloc(numbers, sizeof *run.theirs);
    if (!run.ours || !run.theirs || !mkdtemp(run.folder))
        die("no memory or no folder for trees");
    write_scenes(&run);
    if (!render(&run))
        die("the trees could not be rendered: see %s", run.folder);
    for (int i = 0; i < options->count; i++)
        compare(&run, options->first + i);
    print_sums(&run);
    *result = run.sums[DEPTHS];
    free(run.ours);
    free(run.theirs);
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", run.folder);
    if (options->keep)
        printf("texts and pictures are in %s\n", run.folder);
    else if (system(command) != 0)
        fprintf(stderr, "%s stays behind\n", run.folder);
    return true;
}
