// SPDX-License-Identifier: MIT
// Rainbows (facts: rendering 6): a ring of colours about a direction, laid over what a ray sees
// the more the farther away that is. Where several bows cross, their mean is seen.
#include "render/shading.h"

#include "texture/pigment.h"

#include <math.h>

static const double DEGREE = 0.01745329251994329576923690768489;      // pi / 180
static const double HALF_DEGREE = 0.00872664625997164788461845384244; // pi / 360

// Wider than any angle: POV-Ray keeps 180 degrees here without making radians of them, and fades
// towards it.
static const double ALL_AROUND = 180.0;

BowAngles rainbow_angles(const Rainbow *bow) {
    BowAngles a;
    a.start = (bow->angle_deg - 0.5 * bow->width_deg) * DEGREE;
    a.width = bow->width_deg * DEGREE;
    a.arc = bow->arc_deg < 0.0 ? ALL_AROUND : bow->arc_deg * HALF_DEGREE;
    a.falloff = bow->falloff_deg < 0.0 ? ALL_AROUND : bow->falloff_deg * HALF_DEGREE;
    return a;
}

// The angle between the ray and up, seen along the bow's direction.
static double angle_around(const Rainbow *bow, Vec3 dir) {
    double x = vec_dot(dir, bow->right), y = vec_dot(dir, bow->up);
    double length = x * x + y * y;
    return fabs(acos(length > 0.0 ? y / sqrt(length) : y));
}

// The colour of the bow in that direction; false outside of it.
static bool bow_color(Tracer *tracer, const Rainbow *bow, const BowAngles *angles, Vec3 dir,
                      Color *color) {
    double cosine = vec_dot(dir, bow->direction);
    if (!(cosine >= 0.0))
        return false;
    double index = (acos(cosine) - angles->start) / angles->width;
    if (bow->jitter > 0.0)
        index += (2.0 * tracer_random(&tracer->bow_jitter) - 1.0) * bow->jitter;
    if (!(index >= 0.0 && index <= 1.0 - SHADE_EPS))
        return false;
    const TextureHit nowhere = texture_no_hit(false);
    pigment_color(tracer->shading->textures, bow->pigment, &nowhere, vec3(index, 0, 0), color);
    return true;
}

static float blend(float sum, double left, float seen, double filter, float own) {
    return (float)(sum + (left * seen * ((1.0 - filter) + filter * own) + (1.0 - left) * own));
}

Color rainbow_see(Tracer *tracer, const Ray *ray, double depth, Color seen) {
    const Shading *shading = tracer->shading;
    const Scene *scene = shading->scene;
    Color sum = {0.0f, 0.0f, 0.0f, 1.0f, 1.0f};
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->rainbow_count; i++) {
        const Rainbow *bow = &scene->rainbows[i];
        const BowAngles *angles = &shading->bows[i];
        double around = angle_around(bow, ray->dir);
        Color c;
        if (!(around <= angles->arc) || !bow_color(tracer, bow, angles, ray->dir, &c))
            continue;
        double fade = 0.0, soft = angles->arc - angles->falloff;
        if (soft > 0.0 && around > angles->falloff) {
            fade = (around - angles->falloff) / soft;
            fade = (3.0 - 2.0 * fade) * fade * fade;
        }
        double left = fmax(exp(-depth / bow->distance), fade * (1.0 - c.transmit) + c.transmit);
        double filter = c.filter * (1.0 - left);
        sum.r = blend(sum.r, left, seen.r, filter, c.r);
        sum.g = blend(sum.g, left, seen.g, filter, c.g);
        sum.b = blend(sum.b, left, seen.b, filter, c.b);
        sum.filter = (float)(sum.filter * (left * c.filter));
        sum.transmit = (float)(sum.transmit * (left * c.transmit));
        count++;
    }
    if (count == 0)
        return seen;
    float share = (float)(1.0 / count);
    return (Color){sum.r * share, sum.g * share, sum.b * share, seen.filter * sum.filter,
                   seen.transmit * sum.transmit};
}
