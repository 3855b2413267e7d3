// SPDX-License-Identifier: MIT
// qicompare: how far two pictures differ, in figures and as a page. Given a scene, it renders it
// first, with povray and with the qirender beside it, at the same switches, and finds out why they
// differ where they do (report/places.h). Several scenes give a page each and one over all of them.
#include "base/diag.h"
#include "base/file.h"
#include "base/progress.h"
#include "options/animation.h"
#include "options/options.h"
#include "report/compare_page.h"
#include "report/index_page.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// A pixel is off when it differs by more than one step of 8 bits.
static const double ONE_STEP = 1.0 / 255.0 * (1.0 + 1e-4);

// ---- renders ---------------------------------------------------------------------------------

// One scene at work.
typedef struct {
    const RenderOptions *options;
    const char *scene, *folder;
    ComparePage *page;
    Arena *arena;
    Progress *progress;
} Job;

// The programs that a scene may need: both pictures, those that prove, four a place.
static uint64_t most_tasks(const RenderOptions *o) {
    return 7 + PLACE_NUDGES + 4 * (uint64_t)o->places;
}

enum { MOST_WORDS = 6 };

// One program with some words behind those of the command line. name: of the picture and the log.
typedef struct {
    bool povray;
    const char *name, *title;
    const char *words[MOST_WORDS];
    bool picture;        // else only what it says is wanted
    const Place *thirds; // not NULL: only this pixel, at three times the size
} Task;

static void add_words(const Job *job, const Task *task, Command *command) {
    const RenderOptions *o = job->options;
    run_add(command, task->povray ? "povray" : run_find_qirender(job->arena));
    // Both renderers get the same words; qirender those with two dashes as well.
    for (size_t k = 0; k < o->shared_count; k++)
        run_add(command, o->shared[k]);
    // POV-Ray looks for includes in the working directory, not beside the scene.
    run_add(command, arena_printf(job->arena, "+L%s", file_folder(job->arena, job->scene)));
    for (size_t k = 0; !task->povray && k < o->own_count; k++)
        run_add(command, o->own[k]);
    for (int k = 0; k < MOST_WORDS && task->words[k]; k++)
        run_add(command, task->words[k]);
}

// The picture, of the part that is compared; NULL when none was asked for.
static Image *render_task(const Job *job, const Task *task, Run *run) {
    const RenderOptions *o = job->options;
    Arena *arena = job->arena;
    const char *picture =
        arena_printf(arena, "%s/%s.%s", job->folder, task->name, image_extension(o->format));
    Command command = {.count = 0};
    add_words(job, task, &command);
    // Last: an INI file among the words may name another picture.
    run_add(&command, arena_printf(arena, "+I%s", job->scene));
    run_add(&command, arena_printf(arena, "+O%s", picture));
    int by = task->thirds ? 3 : 1;
    run_add(&command, arena_printf(arena, "+W%d", by * o->width));
    run_add(&command, arena_printf(arena, "+H%d", by * o->height));
    if (task->thirds) {
        int x = 3 * (task->thirds->x + job->page->left), y = 3 * (task->thirds->y + job->page->top);
        run_add(&command, arena_printf(arena, "+SC%d", x + 1));
        run_add(&command, arena_printf(arena, "+EC%d", x + 3));
        run_add(&command, arena_printf(arena, "+SR%d", y + 1));
        run_add(&command, arena_printf(arena, "+ER%d", y + 3));
    }
    run_add(&command, "-D");
    run_add(&command, "-P");
    progress_say(job->progress, arena_printf(arena, "%s: %s", job->scene, task->title));
    if (o->verbose && !job->progress->on)
        fprintf(stderr, "%s ...\n", task->title);
    if (task->picture)
        unlink(picture); // what is read below must be new
    *run = run_command_line(&command, task->title,
                            arena_printf(arena, "%s/%s.txt", job->folder, task->name), arena);
    progress_add(job->progress, 1);
    if (!task->picture)
        return NULL;
    Image *image = image_read(arena, picture);
    if (task->thirds)
        return image_cut(arena, image, 3 * (task->thirds->x + job->page->left),
                         3 * (task->thirds->y + job->page->top), 3, 3);
    const int *r = o->region;
    return r[2] ? image_cut(arena, image, r[0], r[1], r[2], r[3]) : image;
}

// The story of a pixel; NULL if it cannot be had (it is only told beside the figures).
typedef struct {
    const Job *job;
    const Task *task;
    Run run;
} StoryTask;

static void run_story(void *context) {
    StoryTask *s = context;
    render_task(s->job, s->task, &s->run);
}

static const char *tell(const Job *job, int x, int y, bool facets) {
    const char *pixel = arena_printf(job->arena, "%d,%d", x, y);
    const Task task = {.name = "story",
                       .title = "the story of a pixel",
                       .words = {"--pixel", pixel, facets ? "--method" : NULL, "facets"}};
    StoryTask s = {.job = job, .task = &task};
    char *message = NULL;
    if (!diag_catch(run_story, &s, &message)) {
        free(message);
        return NULL;
    }
    // Warnings about the scene stand before it.
    const char *start = strstr(s.run.log, "pixel (");
    return start ? start : s.run.log;
}

// ---- causes ----------------------------------------------------------------------------------

static bool any_shading(const ComparePage *page) {
    for (int i = 0; i < page->place_count; i++)
        if (page->places[i].cause == CAUSE_SHADING)
            return true;
    return false;
}

// POV-Ray's triangles under rays that are moved by next to nothing, to each corner.
static void nudge(const Job *job, PlaceProof *proof) {
    for (int k = 0; k < PLACE_NUDGES; k++) {
        Run unused;
        const Task task = {
            .name = arena_printf(job->arena, "facets-nudged-%d", k),
            .title = "qirender with POV-Ray's triangles and moved rays",
            .words = {"--method", "facets", "--nudge",
                      arena_printf(job->arena, "%g,%g", k & 1 ? PLACE_NUDGE : -PLACE_NUDGE,
                                   k & 2 ? PLACE_NUDGE : -PLACE_NUDGE)},
            .picture = true};
        proof->nudged[k] = render_task(job, &task, &unused);
    }
}

// One pixel as 3 x 3 rays, by both. With anti-aliasing a pixel is many rays already.
static void look_beside(const Job *job, Place *place) {
    Run unused;
    const Task povray = {.povray = true,
                         .name = "povray-thirds",
                         .title = "POV-Ray around a pixel",
                         .picture = true,
                         .thirds = place};
    const Task facets = {.name = "facets-thirds",
                         .title = "qirender with POV-Ray's triangles around a pixel",
                         .words = {"--method", "facets"},
                         .picture = true,
                         .thirds = place};
    const PlaceThirds thirds = {.povray = render_task(job, &povray, &unused),
                                .facets = render_task(job, &facets, &unused)};
    places_judge_thirds(&thirds, ONE_STEP, place);
}

// Renders what proves why the places differ, and judges them.
static void look_into(const Job *job) {
    ComparePage *page = job->page;
    Place *places = page->places;
    Run unused;
    const Task facets = {.name = "facets",
                         .title = "qirender with POV-Ray's triangles",
                         .words = {"--method", "facets"},
                         .picture = true};
    const Task finer = {.name = "facets-finer",
                        .title = "the same, cut finer",
                        .words = {"--method", "facets", "--finer", "1"},
                        .picture = true};
    PlaceProof proof = {.povray = page->side[0].image, .ours = page->side[1].image};
    proof.facets = render_task(job, &facets, &unused);
    proof.finer = render_task(job, &finer, &unused);
    places_judge(&proof, ONE_STEP, places, page->place_count);

    if (any_shading(page) && job->options->antialias) {
        const Task povray = {.povray = true,
                             .name = "povray-plain",
                             .title = "POV-Ray without anti-aliasing",
                             .words = {"-A"},
                             .picture = true};
        const Task plain = {.name = "facets-plain",
                            .title = "qirender with POV-Ray's triangles, without anti-aliasing",
                            .words = {"--method", "facets", "-A"},
                            .picture = true};
        proof.povray_plain = render_task(job, &povray, &unused);
        proof.plain = render_task(job, &plain, &unused);
        places_judge(&proof, ONE_STEP, places, page->place_count);
    }
    if (any_shading(page)) {
        nudge(job, &proof);
        places_judge(&proof, ONE_STEP, places, page->place_count);
    }
    if (any_shading(page)) {
        const Task sorted = {.povray = true,
                             .name = "povray-sorted",
                             .title = "POV-Ray with another sorting",
                             .words = {"+BM2"},
                             .picture = true};
        proof.povray_sorted = render_task(job, &sorted, &unused);
        places_judge(&proof, ONE_STEP, places, page->place_count);
    }
    for (int i = 0; i < page->place_count && !job->options->antialias; i++)
        if (places[i].cause == CAUSE_SHADING)
            look_beside(job, &places[i]);
    for (int i = 0; i < page->place_count; i++)
        for (int k = 0; k < 2; k++)
            places[i].story[k] = tell(job, places[i].x + page->left, places[i].y + page->top, k);
}

static void find_places(const RenderOptions *o, ComparePage *page) {
    Arena *scratch = arena_create();
    const Image *off = image_difference(scratch, page->side[0].image, page->side[1].image);
    page->place_count = places_find(off, ONE_STEP, o->places, page->places);
    arena_destroy(scratch);
}

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

static const char *judge(const ImageDifference *d, const RenderOptions *o) {
    double share = 100.0 / (double)d->pixels;
    if ((double)d->failed * share > o->fail_percent)
        return "FAILURE";
    return (double)d->warned * share > o->warn_percent ? "WARNING" : "PASS";
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

static void finish(const RenderOptions *o, ComparePage *page) {
    page->left = o->region[2] ? o->region[0] : 0;
    page->top = o->region[2] ? o->region[1] : 0;
    page->fail = o->fail;
    page->fail_percent = o->fail_percent;
    page->difference = image_compare(page->side[0].image, page->side[1].image, o->fail, o->warn);
    page->verdict = judge(&page->difference, o);
    find_places(o, page);
}

static void compare_scene(Job *job) {
    static const Task tasks[2] = {
        {.povray = true, .name = "povray", .title = "POV-Ray", .picture = true},
        {.name = "qirender", .title = "qirender", .picture = true}};
    ComparePage *page = job->page;
    for (int i = 0; i < 2; i++) {
        page->side[i].name = tasks[i].title;
        page->side[i].image = render_task(job, &tasks[i], &page->side[i].run);
    }
    page->title = job->scene;
    page->machine = run_machine(job->arena);
    finish(job->options, page);
    if (page->place_count > 0)
        look_into(job);
    if (run_interrupted) // while a story was told, which may fail
        die("interrupted");
}

static void compare_pictures(const RenderOptions *o, ComparePage *page, Arena *arena) {
    for (int i = 0; i < 2; i++) {
        Image *image = image_read(arena, o->pictures[i]);
        const int *r = o->region;
        if (r[2] && (r[0] >= image->width || r[1] >= image->height))
            die("the region lies outside '%s', %d x %d pixels", o->pictures[i], image->width,
                image->height);
        page->side[i] =
            (CompareSide){.name = o->pictures[i],
                          .run = {.seconds = -1},
                          .image = r[2] ? image_cut(arena, image, r[0], r[1], r[2], r[3]) : image};
    }
    page->title = arena_printf(arena, "%s and %s", o->pictures[0], o->pictures[1]);
    finish(o, page);
}

static void write_page(const ComparePage *page, const char *folder, Arena *arena) {
    const char *path = arena_printf(arena, "%s/index.html", folder);
    compare_page_write(page, path);
    printf("%s\n", path);
}

// One scene of several. What goes wrong with it is its row's, and the others go on.
typedef struct {
    Job job;
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
    Progress progress =
        progress_begin("comparing", most_tasks(o) * (uint64_t)o->scene_count, o->verbose);
    for (size_t i = 0; i < o->scene_count; i++) {
        Arena *own = arena_create();
        const char *name = scene_name(o, i, arena);
        SceneTask task = {.row = &rows[i]};
        task.job = (Job){.options = o,
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
        progress.done = most_tasks(o) * (uint64_t)(i + 1);
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
        Progress progress = progress_begin("comparing", most_tasks(&options), options.verbose);
        Job job = {&options, options.input, folder, page, arena, &progress};
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
