// SPDX-License-Identifier: MIT
// The lights of a scene on a layer (facts: rendering 4.5, 5).
#include "render/shading.h"

#include <math.h>

void lights_reset(Tracer *tracer) {
    uint32_t count = tracer->shading->scene->light_count;
    for (uint32_t i = 0; i < count; i++)
        tracer->lights[i].ready = tracer->lights[i].shadow_done = false;
}

static double attenuation(const Light *light, double distance) {
    if (!(light->fade_power > 0.0) || !(fabs(light->fade_distance) > SHADE_EPS))
        return 1.0;
    return 2.0 / (1.0 + pow(distance / light->fade_distance, light->fade_power));
}

static LightSample sample(const Shading *shading, uint32_t index, Vec3 p) {
    const Light *light = &shading->scene->lights[index];
    LightSample s = {.ready = true};
    s.dir = vec_sub(light->location, p);
    s.distance = vec_length(s.dir);
    if (!(s.distance > 0.0))
        return s; // the surface goes through the light: there is no direction, so no light
    s.dir = vec_scale(s.dir, 1.0 / s.distance);
    if (light->type == LIGHT_PARALLEL) {
        Vec3 travel = shading->parallel_travel[index];
        s.distance *= -vec_dot(travel, s.dir);
        s.dir = vec_neg(travel);
    }
    s.color = rgb_scale(light->color, attenuation(light, s.distance));
    return s;
}

static bool is_black(Rgb c) {
    return fabsf(c.r) < SHADE_EPS && fabsf(c.g) < SHADE_EPS && fabsf(c.b) < SHADE_EPS;
}

static void add_light(Tracer *tracer, const LitLayer *layer, uint32_t index, Rgb *color) {
    const Shading *shading = tracer->shading;
    const Surface *surface = layer->surface;
    const Light *light = &shading->scene->lights[index];
    LightSample *s = &tracer->lights[index];
    if (!s->ready)
        *s = sample(shading, index, surface->hit->p);
    if (is_black(s->color))
        return;

    // A light behind the surface reaches only its back, or both sides of a double_illuminate.
    bool backside = false;
    if (!surface->double_illuminate && vec_dot(layer->normal, s->dir) < SHADE_EPS) {
        if (layer->finish->diffuse_back == 0.0f)
            return;
        backside = true;
    }

    if (shading->quality.shadows && !light->shadowless && !s->shadow_done) {
        shadow_filter(tracer, (Ray){surface->hit->p, s->dir}, s->distance, surface->path->inside,
                      &s->color);
        s->shadow_done = true;
    }
    if (is_black(s->color))
        return;

    Rgb sum = {0};
    Vec3 eye = surface->path->ray.dir;
    finish_diffuse(tracer, layer, s->dir, s->color, backside, &sum);
    if (!light->shadowless && !backside) {
        if (layer->finish->phong > 0.0f)
            finish_phong(layer, eye, s->dir, s->color, &sum);
        if (layer->finish->specular > 0.0f)
            finish_specular(layer, eye, s->dir, s->color, &sum);
    }
    if (layer->finish->irid > 0.0f)
        finish_irid(shading->scene, layer->finish, surface->hit->p, eye, s->dir, layer->normal,
                    &sum);
    *color = rgb_add(*color, sum);
}

void lights_add(Tracer *tracer, const LitLayer *layer, Rgb *color) {
    const Finish *finish = layer->finish;
    if (finish->diffuse == 0.0f && finish->diffuse_back == 0.0f && finish->specular == 0.0f &&
        finish->phong == 0.0f)
        return;
    for (uint32_t i = 0; i < tracer->shading->scene->light_count; i++)
        add_light(tracer, layer, i, color);
}
