// SPDX-License-Identifier: MIT
// qicompare: how far two pictures differ, in figures and as a page. Given a scene, it renders it
// first, with povray and with qirender (report/compare_scene.h). Several scenes give a page each
// and one over all of them.
#include "base/diag.h"
#include "base/file.h"
#include "options/animation.h"
#include "report/compare_scene.h"
#include "report/index_page.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// ---- results ---------------------------------------------------------------------------------

static void print_limit(uint64_t count, uint64_t pixels, double limit) {
    printf("  %llu pixels (%.3g%%) over %g\n", (unsigned long long)count,
           100.0 * (double)count / (double)pixels, limit);
}

// In the words and the order of idiff.
static void print_figures(const ComparePage *page, const RenderOptions *o) {
    const ImageDifference *d = &page->difference;
    printf("Comparing \"%s\" and \"%s\"\n", page->side[0].name, page->side[1].name);
    if (d->max > 0) {
        printf("  Mean error = %.6g\n  RMS error = %.6g\n  Peak SNR = %.4g\n", d->mean, d->rms,
               d->psnr);
        printf("  Max error  = %.6g @ (%d, %d, channel %d)\n", d->max, d->max_x + page->left,
               d->max_y + page->top, d->max_channel);
        printf("  %llu pixels (%.3g%%) off by more than one step of 8 bits\n",
               (unsigned long long)d->different, 100.0 * (double)d->different / (double)d->pixels);
        print_limit(d->warned, d->pixels, o->warn);
        print_limit(d->failed, d->pixels, o->fail);
    }
    if (page->side[0].run.seconds >= 0)
        printf("  User seconds: %s %.2f, %s %.2f\n", page->side[0].name, page->side[0].run.seconds,
               page->side[1].name, page->side[1].run.seconds);
    if (d->perceptible >= 0)
        printf("  %lld pixels differ to the eye (Yee)\n", (long long)d->perceptible);
    int causes[CAUSE_COUNT] = {0};
    for (int i = 0; i < page->place_count; i++)
        causes[page->places[i].cause]++;
    for (int i = CAUSE_GEOMETRY; i < CAUSE_COUNT; i++)
        if (causes[i])
            printf("  %d of the %d worst places: %s\n", causes[i], page->place_count,
                   place_cause_name((PlaceCause)i));
    printf("%s\n", page->verdict);
}

static void make_folder(const char *folder) {
    struct stat st;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        die("cannot make the folder '%s': %s", folder, strerror(errno));
    if (stat(folder, &st) != 0 || !S_ISDIR(st.st_mode))
        die("'%s' is not a folder", folder);
}

// The folder for pictures and page: what -o says, made if need be, or a new temporary one.
static const char *output_folder(const RenderOptions *o, Arena *arena) {
    if (o->output) {
        char *folder = arena_strdup(arena, o->output);
        size_t length = strlen(folder);
        while (length > 1 && folder[length - 1] == '/')
            folder[--length] = '\0';
        make_folder(folder);
        return folder;
    }
    const char *base = getenv("TMPDIR");
    char *folder = arena_printf(arena, "%s/qicompare-XXXXXX", base && *base ? base : "/tmp");
    if (!mkdtemp(folder))
        die("cannot make a temporary folder '%s': %s", folder, strerror(errno));
    return folder;
}

// ---- comparisons -----------------------------------------------------------------------------

static void write_page(const ComparePage *page, const char *folder, Arena *arena) {
    const char *path = arena_printf(arena, "%s/index.html", folder);
    compare_page_write(page, path);
    printf("%s\n", path);
}

// One scene of several. What goes wrong with it is its row's, and the others go on.
typedef struct {
    CompareJob job;
    IndexRow *row;
} SceneTask;

static void run_scene(void *context) {
    SceneTask *t = context;
    make_folder(t->job.folder);
    compare_scene(&t->job);
    progress_end(t->job.progress);
    print_figures(t->job.page, t->job.options);
    write_page(t->job.page, t->job.folder, t->job.arena);
}

// A picture of at most this width for the table; every nth pixel of the whole.
static Image *thumbnail(Arena *arena, const Image *image) {
    enum { WIDE = 160 };
    int by = (image->width + WIDE - 1) / WIDE;
    Image *small = ARENA_NEW(arena, Image);
    *small = *image;
    small->width = image->width / by > 0 ? image->width / by : 1;
    small->height = image->height / by > 0 ? image->height / by : 1;
    size_t channels = (size_t)image->channels;
    small->pixels =
        ARENA_ARRAY(arena, float, (size_t)small->width *(size_t)small->height *channels);
    for (int y = 0; y < small->height; y++)
        for (int x = 0; x < small->width; x++)
            memcpy(small->pixels + ((size_t)y * (size_t)small->width + (size_t)x) * channels,
                   image->pixels +
                       ((size_t)(y * by) * (size_t)image->width + (size_t)(x * by)) * channels,
                   channels * sizeof(float));
    return small;
}

// The name of a scene's folder: its own without what comes before and after, and a number where two
// scenes share it.
static const char *scene_name(const RenderOptions *o, size_t index, Arena *arena) {
    const char *name = file_name(o->scenes[index]), *dot = strrchr(name, '.');
    char *stem = arena_printf(arena, "%.*s", (int)(dot - name), name);
    for (size_t i = 0; i < o->scene_count; i++) {
        if (i != index && strcmp(file_name(o->scenes[i]), name) == 0)
            return arena_printf(arena, "%zu-%s", index + 1, stem);
    }
    return stem;
}

// True: all of them pass.
static bool compare_scenes(const RenderOptions *o, const char *folder, Arena *arena) {
    IndexRow *rows = ARENA_ARRAY(arena, IndexRow, o->scene_count);
    bool good = true;
    Progress progress = progress_begin(
        "comparing", compare_most_programs(o) * (uint64_t)o->scene_count, o->verbose);
    for (size_t i = 0; i < o->scene_count; i++) {
        Arena *own = arena_create();
        const char *name = scene_name(o, i, arena);
        SceneTask task = {.row = &rows[i]};
        task.job = (CompareJob){.options = o,
                                .scene = o->scenes[i],
                                .folder = arena_printf(own, "%s/%s", folder, name),
                                .page = ARENA_NEW(own, ComparePage),
                                .arena = own,
                                .progress = &progress};
        IndexRow *row = &rows[i];
        *row =
            (IndexRow){.title = o->scenes[i], .link = arena_printf(arena, "%s/index.html", name)};
        char *message = NULL;
        if (run_interrupted) {
            row->failed = "interrupted before it";
        } else if (diag_catch(run_scene, &task, &message)) {
            const ComparePage *page = task.job.page;
            row->verdict = page->verdict;
            row->difference = page->difference;
            for (int k = 0; k < 2; k++)
                row->seconds[k] = page->side[k].run.seconds;
            for (int k = 0; k < page->place_count; k++)
                row->causes[page->places[k].cause]++;
            row->picture = thumbnail(arena, page->side[1].image);
            good = good && strcmp(page->verdict, "FAILURE") != 0;
        } else {
            row->failed = arena_strdup(arena, message);
            printf("%s: not compared: %s\n", o->scenes[i], message);
            free(message);
            good = false;
        }
        arena_destroy(own);
        progress.done = compare_most_programs(o) * (uint64_t)(i + 1);
    }
    progress_end(&progress);
    const char *path = arena_printf(arena, "%s/index.html", folder);
    index_page_write(rows, o->scene_count, run_machine(arena), path);
    printf("%s\n", path);
    return good;
}

static int usage(const char *why) {
    fprintf(stderr, "qicompare: error: %s (try qicompare --help)\n", why);
    return 2;
}

static int check_words(const RenderOptions *o) {
    if (o->input && o->picture_count)
        return usage("give a scene or two pictures, not both");
    if (!o->input && o->picture_count != 2)
        return usage("a scene or two pictures are needed");
    for (size_t i = 0; i < o->scene_count || (i == 0 && o->input); i++) {
        const char *scene = i < o->scene_count ? o->scenes[i] : o->input;
        size_t length = strlen(scene);
        if (length > 5 && strcmp(scene + length - 5, ".json") == 0)
            return usage("POV-Ray must render it too, so the scene must be a .pov");
    }
    Animation animation;
    if (animation_of(o, &animation))
        return usage("an animation is compared frame by frame: give its clock with +K");
    if (!o->output_to_file)
        return usage("-F writes no picture, so there is nothing to compare");
    if (o->output && (!*o->output || strcmp(o->output, "-") == 0))
        return usage("-o names a folder");
    return 0;
}

// Says what is missing; what is finished stays.
static int end_interrupted(const RenderOptions *o, const char *folder) {
    if (o->scene_count > 1)
        fprintf(stderr,
                "qicompare: interrupted: the pages of the scenes that were finished are whole; the "
                "index says which are missing\n");
    else
        fprintf(stderr, "qicompare: interrupted: '%s/index.html' is not written\n", folder);
    return 2;
}

static void run_single(void *context) { compare_scene(context); }

int main(int argc, char **argv) {
    diag_program("qicompare");
    run_catch_signals();
    Arena *arena = arena_create();
    RenderOptions options = options_default();
    options_read_povray_ini(PROGRAM_QICOMPARE, arena, &options);
    if (!options_parse(PROGRAM_QICOMPARE, argc, argv, arena, &options))
        return 2;
    if (options_inform(PROGRAM_QICOMPARE, &options))
        return 0;
    if (check_words(&options) != 0)
        return 2;
    const char *folder = NULL;
    bool good;
    if (options.scene_count > 1) {
        good = compare_scenes(&options, output_folder(&options, arena), arena);
    } else {
        options.input = options_input_path(&options, arena);
        if (options.input && !file_exists(options.input))
            die("cannot read '%s': no such file", options.input);
        // Two pictures alone need no folder; a scene always does.
        ComparePage *page = ARENA_NEW(arena, ComparePage);
        if (options.output || options.input)
            folder = output_folder(&options, arena);
        Progress progress =
            progress_begin("comparing", compare_most_programs(&options), options.verbose);
        CompareJob job = {&options, options.input, folder, page, arena, &progress};
        char *message = NULL;
        if (options.input && !diag_catch(run_single, &job, &message)) {
            progress_end(&progress);
            if (run_interrupted)
                return end_interrupted(&options, folder);
            fprintf(stderr, "%s\n", message);
            return 1;
        }
        progress_end(&progress);
        if (!options.input)
            compare_pictures(&options, page, arena);
        print_figures(page, &options);
        if (folder)
            write_page(page, folder, arena);
        good = strcmp(page->verdict, "FAILURE") != 0;
    }
    if (run_interrupted)
        return end_interrupted(&options, folder);
    arena_destroy(arena);
    return good ? 0 : 1;
}
