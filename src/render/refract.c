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

bool refract_trace(Tracer *tracer, const Surface *surface, const Finish *finish, Vec3 normal,
                   float weight, Color *color) {
    const Path *path = surface->path;
    InteriorList node;
    Path next = *path;
    double ratio =
        interior_cross(tracer->shading->scene, path->inside, surface->body, &node, &next.inside);
    next.ray.org = surface->hit->p;
    next.from = surface->hit;
    next.weight = weight;
    next.nesting++;
    if (fabs(ratio - 1.0) < SHADE_EPS) {
        tracer->stats.transmitted++;
        *color = trace_path(tracer, &next, true);
        return false;
    }

    // Heckbert's form of Snell's law; the new direction is not normalised.
    double cosine = vec_dot(path->ray.dir, normal);
    Vec3 against = cosine <= 0.0 ? normal : vec_neg(normal);
    cosine = cosine <= 0.0 ? -cosine : cosine;
    double radicand = 1.0 + ratio * ratio * (cosine * cosine - 1.0);
    if (radicand < 0.0) {
        LayerReflection mirror = {weight, normal, {1.0f, 1.0f, 1.0f}, finish};
        Rgb seen = reflect_trace(tracer, surface, &mirror);
        *color = (Color){seen.r, seen.g, seen.b, 0.0f, 0.0f};
        return true;
    }
    double k = ratio * cosine - sqrt(radicand);
    next.ray.dir = vec_add(vec_scale(path->ray.dir, ratio), vec_scale(against, k));
    tracer->stats.refracted++;
    *color = trace_path(tracer, &next, false);
    return false;
}
