// SPDX-License-Identifier: MIT
#include "probe/probe.h"

#include "render/world.h"
#include "texture/pattern.h"
#include "texture/pigment.h"

struct Probe {
    Arena *arena;
    const Scene *scene;
    World *world;   // NULL: the scene has only pigments
    World **bodies; // one per projection of the scene: what patterns look into
    Textures *textures;
};

// POV-Ray's least depth of a hit that counts.
static const double NEAREST = 1e-4;

static World *make_world(const Scene *scene, const Textures *textures) {
    PatchSetOptions patches = patchset_options_default();
    patches.method = METHOD_FACETS;
    World *world = world_create(scene, &patches);
    world_use_functions(world, &textures->functions);
    return world;
}

// The object of a pattern alone.
static World *make_body(const Probe *probe, uint32_t projection) {
    const Scene *scene = probe->scene;
    Scene *alone = arena_copy(probe->arena, scene, sizeof *scene);
    alone->roots = &scene->projections[projection];
    alone->root_count = 1;
    return make_world(alone, probe->textures);
}

static bool in_body(const void *objects, uint32_t object, Vec3 p) {
    const Probe *probe = objects;
    return world_inside(probe->bodies[object], probe->scene->projections[object], p);
}

Probe *probe_create(const Scene *scene) {
    Arena *arena = arena_create();
    Probe *probe = ARENA_NEW(arena, Probe);
    *probe = (Probe){.arena = arena, .scene = scene, .textures = textures_create(scene, arena)};
    probe->bodies = ARENA_ARRAY(arena, World *, scene->projection_count);
    for (uint32_t i = 0; i < scene->projection_count; i++)
        probe->bodies[i] = make_body(probe, i);
    probe->textures->inside = in_body;
    probe->textures->objects = probe;
    if (scene->root_count > 0)
        probe->world = make_world(scene, probe->textures);
    return probe;
}

uint64_t probe_memory(const Probe *probe) {
    uint64_t bytes = arena_bytes(probe->arena);
    for (uint32_t i = 0; i < probe->scene->projection_count; i++)
        bytes += world_memory(probe->bodies[i]);
    return bytes + (probe->world ? world_memory(probe->world) : 0);
}

void probe_destroy(Probe *probe) {
    if (!probe)
        return;
    for (uint32_t i = 0; i < probe->scene->projection_count; i++)
        world_destroy(probe->bodies[i]);
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
    pigment_color(probe->textures, pigment, &hit, p, &c);
    const float components[FUNCTION_WIDTH] = {c.r, c.g, c.b, c.filter, c.transmit};
    for (int i = 0; i < FUNCTION_WIDTH; i++)
        color[i] = components[i];
}

double probe_pattern(const Probe *probe, uint32_t pigment, Vec3 p) {
    const Pattern *pattern = &probe->scene->pigments[pigment].pattern;
    const TextureHit hit = texture_no_hit(false);
    return pattern_value(probe->textures, pattern, &hit, pattern_point(pattern, p));
}
