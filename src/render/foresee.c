// SPDX-License-Identifier: MIT
// Camera rays of neighbouring pixels ask the patches together (patch.h): what they meet is kept
// until each of them is traced. The bits are those of single rays.
#include "render/world_data.h"

enum { SIDE = 4 }; // a packet is a square of rays where there are enough rows
_Static_assert(SIDE *SIDE == PATCH_PACKET, "a square");

// Numbers in the list of the rays of one packet.
typedef struct {
    size_t number[PATCH_PACKET];
    size_t count;
} Group;

static void group_of(Group *group, size_t across, size_t down, size_t left, size_t top,
                     size_t wide) {
    group->count = 0;
    for (size_t y = top; y < top + PATCH_PACKET / wide && y < down; y++)
        for (size_t x = left; x < left + wide && x < across; x++)
            group->number[group->count++] = y * across + x;
}

static void ask_group(const World *world, const Ray *rays, const Group *group,
                      const PatchRange *range, PatchStats *stats, WorldForeseen *foreseen) {
    Ray some[PATCH_PACKET];
    PatchRange ranges[PATCH_PACKET];
    PatchHit hits[PATCH_PACKET];
    bool found[PATCH_PACKET];
    for (size_t i = 0; i < group->count; i++) {
        some[i] = rays[group->number[i]];
        ranges[i] = *range;
    }
    patchset_intersect_many(world->patches, some, ranges, group->count, stats, found, hits);
    for (size_t i = 0; i < group->count; i++) {
        WorldForeseen *f = &foreseen[group->number[i]];
        f->found = found[i];
        if (found[i])
            f->hit = hits[i];
    }
}

bool world_foresee(const World *world, const Ray *rays, size_t across, size_t down, WorldNear near,
                   RayKind kind, RayStats *stats, WorldForeseen *foreseen) {
    if (!world->patches || !world->packets)
        return false;
    // As they are asked one by one: world_nearest makes no others of these.
    for (size_t i = 0; i < across * down; i++)
        if (!ray_is_unit(&rays[i]))
            return false;
    const PatchRange range = {near.patches, INFINITY, kind};
    size_t wide = down >= SIDE ? SIDE : PATCH_PACKET / (down < 1 ? 1 : down);
    for (size_t y = 0; y < down; y += PATCH_PACKET / wide) {
        for (size_t x = 0; x < across; x += wide) {
            Group group;
            group_of(&group, across, down, x, y, wide);
            ask_group(world, rays, &group, &range, &stats->patch, foreseen);
        }
    }
    return true;
}
