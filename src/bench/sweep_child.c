// SPDX-License-Identifier: MIT
#include "bench/sweep_child.h"

#include "base/diag.h"
#include "base/usage.h"
#include "bench/tracers.h"
#include "render/camera.h"
#include "render/render.h"
#include "report/run.h"

#include <errno.h>
#include <math.h>
#include <omp.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const double LEAST_TIME = 0.1; // seconds

static size_t shared_size(int width, int height) {
    size_t pixels = (size_t)width * (size_t)height;
    return sizeof(SweepShared) + pixels * (sizeof(SweepLook) + 3 * sizeof(float));
}

SweepShared *sweep_shared_create(int width, int height) {
    void *memory = mmap(NULL, shared_size(width, height), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        die("out of memory");
    SweepShared *shared = memory;
    shared->looks = (SweepLook *)(void *)(shared + 1);
    shared->pixels = (float *)(void *)(shared->looks + (size_t)width * (size_t)height);
    return shared;
}

void sweep_shared_destroy(SweepShared *shared, int width, int height) {
    munmap(shared, shared_size(width, height));
}

static void look_around(const Scene *scene, const World *world, int width, int height,
                        SweepLook *looks) {
    Camera smooth = scene->camera;
    smooth.has_normal = false; // the same ray through each pixel for everybody
    const CameraView view = camera_view(&smooth, NULL, width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            SweepLook *look = &looks[(size_t)y * (size_t)width + (size_t)x];
            *look = (SweepLook){.t = INFINITY, .object = NO_INDEX};
            Ray ray;
            RayStats stats = {0};
            WorldHit hit;
            if (!camera_ray(&view, x, y, &ray))
                continue;
            look->dir = ray.dir;
            if (world_intersect(world, &ray, 0.0, INFINITY, RAY_CAMERA, &stats, &hit)) {
                look->t = hit.t;
                look->normal = hit.normal;
                look->object = hit.object;
            }
            look->leaves = (uint32_t)stats.patch.patch_tests;
            look->steps = (uint32_t)stats.patch.steps;
            look->newton = (uint32_t)stats.patch.newton;
        }
}

// What this process holds in memory now.
static double resident_megabytes(void) {
    unsigned long whole, resident = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (f && fscanf(f, "%lu %lu", &whole, &resident) != 2)
        resident = 0;
    if (f)
        fclose(f);
    return (double)resident * (double)sysconf(_SC_PAGESIZE) / 1048576.0;
}

static size_t count_leaks(const Scene *scene, const PatchSetOptions *options,
                          const EdgeRays *edges) {
    PatchSet *set = patchset_create(options);
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const PatchShape *patch = &scene->objects[i].shape.patch;
        if (scene->objects[i].type != OBJECT_PATCH || patch->weights)
            continue;
        const PatchDef def = {.degree_u = patch->degree_u,
                              .degree_v = patch->degree_v,
                              .points = patch->points,
                              .id = i,
                              .mask = 1,
                              .flatness = patch->flatness,
                              .u_steps = patch->u_steps,
                              .v_steps = patch->v_steps};
        patchset_add(set, &def);
    }
    patchset_commit(set);
    size_t leaks = edges_leaks(edges, set);
    patchset_destroy(set);
    return leaks;
}

static void put_picture(const Scene *scene, const RenderOptions *render, float *pixels) {
    Arena *arena = arena_create();
    ImageWriteOptions write;
    RenderStats stats;
    const Image *image = render_scene(scene, render, arena, &write, &stats);
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++)
        memcpy(&pixels[3 * i], &image->pixels[(size_t)image->channels * i], 3 * sizeof(float));
    arena_destroy(arena);
}

static void measure(const Scene *scene, const SweepOptions *o, const SweepPoint *point,
                    const EdgeRays *edges, SweepShared *shared) {
    double before = resident_megabytes(); // what is inherited
    PatchSetOptions patches = patchset_options_default();
    patches.method = point->method;
    patches.tolerance = point->tolerance;
    patches.prepare = point->prepare;
    double start = usage_process();
    World *world = world_create(scene, &patches);
    shared->prepare = usage_process() - start;
    // Again and again until the clock, which may tick 250 times a second, can tell.
    int times = 0;
    start = usage_process();
    do {
        look_around(scene, world, o->width, o->height, shared->looks);
        shared->trace = (usage_process() - start) / ++times;
    } while (shared->trace * times < LEAST_TIME);
    world_destroy(world);

    RenderOptions render = options_default();
    render.width = o->width;
    render.height = o->height;
    render.threads = 1;
    render.verbose = false;
    render.bits = 16;
    render.method = point->method;
    render.tolerance = point->tolerance;
    render.prepare = point->prepare;
    render.prepare_given = true;
    times = 0;
    start = usage_process();
    do {
        put_picture(scene, &render, shared->pixels);
        shared->picture = (usage_process() - start) / ++times;
    } while (shared->picture * times < LEAST_TIME);
    shared->megabytes = usage_peak_megabytes() - before;
    if (edges)
        shared->leaks = count_leaks(scene, &patches, edges);
    shared->done = true;
}

// The child's side: one processor, one thread, not for longer than patience.
_Noreturn static void be_child(const Scene *scene, const SweepOptions *o, const SweepPoint *point,
                               const EdgeRays *edges, SweepShared *shared) {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(0, &one);
    sched_setaffinity(0, sizeof one, &one);
    rlim_t seconds = (rlim_t)ceil(o->patience);
    const struct rlimit limit = {seconds, seconds + 1};
    setrlimit(RLIMIT_CPU, &limit);
    omp_set_num_threads(1);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    measure(scene, o, point, edges, shared);
    fflush(NULL);
    _exit(0);
}

static void set_steps(Scene *scene, const SweepPoint *point) {
    for (uint32_t i = 0; i < scene->object_count; i++) {
        Object *object = &scene->objects[i];
        if (object->type != OBJECT_PATCH || point->steps < 0)
            continue;
        object->shape.patch.u_steps = object->shape.patch.v_steps = point->steps;
        object->shape.patch.flatness = point->flatness;
    }
}

static double seconds_of(const struct timeval *time) {
    return (double)time->tv_sec + 1e-6 * (double)time->tv_usec;
}

const char *sweep_measure(Scene *scene, const SweepOptions *o, const SweepPoint *point,
                          const EdgeRays *edges, SweepShared *shared) {
    set_steps(scene, point);
    shared->done = false;
    fflush(NULL);
    pid_t child = fork();
    if (child < 0)
        die("cannot start a process: %s", strerror(errno));
    if (child == 0)
        be_child(scene, o, point, edges, shared);
    int status;
    struct rusage use;
    run_end_with_us(child);
    while (wait4(child, &status, 0, &use) < 0)
        if (errno != EINTR)
            die("cannot wait for a process: %s", strerror(errno));
    run_end_with_us(0);
    shared->used = seconds_of(&use.ru_utime) + seconds_of(&use.ru_stime);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return "too slow";
    return shared->done ? NULL : "ended with an error";
}
