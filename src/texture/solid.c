// SPDX-License-Identifier: MIT
// Patterns of plain geometry (facts: textures 2).
#include "texture/formula.h"
#include "noise/noise.h"

#include <math.h>

// 1 at the middle, 0 at distance 1 and beyond.
static double falling(double distance) {
    return distance < 0.0 ? 1.0 : distance > 1.0 ? 0.0 : 1.0 - distance;
}

double solid_gradient(const Pattern *pattern, Vec3 p) {
    double d = vec_dot(p, pattern->gradient);
    return d > 1.0 ? fmod(d, 1.0) : d;
}

double solid_boxed(Vec3 p) {
    double m = fabs(p.x);
    m = fabs(p.y) > m ? fabs(p.y) : m;
    return falling(fabs(p.z) > m ? fabs(p.z) : m);
}

double solid_cylindrical(Vec3 p) { return falling(sqrt(p.x * p.x + p.z * p.z)); }
double solid_planar(Vec3 p) { return falling(fabs(p.y)); }
double solid_spherical(Vec3 p) { return falling(vec_length(p)); }
double solid_onion(Vec3 p) { return fmod(vec_length(p), 1.0); }

double solid_leopard(Vec3 p) {
    double v = (sin(p.x) + sin(p.y) + sin(p.z)) / 3.0;
    return v * v;
}

double solid_radial(Vec3 p) {
    if (fabs(p.x) < 0.001 && fabs(p.z) < 0.001)
        return 0.25;
    return 0.25 + (atan2(p.x, p.z) + M_PI) / FORMULA_PI_2;
}

// The distance to a wave's centre, never 0.
static double wave_distance(Vec3 p, Vec3 center) {
    double d = vec_length(vec_sub(p, center));
    return d == 0.0 ? 1.0 : d;
}

double solid_ripples(const Pattern *pattern, Vec3 p, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        Vec3 center;
        double frequency;
        noise_wave((uint32_t)i, &center, &frequency);
        sum += formula_cycloidal(wave_distance(p, center) * pattern->frequency + pattern->phase);
    }
    return 0.5 * (1.0 + sum / count);
}

double solid_waves(const Pattern *pattern, Vec3 p, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        Vec3 center;
        double frequency;
        noise_wave((uint32_t)i, &center, &frequency);
        double at = wave_distance(p, center) * pattern->frequency * frequency + pattern->phase;
        sum += formula_cycloidal(at) / frequency;
    }
    return 0.2 * (2.5 + sum / count);
}
