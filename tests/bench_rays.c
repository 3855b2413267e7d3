// SPDX-License-Identifier: MIT
// How many rays a second: METHOD_QI beside Embree's triangles on the teapot of POV-Ray's examples,
// in turn within one run, one thread, user time. `make bench-rays`; arguments: rounds [threads
// [view [method]]].
//
// Three views: full and zoom are 1024x1024 cameras at (0,-10,1.5) along y with their windows on
// y = 0, in tiles of 4x4; scattered rays go at random through the bounding sphere.
#include "base/rng.h"
#include "patch/bezier.h"
#include "patch/patch.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef WITH_EMBREE
#include <embree3/rtcore.h>
#endif

enum { SIDE = 1024, RAYS = SIDE * SIDE, PATCHES = 32, CELLS = 32, GROUP = 16, MAX_ROUNDS = 21 };

typedef struct {
    const char *name;
    Ray *rays; // GROUP of them belong together
} View;

static Vec3 points[PATCHES][16];

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double wall(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool load_teapot(void) {
    FILE *f = fopen("/usr/share/doc/povray/examples/advanced/teapot/teapot.inc", "r");
    char line[1000];
    int count = 0;
    if (!f)
        return false;
    while (fgets(line, sizeof line, f)) {
        for (char *p = strstr(line, "//") ? NULL : line; p && (p = strchr(p, '<')) != NULL; p++) {
            Vec3 q;
            if (sscanf(p, "<%lf, %lf, %lf>", &q.x, &q.y, &q.z) == 3 && count < PATCHES * 16) {
                points[count / 16][count % 16] = q;
                count++;
            }
        }
    }
    fclose(f);
    return count == PATCHES * 16;
}

// ---- Rays

static void camera_view(View *view, double x0, double x1, double z0, double z1) {
    int n = 0;
    for (int y = 0; y < SIDE; y += 4)
        for (int x = 0; x < SIDE; x += 4)
            for (int k = 0; k < 16; k++) {
                double px = x0 + (x1 - x0) * (x + k % 4 + 0.5) / SIDE;
                double pz = z1 + (z0 - z1) * (y + k / 4 + 0.5) / SIDE;
                Vec3 org = vec3(0.0, -10.0, 1.5);
                view->rays[n++] = (Ray){org, vec_sub(vec3(px, 0.0, pz), org)};
            }
}

static Vec3 on_sphere(Rng *rng, Vec3 center, double radius) {
    for (;;) {
        Vec3 d = vec3(rng_range(rng, -1, 1), rng_range(rng, -1, 1), rng_range(rng, -1, 1));
        double length = vec_length(d);
        if (length > 0.1 && length < 1.0)
            return vec_madd(center, radius / length, d);
    }
}

static void scattered_view(View *view) {
    Rng rng = {1};
    Box box = box_empty();
    for (int i = 0; i < PATCHES * 16; i++)
        box = box_extend(box, points[i / 16][i % 16]);
    Vec3 center = vec_scale(vec_add(box.low, box.high), 0.5);
    double radius = 0.5 * vec_length(vec_sub(box.high, box.low));
    for (int i = 0; i < RAYS; i++) {
        Vec3 a = on_sphere(&rng, center, radius), b = on_sphere(&rng, center, radius);
        view->rays[i] = (Ray){a, vec_normalize(vec_sub(b, a))};
    }
}

// ---- What is measured: traces rays [first, last) and returns how many hit.

typedef long (*Tracer)(const void *scene, const View *view, long first, long last);

static long trace_qi(const void *scene, const View *view, long first, long last) {
    long hits = 0;
    for (long i = first; i < last; i++) {
        PatchHit hit;
        hits += patchset_intersect(scene, &view->rays[i], 0.0, INFINITY, 1, NULL, &hit);
    }
    return hits;
}

static long trace_qi_any(const void *scene, const View *view, long first, long last) {
    long hits = 0;
    for (long i = first; i < last; i++)
        hits += patchset_occluded(scene, &view->rays[i], 0.0, INFINITY, 1, NULL);
    return hits;
}

#ifdef WITH_EMBREE
static RTCScene embree_scene(RTCDevice device) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    size_t row = CELLS + 1, vertices = PATCHES * row * row;
    float *vertex = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            3 * sizeof(float), vertices);
    unsigned *index =
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), (size_t)PATCHES * CELLS * CELLS * 2);
    for (int p = 0; p < PATCHES; p++) {
        Bezier patch;
        bezier_init(&patch, 3, 3, points[p]);
        unsigned base = (unsigned)p * (unsigned)(row * row);
        for (int i = 0; i <= CELLS; i++)
            for (int j = 0; j <= CELLS; j++) {
                Vec3 s = bezier_eval(&patch, (double)i / CELLS, (double)j / CELLS);
                *vertex++ = (float)s.x;
                *vertex++ = (float)s.y;
                *vertex++ = (float)s.z;
                if (i == CELLS || j == CELLS)
                    continue;
                unsigned a = base + (unsigned)i * (unsigned)row + (unsigned)j;
                unsigned b = a + 1, c = a + (unsigned)row, d = c + 1;
                memcpy(index, (unsigned[]){a, b, c, b, d, c}, 6 * sizeof *index);
                index += 6;
            }
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene);
    return scene;
}

static long trace_embree(const void *scene, const View *view, long first, long last) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    long hits = 0;
    for (long i = first; i < last; i++) {
        const Ray *ray = &view->rays[i];
        struct RTCRayHit it = {.ray = {.org_x = (float)ray->org.x,
                                       .org_y = (float)ray->org.y,
                                       .org_z = (float)ray->org.z,
                                       .dir_x = (float)ray->dir.x,
                                       .dir_y = (float)ray->dir.y,
                                       .dir_z = (float)ray->dir.z,
                                       .tfar = INFINITY,
                                       .mask = UINT32_MAX}};
        it.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(*(const RTCScene *)scene, &context, &it);
        hits += it.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

static long trace_embree16(const void *scene, const View *view, long first, long last) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    static const _Alignas(64) int valid[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                               -1, -1, -1, -1, -1, -1, -1, -1};
    long hits = 0;
    for (long i = first; i < last; i += GROUP) {
        struct RTCRayHit16 it;
        for (int k = 0; k < GROUP; k++) {
            const Ray *ray = &view->rays[i + k];
            it.ray.org_x[k] = (float)ray->org.x;
            it.ray.org_y[k] = (float)ray->org.y;
            it.ray.org_z[k] = (float)ray->org.z;
            it.ray.dir_x[k] = (float)ray->dir.x;
            it.ray.dir_y[k] = (float)ray->dir.y;
            it.ray.dir_z[k] = (float)ray->dir.z;
            it.ray.tnear[k] = it.ray.time[k] = 0.0f;
            it.ray.tfar[k] = INFINITY;
            it.ray.mask[k] = UINT32_MAX;
            it.ray.flags[k] = 0;
            it.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, *(const RTCScene *)scene, &context, &it);
        for (int k = 0; k < GROUP; k++)
            hits += it.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}
#endif

typedef struct {
    const char *name;
    Tracer trace;
    const void *scene;
    double mrays[MAX_ROUNDS];
    long hits;
} Entry;

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void run(Entry *entry, const View *view, int round, int threads) {
    long hits = 0;
    double start = threads > 1 ? wall() : seconds();
    if (threads > 1) {
        enum { PART = 4096 };
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(+ : hits)
        for (long first = 0; first < RAYS; first += PART)
            hits += entry->trace(entry->scene, view, first, first + PART);
    } else {
        hits = entry->trace(entry->scene, view, 0, RAYS);
    }
    double used = (threads > 1 ? wall() : seconds()) - start;
    entry->mrays[round] = RAYS / used * 1e-6;
    entry->hits = hits;
}

int main(int argc, char **argv) {
    int rounds = argc > 1 ? atoi(argv[1]) : 5, threads = argc > 2 ? atoi(argv[2]) : 1;
    rounds = rounds < 1 ? 1 : rounds > MAX_ROUNDS ? MAX_ROUNDS : rounds;
    const char *only = argc > 3 ? argv[3] : NULL, *method = argc > 4 ? argv[4] : NULL;
    if (argc > 5 && patch_isa_choose(argv[5]) != PATCH_ISA_CHOSEN) {
        fprintf(stderr, "no such instruction set\n");
        return 2;
    }
    if (!load_teapot()) {
        fprintf(stderr, "the teapot of povray-examples is missing\n");
        return 1;
    }
    PatchSetOptions options = patchset_options_default();
    PatchSet *set = patchset_create(&options);
    for (int i = 0; i < PATCHES; i++) {
        PatchDef def = {.degree_u = 3,
                        .degree_v = 3,
                        .points = points[i],
                        .id = (uint32_t)i,
                        .mask = 1,
                        .u_steps = 5,
                        .v_steps = 5};
        patchset_add(set, &def);
    }
    double start = seconds();
    patchset_commit(set);
    printf("prepared in %.1f ms, %.2f MB\n", 1e3 * (seconds() - start),
           (double)patchset_memory(set) * 1e-6);
    Entry entries[8] = {{"qi", trace_qi, set, {0}, 0}, {"qi any", trace_qi_any, set, {0}, 0}};
    int count = 2;
#ifdef WITH_EMBREE
    RTCDevice device = rtcNewDevice("threads=1");
    start = seconds();
    RTCScene triangles = embree_scene(device);
    printf("Embree: prepared in %.1f ms\n", 1e3 * (seconds() - start));
    entries[count++] = (Entry){"embree", trace_embree, &triangles, {0}, 0};
    entries[count++] = (Entry){"embree 16", trace_embree16, &triangles, {0}, 0};
#endif
    View views[3] = {{"full", NULL}, {"zoom", NULL}, {"scattered", NULL}};
    for (int i = 0; i < 3; i++)
        views[i].rays = malloc(sizeof(Ray) * RAYS);
    camera_view(&views[0], -3.6, 3.6, -2.1, 5.1);
    camera_view(&views[1], -1.35, 1.35, 0.15, 2.2);
    scattered_view(&views[2]);
    for (int i = 0; i < 3; i++) {
        if (only && strcmp(only, views[i].name) != 0)
            continue;
        for (int round = 0; round < rounds; round++)
            for (int e = 0; e < count; e++)
                if (!method || strcmp(method, entries[e].name) == 0)
                    run(&entries[e], &views[i], round, threads);
        printf("%-9s", views[i].name);
        for (int e = 0; e < count; e++) {
            qsort(entries[e].mrays, (size_t)rounds, sizeof(double), by_value);
            printf("  %s %.2f Mray/s (%ld hits)", entries[e].name, entries[e].mrays[rounds / 2],
                   entries[e].hits);
        }
        printf("\n");
    }
    for (int i = 0; i < 3; i++)
        free(views[i].rays);
    patchset_destroy(set);
    return 0;
}
