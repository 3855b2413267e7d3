// SPDX-License-Identifier: MIT
// The lights of a scene on a layer (facts: rendering 4.5, 5).
#include "render/shading.h"
#include "render/story.h"

#include <math.h>

void lights_reset(Tracer *tracer, const WorldHit *hit) {
    uint32_t count = tracer->shading->scene->light_count;
    tracer->lights = ahead_lights(tracer, hit);
    if (tracer->lights)
        return;
    tracer->lights = tracer->own_lights;
    for (uint32_t i = 0; i < count; i++)
        tracer->lights[i].ready = tracer->lights[i].shadow_done = false;
}

// 0 at low and below, 1 at high and above.
static double smooth_step(double low, double high, double x) {
    if (x < low)
        return 0.0;
    if (x >= high)
        return 1.0;
    double p = (x - low) / (high - low);
    return (3.0 - 2.0 * p) * p * p;
}

// In the cosine of the angle to the axis. A distance below 0: the point lies behind a parallel one.
static double spot_attenuation(const Light *light, const LightAxis *axis, Vec3 dir,
                               double distance) {
    double cosine = vec_dot(dir, axis->travel) * (distance > 0.0 ? -1.0 : 1.0);
    if (!(cosine > 0.0))
        return 0.0;
    double a = pow(cosine, light->tightness);
    if (axis->radius > 0.0 && cosine < axis->radius)
        a *= smooth_step(axis->falloff, axis->radius, cosine);
    return a;
}

// p: the lit point as seen from the light.
static double cylinder_attenuation(const Light *light, const LightAxis *axis, Vec3 p) {
    double along = vec_dot(p, axis->travel);
    if (!(along > 0.0))
        return 0.0;
    double away = sqrt(fmax(0.0, vec_dot(p, p) - along * along));
    if (away >= axis->falloff)
        return 0.0;
    double x = 1.0 - away / axis->falloff;
    double a = pow(x, light->tightness);
    if (axis->radius > 0.0 && away > axis->radius)
        a *= smooth_step(0.0, 1.0 - axis->radius / axis->falloff, x);
    return a;
}

static double fading(const Light *light, double distance) {
    if (!(light->fade_power > 0.0) || !(fabs(light->fade_distance) > SHADE_EPS))
        return 1.0;
    return 2.0 / (1.0 + pow(distance / light->fade_distance, light->fade_power));
}

// dir and distance of s for a point p and a light at center; false: there is no direction.
static bool aim(const Light *light, const LightAxis *axis, Vec3 p, Vec3 center, LightSample *s) {
    Vec3 towards = vec_sub(center, p);
    s->distance = vec_length(towards);
    if (!(s->distance > 0.0))
        return false;
    s->dir = vec_scale(towards, 1.0 / s->distance);
    if (light->type == LIGHT_PARALLEL || light->type == LIGHT_CYLINDER || light->parallel) {
        // Each point of an area shines towards point_at.
        Vec3 back = light->has_area ? vec_normalize(vec_sub(center, light->point_at))
                                    : vec_neg(axis->travel);
        s->distance *= vec_dot(back, s->dir);
        s->dir = back;
    }
    return true;
}

bool light_aim(const Shading *shading, uint32_t index, Vec3 p, Vec3 offset, LightSample *sample) {
    const Light *light = &shading->scene->lights[index];
    return aim(light, &shading->axes[index], p, vec_add(light->location, offset), sample);
}

void light_sample(const Shading *shading, uint32_t index, Vec3 p, Vec3 offset, LightSample *s) {
    const Light *light = &shading->scene->lights[index];
    const LightAxis *axis = &shading->axes[index];
    s->ready = true;
    s->shadow_done = false;
    s->foreseen = NULL;
    if (!aim(light, axis, p, vec_add(light->location, offset), s)) {
        // The surface goes through the light: no light arrives.
        *s = (LightSample){.ready = true};
        return;
    }
    double attenuation = fading(light, s->distance);
    if (light->type == LIGHT_SPOT)
        attenuation *= spot_attenuation(light, axis, s->dir, s->distance);
    else if (light->type == LIGHT_CYLINDER)
        attenuation *= cylinder_attenuation(light, axis, vec_sub(p, light->location));
    s->attenuation = attenuation;
    s->color = rgb_scale(light->color, attenuation);
}

// A light behind the surface reaches only its back, or both sides of a double_illuminate.
bool light_behind(const LitLayer *layer, Vec3 dir, bool *dark) {
    bool behind = !layer->surface->double_illuminate && vec_dot(layer->normal, dir) < SHADE_EPS;
    *dark = behind && layer->finish->diffuse_back == 0.0f;
    return behind;
}

bool light_has_shadow(const Shading *shading, uint32_t index) {
    const Light *light = &shading->scene->lights[index];
    return shading->quality.shadows && (!light->shadowless || light->has_projection);
}

static void find_shadow(Tracer *tracer, const Surface *surface, uint32_t index, LightSample *s) {
    const Light *light = &tracer->shading->scene->lights[index];
    if (s->shadow_done || !light_has_shadow(tracer->shading, index))
        return;
    if (light->has_area && tracer->shading->quality.area_lights)
        area_shadow(tracer, surface, index, s);
    else
        shadow_filter(tracer, index, surface->hit, s, surface->path->inside);
    s->shadow_done = true;
}

static void tell(const Tracer *tracer, const LitLayer *layer, uint32_t index, const LightSample *s,
                 const char *fate, Rgb added) {
    if (tracer->story)
        story_light(tracer->story, layer->surface->path, index, s, fate, added);
}

static void add_light(Tracer *tracer, const LitLayer *layer, uint32_t index, Rgb *color) {
    const Shading *shading = tracer->shading;
    const Surface *surface = layer->surface;
    const Light *light = &shading->scene->lights[index];
    bool spread = light->has_area && light->area.illumination && shading->quality.area_lights;
    LightSample *s = &tracer->lights[index];
    if (!s->ready) {
        light_sample(shading, index, surface->hit->p, vec3(0, 0, 0), s);
        if (spread) // attenuated point by point
            s->color = light->color;
    }
    if (light_is_black(&s->color)) {
        tell(tracer, layer, index, s, "does not reach it", (Rgb){0});
        return;
    }
    bool dark = false, behind = !spread && light_behind(layer, s->dir, &dark);
    if (dark) {
        tell(tracer, layer, index, s, "is behind the surface", (Rgb){0});
        return;
    }
    find_shadow(tracer, surface, index, s);
    if (light_is_black(&s->color)) {
        tell(tracer, layer, index, s, "is hidden", (Rgb){0});
        return;
    }
    Rgb before = {0};
    if (tracer->story)
        before = *color;
    if (spread)
        area_shine(tracer, layer, index, s, color);
    else
        light_shine(tracer, layer, light->shadowless, s, behind, color);
    if (tracer->story)
        tell(tracer, layer, index, s, "shines",
             rgb(color->r - before.r, color->g - before.g, color->b - before.b));
}

void lights_add(Tracer *tracer, const LitLayer *layer, Rgb *color) {
    if (!finish_is_lit(layer->finish))
        return;
    const Scene *scene = tracer->shading->scene;
    if (!tracer->shading->groups) {
        for (uint32_t i = 0; i < scene->light_count; i++)
            add_light(tracer, layer, i, color);
        return;
    }
    // Those of all objects first.
    const Object *object = &scene->objects[layer->surface->hit->object];
    for (uint32_t i = 0; i < scene->light_count && !object->no_global_lights; i++)
        if (scene->lights[i].group == 0)
            add_light(tracer, layer, i, color);
    for (uint32_t i = 0; i < scene->light_count && object->light_group != 0; i++)
        if (scene->lights[i].group == object->light_group)
            add_light(tracer, layer, i, color);
}
