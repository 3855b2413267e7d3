// SPDX-License-Identifier: MIT
// Loading by name keeps the programs that do not ask for Embree as quick to start as they were.
#include "patch/embree.h"

#if !EMBREE_HEADERS

const char *embree_missing(void) {
    return "Embree was not there when this program was built (package libembree-dev)";
}

#else

#include "base/diag.h"
#include "patch/bezier.h"

#include <dlfcn.h>

static Embree functions;

static const char *load(void) {
    void *library = dlopen("libembree3.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return "Embree's library cannot be loaded (package libembree3-3)";
        // Through a pointer to the member: C has no cast from objects to functions.
#define EMBREE_LOAD(name)                                                                          \
    *(void **)&functions.name = dlsym(library, #name);                                             \
    if (!functions.name)                                                                           \
        return "Embree's library lacks " #name;
    EMBREE_FUNCTIONS(EMBREE_LOAD)
#undef EMBREE_LOAD
    return NULL;
}

const char *embree_missing(void) {
    static bool tried;
    static const char *missing;
#pragma omp critical(embree)
    if (!tried) {
        missing = load();
        tried = true;
    }
    return missing;
}

const Embree *embree(void) { return &functions; }

// ---- Triangles

static bool count_bytes(void *context, ssize_t bytes, bool post) {
    (void)post;
    EmbreeMesh *mesh = context;
    __atomic_add_fetch(&mesh->bytes, (size_t)bytes, __ATOMIC_RELAXED);
    return true;
}

static void check(const EmbreeMesh *mesh) {
    enum RTCError error = functions.rtcGetDeviceError(mesh->device);
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        die("Embree is out of memory");
    if (error != RTC_ERROR_NONE)
        die("Embree reports error %d", (int)error);
}

static void fill_vertices(const EmbreeMesh *mesh, const PatchDef *def, uint32_t cuts, float *out) {
    Bezier patch;
    bezier_init(&patch, (int)def->degree_u, (int)def->degree_v, def->points);
    for (uint32_t i = 0; i <= cuts; i++) {
        for (uint32_t j = 0; j <= cuts; j++, out += 3) {
            Vec3 p = bezier_eval(&patch, (double)i / cuts, (double)j / cuts);
            p = vec_sub(p, mesh->center);
            out[0] = (float)p.x;
            out[1] = (float)p.y;
            out[2] = (float)p.z;
        }
    }
}

// Two triangles a square: (i,j) (i+1,j) (i,j+1), and (i+1,j+1) (i,j+1) (i+1,j).
static void fill_triangles(uint32_t cuts, uint32_t first_vertex, uint32_t *out) {
    uint32_t row = cuts + 1;
    for (uint32_t i = 0; i < cuts; i++) {
        for (uint32_t j = 0; j < cuts; j++, out += 6) {
            uint32_t at = first_vertex + i * row + j;
            out[0] = at;
            out[1] = out[5] = at + row;
            out[2] = out[4] = at + 1;
            out[3] = at + row + 1;
        }
    }
}

EmbreeMesh *embree_mesh_create(Arena *arena, const PatchDef *defs, size_t count,
                               const uint32_t *cuts, enum RTCSceneFlags flags, int threads) {
    EmbreeMesh *mesh = ARENA_NEW(arena, EmbreeMesh);
    mesh->patch_count = count;
    mesh->cuts = cuts;
    mesh->first = ARENA_ARRAY(arena, uint32_t, count + 1);
    uint32_t *first_vertex = ARENA_ARRAY(arena, uint32_t, count + 1);
    Box box = box_empty();
    for (size_t i = 0; i < count; i++) {
        mesh->first[i + 1] = mesh->first[i] + 2 * cuts[i] * cuts[i];
        first_vertex[i + 1] = first_vertex[i] + (cuts[i] + 1) * (cuts[i] + 1);
        for (uint32_t k = 0; k < (defs[i].degree_u + 1) * (defs[i].degree_v + 1); k++)
            box = box_extend(box, defs[i].points[k]);
    }
    if (count)
        mesh->center = vec_add(vec_scale(box.low, 0.5), vec_scale(box.high, 0.5));

    mesh->device = functions.rtcNewDevice(threads == 1 ? "threads=1" : NULL);
    functions.rtcSetDeviceMemoryMonitorFunction(mesh->device, count_bytes, mesh);
    mesh->scene = functions.rtcNewScene(mesh->device);
    functions.rtcSetSceneFlags(mesh->scene, flags);
    functions.rtcSetSceneBuildQuality(mesh->scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = functions.rtcNewGeometry(mesh->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    functions.rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    if (count) {
        float *vertices = functions.rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                            RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                            first_vertex[count]);
        uint32_t *triangles =
            functions.rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(uint32_t), mesh->first[count]);
        check(mesh);
#pragma omp parallel for schedule(dynamic, 1)
        for (size_t i = 0; i < count; i++) {
            fill_vertices(mesh, &defs[i], cuts[i], vertices + (size_t)3 * first_vertex[i]);
            fill_triangles(cuts[i], first_vertex[i], triangles + (size_t)3 * mesh->first[i]);
        }
        functions.rtcCommitGeometry(geometry);
        functions.rtcAttachGeometry(mesh->scene, geometry);
    }
    functions.rtcReleaseGeometry(geometry);
    functions.rtcCommitScene(mesh->scene);
    check(mesh);
    return mesh;
}

void embree_mesh_release(EmbreeMesh *mesh) {
    functions.rtcReleaseScene(mesh->scene);
    functions.rtcReleaseDevice(mesh->device);
}

uint32_t embree_mesh_place(const EmbreeMesh *mesh, uint32_t triangle, double a, double b, double *u,
                           double *v) {
    size_t low = 0, high = mesh->patch_count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (mesh->first[middle] <= triangle)
            low = middle;
        else
            high = middle;
    }
    uint32_t cuts = mesh->cuts[low], local = triangle - mesh->first[low];
    uint32_t square = local / 2, i = square / cuts, j = square % cuts;
    // The second triangle counts from the opposite corner.
    double along_u = local % 2 ? 1.0 - a : a, along_v = local % 2 ? 1.0 - b : b;
    *u = fmin(fmax((i + along_u) / cuts, 0.0), 1.0);
    *v = fmin(fmax((j + along_v) / cuts, 0.0), 1.0);
    return (uint32_t)low;
}

#endif
