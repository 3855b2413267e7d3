// SPDX-License-Identifier: MIT
#include "bench/sweep.h"

#include "base/array.h"
#include "base/diag.h"
#include "base/progress.h"
#include "bench/sweep_child.h"
#include "bench/sweep_judge.h"
#include "bench/sweep_povray.h"
#include "patch/embree.h"
#include "converter/convert.h"
#include "report/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TRUTH = 1e-14;
enum { FIRST_STEPS = 2, LAST_STEPS = 8, EDGE_RAYS = 20000 };

SweepOptions sweep_options_default(void) {
    return (SweepOptions){
        .width = 320, .height = 240, .rounds = 3, .patience = 60.0, .povray = true};
}

const char *sweep_point_name(const SweepPoint *p, Arena *arena) {
    if (p->povray)
        return arena_printf(arena, "povray u_steps %d", p->steps);
    if (p->method == METHOD_FACETS)
        return arena_printf(
            arena, p->flatness > 0.0 ? "facets u_steps %d flatness %g" : "facets u_steps %d",
            p->steps, p->flatness);
    if (p->prepare != PREPARE_FULL)
        return arena_printf(arena, "%s prepared %s %g", patch_method_name(p->method),
                            patch_prepare_name(p->prepare), p->tolerance);
    return arena_printf(arena, "%s %g", patch_method_name(p->method), p->tolerance);
}

// ---- What is measured

typedef struct {
    SweepPoint point;
    const char *failed;
    bool spent; // no more rounds: what it may take is used up
    int rounds;
    double used; // seconds
    double prepare[SWEEP_MOST_ROUNDS], trace[SWEEP_MOST_ROUNDS], picture[SWEEP_MOST_ROUNDS];
    double megabytes;
} Measured;

typedef ARRAY(Measured) MeasuredList;

static void add_point(MeasuredList *list, SweepPoint point) {
    array_push(list, ((Measured){.point = point}));
}

static MeasuredList choose_points(const SweepOptions *o) {
    static const PatchMethod methods[] = {METHOD_QI, METHOD_CLIPPING, METHOD_NEWTON,
                                          METHOD_TESSELLATION, METHOD_QI_PAPER};
    static const double tolerances[] = {1e-3, 1e-6, 1e-9, 1e-12};
    // Triangles for 1e-6 would be millions, and single precision does not keep it.
    static const double coarser[] = {1e-3, 1e-4};
    MeasuredList list = {0};
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        bool coarse = methods[m] == METHOD_TESSELLATION;
        if (coarse && embree_missing())
            continue;
        for (int t = 0; t < (coarse ? 2 : 4); t++)
            add_point(&list, (SweepPoint){.method = methods[m],
                                          .tolerance = coarse ? coarser[t] : tolerances[t],
                                          .steps = -1});
    }
    for (int p = PREPARE_LIGHT; p < PREPARE_COUNT; p++)
        for (int t = 0; t < 4; t++)
            add_point(
                &list,
                (SweepPoint){.prepare = (PatchPrepare)p, .tolerance = tolerances[t], .steps = -1});
    for (int steps = FIRST_STEPS; steps <= LAST_STEPS; steps++)
        add_point(&list, (SweepPoint){.method = METHOD_FACETS, .tolerance = 1e-9, .steps = steps});
    for (double flatness = 1.0; flatness > 0.5e-4; flatness *= 0.1)
        add_point(&list, (SweepPoint){.method = METHOD_FACETS,
                                      .tolerance = 1e-9,
                                      .steps = LAST_STEPS,
                                      .flatness = flatness});
    for (int steps = FIRST_STEPS; steps <= LAST_STEPS && o->povray; steps++)
        add_point(&list, (SweepPoint){.povray = true, .steps = steps});
    return list;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static Spread spread_of(const double *values, int count) {
    double sorted[SWEEP_MOST_ROUNDS];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, by_value);
    return (Spread){sorted[count / 2], sorted[0], sorted[count - 1]};
}

// ---- The front

// A point lies on the front when no other is at least as good in both and better in one.
static void find_front(Sweep *sweep) {
    for (size_t i = 0; i < sweep->count; i++) {
        SweepResult *a = &sweep->results[i];
        a->front = !a->failed;
        for (size_t k = 0; k < sweep->count && a->front; k++) {
            const SweepResult *b = &sweep->results[k];
            if (b->failed)
                continue;
            bool as_good = b->picture.median <= a->picture.median && b->rms <= a->rms;
            bool better = b->picture.median < a->picture.median || b->rms < a->rms;
            a->front = !(as_good && better);
        }
    }
}

// ---- The sweep

static Scene *read_scene(const SweepOptions *o, Arena *arena) {
    RenderOptions options = options_default();
    options.input = o->scene;
    options.width = o->width;
    options.height = o->height;
    options.library_paths = o->library_paths;
    options.library_path_count = o->library_path_count;
    return convert_scene(&options, arena);
}

static const char TOO_SLOW[] = "too slow", TOO_LARGE[] = "too large", GIVEN_UP[] = "given up: ";

// Points of one curve, the later the finer.
static bool same_curve(const SweepPoint *a, const SweepPoint *b) {
    return a->povray == b->povray && a->method == b->method && a->prepare == b->prepare &&
           (a->steps < 0) == (b->steps < 0) && (a->flatness > 0.0) == (b->flatness > 0.0);
}

// Why a point need not be tried: one of its curve that asks less was too much. NULL: try it.
static const char *give_up(const MeasuredList *list, size_t i, Arena *arena) {
    const Measured *before = i > 0 ? &list->items[i - 1] : NULL;
    if (!before || !before->failed || !same_curve(&before->point, &list->items[i].point))
        return NULL;
    if (strncmp(before->failed, GIVEN_UP, sizeof GIVEN_UP - 1) == 0)
        return before->failed;
    if (strcmp(before->failed, TOO_SLOW) != 0 && strcmp(before->failed, TOO_LARGE) != 0)
        return NULL;
    return arena_printf(arena, "%s%s was %s", GIVEN_UP, sweep_point_name(&before->point, arena),
                        before->failed);
}

// Measures a point once. The picture of POV-Ray is read, that of ours is in shared. NULL: done.
static const char *measure_point(const Judge *judge, Scene *scene, Measured *m, int round,
                                 const SweepCopy *copy, SweepShared *shared, Image **picture,
                                 Arena *scratch) {
    const SweepOptions *o = judge->options;
    if (m->point.povray) {
        SweepPovray run = {0};
        const char *why = sweep_povray(o, copy, m->point.steps, &run, picture, scratch);
        m->picture[round] = run.seconds;
        m->megabytes = run.megabytes;
        shared->used = run.used;
        return why;
    }
    const char *why = sweep_measure(scene, o, &m->point, round ? NULL : &judge->edges, shared);
    m->prepare[round] = shared->prepare;
    m->trace[round] = shared->trace;
    m->picture[round] = shared->picture;
    m->megabytes = shared->megabytes;
    return why;
}

static void measure_round(const Judge *judge, Scene *scene, MeasuredList *list, int round,
                          const SweepCopy *copy, SweepShared *shared, Progress *progress,
                          Sweep *sweep, Arena *arena) {
    const SweepOptions *o = judge->options;
    Arena *scratch = arena_create();
    for (size_t i = 0; i < list->count; i++, progress_add(progress, 1)) {
        Measured *m = &list->items[i];
        SweepResult *r = &sweep->results[i];
        if (m->failed || m->spent || run_interrupted)
            continue;
        if (round == 0)
            m->failed = m->point.povray && !copy ? sweep->no_povray : give_up(list, i, arena);
        if (m->failed)
            continue;
        Image *picture = NULL;
        const char *why = measure_point(judge, scene, m, round, copy, shared, &picture, scratch);
        if (why && round == 0)
            m->failed = why;
        m->used += shared->used;
        m->spent = why || m->used + shared->used > o->patience;
        if (!why)
            m->rounds = round + 1;
        if (why || round > 0 || run_interrupted)
            continue;
        if (!m->point.povray) {
            picture = judge_image(shared, o, scratch);
            judge_hits(judge, shared, r);
        }
        judge_picture(judge, m->point.povray ? NULL : shared, picture, r);
    }
    arena_destroy(scratch);
}

static void summarize(const MeasuredList *list, const SweepOptions *o, Sweep *sweep) {
    for (size_t i = 0; i < list->count; i++) {
        const Measured *m = &list->items[i];
        SweepResult *r = &sweep->results[i];
        r->point = m->point;
        r->failed = m->failed;
        r->rounds = m->rounds;
        if (m->rounds == 0)
            continue;
        r->prepare = spread_of(m->prepare, m->rounds);
        r->trace = spread_of(m->trace, m->rounds);
        r->picture = spread_of(m->picture, m->rounds);
        r->megabytes = m->megabytes;
        if (r->trace.median > 0.0)
            r->rays_per_second = (double)o->width * o->height / r->trace.median;
    }
    find_front(sweep);
}

Sweep *sweep_run(const SweepOptions *o, Arena *arena) {
    run_catch_signals();
    Scene *scene = read_scene(o, arena);
    Sweep *sweep = ARENA_NEW(arena, Sweep);
    sweep->scene = arena_strdup(arena, o->scene);
    sweep->width = o->width;
    sweep->height = o->height;
    sweep->rounds = o->rounds;
    sweep->patience = o->patience;
    for (uint32_t i = 0; i < scene->object_count; i++)
        sweep->patches += scene->objects[i].type == OBJECT_PATCH;

    // The truth, and the maps: what POV-Ray's triangles as the scene has them are off.
    SweepShared *truth = sweep_shared_create(o->width, o->height);
    SweepShared *shared = sweep_shared_create(o->width, o->height);
    SweepPoint exact = {.method = METHOD_QI, .tolerance = TRUTH, .steps = -1},
               facets = {.method = METHOD_FACETS, .tolerance = 1e-9, .steps = -1};
    const char *why = sweep_measure(scene, o, &exact, NULL, truth);
    if (run_interrupted)
        return NULL;
    if (why)
        die("'%s' cannot be measured: its exact picture is %s", o->scene, why);
    Camera smooth = scene->camera;
    smooth.has_normal = false;
    CameraView view = camera_view(&smooth, NULL, o->width, o->height);
    Judge judge = {.options = o,
                   .truth = truth,
                   .footprint = footprint_create(&view, 1.0),
                   .diameter = judge_diameters(scene, arena),
                   .truth_picture = judge_image(truth, o, arena),
                   .edges = edges_find(scene, EDGE_RAYS, arena)};
    sweep->edges = judge.edges.edges;
    sweep->edge_rays = judge.edges.count;
    sweep->picture = judge.truth_picture;
    if (!sweep_measure(scene, o, &facets, NULL, shared))
        judge_maps(&judge, shared, sweep, arena);

    MeasuredList list = choose_points(o);
    sweep->count = list.count;
    sweep->results = ARENA_ARRAY(arena, SweepResult, list.count);
    SweepCopy copy;
    if (o->povray)
        sweep->no_povray = sweep_povray_begin(o, &copy, arena);
    if (o->povray && !sweep->no_povray)
        sweep->povray_version = copy.version;
    Progress progress = progress_begin("measuring", (uint64_t)o->rounds * list.count, true);
    for (int round = 0; round < o->rounds; round++)
        measure_round(&judge, scene, &list, round, o->povray && !sweep->no_povray ? &copy : NULL,
                      shared, &progress, sweep, arena);
    progress_end(&progress);
    if (o->povray && !sweep->no_povray)
        sweep_povray_end(&copy);
    summarize(&list, o, sweep);
    array_free(&list);
    sweep_shared_destroy(truth, o->width, o->height);
    sweep_shared_destroy(shared, o->width, o->height);
    return run_interrupted ? NULL : sweep;
}
