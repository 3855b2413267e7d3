// SPDX-License-Identifier: MIT
// A point becomes a number in three steps (facts: textures 1.6, 2, 4.2): the chain of warps, the
// pattern's own formula (formula.h), then frequency, phase and wave. All in double; the parameters
// that POV-Ray keeps as float are float in the scene and promoted when used.
#include "texture/pattern.h"

#include "texture/density.h"
#include "texture/formula.h"
#include "noise/noise.h"
#include "texture/image_map.h"
#include "texture/pigment.h"
#include "texture/warp.h"

#include <assert.h>
#include <math.h>

static const double COORDINATE_LIMIT = 1e17; // where the chain of warps clamps
// POV-Ray reduces modulo this instead of 1, so that a value of exactly 1 stays at the map's end.
static const double WRAP = 1.00001;

static double clamp_coordinate(double x) {
    return x > COORDINATE_LIMIT ? COORDINATE_LIMIT : x < -COORDINATE_LIMIT ? -COORDINATE_LIMIT : x;
}

Vec3 pattern_point(const Pattern *pattern, Vec3 p) {
    for (uint32_t i = 0; i < pattern->warp_count; i++)
        p = warp_apply(&pattern->warps[i], p);
    // The block's own turbulence comes last, wherever it is written; marble and wood have it in
    // their formulas instead.
    if (pattern->has_turbulence && pattern->type != PATTERN_MARBLE && pattern->type != PATTERN_WOOD)
        p = warp_turbulence(&pattern->turbulence, p);
    return vec3(clamp_coordinate(p.x), clamp_coordinate(p.y), clamp_coordinate(p.z));
}

double formula_cycloidal(double v) {
    if (v >= 0.0)
        return sin((v - floor(v)) * 50000.0 / 50000.0 * FORMULA_PI_2);
    return -sin(-(v + floor(-v)) * 50000.0 / 50000.0 * FORMULA_PI_2);
}

double formula_triangle(double v) {
    double offset = v >= 0.0 ? v - floor(v) : v + 1.0 + floor(fabs(v));
    return offset >= 0.5 ? 2.0 * (1.0 - offset) : 2.0 * offset;
}

static double wave(const Pattern *pattern, double v) {
    switch (pattern->wave) {
    case WAVE_RAMP:
        return v;
    case WAVE_TRIANGLE:
        return formula_triangle(v);
    case WAVE_SINE:
        return (1.0 + formula_cycloidal(v)) * 0.5;
    case WAVE_SCALLOP:
        return fabs(formula_cycloidal(v * 0.5));
    case WAVE_CUBIC:
        return v * v * (-2.0 * v + 3.0);
    case WAVE_POLY:
        return pow(v, pattern->exponent);
    }
    return v;
}

int pattern_generator(const Textures *textures, const Pattern *pattern) {
    return pattern->noise_generator ? pattern->noise_generator
                                    : textures->scene->settings.noise_generator;
}

// The formula's value; split in two only for length.
static double noise_formula(const Textures *textures, const Pattern *pattern, Vec3 p) {
    const Settings *settings = &textures->scene->settings;
    int generator = pattern_generator(textures, pattern);
    switch (pattern->type) {
    case PATTERN_AGATE:
        return stone_agate(pattern, p, generator);
    case PATTERN_BOZO:
        return noise_value(p, generator);
    case PATTERN_CRACKLE:
        return crackle_value(&pattern->crackle, p, generator);
    case PATTERN_DENTS:
        return stone_dents(p, generator);
    case PATTERN_GRANITE:
        return stone_granite(p, generator);
    case PATTERN_MARBLE:
        return stone_marble(pattern, p, generator);
    case PATTERN_RIPPLES:
        return solid_ripples(pattern, p, settings->number_of_waves);
    case PATTERN_SPIRAL1:
        return stone_spiral1(pattern, p, generator);
    case PATTERN_SPIRAL2:
        return stone_spiral2(pattern, p, generator);
    case PATTERN_WAVES:
        return solid_waves(pattern, p, settings->number_of_waves);
    case PATTERN_WOOD:
        return stone_wood(pattern, p);
    case PATTERN_WRINKLES:
        return stone_wrinkles(p, generator);
    default:
        assert(!"this pattern has no value");
        return 0.0;
    }
}

// The angle between the surface and a direction, or the way to a place, and how high the point is.
static double slope(const SlopeShape *shape, const TextureHit *hit, Vec3 p) {
    Vec3 to = shape->slope;
    if (shape->point_at)
        to = vec_normalize(vec_sub(shape->slope, hit->p));
    double v = vec_dot(hit->normal, to);
    v = v > 1.0 ? 1.0 : v < -1.0 ? -1.0 : v;
    v = (asin(v) / M_PI * 2.0 + 1.0) * 0.5;
    double range = shape->high - shape->low;
    if (range != 0.0)
        v = (v - shape->low) / range;
    if (shape->share != 1.0) {
        double height = vec_dot(p, shape->altitude);
        range = shape->altitude_high - shape->altitude_low;
        if (range != 0.0)
            height = (height - shape->altitude_low) / range;
        v = shape->share * v + (1.0 - shape->share) * height;
        if (v >= 1.0 && v - 1.0 < FORMULA_EPS)
            return v - FORMULA_EPS;
    } else if (v == 1.0) {
        return v - FORMULA_EPS;
    }
    return v < 0.0 ? 1.0 + fmod(v, 1.0) : fmod(v, 1.0);
}

// The angle at which the ray meets the surface; 0 without a surface.
static double angle_of_incidence(const TextureHit *hit) {
    if (hit->dir.x == 0.0 && hit->dir.y == 0.0 && hit->dir.z == 0.0)
        return 0.0;
    double cosine = vec_dot(vec_normalize(hit->normal), vec_normalize(hit->dir));
    return acos(cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine) / M_PI;
}

static double function(const Textures *textures, const Pattern *pattern, Vec3 p) {
    const double arguments[3] = {p.x, p.y, p.z};
    double v = function_value(&textures->functions, pattern->function, arguments);
    return v > 1.0 ? fmod(v, 1.0) : v;
}

static double brightness(const Textures *textures, const Pattern *pattern, const TextureHit *hit,
                         Vec3 p) {
    Color c;
    if (!pigment_color(textures, pattern->pigment, hit, p, &c))
        return 0.0;
    return rgb_grey(color_rgb(c));
}

// Patterns that look at something else than the point.
static double other_formula(const Textures *textures, const Pattern *pattern, const TextureHit *hit,
                            Vec3 p) {
    switch (pattern->type) {
    case PATTERN_SLOPE:
        return slope(&pattern->slope, hit, p);
    case PATTERN_AOI:
        return angle_of_incidence(hit);
    case PATTERN_FUNCTION:
        return function(textures, pattern, p);
    case PATTERN_PIGMENT:
        return brightness(textures, pattern, hit, p);
    case PATTERN_OBJECT:
        return textures->inside(textures->objects, pattern->object, p) ? 1.0 : 0.0;
    case PATTERN_DENSITY:
        return density_value(&textures->densities[pattern->density], pattern->density_between, p);
    case PATTERN_FRACTAL:
        return fractal_value(pattern, p);
    case PATTERN_IMAGE:
        return image_map_value(&textures->pictures[pattern->picture], p);
    default:
        return noise_formula(textures, pattern, p);
    }
}

static double formula(const Textures *textures, const Pattern *pattern, const TextureHit *hit,
                      Vec3 p) {
    switch (pattern->type) {
    case PATTERN_CHECKER:
        return tiles_checker(p);
    case PATTERN_GRADIENT:
        return solid_gradient(pattern, p);
    case PATTERN_BOXED:
        return solid_boxed(p);
    case PATTERN_BRICK:
        return tiles_brick(pattern, p);
    case PATTERN_CELLS:
        return tiles_cells(p);
    case PATTERN_CUBIC:
        return tiles_cubic(p);
    case PATTERN_CYLINDRICAL:
        return solid_cylindrical(p);
    case PATTERN_HEXAGON:
        return tiles_hexagon(p);
    case PATTERN_LEOPARD:
        return solid_leopard(p);
    case PATTERN_ONION:
        return solid_onion(p);
    case PATTERN_PLANAR:
        return solid_planar(p);
    case PATTERN_QUILTED:
        return tiles_quilted(pattern, p);
    case PATTERN_RADIAL:
        return solid_radial(p);
    case PATTERN_SPHERICAL:
        return solid_spherical(p);
    case PATTERN_SQUARE:
        return tiles_square(p);
    case PATTERN_TRIANGULAR:
        return tiles_triangular(p);
    default:
        return other_formula(textures, pattern, hit, p);
    }
}

bool pattern_has_value(PatternType type) {
    switch (type) {
    case PATTERN_PLAIN:
    case PATTERN_AVERAGE:
    case PATTERN_BUMPS:
    case PATTERN_FACETS:
    case PATTERN_IMAGE_MAP:
    case PATTERN_BUMP_MAP:
    case PATTERN_MATERIAL_MAP:
        return false;
    default:
        return true;
    }
}

double pattern_value(const Textures *textures, const Pattern *pattern, const TextureHit *hit,
                     Vec3 warped) {
    double v = formula(textures, pattern, hit, warped);
    if (pattern->frequency != 0.0f)
        v = fmod(v * pattern->frequency + pattern->phase, WRAP);
    if (v < 0.0)
        v -= floor(v);
    return wave(pattern, v);
}
