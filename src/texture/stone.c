// SPDX-License-Identifier: MIT
// Patterns made of noise (facts: textures 2, 3.5).
#include "texture/formula.h"
#include "noise/noise.h"

#include <math.h>

static double clamp01(double v) { return v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v; }

static NoiseOctaves octaves_of(const Pattern *pattern) {
    const Turbulence *t = &pattern->turbulence;
    return pattern->has_turbulence ? (NoiseOctaves){t->octaves, t->lambda, t->omega}
                                   : (NoiseOctaves){6, 2.0f, 0.5f};
}

// The scalar turbulence that marble and the spirals add to their own coordinate.
static double turbulence_along(const Pattern *pattern, Vec3 p, int generator) {
    if (!pattern->has_turbulence)
        return 0.0;
    NoiseOctaves octaves = octaves_of(pattern);
    return pattern->turbulence.amount.x * noise_turbulence(p, &octaves, generator);
}

double stone_agate(const Pattern *pattern, Vec3 p, int generator) {
    NoiseOctaves octaves = octaves_of(pattern);
    double turbulence = pattern->agate_turb * noise_turbulence(p, &octaves, generator);
    double v = 0.5 * (formula_cycloidal(1.3 * turbulence + 1.1 * p.z) + 1.0);
    return pow(clamp01(v), 0.77);
}

double stone_dents(Vec3 p, int generator) {
    double n = noise_value(p, generator);
    return n * n * n;
}

double stone_granite(Vec3 p, int generator) {
    double sum = 0.0, scale = 1.0;
    for (int i = 0; i < 6; i++, scale *= 2.0) {
        double n = noise_value(vec_scale(p, 4.0 * scale), generator);
        double t = generator > 1 ? fabs(1.0 - 2.0 * n) : fabs(0.5 - n);
        if (generator > 1 && t > 0.5)
            t = 0.5;
        sum += t / scale;
    }
    return sum;
}

double stone_marble(const Pattern *pattern, Vec3 p, int generator) {
    return p.x + turbulence_along(pattern, p, generator);
}

// The angle about z that a spiral arm winds by; 0 on the axis.
static double spiral_angle(Vec3 p, double radius) {
    if (radius == 0.0)
        return 0.0;
    return p.x < 0.0 ? 3.0 * M_PI / 2.0 - asin(p.y / radius) : M_PI / 2.0 + asin(p.y / radius);
}

static double spiral(const Pattern *pattern, Vec3 p, int generator) {
    double radius = sqrt(p.x * p.x + p.y * p.y), angle = spiral_angle(p, radius);
    return p.z + radius + pattern->arms * angle / FORMULA_PI_2 +
           turbulence_along(pattern, p, generator);
}

double stone_spiral1(const Pattern *pattern, Vec3 p, int generator) {
    return spiral(pattern, p, generator);
}

double stone_spiral2(const Pattern *pattern, Vec3 p, int generator) {
    double radius = sqrt(p.x * p.x + p.y * p.y);
    return formula_triangle(radius) + formula_triangle(spiral(pattern, p, generator));
}

double stone_wood(const Pattern *pattern, Vec3 p) {
    Vec3 d = vec3(0.0, 0.0, 0.0);
    if (pattern->has_turbulence) {
        NoiseOctaves octaves = octaves_of(pattern);
        Vec3 amount = pattern->turbulence.amount, t = noise_turbulence_vector(p, &octaves);
        d.x = formula_cycloidal((p.x + t.x) * amount.x);
        d.y = formula_cycloidal((p.y + t.y) * amount.y);
    }
    double x = p.x + d.x, y = p.y + d.y;
    return sqrt(x * x + y * y);
}

double stone_wrinkles(Vec3 p, int generator) {
    double sum = 0.0, scale = 1.0, share = 1.0;
    for (int i = 0; i < 10; i++, scale *= 2.0, share *= 0.5) {
        double n = noise_value(vec_scale(p, scale), generator);
        sum += share * (generator > 1 ? clamp01(2.0 * n - 0.5) : n);
    }
    return sum / 2.0;
}
