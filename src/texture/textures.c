// SPDX-License-Identifier: MIT
#include "texture/textures.h"

#include "noise/noise.h"
#include "texture/density.h"
#include "texture/image_map.h"
#include "texture/pattern.h"
#include "texture/pigment.h"

#include <string.h>

TextureHit texture_no_hit(bool quick) { return (TextureHit){.quick = quick}; }

// Functions may ask for pigments, and for what their patterns say.
static void ask_pigment(const void *world, uint32_t pigment, Vec3 p, double color[FUNCTION_WIDTH]) {
    const TextureHit nowhere = texture_no_hit(false);
    Color c;
    pigment_color(world, pigment, &nowhere, p, &c);
    const double components[FUNCTION_WIDTH] = {c.r, c.g, c.b, c.filter, c.transmit};
    memcpy(color, components, sizeof components);
}

static double ask_pattern(const void *world, uint32_t pigment, Vec3 p) {
    const Textures *textures = world;
    const Pattern *pattern = &textures->scene->pigments[pigment].pattern;
    const TextureHit nowhere = texture_no_hit(false);
    if (!pattern_has_value(pattern->type))
        return 0.0;
    return pattern_value(textures, pattern, &nowhere, pattern_point(pattern, p));
}

static bool never_inside(const void *objects, uint32_t object, Vec3 p) {
    (void)objects, (void)object, (void)p;
    return false;
}

Textures *textures_create(const Scene *scene, Arena *arena) {
    static const FunctionHooks hooks = {ask_pigment, ask_pattern};
    noise_prepare();
    Textures *textures = ARENA_NEW(arena, Textures);
    ImageMap *pictures = ARENA_ARRAY(arena, ImageMap, scene->picture_count);
    Density *densities = ARENA_ARRAY(arena, Density, scene->density_count);
    for (uint32_t i = 0; i < scene->picture_count; i++)
        pictures[i] = image_map_make(&scene->settings, &scene->pictures[i], arena);
    for (uint32_t i = 0; i < scene->density_count; i++)
        densities[i] = density_make(scene->densities[i].path, arena);
    *textures = (Textures){
        .scene = scene,
        .pictures = pictures,
        .densities = densities,
        .functions = {scene->functions, scene->settings.noise_generator, &hooks, textures},
        .inside = never_inside,
    };
    return textures;
}
