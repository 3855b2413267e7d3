// SPDX-License-Identifier: MIT
// What is seen through a surface (facts: rendering 4.6).
#include "render/shading.h"

#include <math.h>

Rgb refract_fade(const Interior *interior, double distance) {
    const Rgb one = {1.0f, 1.0f, 1.0f};
    if (!(fabsf(interior->fade_distance) > SHADE_EPS))
        return one;
    Rgb fade = interior->fade_color;
    Rgb rest = rgb(1.0f - fade.r, 1.0f - fade.g, 1.0f - fade.b);
    double depth = distance / interior->fade_distance;
    if (interior->fade_power >= 1000.0f) {
        Rgb exponent = rgb_scale(rgb(-rest.r, -rest.g, -rest.b), depth);
        return rgb(expf(exponent.r), expf(exponent.g), expf(exponent.b));
    }
    double share = 1.0 + pow(depth, interior->fade_power);
    return rgb_add(fade,
                   rgb((float)(rest.r / share), (float)(rest.g / share), (float)(rest.b / share)));
}

// Refracts next by the ratio of the indices. cosine: of the ray and the normal that is against it.
// True: total internal reflection took its place.
static bool bend(Tracer *tracer, const Surface *surface, const LayerReflection *mirror, Path *next,
                 double ratio, double cosine, Vec3 against, Color *color) {
    // Heckbert's form of Snell's law; the new direction is not normalised.
    double radicand = 1.0 + ratio * ratio * (cosine * cosine - 1.0);
    if (radicand < 0.0) {
        Rgb seen = reflect_trace(tracer, surface, mirror);
        *color = (Color){seen.r, seen.g, seen.b, 0.0f, 0.0f};
        return true;
    }
    double k = ratio * cosine - sqrt(radicand);
    next->ray.dir = vec_add(vec_scale(surface->path->ray.dir, ratio), vec_scale(against, k));
    tracer->stats.refracted++;
    trace_path(tracer, next, false, color);
    return false;
}

bool refract_trace(Tracer *tracer, const Surface *surface, const Finish *finish, Vec3 normal,
                   float weight, Color *color) {
    const Path *path = surface->path;
    InteriorList node;
    Path next = *path;
    Bending bending =
        interior_cross(tracer->shading->scene, path->inside, surface->body, &node, &next.inside);
    next.ray.org = surface->hit->p;
    next.from = surface->hit;
    next.foreseen = NULL;
    next.weight = weight;
    next.nesting++;
    next.kind = path->kind == RAY_CAMERA ? RAY_REFRACTED : path->kind;
    bool together = fabs(bending.dispersion - 1.0) < SHADE_EPS;
    if (together && fabs(bending.ior - 1.0) < SHADE_EPS) {
        tracer->stats.transmitted++;
        trace_path(tracer, &next, true, color);
        return false;
    }

    double cosine = vec_dot(path->ray.dir, normal);
    Vec3 against = cosine <= 0.0 ? normal : vec_neg(normal);
    cosine = cosine <= 0.0 ? -cosine : cosine;
    const LayerReflection mirror = {weight, normal, {1.0f, 1.0f, 1.0f}, finish};
    if (together)
        return bend(tracer, surface, &mirror, &next, bending.ior, cosine, against, color);
    if (path->wavelength > 0.0f) {
        double ratio = dispersion_ratio(bending.ior, bending.dispersion, path->wavelength);
        return bend(tracer, surface, &mirror, &next, ratio, cosine, against, color);
    }

    Rgb sum = {0};
    for (int i = 0; i < bending.samples; i++) {
        Band band = dispersion_band(tracer->shading, i, bending.samples);
        next.wavelength = band.wavelength;
        double ratio = dispersion_ratio(bending.ior, bending.dispersion, band.wavelength);
        Color seen;
        bend(tracer, surface, &mirror, &next, ratio, cosine, against, &seen);
        sum = rgb_add(sum, rgb_mul(color_rgb(seen), band.hue));
    }
    double n = bending.samples;
    *color = (Color){(float)(sum.r / n), (float)(sum.g / n), (float)(sum.b / n), 0.0f, 0.0f};
    return false;
}
