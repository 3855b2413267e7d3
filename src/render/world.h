// SPDX-License-Identifier: MIT
// The scene made ready for rays: bounded primitives, the patches (a PatchSet) and copies of shared
// trees in one tree of boxes, infinite primitives beside it. Read-only while rendering; any number
// of threads.
#ifndef RENDER_WORLD_H
#define RENDER_WORLD_H

#include "model/scene.h"
#include "patch/patch.h"
#include "shape/shape.h"

// What a ray is for; also the bits of an object's mask (no_image, no_reflection, no_shadow).
typedef enum {
    RAY_CAMERA = 1,
    RAY_REFLECTION = 2, // reflected at least once
    RAY_SHADOW = 4,
    RAY_REFRACTED = 8, // or passed straight through, and not reflected
    RAY_ALL = 15,
} RayKind;
// Those that no_image hides things from.
#define RAY_IMAGE (RAY_CAMERA | RAY_REFRACTED)

typedef struct {
    uint64_t primary, reflected, refracted, transmitted, shadow; // rays
    uint64_t shape_tests, shape_hits;                            // primitives other than patches
    PatchStats patch;
} RayStats;

typedef struct {
    double t;
    Vec3 p;          // org + t dir
    Vec3 normal;     // unit; the object's, before flipping to the viewer; `inverse` already applied
    double u, v;     // texture coordinates; p.x, p.y where the object has no mapping of its own
    double bound;    // patches: the hit's proven bound, else 0
    double reach;    // patches: how far apart this hit and another one of the same place may be
    uint32_t object; // index in scene->objects, a leaf
    uint32_t instance; // the instance that shows it, an object too, or NO_INDEX
    // The primitive's own textures, or those of what it cuts; none: the object's count.
    uint32_t texture_count;
    ShapeTexture textures[SHAPE_MAX_TEXTURES];
} WorldHit;

// What a ray meets of the patches that nothing hides.
typedef struct {
    bool found;
    PatchHit hit;
} WorldForeseen;

typedef struct World World;

// scene must outlive the world and be valid.
World *world_create(const Scene *scene, const PatchSetOptions *patches);
void world_destroy(World *world);
// What the surfaces of functions in it ask, which must live as long as rays are traced. Until it is
// told, the pigments of functions give nothing. Not while rays are traced.
void world_use_functions(const World *world, const FunctionPool *functions);
// Before the first ray: nobody asks for the u and v of primitives, which cost sines; they are 0.
void world_without_uv(World *world);

// From where on a ray meets things, in units of its t: primitives, patches.
typedef struct {
    double shapes, patches;
} WorldNear;

// For a ray along dir from a hit; NULL: from the camera. least: what POV-Ray ignores, in scene
// units. Patches met by qi need no such constant: what lies nearer than the bounds of the two hits
// allow is the surface that the ray leaves, and all else counts.
WorldNear world_near(const World *world, const WorldHit *from, Vec3 dir, double least);
// POV-Ray's least depths suit scenes of some units. In a scene whose patches are altogether smaller
// than 1/20 (which POV-Ray does not render) they are taken in quarters of its diameter; else 1.
double world_unit(const World *world);

// Nearest hit with near <= t < t_max that this kind of ray can see. Equal depths: the object that
// stands first in the source, infinite ones before all others. Each primitive also has its own
// least depth (facts: rendering 0.2). stats are added to; NULL: nobody counts.
bool world_nearest(const World *world, const Ray *ray, WorldNear near, double t_max, RayKind kind,
                   RayStats *stats, WorldHit *hit);
// The same with one t_min for both.
bool world_intersect(const World *world, const Ray *ray, double t_min, double t_max, RayKind kind,
                     RayStats *stats, WorldHit *hit);
// world_nearest, where the patches have been asked ahead: foreseen is that ray's (see foresee.c),
// or NULL.
bool world_nearest_foreseen(const World *world, const Ray *ray, WorldNear near, double t_max,
                            RayKind kind, const WorldForeseen *foreseen, RayStats *stats,
                            WorldHit *hit);
// Asks the patches for rays of one kind that lie side by side, to `near` and infinity: `down` rows
// of `across` rays, which is faster than one after the other. False: there is nothing to be gained.
bool world_foresee(const World *world, const Ray *rays, size_t across, size_t down, WorldNear near,
                   RayKind kind, RayStats *stats, WorldForeseen *foreseen);
// The same for up to PATCH_PACKET rays, each with its own range. any: an answer says no more than
// whether there is a hit, as world_blocked_foreseen wants it. Only where world_foresees().
typedef struct {
    size_t count;
    Ray rays[PATCH_PACKET];
    PatchRange ranges[PATCH_PACKET];
    WorldForeseen *answers[PATCH_PACKET]; // filled in
} WorldAsked;
bool world_foresees(const World *world);
// One more; false: not this one, whose length is not 1. There is room for it.
bool world_ask(WorldAsked *asked, const Ray *ray, WorldNear near, double t_max, RayKind kind,
               WorldForeseen *answer);
void world_foresee_some(const World *world, const WorldAsked *asked, bool any, RayStats *stats);
// Rows of rays in packets: which of down x across rays lie side by side. Zeroed at first; false:
// that were all.
typedef struct {
    size_t left, top;
    size_t number[PATCH_PACKET], count; // of the next packet
} WorldPackets;
bool world_next_packet(WorldPackets *packets, size_t across, size_t down);
// Is anything that throws a shadow between? Only right when all of that is opaque. last: what
// blocked the ray before, WORLD_NO_BLOCKER at first: it is asked first, and kept up to date.
#define WORLD_NO_BLOCKER UINT32_MAX
bool world_blocked(const World *world, const Ray *ray, WorldNear near, double t_max, uint32_t *last,
                   RayStats *stats);
bool world_blocked_foreseen(const World *world, const Ray *ray, WorldNear near, double t_max,
                            const WorldForeseen *foreseen, uint32_t *last, RayStats *stats);
// The same with one t_min for both, and no memory.
bool world_occluded(const World *world, const Ray *ray, double t_min, double t_max,
                    RayStats *stats);
// Is the point inside the object (a root or a leaf)? Patches, triangles have no inside.
bool world_inside(const World *world, uint32_t object, Vec3 p);
// The first max of the leaves that contain p, hollow ones too, in the order of the source; returns
// how many.
typedef struct {
    uint32_t object, instance; // as in a hit
} WorldPlace;
uint32_t world_containing(const World *world, Vec3 p, WorldPlace *places, uint32_t max);
uint64_t world_memory(const World *world); // bytes

#endif
