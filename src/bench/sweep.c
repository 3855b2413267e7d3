// SPDX-License-Identifier: MIT
#include "bench/sweep.h"

#include "base/array.h"
#include "base/diag.h"
#include "base/progress.h"
#include "bench/sweep_child.h"
#include "bench/sweep_povray.h"
#include "patch/embree.h"
#include "converter/convert.h"
#include "render/footprint.h"
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

// ---- Errors

typedef struct {
    const SweepOptions *options;
    const SweepShared *truth;
    Footprint footprint;
    double *diameter; // of each object's patch, 0: no patch
    Image *truth_picture;
    EdgeRays edges;
} Judge;

static double *find_diameters(const Scene *scene, Arena *arena) {
    double *diameter = ARENA_ARRAY(arena, double, scene->object_count);
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const PatchShape *patch = &scene->objects[i].shape.patch;
        if (scene->objects[i].type != OBJECT_PATCH)
            continue;
        Box box = box_empty();
        for (uint32_t k = 0; k < (patch->degree_u + 1) * (patch->degree_v + 1); k++)
            box = box_extend(box, patch->points[k]);
        diameter[i] = vec_length(vec_sub(box.high, box.low));
    }
    return diameter;
}

static Image *picture_of(const SweepShared *shared, const SweepOptions *o, Arena *arena) {
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){.width = o->width, .height = o->height, .channels = 3, .bits = 16};
    size_t count = 3 * (size_t)o->width * (size_t)o->height;
    image->pixels = arena_copy(arena, shared->pixels, count * sizeof(float));
    return image;
}

static void judge_picture(const Judge *judge, const Image *picture, SweepResult *r) {
    const ImageDifference d = image_compare(judge->truth_picture, picture, 1.0, 1.0);
    r->rms = 255.0 * d.rms;
    r->psnr = d.psnr;
    r->off = (double)d.different / (double)d.pixels;
}

// How far apart two hits on one ray are across the surface, and the angle of their normals.
static double distance_of(const SweepLook *truth, const SweepLook *look) {
    return fabs(look->t - truth->t) * fabs(vec_dot(truth->dir, truth->normal));
}

static double angle_of(const SweepLook *truth, const SweepLook *look) {
    Vec3 across = vec_cross(truth->normal, look->normal);
    return atan2(vec_length(across), vec_dot(truth->normal, look->normal)) * 180.0 / M_PI;
}

// The truth around a pixel is one surface without a step, and the ray went far through it.
static bool is_hole(const Judge *judge, const SweepShared *shared, size_t at) {
    const SweepLook *truth = &judge->truth->looks[at];
    double diameter = truth->object != NO_INDEX ? judge->diameter[truth->object] : 0.0;
    double step = 0.1 * diameter;
    if (!(diameter > 0.0) || !(shared->looks[at].t > truth->t + step))
        return false;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            const SweepLook *near = truth + (ptrdiff_t)y * judge->options->width + x;
            if (near->object == NO_INDEX || !(judge->diameter[near->object] > 0.0) ||
                !(fabs(near->t - truth->t) < step))
                return false;
        }
    return true;
}

static int count_holes(const Judge *judge, const SweepShared *shared) {
    int holes = 0;
    size_t width = (size_t)judge->options->width, height = (size_t)judge->options->height;
    for (size_t y = 1; y + 1 < height; y++)
        for (size_t x = 1; x + 1 < width; x++)
            holes += is_hole(judge, shared, y * width + x);
    return holes;
}

// t and the coordinates of both rays' starts are rounded to half a unit in the last place each, and
// added up in both hits: four units of the largest of them. In diameters of the patch.
static double rounding_of(const Judge *judge, const SweepLook *truth) {
    Vec3 eye = judge->footprint.eye;
    double most = fmax(truth->t, fmax(fabs(eye.x), fmax(fabs(eye.y), fabs(eye.z))));
    return 4.0 * 0x1p-52 * most / judge->diameter[truth->object];
}

static void judge_hits(const Judge *judge, const SweepShared *shared, SweepResult *r) {
    size_t pixels = (size_t)judge->options->width * (size_t)judge->options->height, both = 0;
    size_t wrong = 0, patches = 0;
    double squares = 0.0, angle_squares = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        const SweepLook *truth = &judge->truth->looks[i], *look = &shared->looks[i];
        bool on_patch = truth->object != NO_INDEX && judge->diameter[truth->object] > 0.0;
        bool now = look->object != NO_INDEX && judge->diameter[look->object] > 0.0;
        patches += on_patch || now;
        if (truth->object != look->object) {
            wrong += on_patch || now;
            continue;
        }
        if (!on_patch)
            continue;
        double distance = distance_of(truth, look), angle = angle_of(truth, look);
        double share = distance / judge->diameter[truth->object];
        double pixel = fmax(judge->footprint.angle * truth->t, judge->footprint.width);
        r->position_max = fmax(r->position_max, share);
        r->rounding = fmax(r->rounding, rounding_of(judge, truth));
        r->position_pixels = fmax(r->position_pixels, distance / pixel);
        r->normal_max = fmax(r->normal_max, angle);
        squares += share * share;
        angle_squares += angle * angle;
        both++;
    }
    if (both > 0) {
        r->position_rms = sqrt(squares / (double)both);
        r->normal_rms = sqrt(angle_squares / (double)both);
    }
    r->holes = count_holes(judge, shared);
    r->leaks = judge->edges.count > 0 ? (double)shared->leaks / (double)judge->edges.count : 0.0;
    r->wrong = patches > 0 ? (double)wrong / (double)patches : 0.0;
}

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

// ---- Maps

static Image *new_map(const SweepOptions *o, Arena *arena) {
    Image *map = ARENA_NEW(arena, Image);
    *map = (Image){.width = o->width, .height = o->height, .channels = 1, .bits = 32};
    map->pixels = ARENA_ARRAY(arena, float, (size_t)o->width *(size_t)o->height);
    return map;
}

static void make_maps(const Judge *judge, const SweepShared *facets, Sweep *sweep, Arena *arena) {
    const SweepOptions *o = judge->options;
    sweep->distance = new_map(o, arena);
    sweep->angle = new_map(o, arena);
    sweep->steps = new_map(o, arena);
    sweep->leaves = new_map(o, arena);
    for (size_t i = 0; i < (size_t)o->width * (size_t)o->height; i++) {
        const SweepLook *truth = &judge->truth->looks[i], *look = &facets->looks[i];
        sweep->steps->pixels[i] = (float)(truth->steps + truth->newton);
        sweep->leaves->pixels[i] = (float)truth->leaves;
        if (truth->object == NO_INDEX || truth->object != look->object ||
            !(judge->diameter[truth->object] > 0.0))
            continue;
        double pixel = fmax(judge->footprint.angle * truth->t, judge->footprint.width);
        sweep->distance->pixels[i] = (float)(distance_of(truth, look) / pixel);
        sweep->angle->pixels[i] = (float)angle_of(truth, look);
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

static void measure_round(const Judge *judge, Scene *scene, MeasuredList *list, int round,
                          const SweepCopy *copy, SweepShared *shared, Progress *progress,
                          Sweep *sweep) {
    const SweepOptions *o = judge->options;
    Arena *scratch = arena_create();
    for (size_t i = 0; i < list->count; i++, progress_add(progress, 1)) {
        Measured *m = &list->items[i];
        SweepResult *r = &sweep->results[i];
        if (m->failed || run_interrupted)
            continue;
        Image *picture = NULL;
        if (m->point.povray) {
            SweepPovray run = {0};
            m->failed = copy ? sweep_povray(o, copy, m->point.steps, &run, &picture, scratch)
                             : sweep->no_povray;
            m->picture[round] = run.seconds;
            m->megabytes = run.megabytes;
        } else {
            m->failed = sweep_measure(scene, o, &m->point, round ? NULL : &judge->edges, shared);
            m->prepare[round] = shared->prepare;
            m->trace[round] = shared->trace;
            m->picture[round] = shared->picture;
            m->megabytes = shared->megabytes;
        }
        if (m->failed || round > 0 || run_interrupted)
            continue;
        if (!m->point.povray) {
            picture = picture_of(shared, o, scratch);
            judge_hits(judge, shared, r);
        }
        judge_picture(judge, picture, r);
    }
    arena_destroy(scratch);
}

static void summarize(const MeasuredList *list, const SweepOptions *o, Sweep *sweep) {
    for (size_t i = 0; i < list->count; i++) {
        const Measured *m = &list->items[i];
        SweepResult *r = &sweep->results[i];
        r->point = m->point;
        r->failed = m->failed;
        r->prepare = spread_of(m->prepare, o->rounds);
        r->trace = spread_of(m->trace, o->rounds);
        r->picture = spread_of(m->picture, o->rounds);
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
                   .diameter = find_diameters(scene, arena),
                   .truth_picture = picture_of(truth, o, arena),
                   .edges = edges_find(scene, EDGE_RAYS, arena)};
    sweep->edges = judge.edges.edges;
    sweep->edge_rays = judge.edges.count;
    sweep->picture = judge.truth_picture;
    if (!sweep_measure(scene, o, &facets, NULL, shared))
        make_maps(&judge, shared, sweep, arena);

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
                      shared, &progress, sweep);
    progress_end(&progress);
    if (o->povray && !sweep->no_povray)
        sweep_povray_end(&copy);
    summarize(&list, o, sweep);
    array_free(&list);
    sweep_shared_destroy(truth, o->width, o->height);
    sweep_shared_destroy(shared, o->width, o->height);
    return run_interrupted ? NULL : sweep;
}
