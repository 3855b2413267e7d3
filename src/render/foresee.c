// SPDX-License-Identifier: MIT
// Rays of neighbouring pixels ask the patches together (patch.h): what they meet is kept until each
// of them is traced. The bits are those of single rays.
#include "render/world_data.h"

enum { SIDE = 4 }; // a packet is a square of rays where there are enough rows
_Static_assert(SIDE *SIDE == PATCH_PACKET, "a square");

bool world_next_packet(WorldPackets *packets, size_t across, size_t down) {
    size_t wide = down >= SIDE ? SIDE : PATCH_PACKET / (down < 1 ? 1 : down);
    if (packets->left >= across) {
        packets->left = 0;
        packets->top += PATCH_PACKET / wide;
    }
    packets->count = 0;
    for (size_t y = packets->top; y < packets->top + PATCH_PACKET / wide && y < down; y++)
        for (size_t x = packets->left; x < packets->left + wide && x < across; x++)
            packets->number[packets->count++] = y * across + x;
    packets->left += wide;
    return packets->count > 0;
}

bool world_foresees(const World *world) { return world->patches && world->packets; }

bool world_ask(WorldAsked *asked, const Ray *ray, WorldNear near, double t_max, RayKind kind,
               WorldForeseen *answer) {
    // As they are asked one by one: world_nearest makes no others of these.
    if (!ray_is_unit(ray))
        return false;
    asked->rays[asked->count] = *ray;
    asked->ranges[asked->count] = (PatchRange){near.patches, t_max, kind};
    asked->answers[asked->count++] = answer;
    return true;
}

void world_foresee_some(const World *world, const WorldAsked *asked, bool any, RayStats *stats) {
    PatchHit hits[PATCH_PACKET];
    bool found[PATCH_PACKET];
    const size_t count = asked->count;
    if (any)
        patchset_occluded_many(world->patches, asked->rays, asked->ranges, count, &stats->patch,
                               found);
    else
        patchset_intersect_many(world->patches, asked->rays, asked->ranges, count, &stats->patch,
                                found, hits);
    for (size_t i = 0; i < count; i++) {
        asked->answers[i]->found = found[i];
        if (found[i] && !any)
            asked->answers[i]->hit = hits[i];
    }
}

bool world_foresee(const World *world, const Ray *rays, size_t across, size_t down, WorldNear near,
                   RayKind kind, RayStats *stats, WorldForeseen *foreseen) {
    if (!world_foresees(world))
        return false;
    for (WorldPackets packets = {0}; world_next_packet(&packets, across, down);) {
        WorldAsked asked;
        asked.count = 0;
        for (size_t i = 0; i < packets.count; i++) {
            size_t at = packets.number[i];
            if (!world_ask(&asked, &rays[at], near, INFINITY, kind, &foreseen[at]))
                return false;
        }
        world_foresee_some(world, &asked, false, stats);
    }
    return true;
}
