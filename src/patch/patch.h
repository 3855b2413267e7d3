// SPDX-License-Identifier: MIT
// Ray against Bézier patches: one interface, several methods. The mathematics is in bezier.h and
// quasi.h, the methods in qi.c (the paper), accel.c (the fast path), facets.c (POV-Ray's
// triangles).
//
// Units: points in world space, t in lengths of the ray's dir, (u, v) in [0,1]^2 with u weighting
// the rows of the control points (POV-Ray's first index).
#ifndef PATCH_PATCH_H
#define PATCH_PATCH_H

#include "base/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// ORDER patch_method (names in patchset.c)
typedef enum {
    METHOD_QI,           // sub-patches, tree, QI bounds: the product
    METHOD_QI_PAPER,     // the paper's loop, double, no shortcuts
    METHOD_CLIPPING,     // Bézier clipping
    METHOD_NEWTON,       // Newton from the middles of refined sub-patches
    METHOD_FACETS,       // POV-Ray's own triangles
    METHOD_TESSELLATION, // Embree over triangles, where Embree is installed
    METHOD_COUNT,
} PatchMethod;

const char *patch_method_name(PatchMethod method);
bool patch_method_parse(const char *name, PatchMethod *method); // false: no such method

// METHOD_QI is compiled for several instruction sets: scalar, avx2, avx512. They give the same
// bits. The best that this machine can run is used unless another is chosen here, before any thread
// traces. name NULL: the best.
typedef enum { PATCH_ISA_CHOSEN, PATCH_ISA_UNKNOWN, PATCH_ISA_UNUSABLE } PatchIsa;
PatchIsa patch_isa_choose(const char *name);
const char *patch_isa_name(void); // of the one in use

typedef struct {
    uint32_t degree_u, degree_v; // 1..16
    const Vec3 *points;          // (degree_u + 1) * (degree_v + 1), row by row; copied
    const double *weights;       // of the points, > 0 and finite; NULL: all 1 (copied as well)
    uint32_t id;                 // the caller's, comes back in hits
    uint32_t mask;               // a ray meets the patch when (ray mask & mask) != 0
    double tolerance;            // of a hit, scene units; 0: the set's share of the diameter
    double flatness;             // facets only, as are the steps
    int u_steps, v_steps;
} PatchDef;

typedef struct {
    double t, u, v;
    Vec3 normal;  // unit, along dS/du x dS/dv (facets: interpolated as POV-Ray does)
    double bound; // |org + t dir - S(u,v)| <= bound, in scene units (facets: of the triangle, 0)
    uint32_t id;
} PatchHit;

// Counted per thread; the caller adds them up.
typedef struct {
    uint64_t patch_tests; // patches (or sub-patches) whose box the ray met
    uint64_t steps;       // QI nets built or thick parallelograms tested; facets: triangles tested
    uint64_t newton;      // Newton steps
    uint64_t hits;        // hits reported
} PatchStats;

typedef struct PatchSet PatchSet;

// How far METHOD_QI prepares. ORDER patch_prepare (names in patchset.c, limits in piece.c)
typedef enum {
    PREPARE_FULL,  // as many sub-patches as make rays fast
    PREPARE_LIGHT, // few: half of the memory
    PREPARE_NONE,  // whole patches, as in the paper
    PREPARE_COUNT,
} PatchPrepare;

const char *patch_prepare_name(PatchPrepare prepare);
bool patch_prepare_parse(const char *name, PatchPrepare *prepare); // false: no such way

typedef struct {
    PatchMethod method;
    PatchPrepare prepare;
    int finer;        // facets: steps are so many more, flatness is a 4^finer-th
    double tolerance; // |hit - S| <= tolerance x the patch's diameter; default 1e-9
    // Not NULL: gives the tolerance of a patch in scene units instead; <= 0: the share as above.
    double (*tolerance_of)(const void *context, Box bounds);
    const void *context;
} PatchSetOptions;

PatchSetOptions patchset_options_default(void);
// What a patch in that box gets when its definition gives none, scene units.
double patchset_tolerance(const PatchSetOptions *options, Box bounds);
PatchSet *patchset_create(const PatchSetOptions *options);
void patchset_destroy(PatchSet *set);
// Points must be finite and weights valid (the caller has checked). Not after commit.
void patchset_add(PatchSet *set, const PatchDef *def);
// Builds what the method needs, in parallel if it pays. Dies for a method that has no rational
// patches (qi-paper, facets, tessellation) when there is one. After it the set is read-only and any
// number of threads may trace.
void patchset_commit(PatchSet *set);
Box patchset_bounds(const PatchSet *set);      // of the control points; empty when there are none
uint64_t patchset_memory(const PatchSet *set); // bytes after commit

// Nearest hit with t_min <= t < t_max among the patches that mask selects. stats may be NULL.
bool patchset_intersect(const PatchSet *set, const Ray *ray, double t_min, double t_max,
                        uint32_t mask, PatchStats *stats, PatchHit *hit);
// The same from t = 0 on for a ray that leaves a surface: a hit that lies within its own bound of
// the ray's origin is that surface, and does not count.
bool patchset_intersect_leaving(const PatchSet *set, const Ray *ray, double t_max, uint32_t mask,
                                PatchStats *stats, PatchHit *hit);
// From which t on a ray that starts at a hit (org: the hit's point as computed, dir any) is clear
// of the surface that it leaves: to be its t_min. Derived from the hit's bound: what lies before is
// within ten bounds of the ray all the way from its start (clearance.c), so a sheet farther away
// than that is never lost. def: the patch that was hit. Less than 1 us; where the surface has to be
// followed (along rulings, beside folds of very long ribbons), 20 us and up to some 1,000.
// Where surfaces meet, a neighbour may be found from there on, another sheet, or the same one with
// a larger bound. Of the rest of the ray, that begins there, ask for the clearance of such a hit,
// with the larger of both bounds: one that lies before it is still what is left, and the ray is
// clear from there on.
double patch_clearance(const PatchDef *def, const PatchHit *hit, const Ray *ray);
// Is there any?
bool patchset_occluded(const PatchSet *set, const Ray *ray, double t_min, double t_max,
                       uint32_t mask, PatchStats *stats);
// The same for many rays at once, to the last bit; fastest by METHOD_QI for rays that lie side by
// side and go the same way, PATCH_PACKET after one another in the list. ranges NULL: from 0 to
// infinity, all patches; mask 0: the ray is not asked, and hits nothing. found[i]: does ray i hit?
// hits[i] is written where it does.
enum { PATCH_PACKET = 16 };
typedef struct {
    double t_min, t_max;
    uint32_t mask;
} PatchRange;
void patchset_intersect_many(const PatchSet *set, const Ray *rays, const PatchRange *ranges,
                             size_t count, PatchStats *stats, bool *found, PatchHit *hits);
void patchset_occluded_many(const PatchSet *set, const Ray *rays, const PatchRange *ranges,
                            size_t count, PatchStats *stats, bool *found);
// Every hit, in no particular order: calls sink for each (for CSG). A double hit of a fold is two.
typedef void (*PatchSink)(void *context, const PatchHit *hit);
void patchset_all(const PatchSet *set, const Ray *ray, double t_min, double t_max, uint32_t mask,
                  PatchStats *stats, PatchSink sink, void *context);

#endif
