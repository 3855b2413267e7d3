// SPDX-License-Identifier: MIT
#include "probe/probe.h"

#include "render/world.h"
#include "texture/pattern.h"
#include "texture/pigment.h"

struct Probe {
    Arena *arena;
    const Scene *scene;
    World *world; // NULL: the scene has only pigments
    Textures textures;
};

// POV-Ray's least depth of a hit that counts.
static const double NEAREST = 1e-4;

Probe *probe_create(const Scene *scene) {
    Arena *arena = arena_create();
    Probe *probe = ARENA_NEW(arena, Probe);
    *probe = (Probe){.arena = arena, .scene = scene, .textures = textures_make(scene)};
    PatchSetOptions patches = patchset_options_default();
    patches.method = METHOD_FACETS;
    if (scene->root_count > 0)
        probe->world = world_create(scene, &patches);
    return probe;
}

void probe_destroy(Probe *probe) {
    if (!probe)
        return;
    world_destroy(probe->world);
    arena_destroy(probe->arena);
}

bool probe_trace(const Probe *probe, const Ray *ray, Vec3 *p, Vec3 *normal) {
    WorldHit hit;
    if (!world_intersect(probe->world, ray, NEAREST, INFINITY, RAY_ALL, NULL, &hit))
        return false;
    *p = hit.p;
    *normal = hit.normal;
    return true;
}

bool probe_inside(const Probe *probe, Vec3 p) {
    return world_inside(probe->world, probe->scene->roots[0], p);
}

void probe_color(const Probe *probe, uint32_t pigment, Vec3 p, double color[FUNCTION_WIDTH]) {
    const TextureHit hit = texture_no_hit(false);
    Color c;
    pigment_color(&probe->textures, pigment, &hit, p, &c);
    const float components[FUNCTION_WIDTH] = {c.r, c.g, c.b, c.filter, c.transmit};
    for (int i = 0; i < FUNCTION_WIDTH; i++)
        color[i] = components[i];
}

double probe_pattern(const Probe *probe, uint32_t pigment, Vec3 p) {
    const Pattern *pattern = &probe->scene->pigments[pigment].pattern;
    const TextureHit hit = texture_no_hit(false);
    return pattern_value(&probe->textures, pattern, &hit, pattern_point(pattern, p));
}
