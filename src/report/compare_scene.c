// SPDX-License-Identifier: MIT
#include "report/compare_scene.h"

#include "base/diag.h"
#include "base/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// A pixel is off when it differs by more than one step of 8 bits.
static const double ONE_STEP = 1.0 / 255.0 * (1.0 + 1e-4);

// Both pictures, those that prove, four a place.
uint64_t compare_most_programs(const RenderOptions *o) {
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

static void add_words(const CompareJob *job, const Task *task, Command *command) {
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
static Image *render_task(const CompareJob *job, const Task *task, Run *run) {
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
    const CompareJob *job;
    const Task *task;
    Run run;
} StoryTask;

static void run_story(void *context) {
    StoryTask *s = context;
    render_task(s->job, s->task, &s->run);
}

static const char *tell(const CompareJob *job, int x, int y, bool facets) {
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
static void nudge(const CompareJob *job, PlaceProof *proof) {
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
static void look_beside(const CompareJob *job, Place *place) {
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
static void look_into(const CompareJob *job) {
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

// ---- comparisons -----------------------------------------------------------------------------

static const char *judge(const ImageDifference *d, const RenderOptions *o) {
    double share = 100.0 / (double)d->pixels;
    if ((double)d->failed * share > o->fail_percent)
        return "FAILURE";
    return (double)d->warned * share > o->warn_percent ? "WARNING" : "PASS";
}

static void finish(const RenderOptions *o, ComparePage *page) {
    page->left = o->region[2] ? o->region[0] : 0;
    page->top = o->region[2] ? o->region[1] : 0;
    page->fail = o->fail;
    page->fail_percent = o->fail_percent;
    page->difference = image_compare(page->side[0].image, page->side[1].image, o->fail, o->warn);
    page->verdict = judge(&page->difference, o);
    find_places(o, page);
}

void compare_scene(const CompareJob *job) {
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

void compare_pictures(const RenderOptions *o, ComparePage *page, Arena *arena) {
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
