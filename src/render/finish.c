// SPDX-License-Identifier: MIT
// One light on one layer (facts: rendering 4.5). Cosines and powers in double, each colour product
// rounded to float where POV-Ray rounds it.
#include "render/shading.h"

#include "noise/noise.h"

#include <math.h>

static inline void add_diffuse(Tracer *tracer, const LitLayer *layer, Vec3 dir, const Rgb *light,
                               bool backside, Rgb *color) {
    const Finish *finish = layer->finish;
    double diffuse = backside ? finish->diffuse_back : finish->diffuse;
    if (diffuse <= 0.0)
        return;
    double intensity = fabs(vec_dot(layer->normal, dir));
    if (finish->brilliance != 1.0f)
        intensity = pow(intensity, finish->brilliance);
    intensity *= diffuse * layer->opacity;
    if (finish->crand > 0.0f)
        intensity -= tracer_random(&tracer->crand) * finish->crand;
    *color = rgb_add(*color, rgb_mul(rgb_scale(layer->color, intensity), *light));
}

double finish_metallic_fresnel(double cosine) {
    double x = fabs(acos(cosine)) / M_PI_2 - 1.12;
    double f = 0.014567225 / (x * x) - 0.011612903;
    // In this form the NaN of a cosine that rounding has put beyond 1 gives 0.
    f = f > 0.0 ? f : 0.0;
    return f < 1.0 ? f : 1.0;
}

// The highlight's colour: the light's, drawn towards the surface's by `metallic`.
static inline Rgb highlight_color(const LitLayer *layer, Vec3 dir, const Rgb *light) {
    float metallic = layer->finish->metallic;
    if (!(metallic > 0.0f))
        return *light;
    double f = finish_metallic_fresnel(vec_dot(layer->normal, dir));
    Rgb tint = rgb_scale(rgb(layer->color.r - 1.0f, layer->color.g - 1.0f, layer->color.b - 1.0f),
                         metallic * (1.0 - f));
    return rgb_mul(*light, rgb_add(rgb(1.0f, 1.0f, 1.0f), tint));
}

static void add_phong(const LitLayer *layer, Vec3 eye, Vec3 dir, const Rgb *light, Rgb *color) {
    const Finish *finish = layer->finish;
    Vec3 mirrored = vec_madd(eye, -2.0 * vec_dot(eye, layer->normal), layer->normal);
    double cosine = vec_dot(mirrored, dir);
    if (!(cosine > 0.0))
        return;
    // POV-Ray spares itself the power where it would vanish anyway.
    if (finish->phong_size >= 60.0f && cosine <= 0.0008)
        return;
    double intensity = finish->phong * pow(cosine, finish->phong_size);
    *color = rgb_add(*color, rgb_scale(highlight_color(layer, dir, light), intensity));
}

static void add_specular(const LitLayer *layer, Vec3 eye, Vec3 dir, const Rgb *light, Rgb *color) {
    const Finish *finish = layer->finish;
    Vec3 halfway = vec_scale(vec_sub(dir, eye), 0.5);
    double length = vec_length(halfway);
    if (!(length > 0.0))
        return;
    double cosine = vec_dot(halfway, layer->normal) / length;
    if (!(cosine > 0.0))
        return;
    // The exponent is kept as float; a roughness of 0 is used as an exponent of 0.
    float exponent = finish->roughness != 0.0f ? 1.0f / finish->roughness : 0.0f;
    double intensity = finish->specular * pow(cosine, exponent);
    *color = rgb_add(*color, rgb_scale(highlight_color(layer, dir, light), intensity));
}

void finish_irid(const Scene *scene, const Finish *finish, Vec3 p, Vec3 eye, Vec3 dir, Vec3 normal,
                 Rgb *color) {
    double thickness = finish->irid_thickness;
    if (finish->irid_turbulence != 0.0f) {
        const NoiseOctaves octaves = {5, 2.0f, 0.5f};
        double n = noise_turbulence(p, &octaves, scene->settings.noise_generator);
        thickness *= 1.0 + (2.0 * n - 1.0) * finish->irid_turbulence;
    }
    double cosines = fabs(vec_dot(normal, dir)) + fabs(vec_dot(normal, eye));
    double phase = 2.0 * M_PI * thickness * cosines;
    Rgb wavelength = scene->settings.irid_wavelength;
    color->r *= (float)(1.0 + finish->irid * cos(phase / wavelength.r));
    color->g *= (float)(1.0 + finish->irid * cos(phase / wavelength.g));
    color->b *= (float)(1.0 + finish->irid * cos(phase / wavelength.b));
}

void light_shine(Tracer *tracer, const LitLayer *layer, bool shadowless, const LightSample *s,
                 bool backside, Rgb *color) {
    const Surface *surface = layer->surface;
    Rgb sum = {0};
    Vec3 eye = surface->path->ray.dir;
    add_diffuse(tracer, layer, s->dir, &s->color, backside, &sum);
    if (!shadowless && !backside) {
        if (layer->finish->phong > 0.0f)
            add_phong(layer, eye, s->dir, &s->color, &sum);
        if (layer->finish->specular > 0.0f)
            add_specular(layer, eye, s->dir, &s->color, &sum);
    }
    if (layer->finish->irid > 0.0f)
        finish_irid(tracer->shading->scene, layer->finish, surface->hit->p, eye, s->dir,
                    layer->normal, &sum);
    *color = rgb_add(*color, sum);
}
