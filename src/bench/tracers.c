// SPDX-License-Identifier: MIT
#include "bench/tracers.h"

#include <math.h>

long trace_set(const void *set, const Ray *rays, long count) {
    long hits = 0;
    for (long i = 0; i < count; i++) {
        PatchHit hit;
        hits += patchset_intersect(set, &rays[i], 0.0, INFINITY, 1, NULL, &hit);
    }
    return hits;
}

long trace_set_packets(const void *set, const Ray *rays, long count) {
    long hits = 0;
    PatchHit hit[PATCH_PACKET];
    bool found[PATCH_PACKET];
    for (long first = 0; first < count; first += PATCH_PACKET) {
        long some = count - first < PATCH_PACKET ? count - first : PATCH_PACKET;
        patchset_intersect_many(set, rays + first, NULL, (size_t)some, NULL, found, hit);
        for (long i = 0; i < some; i++)
            hits += found[i];
    }
    return hits;
}

#if !EMBREE_HEADERS

long trace_embree(const void *mesh, const Ray *rays, long count) {
    (void)mesh, (void)rays, (void)count;
    return 0;
}

long trace_embree_packets(const void *mesh, const Ray *rays, long count) {
    (void)mesh, (void)rays, (void)count;
    return 0;
}

#else

long trace_embree(const void *scene, const Ray *rays, long count) {
    const EmbreeMesh *mesh = scene;
    const Embree *e = embree();
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    long hits = 0;
    for (long i = 0; i < count; i++) {
        const Ray *ray = &rays[i];
        struct RTCRayHit it;
        it.ray = (struct RTCRay){.org_x = (float)(ray->org.x - mesh->center.x),
                                 .org_y = (float)(ray->org.y - mesh->center.y),
                                 .org_z = (float)(ray->org.z - mesh->center.z),
                                 .dir_x = (float)ray->dir.x,
                                 .dir_y = (float)ray->dir.y,
                                 .dir_z = (float)ray->dir.z,
                                 .tfar = INFINITY,
                                 .mask = UINT32_MAX};
        it.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        e->rtcIntersect1(mesh->scene, &context, &it);
        hits += it.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

long trace_embree_packets(const void *scene, const Ray *rays, long count) {
    const EmbreeMesh *mesh = scene;
    const Embree *e = embree();
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    static const _Alignas(64) int valid[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                               -1, -1, -1, -1, -1, -1, -1, -1};
    long hits = 0;
    for (long i = 0; i + 16 <= count; i += 16) {
        struct RTCRayHit16 it;
        for (int k = 0; k < 16; k++) {
            const Ray *ray = &rays[i + k];
            it.ray.org_x[k] = (float)(ray->org.x - mesh->center.x);
            it.ray.org_y[k] = (float)(ray->org.y - mesh->center.y);
            it.ray.org_z[k] = (float)(ray->org.z - mesh->center.z);
            it.ray.dir_x[k] = (float)ray->dir.x;
            it.ray.dir_y[k] = (float)ray->dir.y;
            it.ray.dir_z[k] = (float)ray->dir.z;
            it.ray.tnear[k] = it.ray.time[k] = 0.0f;
            it.ray.tfar[k] = INFINITY;
            it.ray.mask[k] = UINT32_MAX;
            it.ray.flags[k] = 0;
            it.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        e->rtcIntersect16(valid, mesh->scene, &context, &it);
        for (int k = 0; k < 16; k++)
            hits += it.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

#endif
