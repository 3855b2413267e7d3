// SPDX-License-Identifier: MIT
// Patterns that bend a normal in ways of their own instead of by their height (facts: textures
// 5.2). n is changed where it stands, in the pattern's space.
#include "texture/formula.h"
#include "noise/noise.h"

#include <math.h>

Vec3 bump_bumps(double amount, Vec3 p, Vec3 n) { return vec_madd(n, amount, noise_vector(p)); }

Vec3 bump_dents(double amount, Vec3 p, Vec3 n, int generator) {
    double depth = noise_value(p, generator);
    depth = depth * depth * depth * amount;
    return vec_madd(n, depth, noise_vector(p));
}

Vec3 bump_wrinkles(double amount, Vec3 p, Vec3 n) {
    Vec3 sum = vec3(0.0, 0.0, 0.0);
    double scale = 1.0;
    for (int i = 0; i < 10; i++, scale *= 2.0) {
        Vec3 v = noise_vector(vec_scale(p, scale));
        sum = vec_add(sum, vec3(fabs(v.x / scale), fabs(v.y / scale), fabs(v.z / scale)));
    }
    return vec_madd(n, amount, sum);
}

Vec3 bump_waves(const Pattern *pattern, double amount, Vec3 p, Vec3 n, int count) {
    bool ripples = pattern->type == PATTERN_RIPPLES;
    for (int i = 0; i < count; i++) {
        Vec3 center;
        double frequency;
        noise_wave((uint32_t)i, &center, &frequency);
        Vec3 d = vec_sub(p, center);
        double length = vec_length(d);
        if (length == 0.0)
            length = 1.0;
        double at = length * pattern->frequency, height;
        if (ripples)
            height = formula_cycloidal(at + pattern->phase) * amount;
        else
            height = formula_cycloidal(at * frequency + pattern->phase) * amount / frequency;
        n = vec_madd(n, height / (length * count), d);
    }
    return n;
}

Vec3 bump_quilted(const Pattern *pattern, double amount, Vec3 p, Vec3 n) {
    return vec_madd(n, amount, tiles_quilt(pattern, p));
}

// How far a cell's point is, by the metric. The one of 1 has no absolute values: so POV-Ray has it.
static double facet_distance(double metric, Vec3 d) {
    if (metric == 2.0)
        return d.x * d.x + d.y * d.y + d.z * d.z;
    if (metric == 1.0)
        return d.x + d.y + d.z;
    return pow(fabs(d.x), metric) + pow(fabs(d.y), metric) + pow(fabs(d.z), metric);
}

// The nearest of the points strewn one a cell. Each cell is found from the shifted point itself.
static Vec3 nearest_facet(double metric, Vec3 p) {
    double least = INFINITY;
    Vec3 nearest = p;
    bool first = true;
    for (int a = -2; a <= 2; a++)
        for (int b = -2; b <= 2; b++)
            for (int c = -2; c <= 2; c++) {
                if ((a * a == 4) + (b * b == 4) + (c * c == 4) > 1)
                    continue;
                Vec3 site = crackle_site(vec_add(p, vec3(a, b, c)));
                double s = facet_distance(metric, vec_sub(site, p));
                if (first || s < least) {
                    least = s;
                    nearest = site;
                }
                first = false;
            }
    return nearest;
}

Vec3 bump_facets(const FacetsShape *shape, Vec3 p, Vec3 n) {
    n = vec_normalize(n);
    double scale = shape->size < 1e-6 ? 1e6 : 1.0 / shape->size;
    Vec3 site = nearest_facet(shape->metric, vec_scale(shape->coords != 0.0 ? p : n, scale));
    if (shape->coords == 0.0)
        return site;
    Vec3 v = noise_vector(site);
    v = vec_sub(v, vec_scale(n, vec_dot(v, n)));
    return vec_madd(n, shape->coords, v);
}
