// SPDX-License-Identifier: MIT
// What lies between a surface and a light (facts: rendering 4.7): surface by surface until one is
// opaque or the light is reached. Where everything is opaque one any-hit query answers.
//
// POV-Ray also remembers, per thread and light, the last opaque blocker, and tries that first with
// smaller margins. It changes only pixels with geometry closer than SHADE_SHADOW_TOL to a surface,
// and makes them depend on the pixels before; we leave it out.
#include "render/shading.h"

#include <math.h>

// POV-Ray takes depths > SHADE_SHADOW_TOL; our queries take t >= t_min.
static double shadow_t_min(void) { return nextafter(SHADE_SHADOW_TOL, 1.0); }

// The bodies that swallow light and that the shadow ray has crossed an odd number of times: it is
// inside those and those of the surface's own ray, but not inside both. Only fading needs it.
typedef struct {
    uint32_t bodies[64]; // more of them around each other: the innermost do not fade
    uint32_t count;
} Crossed;

static bool has_crossed(const Crossed *crossed, uint32_t body) {
    for (uint32_t i = 0; i < crossed->count; i++)
        if (crossed->bodies[i] == body)
            return true;
    return false;
}

static void cross(Crossed *crossed, uint32_t body) {
    for (uint32_t i = 0; i < crossed->count; i++)
        if (crossed->bodies[i] == body) {
            crossed->bodies[i] = crossed->bodies[--crossed->count];
            return;
        }
    if (crossed->count < sizeof crossed->bodies / sizeof crossed->bodies[0])
        crossed->bodies[crossed->count++] = body;
}

// What the surface at hit lets through; false when nothing.
static bool surface_filter(const Shading *shading, const Ray *ray, const InteriorList *inside,
                           const WorldHit *hit, Crossed *crossings, Rgb *color) {
    const ObjectInfo *info = &shading->objects[hit->object];
    if (info->opaque)
        return false;
    const Scene *scene = shading->scene;
    const Object *object = &scene->objects[hit->object];
    double cosine = vec_dot(hit->normal, ray->dir);
    uint32_t index = surface_texture(object, cosine);
    if (index == NO_INDEX)
        return false;

    const Texture *texture = &scene->textures[index];
    TexturePoint at = texture_point(texture, object->uv_mapping, hit->p, hit->u, hit->v,
                                    shading->quality.quick_color);
    const Interior *interior = body_interior(scene, info->body);
    Rgb through = rgb(1.0f, 1.0f, 1.0f);
    for (uint32_t i = 0; i < texture->layer_count; i++) {
        Color c;
        if (pigment_color(scene, texture->layers[i].pigment, &at, &c))
            through = rgb_mul(through, color_through(c));
        if (interior != NULL && interior->caustics != 0.0f)
            through = rgb_scale(through, 1.0 + pow(fabs(cosine), interior->caustics));
    }
    if (interior != NULL && interior->fade_power > 0.0f) {
        if (interior_inside(inside, info->body) != has_crossed(crossings, info->body))
            through = rgb_mul(through, refract_fade(interior, hit->t));
        cross(crossings, info->body);
    }
    *color = rgb_mul(*color, through);
    return true;
}

void shadow_filter(Tracer *tracer, Ray ray, double distance, const InteriorList *inside,
                   Rgb *color) {
    const Shading *shading = tracer->shading;
    const Rgb black = {0};
    double t_min = shadow_t_min();
    tracer->stats.shadow++;
    if (shading->all_opaque) {
        if (world_occluded(shading->world, &ray, t_min, distance - SHADE_SHADOW_TOL,
                           &tracer->stats))
            *color = black;
        return;
    }
    WorldHit hit;
    Crossed crossings = {.count = 0};
    while (world_intersect(shading->world, &ray, t_min, distance - SHADE_SHADOW_TOL, RAY_SHADOW,
                           &tracer->stats, &hit)) {
        if (!surface_filter(shading, &ray, inside, &hit, &crossings, color)) {
            *color = black;
            return;
        }
        distance -= hit.t;
        ray.org = hit.p;
    }
}
