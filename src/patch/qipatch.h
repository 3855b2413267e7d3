// SPDX-License-Identifier: MIT
// libqipatch: rays against Bézier patches themselves, without triangles. The only public header.
//
// The order is Embree's: make a scene, attach patches, commit, then intersect or ask whether
// something is occluded, release. Names are Embree's where the thing is the same.
//
// Units. Points are in the caller's space, in double; nothing depends on its scale. dir may have
// any length, and t, tnear and tfar count in it: the hit is at org + t dir. (u, v) lie in [0,1]^2,
// u runs over the rows of the control points. Ng is of unit length, along dS/du x dS/dv; where that
// vanishes it is the limit from inside the patch.
//
// Accuracy. A hit is at most `bound` away from the patch's own point, |org + t dir - S(u,v)| <=
// bound, in the caller's units; bound is at most the scene's tolerance times the patch's diameter,
// or what rounding alone can do if that is more. No crossing is missed, also on edges that patches
// share, and none is made up beyond the tolerance.
//
// Where infinitely many points are on the ray (it lies in a flat patch, runs along a ruling, or the
// patch is a curve along it) the answer is the one with the smallest t of the range, within the
// tolerance; a patch that is one point or a curve across the ray is hit when the ray passes it by
// no more than rounding. The work of a ray at one patch is bounded.
//
// Errors. A call that can fail returns a QipatchError; qipatch_error_text() says more about the
// last one of the scene. Nothing is printed, and the program is never ended.
//
// Threads. One thread at a time makes, attaches, commits and releases a scene. From commit to
// release a scene does not change: any number of threads may intersect it at once. The commit uses
// as many threads as OpenMP has.
#ifndef QIPATCH_H
#define QIPATCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define QIPATCH_MAX_DEGREE 16
#define QIPATCH_INVALID_ID UINT32_MAX

typedef enum {
    QIPATCH_OK,
    QIPATCH_INVALID_ARGUMENT,  // a pointer, degree, point, weight or tolerance that cannot be
    QIPATCH_INVALID_OPERATION, // attach or commit after commit
    QIPATCH_OUT_OF_MEMORY,
} QipatchError;

typedef struct QipatchScene QipatchScene;

// tolerance: share of a patch's diameter, 1e-15 to 1; 0 stands for 1e-9. NULL when it is neither,
// or memory is out.
QipatchScene *qipatch_new_scene(double tolerance);
void qipatch_release_scene(QipatchScene *scene); // NULL is fine

typedef struct {
    unsigned degree_u, degree_v; // 1 to 16; 3 and 3 are fastest
    const double (*points)[3];   // (degree_u + 1) rows of (degree_v + 1) points; copied
    const double *weights;       // as many, > 0, up to 1e12 apart; NULL: polynomial; copied
    uint32_t mask; // a ray meets the patch when (mask & ray mask) != 0; 0 stands for all
} QipatchPatch;

// *id counts from 0 in the order of attaching; it may be NULL.
QipatchError qipatch_attach_patch(QipatchScene *scene, const QipatchPatch *patch, uint32_t *id);
QipatchError qipatch_commit_scene(QipatchScene *scene);

// Of the last call that returned an error; "" if none did. Lives as long as the scene.
const char *qipatch_error_text(const QipatchScene *scene);
// Low and high corner of the control points; false for an empty scene.
bool qipatch_scene_bounds(const QipatchScene *scene, double low[3], double high[3]);
size_t qipatch_scene_memory(const QipatchScene *scene); // bytes held

// The ray starts on a surface: a hit within its own bound of org is that surface and does not
// count. tnear must be 0 then.
#define QIPATCH_RAY_LEAVES 1u

typedef struct {
    double org[3], dir[3];
    double tnear, tfar; // a hit has tnear <= t < tfar; tfar may be INFINITY
    uint32_t mask;      // UINT32_MAX: all patches
    unsigned flags;
} QipatchRay;

typedef struct {
    double t, u, v, Ng[3], bound;
    uint32_t patchID; // QIPATCH_INVALID_ID: nothing was met
} QipatchHit;

// The nearest hit. False, and hit->patchID is QIPATCH_INVALID_ID, if there is none; so also for a
// ray that is not finite or has no direction, and before commit.
bool qipatch_intersect1(const QipatchScene *scene, const QipatchRay *ray, QipatchHit *hit);
// Is there any?
bool qipatch_occluded1(const QipatchScene *scene, const QipatchRay *ray);

// The same for N rays, any number, in one call, to the last bit. Rays that follow each other 16 at
// a time in the list, lie side by side and go the same way take half of the time to a quarter;
// others no more than alone. Rays whose valid[i] is 0 are left out (found: false); valid NULL: none
// is. hits[i] is as from qipatch_intersect1.
void qipatch_intersectN(const int *valid, const QipatchScene *scene, const QipatchRay *rays,
                        size_t N, QipatchHit *hits);
void qipatch_occludedN(const int *valid, const QipatchScene *scene, const QipatchRay *rays,
                       size_t N, bool *occluded);

#ifdef __cplusplus
}
#endif
#endif
