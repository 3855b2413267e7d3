// SPDX-License-Identifier: MIT
// The picture is cut into tiles of POV-Ray's size and order; threads take the next free one. Each
// thread has its own tracer and sampler, and a tile's pixels depend on nothing but the tile.
#include "render/render.h"

#include "base/diag.h"
#include "base/hash.h"
#include "base/progress.h"
#include "base/usage.h"
#include "render/aov.h"
#include "render/film.h"
#include "render/resume.h"
#include "render/story.h"
#include "render/trace.h"

#include <limits.h>
#include <math.h>
#include <omp.h>
#include <unistd.h>

// A pixel's memory until its file is written: the colour (20 bytes), the developed values (16), the
// bytes for the encoder (8) and the encoder's own (8 or so, at worst a little more than stored).
enum { PIXEL_BYTES = 64 };

void render_check(const RenderOptions *o) {
    if (o->width < 1 || o->height < 1)
        die("a picture of %d x %d pixels cannot be rendered: +W and +H must be at least 1",
            o->width, o->height);
    double pixels = (double)o->width * o->height, bytes = pixels * PIXEL_BYTES;
    double machine = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    if (pixels > INT_MAX)
        die("a picture of %d x %d pixels cannot be rendered: the limit is %d pixels in all",
            o->width, o->height, INT_MAX);
    if (machine > 0 && bytes > machine)
        die("a picture of %d x %d pixels cannot be rendered: it needs %.1f GB (%d bytes a pixel), "
            "this machine has %.1f GB",
            o->width, o->height, bytes / 1e9, PIXEL_BYTES, machine / 1e9);

    PixelRect area = render_area(o);
    if (area.left < 0 || area.left >= o->width)
        die("the start column (+SC%g) lies outside the picture", o->start_column);
    if (area.right < 1 || area.right > o->width)
        die("the end column (+EC%g) lies outside the picture", o->end_column);
    if (area.top < 0 || area.top >= o->height)
        die("the start row (+SR%g) lies outside the picture", o->start_row);
    if (area.bottom < 1 || area.bottom > o->height)
        die("the end row (+ER%g) lies outside the picture", o->end_row);
}

// A start below 1 and an end up to 1 are shares of the size; else they count from 1, both
// inclusive. Single precision, as POV-Ray hands its options around. Both clipped to what an int
// holds.
static int first_of(double start, int size) {
    double s = (double)(float)start;
    if (start < 0)
        return 0;
    return (int)fmin(s < 1.0 ? floor(size * s) : floor(s) - 1.0, INT_MAX);
}

static int past_of(double end, int size) {
    double e = (double)(float)end;
    if (end < 0)
        return size;
    return (int)fmin(e <= 1.0 ? floor(size * e) : floor(e), INT_MAX);
}

PixelRect render_area(const RenderOptions *o) {
    return (PixelRect){.left = first_of(o->start_column, o->width),
                       .top = first_of(o->start_row, o->height),
                       .right = past_of(o->end_column, o->width),
                       .bottom = past_of(o->end_row, o->height)};
}

static SampleOptions sample_options(const Scene *scene, const RenderOptions *o) {
    SampleOptions s = {.method = o->antialias ? o->sampling_method : 0,
                       .depth = o->antialias_depth,
                       .threshold = (double)(float)o->antialias_threshold,
                       .jitter = o->jitter ? (double)(float)o->jitter_amount : 0.0,
                       .nudge = {o->nudge[0], o->nudge[1]}};
    s.eye =
        transfer_between(curve_working(&scene->settings), curve_power((float)o->antialias_gamma));
    return s;
}

static void add_stats(RayStats *sum, const RayStats *one) {
    sum->primary += one->primary;
    sum->reflected += one->reflected;
    sum->refracted += one->refracted;
    sum->transmitted += one->transmitted;
    sum->shadow += one->shadow;
    sum->shape_tests += one->shape_tests;
    sum->shape_hits += one->shape_hits;
    sum->patch.patch_tests += one->patch.patch_tests;
    sum->patch.steps += one->patch.steps;
    sum->patch.newton += one->patch.newton;
    sum->patch.hits += one->patch.hits;
}

static Color trace_with(void *tracer, const Ray *ray) { return tracer_trace(tracer, ray); }

static void foresee_with(void *tracer, const Ray *rays, size_t across, size_t down) {
    tracer_foresee(tracer, rays, across, down);
}

// The tiles of one render, and what its threads share.
typedef struct {
    const Scene *scene;
    const RenderOptions *options;
    const Shading *shading;
    PixelRect area;
    int block, across, count;
    Color *picture;
    Resume *resume; // NULL: nothing is kept
    Progress progress;
} Job;

volatile sig_atomic_t render_interrupted;

static PixelRect tile_at(const void *context, int i) {
    const Job *job = context;
    PixelRect t = {.left = job->area.left + i % job->across * job->block,
                   .top = job->area.top + i / job->across * job->block};
    int right = job->area.right - t.left, bottom = job->area.bottom - t.top;
    t.right = t.left + (right < job->block ? right : job->block);
    t.bottom = t.top + (bottom < job->block ? bottom : job->block);
    return t;
}

// Preparing a patch in full takes about 250 us more than lightly, and saves about 12 ns a ray
// (lattices of teapots): that pays from 20,000 rays a patch on. A pixel is taken for four rays,
// wherever it is in the picture and however many threads there are, so that parts of a picture have
// the same bytes.
static PatchPrepare prepare_of(const Scene *scene, const RenderOptions *o) {
    const double rays_per_pixel = 4.0, rays_per_patch = 20000.0;
    if (o->prepare_given)
        return o->prepare;
    uint32_t patches = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        patches += scene->objects[i].type == OBJECT_PATCH;
    double rays = rays_per_pixel * o->width * o->height;
    return rays < rays_per_patch * patches ? PREPARE_LIGHT : PREPARE_FULL;
}

// What decides on the colours of a tile beside the scene.
static uint64_t identity_of(const void *context) {
    const Job *job = context;
    const Scene *scene = job->scene;
    const RenderOptions *o = job->options;
    const double facts[] = {o->width,           o->height,          o->start_row,
                            o->end_row,         o->start_column,    o->end_column,
                            o->block_size,      o->antialias,       o->antialias_threshold,
                            o->sampling_method, o->antialias_depth, o->jitter,
                            o->jitter_amount,   o->antialias_gamma, o->quality,
                            o->alpha,           o->method,          o->finer,
                            o->tolerance,       o->pixels,          prepare_of(scene, o),
                            o->nudge[0],        o->nudge[1]};
    return hash_bytes(scene_hash(scene), facts, sizeof facts);
}

static void begin_resume(Job *job) {
    const RenderOptions *o = job->options;
    if (!o->state)
        return;
    const ResumeJob resume = {.identity = identity_of,
                              .width = o->width,
                              .tile_count = job->count,
                              .tile = tile_at,
                              .context = job,
                              .picture = job->picture};
    job->resume = resume_create(o->state, &resume, o->continue_trace);
}

// What is finished stays for the next run.
static void end_resume(Job *job, RenderStats *stats) {
    stats->interrupted = render_interrupted;
    stats->share = (double)job->progress.done / (double)job->progress.total;
    if (!job->resume)
        return;
    stats->kept = render_interrupted && resume_keep(job->resume);
    resume_destroy(job->resume);
}

static void render_tiles(Job *job, RenderStats *stats) {
    const RenderOptions *o = job->options;
    SampleOptions samples = sample_options(job->scene, o);
    samples.textures = shading_textures(job->shading);
#pragma omp parallel num_threads(stats->threads)
    {
        Tracer *tracer = tracer_create(job->shading);
        Sampler *sampler =
            sampler_create(&samples, &job->scene->camera, o->width, o->height, job->block);
        sampler_foresee(sampler, foresee_with);
#pragma omp for schedule(dynamic, 1)
        for (int i = 0; i < job->count; i++) {
            PixelRect tile = tile_at(job, i);
            if (render_interrupted)
                continue;
            uint64_t pixels =
                (uint64_t)(tile.right - tile.left) * (uint64_t)(tile.bottom - tile.top);
            if (job->resume && resume_has(job->resume, i)) {
#pragma omp atomic
                stats->taken_up += pixels;
            } else {
                sampler_tile(sampler, tile, trace_with, tracer, job->picture);
                if (job->resume)
                    resume_tile(job->resume, i);
            }
            progress_add(&job->progress, pixels);
        }
#pragma omp critical(render_stats)
        {
            RayStats own = tracer_stats(tracer);
            add_stats(&stats->rays, &own);
            stats->samples += sampler_rays(sampler);
            stats->supersampled += sampler_pixels(sampler);
        }
        sampler_destroy(sampler);
        tracer_destroy(tracer);
    }
}

// What is lost of one pixel goes to others behind it: one after the other. BMP files begin with the
// last row.
static void develop_dithered(const Film *film, const Color *picture, const RenderOptions *o,
                             float *values) {
    Arena *scratch = arena_create();
    DitherMethod method = o->dither_method == DITHER_NONE ? DITHER_FS : o->dither_method;
    Dither *dither = dither_create(method, o->width, scratch);
    for (int i = 0; i < o->height; i++) {
        int y = o->format == IMAGE_BMP ? o->height - 1 - i : i;
        for (int x = 0; x < o->width; x++) {
            size_t at = (size_t)y * (size_t)o->width + (size_t)x;
            film_develop_dithered(film, dither, x, y, picture[at],
                                  values + at * (size_t)film_channels(film));
        }
    }
    arena_destroy(scratch);
}

static Image *develop(const Film *film, const Color *picture, const RenderOptions *o,
                      Arena *arena) {
    Image *image = ARENA_NEW(arena, Image);
    *image = (Image){.width = o->width,
                     .height = o->height,
                     .channels = film_channels(film),
                     .bits = film->floats     ? 32
                             : film->bits > 8 ? 16
                                              : 8};
    size_t channels = (size_t)image->channels, width = (size_t)o->width;
    image->pixels = ARENA_ARRAY(arena, float, width *(size_t)o->height *channels);
    // JPEG has its own losses, and files of floats are not rounded.
    if (o->dither && !film->floats && o->format != IMAGE_JPEG) {
        develop_dithered(film, picture, o, image->pixels);
        return image;
    }
#pragma omp parallel for schedule(static)
    for (int y = 0; y < o->height; y++)
        for (size_t x = 0; x < width; x++) {
            size_t at = (size_t)y * width + x;
            film_develop(film, picture[at], image->pixels + at * channels);
        }
    return image;
}

PatchSetOptions render_patch_options(const Scene *scene, const RenderOptions *o,
                                     Footprint *footprint) {
    PatchSetOptions patches = patchset_options_default();
    if (o->pixels > 0.0) {
        Camera smooth = scene->camera;
        smooth.has_normal = false; // what bends its rays does not change how fine the picture is
        CameraView view = camera_view(&smooth, NULL, o->width, o->height);
        *footprint = footprint_create(&view, o->pixels);
        patches.tolerance_of = footprint_tolerance;
        patches.context = footprint;
    }
    patches.method = o->method;
    patches.tolerance = o->tolerance;
    patches.prepare = prepare_of(scene, o);
    patches.finer = o->finer;
    return patches;
}

static bool asks_uv(const Scene *scene) {
    bool any = false;
    for (uint32_t i = 0; i < scene->object_count; i++)
        any |= scene->objects[i].uv_mapping;
    for (uint32_t i = 0; i < scene->texture_count; i++)
        any |= scene->textures[i].uv_mapping;
    for (uint32_t i = 0; i < scene->pigment_count; i++)
        any |= scene->pigments[i].uv_mapping;
    for (uint32_t i = 0; i < scene->normal_count; i++)
        any |= scene->normals[i].uv_mapping;
    return any;
}

// All tiles of the area; nothing if that is empty.
static void trace_area(Job *job, RenderStats *stats) {
    const RenderOptions *o = job->options;
    int wide = job->area.right - job->area.left, high = job->area.bottom - job->area.top;
    if (wide <= 0 || high <= 0)
        return;
    int longest = wide > high ? wide : high;
    job->block = o->block_size < longest ? o->block_size : longest;
    job->across = (wide + job->block - 1) / job->block;
    job->count = job->across * ((high + job->block - 1) / job->block);
    stats->pixels = (uint64_t)wide * (uint64_t)high;
    if (stats->threads > job->count)
        stats->threads = job->count;
    job->progress =
        progress_begin("rendering", stats->pixels, o->verbose && o->console[CONSOLE_RENDER]);
    begin_resume(job);
    double work = usage_process();
    render_tiles(job, stats);
    stats->work_seconds = usage_process() - work;
    progress_end(&job->progress);
    end_resume(job, stats);
}

Image *render_scene(const Scene *scene, const RenderOptions *o, Arena *arena,
                    ImageWriteOptions *write, RenderStats *stats) {
    *stats = (RenderStats){.threads = o->threads > 0 ? o->threads : omp_get_num_procs()};
    // For all that is prepared in parallel as well; threads that wait for work cost time too.
    omp_set_num_threads(stats->threads);

    // Prepare the world.
    double start = usage_clock();
    Footprint footprint;
    PatchSetOptions patches = render_patch_options(scene, o, &footprint);
    World *world = world_create(scene, &patches);
    if (!o->aovs && !asks_uv(scene))
        world_without_uv(world);
    const TraceOptions trace = {.quality = o->quality, .alpha = o->alpha, .patches = patches};
    Shading *shading = shading_create(scene, world, &trace);
    stats->memory = world_memory(world);
    for (uint32_t i = 0; i < scene->object_count; i++)
        stats->patches += scene->objects[i].type == OBJECT_PATCH;
    stats->prepare_seconds = usage_clock() - start;

    // What lies outside the area stays as it is: black, and opaque.
    start = usage_clock();
    Arena *scratch = arena_create();
    Job job = {.scene = scene, .options = o, .shading = shading, .area = render_area(o)};
    job.picture = ARENA_ARRAY(scratch, Color, (size_t)o->width * (size_t)o->height);

    trace_area(&job, stats);
    stats->trace_seconds = usage_clock() - start;

    // Develop the film.
    Film film =
        film_create(&scene->settings, o->format, o->bits, o->grayscale, o->alpha, o->file_gamma);
    film_prepare(&film, scratch);
    Image *image = render_interrupted ? NULL : develop(&film, job.picture, o, arena);
    *write = (ImageWriteOptions){.format = o->format,
                                 .bits = film.bits,
                                 .compressed = o->compressed,
                                 .gamma = film.header_gamma,
                                 .srgb = film.header_srgb};
    if (image && o->aovs) {
        const CameraView view =
            camera_view(&scene->camera, shading_textures(shading), o->width, o->height);
        stats->layers = aov_render(scene, world, &view, o, job.picture, arena);
    }
    arena_destroy(scratch);
    shading_destroy(shading);
    world_destroy(world);
    return image;
}

void render_pixel(const Scene *scene, const RenderOptions *o, FILE *out) {
    int x = o->pixel[0], y = o->pixel[1];
    if (x >= o->width || y >= o->height)
        die("pixel %d,%d lies outside the picture: it has %d x %d, counted from 0", x, y, o->width,
            o->height);
    Footprint footprint;
    PatchSetOptions patches = render_patch_options(scene, o, &footprint);
    World *world = world_create(scene, &patches);
    const TraceOptions trace = {.quality = o->quality, .alpha = o->alpha, .patches = patches};
    Shading *shading = shading_create(scene, world, &trace);
    Color color = story_of_pixel(scene, shading, o->width, o->height, x, y, out);
    Film film =
        film_create(&scene->settings, o->format, o->bits, o->grayscale, o->alpha, o->file_gamma);
    float values[4];
    film_develop(&film, color, values);
    fputs("in the file, without anti-aliasing:", out);
    double full = film.floats ? 1.0 : (double)((1u << film.bits) - 1u);
    for (int i = 0; i < film_channels(&film); i++)
        fprintf(out, " %.9g", (double)values[i] * full);
    putc('\n', out);
    shading_destroy(shading);
    world_destroy(world);
}
