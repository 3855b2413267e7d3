// SPDX-License-Identifier: MIT
#include "texture/textures.h"

#include "noise/noise.h"
#include "texture/image_map.h"

Textures textures_make(const Scene *scene, Arena *arena) {
    noise_prepare();
    ImageMap *pictures = ARENA_ARRAY(arena, ImageMap, scene->picture_count);
    for (uint32_t i = 0; i < scene->picture_count; i++)
        pictures[i] = image_map_make(&scene->settings, &scene->pictures[i], arena);
    return (Textures){.scene = scene, .pictures = pictures};
}

TextureHit texture_no_hit(bool quick) { return (TextureHit){.quick = quick}; }
