// SPDX-License-Identifier: MIT
// Fog (facts: rendering 6): each dims what a ray sees at its end and adds its own colour, as much
// as lies between. Light that fogs add is not dimmed by the other fogs.
#include "render/shading.h"

#include "noise/noise.h"

#include <math.h>

// The mean density between two heights above the offset, in units of alt: full below 0, above it
// 1 / (1 + y^2), whose integral is atan y.
static double ground_density(double start, double end) {
    if (start <= 0.0)
        return end <= 0.0 ? 1.0 : (atan(end) - start) / (end - start);
    if (end <= 0.0)
        return (atan(start) - end) / (start - end);
    double delta = start - end;
    if (fabs(delta) > SHADE_EPS)
        return (atan(start) - atan(end)) / delta;
    return 1.0 / (start * start + 1.0);
}

// Turbulence makes the way shorter, less so where little is left to be seen.
static double turbulent_depth(const Shading *shading, const Fog *fog, Vec3 middle, double depth) {
    const Turbulence *t = &fog->turbulence;
    const NoiseOctaves octaves = {t->octaves, t->lambda, t->omega};
    double left = exp(-depth / fog->distance);
    double noise = noise_turbulence(vec_mul(middle, t->amount), &octaves,
                                    shading->scene->settings.noise_generator);
    return depth * (1.0 - left * fmin(1.0, noise * fog->turb_depth));
}

// How much of the light from the end of the segment arrives.
static double fog_left(const Shading *shading, const Fog *fog, const Ray *ray, double depth) {
    double density = 1.0;
    Vec3 end = vec_add(ray->org, vec_scale(ray->dir, depth)), middle;
    if (fog->type == FOG_GROUND) {
        double y1 = vec_dot(ray->org, fog->up), y2 = vec_dot(end, fog->up);
        density = ground_density((y1 - fog->offset) / fog->alt, (y2 - fog->offset) / fog->alt);
        middle = vec_scale(vec_add(ray->org, end), 0.5);
    } else {
        middle = vec_add(ray->org, vec_scale(ray->dir, depth / 2.0));
    }
    if (fog->has_turbulence)
        depth = turbulent_depth(shading, fog, middle, depth);
    return exp(-depth * density / fog->distance);
}

static void add_fogs(const Shading *shading, const Ray *ray, double depth, Rgb *dim, Rgb *own) {
    const Scene *scene = shading->scene;
    *dim = rgb(1.0f, 1.0f, 1.0f);
    *own = rgb(0.0f, 0.0f, 0.0f);
    for (uint32_t i = 0; i < scene->fog_count; i++) {
        const Fog *fog = &scene->fogs[i];
        Color c = fog->color;
        double left = fmax(fog_left(shading, fog, ray, depth), c.transmit);
        dim->r = (float)(dim->r * (left * ((1.0 - c.filter) + c.filter * c.r)));
        dim->g = (float)(dim->g * (left * ((1.0 - c.filter) + c.filter * c.g)));
        dim->b = (float)(dim->b * (left * ((1.0 - c.filter) + c.filter * c.b)));
        *own = rgb_add(*own, rgb_scale(color_rgb(c), 1.0 - left));
    }
}

Color fog_see(const Shading *shading, const Ray *ray, double depth, Color seen) {
    Rgb dim, own;
    add_fogs(shading, ray, depth, &dim, &own);
    Rgb sum = rgb_add(own, rgb_mul(dim, color_rgb(seen)));
    return (Color){sum.r, sum.g, sum.b, seen.filter, seen.transmit * rgb_grey(dim)};
}

Rgb fog_dim(const Shading *shading, const Ray *ray, double depth, Rgb light) {
    Rgb dim, own;
    add_fogs(shading, ray, depth, &dim, &own);
    return rgb_mul(dim, light);
}
