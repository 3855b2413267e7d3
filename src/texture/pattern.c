// SPDX-License-Identifier: MIT
// A point becomes a number in three steps (facts: textures 1.6, 2, 4.2): the chain of warps, the
// pattern's own formula, then frequency, phase and wave. All in double; the parameters that POV-Ray
// keeps as float are float in the scene and promoted when used.
#include "texture/pattern.h"

#include <assert.h>
#include <math.h>

static const double PI_2 = 6.283185307179586476925; // POV-Ray's 2 pi
static const double EPS = 1e-10;                    // POV-Ray's near-zero
static const double COORDINATE_LIMIT = 1e17;        // where the chain of warps clamps
// POV-Ray reduces modulo this instead of 1, so that a value of exactly 1 stays at the map's end.
static const double WRAP = 1.00001;

static double clamp_coordinate(double x) {
    return x > COORDINATE_LIMIT ? COORDINATE_LIMIT : x < -COORDINATE_LIMIT ? -COORDINATE_LIMIT : x;
}

Vec3 pattern_point(const Pattern *pattern, Vec3 p) {
    for (uint32_t i = 0; i < pattern->warp_count; i++) {
        const Warp *warp = &pattern->warps[i];
        switch (warp->type) {
        case WARP_TRANSFORM:
            p = transform_inv_point(&warp->transform, p);
            break;
        }
    }
    return vec3(clamp_coordinate(p.x), clamp_coordinate(p.y), clamp_coordinate(p.z));
}

// One period of the sine at fraction v; odd, and rounded through a scale of 50000 as POV-Ray's.
static double cycloidal(double v) {
    if (v >= 0.0)
        return sin((v - floor(v)) * 50000.0 / 50000.0 * PI_2);
    return -sin(-(v + floor(-v)) * 50000.0 / 50000.0 * PI_2);
}

// 0 at whole numbers, 1 half-way between.
static double triangle(double v) {
    double offset = v >= 0.0 ? v - floor(v) : v + 1.0 + floor(fabs(v));
    return offset >= 0.5 ? 2.0 * (1.0 - offset) : 2.0 * offset;
}

static double wave(const Pattern *pattern, double v) {
    switch (pattern->wave) {
    case WAVE_RAMP:
        return v;
    case WAVE_TRIANGLE:
        return triangle(v);
    case WAVE_SINE:
        return (1.0 + cycloidal(v)) * 0.5;
    case WAVE_SCALLOP:
        return fabs(cycloidal(v * 0.5));
    case WAVE_CUBIC:
        return v * v * (-2.0 * v + 3.0);
    case WAVE_POLY:
        return pow(v, pattern->exponent);
    }
    return v;
}

// Which of the two colours: the parity of the unit cube; EPS keeps points on its faces in it.
static double checker(Vec3 p) {
    double cell = floor(p.x + EPS) + floor(p.y + EPS) + floor(p.z + EPS);
    return fmod(cell, 2.0) != 0.0 ? 1.0 : 0.0;
}

static double gradient(const Pattern *pattern, Vec3 p) {
    double d = vec_dot(p, pattern->gradient);
    return d > 1.0 ? fmod(d, 1.0) : d;
}

static double raw_value(const Pattern *pattern, Vec3 p) {
    switch (pattern->type) {
    case PATTERN_CHECKER:
        return checker(p);
    case PATTERN_GRADIENT:
        return gradient(pattern, p);
    case PATTERN_PLAIN:
    case PATTERN_MODELLED:
        break;
    }
    assert(!"this pattern has no value");
    return 0.0;
}

double pattern_value(const Pattern *pattern, Vec3 warped) {
    double v = raw_value(pattern, warped);
    if (pattern->frequency != 0.0f)
        v = fmod(v * pattern->frequency + pattern->phase, WRAP);
    if (v < 0.0)
        v -= floor(v);
    return wave(pattern, v);
}
