// SPDX-License-Identifier: MIT
// The door of libqipatch: checks what patch.h takes for granted, and catches what it dies of.
#include "patch/qipatch.h"

#include "base/diag.h"
#include "patch/bezier.h"
#include "patch/patch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct QipatchScene {
    PatchSet *set;
    uint32_t count;
    bool committed;
    char error[160];
};

static QipatchError refuse(QipatchScene *scene, QipatchError error, const char *text) {
    snprintf(scene->error, sizeof scene->error, "%s", text);
    return error;
}

// Everything inside dies for one reason only: memory is out.
static QipatchError guarded(QipatchScene *scene, void (*body)(void *), void *arg) {
    char *message = NULL;
    if (diag_catch(body, arg, &message))
        return QIPATCH_OK;
    refuse(scene, QIPATCH_OUT_OF_MEMORY, message);
    free(message);
    return QIPATCH_OUT_OF_MEMORY;
}

static void create(void *arg) {
    PatchSetOptions options = patchset_options_default();
    double tolerance = *(const double *)*(void **)arg;
    if (tolerance > 0.0)
        options.tolerance = tolerance;
    *(void **)arg = patchset_create(&options);
}

QipatchScene *qipatch_new_scene(double tolerance) {
    if (tolerance != 0.0 && !(tolerance >= 1e-15 && tolerance <= 1.0))
        return NULL;
    QipatchScene *scene = calloc(1, sizeof *scene);
    void *arg = &tolerance;
    if (!scene || guarded(scene, create, &arg) != QIPATCH_OK) {
        free(scene);
        return NULL;
    }
    scene->set = arg;
    return scene;
}

void qipatch_release_scene(QipatchScene *scene) {
    if (!scene)
        return;
    patchset_destroy(scene->set);
    free(scene);
}

typedef struct {
    PatchSet *set;
    const PatchDef *def;
} Attach;

static void attach(void *arg) {
    const Attach *a = arg;
    patchset_add(a->set, a->def);
}

// What is wrong with a patch, or NULL.
static const char *fault_of(const QipatchPatch *patch, char text[160]) {
    if (!patch || !patch->points)
        return "no patch or no points";
    if (patch->degree_u < 1 || patch->degree_u > QIPATCH_MAX_DEGREE || patch->degree_v < 1 ||
        patch->degree_v > QIPATCH_MAX_DEGREE)
        return "the degrees must lie between 1 and 16";
    size_t count = (size_t)(patch->degree_u + 1) * (patch->degree_v + 1);
    double least = INFINITY, most = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double *p = patch->points[i];
        if (!vec_is_finite(vec3(p[0], p[1], p[2]))) {
            snprintf(text, 160, "point %zu is not finite", i);
            return text;
        }
        if (patch->weights && !(isfinite(patch->weights[i]) && patch->weights[i] > 0.0)) {
            snprintf(text, 160, "weight %zu is not a finite number above 0", i);
            return text;
        }
        least = fmin(least, patch->weights ? patch->weights[i] : 1.0);
        most = fmax(most, patch->weights ? patch->weights[i] : 1.0);
    }
    if (!(most / least > BEZIER_MAX_WEIGHTS))
        return NULL;
    snprintf(text, 160, "the weights differ by more than %g", BEZIER_MAX_WEIGHTS);
    return text;
}

QipatchError qipatch_attach_patch(QipatchScene *scene, const QipatchPatch *patch, uint32_t *id) {
    char text[160];
    if (!scene)
        return QIPATCH_INVALID_ARGUMENT;
    if (scene->committed)
        return refuse(scene, QIPATCH_INVALID_OPERATION, "the scene is committed");
    const char *fault = fault_of(patch, text);
    if (fault)
        return refuse(scene, QIPATCH_INVALID_ARGUMENT, fault);
    Vec3 points[(QIPATCH_MAX_DEGREE + 1) * (QIPATCH_MAX_DEGREE + 1)];
    size_t count = (size_t)(patch->degree_u + 1) * (patch->degree_v + 1);
    for (size_t i = 0; i < count; i++)
        points[i] = vec3(patch->points[i][0], patch->points[i][1], patch->points[i][2]);
    PatchDef def = {.degree_u = patch->degree_u,
                    .degree_v = patch->degree_v,
                    .points = points,
                    .weights = patch->weights,
                    .id = scene->count,
                    .mask = patch->mask ? patch->mask : UINT32_MAX};
    Attach arg = {scene->set, &def};
    QipatchError error = guarded(scene, attach, &arg);
    if (error == QIPATCH_OK) {
        if (id)
            *id = scene->count;
        scene->count++;
    }
    return error;
}

static void commit(void *set) { patchset_commit(set); }

QipatchError qipatch_commit_scene(QipatchScene *scene) {
    if (!scene)
        return QIPATCH_INVALID_ARGUMENT;
    if (scene->committed)
        return refuse(scene, QIPATCH_INVALID_OPERATION, "the scene is committed");
    QipatchError error = guarded(scene, commit, scene->set);
    scene->committed = error == QIPATCH_OK;
    return error;
}

const char *qipatch_error_text(const QipatchScene *scene) {
    return scene ? scene->error : "there is no scene";
}

bool qipatch_scene_bounds(const QipatchScene *scene, double low[3], double high[3]) {
    if (!scene || scene->count == 0)
        return false;
    Box box = patchset_bounds(scene->set);
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = vec_get(box.low, axis);
        high[axis] = vec_get(box.high, axis);
    }
    return true;
}

size_t qipatch_scene_memory(const QipatchScene *scene) {
    return scene ? (size_t)patchset_memory(scene->set) + sizeof *scene : 0;
}

static Ray ray_of(const QipatchRay *ray) {
    return (Ray){vec3(ray->org[0], ray->org[1], ray->org[2]),
                 vec3(ray->dir[0], ray->dir[1], ray->dir[2])};
}

static QipatchHit hit_of(const PatchHit *hit) {
    return (QipatchHit){hit->t,     hit->u, hit->v, {hit->normal.x, hit->normal.y, hit->normal.z},
                        hit->bound, hit->id};
}

bool qipatch_intersect1(const QipatchScene *scene, const QipatchRay *ray, QipatchHit *hit) {
    PatchHit found;
    Ray own = ray_of(ray);
    bool leaves = ray->flags & QIPATCH_RAY_LEAVES, any = false;
    hit->patchID = QIPATCH_INVALID_ID;
    if (!scene || !scene->committed)
        return false;
    if (leaves)
        any = patchset_intersect_leaving(scene->set, &own, ray->tfar, ray->mask, NULL, &found);
    else
        any = patchset_intersect(scene->set, &own, ray->tnear, ray->tfar, ray->mask, NULL, &found);
    if (any)
        *hit = hit_of(&found);
    return any;
}

bool qipatch_occluded1(const QipatchScene *scene, const QipatchRay *ray) {
    Ray own = ray_of(ray);
    PatchHit hit;
    if (!scene || !scene->committed)
        return false;
    if (ray->flags & QIPATCH_RAY_LEAVES)
        return patchset_intersect_leaving(scene->set, &own, ray->tfar, ray->mask, NULL, &hit);
    return patchset_occluded(scene->set, &own, ray->tnear, ray->tfar, ray->mask, NULL);
}

// ---- Many rays

// A packet of those that can be asked together: the others have mask 0.
typedef struct {
    Ray rays[PATCH_PACKET];
    PatchRange ranges[PATCH_PACKET];
    size_t count;
} Together;

static bool is_valid(const int *valid, size_t i) { return !valid || valid[i]; }

static void gather(const int *valid, const QipatchRay *rays, Together *out) {
    for (size_t i = 0; i < out->count; i++) {
        bool asked = is_valid(valid, i) && !(rays[i].flags & QIPATCH_RAY_LEAVES);
        // What is left out may be no ray at all.
        out->rays[i] = asked ? ray_of(&rays[i]) : (Ray){{0, 0, 0}, {0, 0, 1}};
        out->ranges[i] =
            asked ? (PatchRange){rays[i].tnear, rays[i].tfar, rays[i].mask} : (PatchRange){0, 0, 0};
    }
}

void qipatch_intersectN(const int *valid, const QipatchScene *scene, const QipatchRay *rays,
                        size_t N, QipatchHit *hits) {
    for (size_t at = 0; at < N; at += PATCH_PACKET) {
        Together some = {.count = N - at < PATCH_PACKET ? N - at : PATCH_PACKET};
        bool found[PATCH_PACKET] = {false};
        PatchHit best[PATCH_PACKET];
        gather(valid ? valid + at : NULL, rays + at, &some);
        if (scene && scene->committed)
            patchset_intersect_many(scene->set, some.rays, some.ranges, some.count, NULL, found,
                                    best);
        for (size_t i = 0; i < some.count; i++) {
            hits[at + i].patchID = QIPATCH_INVALID_ID;
            if (found[i])
                hits[at + i] = hit_of(&best[i]);
            else if (is_valid(valid, at + i) && rays[at + i].flags & QIPATCH_RAY_LEAVES)
                qipatch_intersect1(scene, &rays[at + i], &hits[at + i]);
        }
    }
}

void qipatch_occludedN(const int *valid, const QipatchScene *scene, const QipatchRay *rays,
                       size_t N, bool *occluded) {
    for (size_t at = 0; at < N; at += PATCH_PACKET) {
        Together some = {.count = N - at < PATCH_PACKET ? N - at : PATCH_PACKET};
        bool found[PATCH_PACKET] = {false};
        gather(valid ? valid + at : NULL, rays + at, &some);
        if (scene && scene->committed)
            patchset_occluded_many(scene->set, some.rays, some.ranges, some.count, NULL, found);
        for (size_t i = 0; i < some.count; i++)
            occluded[at + i] =
                found[i] || (is_valid(valid, at + i) && rays[at + i].flags & QIPATCH_RAY_LEAVES &&
                             qipatch_occluded1(scene, &rays[at + i]));
    }
}
