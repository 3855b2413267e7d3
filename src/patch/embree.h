// SPDX-License-Identifier: MIT
// Embree 3 (package libembree-dev), loaded when it is asked for, and patches as triangles in it.
// Built without its headers, or run without its library, there is only the reason why not.
#ifndef PATCH_EMBREE_H
#define PATCH_EMBREE_H

#include "base/arena.h"
#include "patch/patch.h"

#include <stddef.h>

#ifndef EMBREE_HEADERS
#if __has_include(<embree3/rtcore.h>)
#define EMBREE_HEADERS 1
#else
#define EMBREE_HEADERS 0
#endif
#endif
#if EMBREE_HEADERS
#include <embree3/rtcore.h>
#endif

// NULL: it can be used; else a static text that names what is missing.
const char *embree_missing(void);

#if EMBREE_HEADERS

#define EMBREE_FUNCTIONS(X)                                                                        \
    X(rtcNewDevice)                                                                                \
    X(rtcReleaseDevice)                                                                            \
    X(rtcGetDeviceError)                                                                           \
    X(rtcSetDeviceMemoryMonitorFunction)                                                           \
    X(rtcNewScene)                                                                                 \
    X(rtcReleaseScene)                                                                             \
    X(rtcSetSceneFlags)                                                                            \
    X(rtcSetSceneBuildQuality)                                                                     \
    X(rtcCommitScene)                                                                              \
    X(rtcNewGeometry)                                                                              \
    X(rtcReleaseGeometry)                                                                          \
    X(rtcSetNewGeometryBuffer)                                                                     \
    X(rtcSetGeometryBuildQuality)                                                                  \
    X(rtcCommitGeometry)                                                                           \
    X(rtcAttachGeometry)                                                                           \
    X(rtcIntersect1)                                                                               \
    X(rtcIntersect16)                                                                              \
    X(rtcOccluded1)

typedef struct {
#define EMBREE_MEMBER(name) __typeof__(&name) name;
    EMBREE_FUNCTIONS(EMBREE_MEMBER)
#undef EMBREE_MEMBER
} Embree;

// The functions by their names. Only when nothing is missing.
const Embree *embree(void);

// Patches as one mesh of triangles, patch i cut cuts[i] times each way. Vertices count from center,
// so that single precision is relative to the set and not to its place.
typedef struct {
    RTCDevice device;
    RTCScene scene;
    Vec3 center;
    size_t patch_count;
    const uint32_t *cuts;  // the caller's
    uint32_t *first;       // triangle of each patch; patch_count + 1
    volatile size_t bytes; // what Embree holds, triangles and vertices included
} EmbreeMesh;

// High build quality. threads 0: all. The numbers lie in the arena; the rest goes with
// embree_mesh_release(). Dies when Embree does not accept it (out of memory).
EmbreeMesh *embree_mesh_create(Arena *arena, const PatchDef *defs, size_t count,
                               const uint32_t *cuts, enum RTCSceneFlags flags, int threads);
void embree_mesh_release(EmbreeMesh *mesh);

// The patch and its (u,v) of a hit: triangle number and the weights of its second and third corner.
uint32_t embree_mesh_place(const EmbreeMesh *mesh, uint32_t triangle, double a, double b, double *u,
                           double *v);

#endif
#endif
