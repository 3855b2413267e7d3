// SPDX-License-Identifier: MIT
// Before a block of neighbouring pixels is shaded: what its camera rays meet, then whether their
// hits see the lights and what they mirror, 16 neighbours at a time, which the patches answer
// together. The shading takes what is here as if it had just asked; what it does not find (rays of
// reflections, points of area lights, bent normals) it asks itself, and the answers are the same to
// the last bit.
#include "render/shading.h"

#include <string.h>

// One packet of rays on their way through the stages.
typedef struct {
    Tracer *tracer;
    const WorldPackets *packet;
    Vec3 normals[PATCH_PACKET]; // of the hits, turned against their rays
} Look;

static void look_at_hits(Look *look, WorldNear near) {
    Tracer *tracer = look->tracer;
    Ahead *ahead = &tracer->ahead;
    for (size_t i = 0; i < look->packet->count; i++) {
        size_t at = look->packet->number[i];
        AheadHit *hit = &ahead->hits[at];
        const Ray *ray = &ahead->rays[at];
        hit->mirrors = false;
        hit->met = world_nearest_foreseen(tracer->shading->world, ray, near, INFINITY, RAY_CAMERA,
                                          &ahead->patches[at], &tracer->stats, &hit->hit);
        if (!hit->met)
            continue;
        Vec3 normal = hit->hit.normal;
        look->normals[i] = vec_dot(normal, ray->dir) > 0.0 ? vec_neg(normal) : normal;
    }
}

// Is the ray to the light one that the shading will ask for, unless the normal is bent?
static bool light_matters(const Shading *shading, const WorldHit *hit, Vec3 normal,
                          const LightSample *sample) {
    return !light_is_black(&sample->color) &&
           (vec_dot(normal, sample->dir) >= SHADE_EPS ||
            shading->scene->objects[hit->object].double_illuminate);
}

static void look_at_light(const Look *look, uint32_t light) {
    Tracer *tracer = look->tracer;
    const Shading *shading = tracer->shading;
    Ahead *ahead = &tracer->ahead;
    WorldAsked asked;
    asked.count = 0;
    for (size_t i = 0; i < look->packet->count; i++) {
        size_t at = look->packet->number[i];
        const AheadHit *ray = &ahead->hits[at];
        LightSample *sample = &ahead->lights[at * ahead->light_count + light];
        sample->ready = false;
        if (!ray->met || !shading->objects[ray->hit.object].lit)
            continue;
        const WorldHit *hit = &ray->hit;
        light_sample(shading, light, hit->p, vec3(0, 0, 0), sample);
        if (!light_matters(shading, hit, look->normals[i], sample))
            continue;
        const Ray to_light = {hit->p, sample->dir};
        WorldForeseen *shade = &ahead->shades[at * ahead->light_count + light];
        sample->near = shadow_near(shading, hit, sample->dir);
        if (world_ask(&asked, &to_light, sample->near, shadow_limit(shading, sample->distance),
                      RAY_SHADOW, shade))
            sample->foreseen = shade;
    }
    world_foresee_some(shading->world, &asked, shading->all_opaque, &tracer->stats);
}

static void forget_light(const Look *look, uint32_t light) {
    const Ahead *ahead = &look->tracer->ahead;
    for (size_t i = 0; i < look->packet->count; i++)
        ahead->lights[look->packet->number[i] * ahead->light_count + light].ready = false;
}

static bool is_looked_at(const Shading *shading, uint32_t light) {
    const Light *l = &shading->scene->lights[light];
    return light_has_shadow(shading, light) && !l->has_projection && !l->has_area;
}

static void look_into_mirrors(const Look *look) {
    Tracer *tracer = look->tracer;
    const Shading *shading = tracer->shading;
    Ahead *ahead = &tracer->ahead;
    WorldAsked asked;
    asked.count = 0;
    for (size_t i = 0; i < look->packet->count; i++) {
        size_t at = look->packet->number[i];
        AheadHit *hit = &ahead->hits[at];
        if (!hit->met || !shading->objects[hit->hit.object].mirror)
            continue;
        hit->mirror_dir = reflect_dir(ahead->rays[at].dir, look->normals[i], look->normals[i]);
        const Ray ray = {hit->hit.p, hit->mirror_dir};
        WorldNear near = world_near(shading->world, &hit->hit, ray.dir, SHADE_MIN_DEPTH);
        hit->mirrors = world_ask(&asked, &ray, near, INFINITY, RAY_REFLECTION, &hit->mirror);
    }
    world_foresee_some(shading->world, &asked, false, &tracer->stats);
}

static void make_room(Tracer *tracer, size_t count) {
    Ahead *ahead = &tracer->ahead;
    if (count <= ahead->room)
        return;
    const Scene *scene = tracer->shading->scene;
    // Of those that do not shine on everything most are none of the hit's business.
    bool few = scene->light_count <= AHEAD_LIGHTS && !tracer->shading->groups;
    ahead->light_count = few ? scene->light_count : 0;
    size_t lights = count * ahead->light_count;
    ahead->patches = ARENA_ARRAY(tracer->arena, WorldForeseen, count);
    ahead->hits = ARENA_ARRAY(tracer->arena, AheadHit, count);
    ahead->lights = ARENA_ARRAY(tracer->arena, LightSample, lights);
    ahead->shades = ARENA_ARRAY(tracer->arena, WorldForeseen, lights);
    ahead->room = count;
}

void tracer_foresee(Tracer *tracer, const Ray *rays, size_t across, size_t down) {
    const Shading *shading = tracer->shading;
    Ahead *ahead = &tracer->ahead;
    ahead->count = ahead->next = 0;
    if (!world_foresees(shading->world))
        return;
    make_room(tracer, across * down);
    WorldNear near = world_near(shading->world, NULL, vec3(0, 0, 0), SHADE_MIN_DEPTH);
    if (!world_foresee(shading->world, rays, across, down, near, RAY_CAMERA, &tracer->stats,
                       ahead->patches))
        return;
    ahead->rays = rays;
    ahead->count = across * down;
    bool mirrors = shading->quality.reflection && shading->scene->settings.max_trace_level > 1;
    for (WorldPackets packet = {0}; world_next_packet(&packet, across, down);) {
        Look look;
        look.tracer = tracer;
        look.packet = &packet;
        look_at_hits(&look, near);
        for (uint32_t light = 0; light < ahead->light_count; light++) {
            if (is_looked_at(shading, light))
                look_at_light(&look, light);
            else
                forget_light(&look, light);
        }
        if (mirrors)
            look_into_mirrors(&look);
    }
}

AheadHit *ahead_take(Tracer *tracer, const Ray *ray) {
    Ahead *ahead = &tracer->ahead;
    if (ahead->next >= ahead->count || ray != &ahead->rays[ahead->next])
        return NULL;
    return &ahead->hits[ahead->next++];
}

// Is it the hit of the camera ray at hand?
static bool is_at_hand(const Ahead *ahead, const WorldHit *hit) {
    return ahead->next > 0 && hit == &ahead->hits[ahead->next - 1].hit;
}

LightSample *ahead_lights(const Tracer *tracer, const WorldHit *hit) {
    const Ahead *ahead = &tracer->ahead;
    if (ahead->light_count == 0 || !is_at_hand(ahead, hit))
        return NULL;
    return &ahead->lights[(ahead->next - 1) * ahead->light_count];
}

const WorldForeseen *ahead_mirror(const Tracer *tracer, const WorldHit *hit, Vec3 dir) {
    const Ahead *ahead = &tracer->ahead;
    if (!is_at_hand(ahead, hit))
        return NULL;
    const AheadHit *at = &ahead->hits[ahead->next - 1];
    return at->mirrors && memcmp(&at->mirror_dir, &dir, sizeof dir) == 0 ? &at->mirror : NULL;
}
