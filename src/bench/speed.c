// SPDX-License-Identifier: MIT
// See speed.h. An entry is one thing to measure; rounds go through all entries in turn, so that
// whatever else the machine does falls on all of them.
#include "bench/speed.h"

#include "base/array.h"
#include "base/diag.h"
#include "base/progress.h"
#include "base/usage.h"
#include "bench/tracers.h"
#include "patch/bezier.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROUNDS = 21, CUTS = 32 };

SpeedOptions speed_options_default(void) {
    return (SpeedOptions){
        .rounds = 5, .share = 1.0, .view = -1, .method = -1, .max_patches = 1000000};
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const double *values, int count) {
    double sorted[MAX_ROUNDS];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, by_value);
    return sorted[count / 2];
}

// Groups of VIEW_GROUP rays, spread evenly over the view, are share of all.
typedef struct {
    const char *name;
    double tolerance; // 0: does not apply
    Tracer trace;
    const void *scene;
    double share;
    double rate[VIEW_COUNT][MAX_ROUNDS]; // rays a second
} Entry;

static void measure(Entry *entry, View view, int round, const Ray *rays) {
    long step = (long)fmax(1.0, rint(1.0 / entry->share)), count = 0;
    double start = usage_process();
    if (step == 1) {
        entry->trace(entry->scene, rays, VIEW_RAYS);
        count = VIEW_RAYS;
    } else {
        for (long i = 0; i < VIEW_RAYS; i += VIEW_GROUP * step, count += VIEW_GROUP)
            entry->trace(entry->scene, rays + i, VIEW_GROUP);
    }
    entry->rate[view][round] = (double)count / (usage_process() - start);
}

static PatchSet *committed(const Vec3 *points, size_t patches, PatchMethod method,
                           PatchPrepare prepare, double tolerance) {
    PatchSetOptions options = patchset_options_default();
    options.method = method;
    options.prepare = prepare;
    options.tolerance = tolerance;
    PatchSet *set = set_of_points(points, patches, &options);
    patchset_commit(set);
    return set;
}

// ---- Embree

static void fill_defs(const Vec3 *points, PatchDef defs[TEAPOT_PATCHES]) {
    for (int i = 0; i < TEAPOT_PATCHES; i++)
        defs[i] = (PatchDef){.degree_u = 3, .degree_v = 3, .points = points + 16 * i, .mask = 1};
}

#if EMBREE_HEADERS
static EmbreeMesh *teapot_mesh(Arena *arena, const Vec3 *points, const uint32_t *cuts) {
    PatchDef *defs = ARENA_ARRAY(arena, PatchDef, TEAPOT_PATCHES);
    fill_defs(points, defs);
    return embree_mesh_create(arena, defs, TEAPOT_PATCHES, cuts, RTC_SCENE_FLAG_NONE, 1);
}
#endif

// ---- Tables

// peers: Embree's single rays and packets, or NULL.
static void print_rates(const char *name, const char *tolerance, const Entry *entry,
                        const Entry *peers, const SpeedOptions *o) {
    bool packets = peers && entry->trace == trace_set_packets;
    const Entry *peer = peers ? &peers[packets] : NULL;
    printf("| %s | %s |", name, tolerance);
    for (int view = 0; view < VIEW_COUNT; view++) {
        if (o->view >= 0 && o->view != view)
            continue;
        double rate = median(entry->rate[view], o->rounds);
        printf(" %.3g", rate * 1e-6);
        if (peer && peer != entry)
            printf(" (%.2f)", rate / median(peer->rate[view], o->rounds));
        printf(" |");
    }
    printf("\n");
}

typedef ARRAY(Entry) Entries;

// Embree's single rays and packets, if it is there.
static void add_embree(Entries *entries, Arena *arena, const Vec3 *points, double share) {
    const char *missing = embree_missing();
    if (missing) {
        printf("%s\n\n", missing);
        return;
    }
#if EMBREE_HEADERS
    uint32_t cuts[TEAPOT_PATCHES];
    for (int i = 0; i < TEAPOT_PATCHES; i++)
        cuts[i] = CUTS;
    EmbreeMesh *mesh = teapot_mesh(arena, points, cuts);
    array_push(entries, ((Entry){.name = "Embree, triangles 32x32 a patch",
                                 .trace = trace_embree,
                                 .scene = mesh,
                                 .share = share}));
    array_push(entries, ((Entry){.name = "the same, packets of 16",
                                 .trace = trace_embree_packets,
                                 .scene = mesh,
                                 .share = share}));
#else
    (void)entries, (void)arena, (void)points, (void)share;
#endif
}

static void add_methods(Entries *entries, const Vec3 *points, const SpeedOptions *o) {
    static const double tolerances[] = {1e-3, 1e-6, 1e-9, 1e-12};
    static const PatchMethod methods[] = {METHOD_QI, METHOD_CLIPPING, METHOD_NEWTON,
                                          METHOD_QI_PAPER};
    for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
        for (int t = 0; t < 4; t++) {
            double tolerance = o->tolerance > 0.0 ? o->tolerance : tolerances[t];
            if ((o->method >= 0 && o->method != (int)methods[m]) || (o->tolerance > 0.0 && t > 0))
                continue;
            // A hundred times slower than the others: one group in 64 will do.
            double share = o->share * (methods[m] == METHOD_QI_PAPER ? 1.0 / 64 : 1.0);
            const PatchSet *set =
                committed(points, TEAPOT_PATCHES, methods[m], (PatchPrepare)o->prepare, tolerance);
            Entry entry = {.name = patch_method_name(methods[m]),
                           .tolerance = tolerance,
                           .trace = trace_set,
                           .scene = set,
                           .share = share};
            array_push(entries, entry);
            if (methods[m] == METHOD_QI) {
                entry.name = "qi, packets of 16";
                entry.trace = trace_set_packets;
                array_push(entries, entry);
            }
        }
    }
}

// The entries take turns, view by view.
static void measure_all(Entries *entries, Arena *arena, const Vec3 *points, const SpeedOptions *o) {
    Box box = points_bounds(points, (size_t)TEAPOT_PATCHES * 16);
    uint64_t views = o->view >= 0 ? 1 : VIEW_COUNT;
    Progress progress =
        progress_begin("methods", views * (uint64_t)o->rounds * entries->count, true);
    for (int view = 0; view < VIEW_COUNT; view++) {
        if (o->view >= 0 && o->view != view)
            continue;
        const Ray *rays = view_rays(arena, (View)view, box);
        for (int round = 0; round < o->rounds; round++) {
            for (size_t i = 0; i < entries->count; i++, progress_add(&progress, 1))
                measure(&entries->items[i], (View)view, round, rays);
        }
    }
    progress_end(&progress);
}

static void print_methods(const Entries *entries, const Entry *peers, const SpeedOptions *o) {
    printf("qi with the instructions %s.\n\n", patch_isa_name());
    printf("| nearest hits, million rays a second (share of Embree's single rays; qi's packets: of "
           "its packets) | tolerance |");
    for (int view = 0; view < VIEW_COUNT; view++) {
        if (o->view < 0 || o->view == view)
            printf(" %s |", view_name((View)view));
    }
    printf("\n|---|---|%s\n", o->view < 0 ? "---|---|---|" : "---|");
    for (size_t i = 0; i < entries->count; i++) {
        const Entry *e = &entries->items[i];
        char tolerance[32] = "";
        if (e->tolerance > 0.0)
            snprintf(tolerance, sizeof tolerance, "%g", e->tolerance);
        print_rates(e->name, tolerance, e, peers, o);
    }
}

static void destroy_entries(Entries *entries) {
    for (size_t i = 0; i < entries->count; i++) {
        const Entry *e = &entries->items[i];
        if (e->trace == trace_set)
            patchset_destroy((PatchSet *)e->scene);
#if EMBREE_HEADERS
        if (e->trace == trace_embree)
            embree_mesh_release((EmbreeMesh *)e->scene);
#endif
    }
    array_free(entries);
}

void speed_methods(const SpeedOptions *o) {
    Arena *arena = arena_create();
    const Vec3 *points = teapot_points(arena);
    Entries entries = {0};
    add_embree(&entries, arena, points, o->share);
    const bool has_peers = entries.count > 0;
    add_methods(&entries, points, o);
    measure_all(&entries, arena, points, o);
    print_methods(&entries, has_peers ? entries.items : NULL, o);
    destroy_entries(&entries);
    arena_destroy(arena);
}

// ---- Time to picture

typedef struct {
    double prepare, trace, megabytes;
} Picture;

static Picture qi_picture(const Vec3 *points, PatchPrepare prepare, double error, const Ray *rays) {
    Picture p;
    double start = usage_process();
    PatchSet *set = committed(points, TEAPOT_PATCHES, METHOD_QI, prepare, error);
    p.prepare = usage_process() - start;
    start = usage_process();
    trace_set(set, rays, VIEW_RAYS);
    p.trace = usage_process() - start;
    p.megabytes = (double)patchset_memory(set) * 1e-6;
    patchset_destroy(set);
    return p;
}

#if EMBREE_HEADERS
// The largest distance of a patch from its triangles, 32 cuts each way, at the middles of their
// sides, where it is largest.
static double triangle_error(const Vec3 *points) {
    Bezier patch;
    bezier_init(&patch, 3, 3, points);
    double most = 0.0, h = 1.0 / CUTS;
    for (int i = 0; i < CUTS; i++) {
        for (int j = 0; j < CUTS; j++) {
            double u = i * h, v = j * h;
            static const double ends[3][4] = {{0, 0, 1, 0}, {0, 0, 0, 1}, {1, 0, 0, 1}};
            for (int k = 0; k < 3; k++) {
                const double *e = ends[k];
                Vec3 a = bezier_eval(&patch, u + e[0] * h, v + e[1] * h);
                Vec3 b = bezier_eval(&patch, u + e[2] * h, v + e[3] * h);
                Vec3 s =
                    bezier_eval(&patch, u + 0.5 * (e[0] + e[2]) * h, v + 0.5 * (e[1] + e[3]) * h);
                most = fmax(most, vec_length(vec_sub(s, vec_scale(vec_add(a, b), 0.5))));
            }
        }
    }
    return most;
}

// The error falls with the square of the cuts.
static void cuts_for_error(const Vec3 *points, double error, uint32_t cuts[TEAPOT_PATCHES]) {
    for (int i = 0; i < TEAPOT_PATCHES; i++) {
        Box box = points_bounds(points + 16 * i, 16);
        double allowed = error * vec_length(vec_sub(box.high, box.low));
        cuts[i] = (uint32_t)ceil(CUTS * sqrt(triangle_error(points + 16 * i) / allowed));
        cuts[i] = cuts[i] < 1 ? 1 : cuts[i];
    }
}

static Picture embree_picture(const Vec3 *points, const uint32_t *cuts, const Ray *rays) {
    Arena *arena = arena_create();
    Picture p;
    double start = usage_process();
    EmbreeMesh *mesh = teapot_mesh(arena, points, cuts);
    p.prepare = usage_process() - start;
    start = usage_process();
    trace_embree(mesh, rays, VIEW_RAYS);
    p.trace = usage_process() - start;
    p.megabytes = (double)mesh->bytes * 1e-6;
    embree_mesh_release(mesh);
    arena_destroy(arena);
    return p;
}
#endif

static Picture median_picture(const Picture *pictures, int count) {
    double prepare[MAX_ROUNDS], trace[MAX_ROUNDS];
    for (int i = 0; i < count; i++) {
        prepare[i] = pictures[i].prepare;
        trace[i] = pictures[i].trace;
    }
    return (Picture){median(prepare, count), median(trace, count), pictures[0].megabytes};
}

static void print_picture(const char *name, double error, Picture p) {
    printf("| %g | %s | %.3f | %.3f | %.3f | %.2f |\n", error, name, p.prepare, p.trace,
           p.prepare + p.trace, p.megabytes);
}

void speed_picture(const SpeedOptions *o) {
    static const double errors[] = {1e-3, 1e-6};
    Arena *arena = arena_create();
    const Vec3 *points = teapot_points(arena);
    const Ray *rays = view_rays(arena, VIEW_FULL, points_bounds(points, 16));
    omp_set_num_threads(1);
    printf(
        "| error, of the diameter | full view, one thread | preparation, s | rays, s | together, s "
        "| memory, MB |\n|---|---|---|---|---|---|\n");
    for (int e = 0; e < 2; e++) {
        Picture qi[MAX_ROUNDS];
#if EMBREE_HEADERS
        Picture peer[MAX_ROUNDS];
        uint32_t cuts[TEAPOT_PATCHES];
        if (!embree_missing())
            cuts_for_error(points, errors[e], cuts);
#endif
        Progress progress = progress_begin("picture", (uint64_t)o->rounds, true);
        for (int round = 0; round < o->rounds; round++, progress_add(&progress, 1)) {
            qi[round] = qi_picture(points, (PatchPrepare)o->prepare, errors[e], rays);
#if EMBREE_HEADERS
            // What takes longer than this once is not measured again.
            if (!embree_missing() && round > 0 && peer[0].prepare > 5.0)
                peer[round] = peer[0];
            else if (!embree_missing())
                peer[round] = embree_picture(points, cuts, rays);
#endif
        }
        progress_end(&progress);
        Picture ours = median_picture(qi, o->rounds);
        print_picture("qi", errors[e], ours);
#if EMBREE_HEADERS
        if (!embree_missing()) {
            uint64_t triangles = 0;
            for (int i = 0; i < TEAPOT_PATCHES; i++)
                triangles += 2 * (uint64_t)cuts[i] * cuts[i];
            Picture theirs = median_picture(peer, o->rounds);
            char name[64];
            snprintf(name, sizeof name, "Embree, %llu triangles", (unsigned long long)triangles);
            print_picture(name, errors[e], theirs);
            printf("| | Embree / qi | %.2f | %.2f | %.2f | %.1f |\n", theirs.prepare / ours.prepare,
                   theirs.trace / ours.trace,
                   (theirs.prepare + theirs.trace) / (ours.prepare + ours.trace),
                   theirs.megabytes / ours.megabytes);
        }
#endif
    }
    omp_set_num_threads(omp_get_num_procs());
    arena_destroy(arena);
}

// ---- Lattices, threads

void speed_lattices(const SpeedOptions *o) {
    static const struct {
        size_t size;
        PatchPrepare prepare;
    } rows[] = {{32, PREPARE_FULL},
                {1000, PREPARE_FULL},
                {32000, PREPARE_FULL},
                {1000000, PREPARE_FULL},
                {1000000, PREPARE_LIGHT}};
    printf("| patches | prepared | preparation, s | of the clock, %d threads, s | memory, MB | "
           "scattered rays "
           "that hit | "
           "ns a ray |\n|---|---|---|---|---|---|---|\n",
           omp_get_num_procs());
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const size_t size = rows[i].size;
        const PatchPrepare how = o->prepare ? (PatchPrepare)o->prepare : rows[i].prepare;
        if (size > o->max_patches)
            continue;
        Arena *arena = arena_create();
        const Vec3 *points = lattice_points(arena, size);
        const Ray *rays = view_rays(arena, VIEW_SCATTERED, points_bounds(points, 16 * size));
        double start = usage_process(), clock = usage_clock();
        PatchSet *set = committed(points, size, METHOD_QI, how, 1e-9);
        double prepare = usage_process() - start;
        clock = usage_clock() - clock;
        double used[MAX_ROUNDS];
        long hits = 0;
        Progress progress = progress_begin("lattice", (uint64_t)o->rounds, true);
        for (int round = 0; round < o->rounds; round++, progress_add(&progress, 1)) {
            start = usage_process();
            hits = trace_set(set, rays, VIEW_RAYS);
            used[round] = usage_process() - start;
        }
        progress_end(&progress);
        printf("| %zu | %s | %.3f | %.3f | %.1f | %.1f %% | %.0f |\n", size,
               patch_prepare_name(how), prepare, clock, (double)patchset_memory(set) * 1e-6,
               100.0 * (double)hits / VIEW_RAYS, 1e9 * median(used, o->rounds) / VIEW_RAYS);
        patchset_destroy(set);
        arena_destroy(arena);
    }
}

void speed_threads(const SpeedOptions *o) {
    Arena *arena = arena_create();
    const Vec3 *points = teapot_points(arena);
    const Ray *rays = view_rays(arena, VIEW_ZOOM, points_bounds(points, 16));
    PatchSet *set = committed(points, TEAPOT_PATCHES, METHOD_QI, (PatchPrepare)o->prepare, 1e-9);
    double used[2][MAX_ROUNDS];
    Progress progress = progress_begin("threads", (uint64_t)o->rounds, true);
    for (int round = 0; round < o->rounds; round++, progress_add(&progress, 1)) {
        for (int threads = 1; threads <= 2; threads++) {
            double start = usage_clock();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
            for (long first = 0; first < VIEW_RAYS; first += 4096)
                trace_set(set, rays + first, 4096);
            used[threads - 1][round] = usage_clock() - start;
        }
    }
    progress_end(&progress);
    double one = median(used[0], o->rounds), two = median(used[1], o->rounds);
    printf(
        "Zoom at 1e-9 takes %.3f s of the clock with one thread and %.3f s with two: %.2f times as "
        "fast.\n",
        one, two, one / two);
    patchset_destroy(set);
    arena_destroy(arena);
}
