// SPDX-License-Identifier: MIT
// What is seen in a surface (facts: rendering 4.5, reflectivity).
#include "render/shading.h"

#include <math.h>

static double max_channel(Rgb c) {
    float m = c.r > c.g ? c.r : c.g;
    return m > c.b ? m : c.b;
}

static Rgb mix(double share, Rgb high, Rgb low) {
    return rgb_add(rgb_scale(high, share), rgb_scale(low, 1.0 - share));
}

// The share of the grazing value in reflection { min, max falloff e }.
static Rgb plain_reflectivity(const Finish *finish, double cosine, double *weight) {
    double high = max_channel(finish->reflection_max), low = max_channel(finish->reflection_min);
    *weight *= high > low ? high : low;
    double share = 1.0 - cosine;
    if (fabs(finish->reflection_falloff - 1.0) > SHADE_EPS)
        share = pow(share, finish->reflection_falloff);
    if (fabs(share) < SHADE_EPS)
        return finish->reflection_min;
    if (fabs(share - 1.0) < SHADE_EPS)
        return finish->reflection_max;
    return mix(share, finish->reflection_max, finish->reflection_min);
}

static double square(double x) { return x * x; }

// Fresnel's formula for unpolarised light at the relative index n.
static Rgb fresnel_reflectivity(const Finish *finish, double n, double cosine, double *weight) {
    Rgb reflectivity = finish->reflection_max;
    double radicand = square(n) + square(cosine) - 1.0;
    if (radicand > 0.0) {
        double g = sqrt(radicand);
        double f = 0.5 * (square(g - cosine) / square(g + cosine));
        f *= 1.0 + square(cosine * (g + cosine) - 1.0) / square(cosine * (g - cosine) + 1.0);
        f = f > 0.0 ? f : 0.0;
        f = f < 1.0 ? f : 1.0;
        reflectivity = mix(f, finish->reflection_max, finish->reflection_min);
    }
    *weight *= max_channel(reflectivity);
    return reflectivity;
}

void reflect_layer(const Shading *shading, const Surface *surface, const Finish *finish,
                   Vec3 normal, Rgb layer_color, LayerReflection *out) {
    double cosine = -vec_dot(surface->path->ray.dir, normal);
    out->normal = normal;
    out->finish = finish;
    if (finish->reflection_fresnel)
        out->reflectivity = fresnel_reflectivity(
            finish, interior_relative_ior(shading->scene, surface->path->inside, surface->body),
            cosine, &out->weight);
    else
        out->reflectivity = plain_reflectivity(finish, cosine, &out->weight);
    if (finish->reflection_metallic != 0.0f) {
        double k = finish->reflection_metallic * (1.0 - finish_metallic_fresnel(cosine));
        Rgb *r = &out->reflectivity;
        r->r = (float)(r->r * (1.0 + k * (layer_color.r - 1.0)));
        r->g = (float)(r->g * (1.0 + k * (layer_color.g - 1.0)));
        r->b = (float)(r->b * (1.0 + k * (layer_color.b - 1.0)));
    }
}

Vec3 reflect_dir(Vec3 dir, Vec3 normal, Vec3 raw_normal) {
    Vec3 out = vec_madd(dir, -2.0 * vec_dot(dir, normal), normal);
    // A perturbed normal can send the ray into the surface.
    double below = vec_dot(out, raw_normal);
    if (below < 0.0) {
        if (vec_dot(out, normal) < 0.0)
            out = vec_madd(dir, -2.0 * vec_dot(dir, raw_normal), raw_normal);
        else
            out = vec_madd(out, -2.0 * below, raw_normal);
    }
    return vec_normalize(out);
}

Rgb reflect_trace(Tracer *tracer, const Surface *surface, const LayerReflection *reflection) {
    const Path *path = surface->path;
    Path next = *path;
    next.ray.org = surface->hit->p;
    next.from = surface->hit;
    next.ray.dir = reflect_dir(path->ray.dir, reflection->normal, surface->normal);
    next.foreseen = ahead_mirror(tracer, surface->hit, next.ray.dir);
    next.weight = (float)reflection->weight;
    next.kind = RAY_REFLECTION;
    next.alpha = false; // a mirror never shows the transparent background
    next.nesting++;
    tracer->stats.reflected++;
    Color color;
    trace_path(tracer, &next, false, &color);
    Rgb seen = color_rgb(color);
    if (reflection->finish->irid > 0.0f)
        finish_irid(tracer->shading->scene, reflection->finish, surface->hit->p, path->ray.dir,
                    next.ray.dir, reflection->normal, &seen);
    return seen;
}
