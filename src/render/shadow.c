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

// What the surface at hit lets through; false when nothing.
static bool surface_filter(const Shading *shading, const Ray *ray, const InteriorList *inside,
                           const WorldHit *hit, Rgb *color) {
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
    if (interior != NULL && interior->fade_power > 0.0f && interior_inside(inside, info->body))
        through = rgb_mul(through, refract_fade(interior, hit->t));
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
    while (world_intersect(shading->world, &ray, t_min, distance - SHADE_SHADOW_TOL, RAY_SHADOW,
                           &tracer->stats, &hit)) {
        if (!surface_filter(shading, &ray, inside, &hit, color)) {
            *color = black;
            return;
        }
        distance -= hit.t;
        ray.org = hit.p;
    }
}
