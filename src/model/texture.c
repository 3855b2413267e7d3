// SPDX-License-Identifier: MIT
// POV-Ray 3.7's defaults of textures (see scene.c).
#include "model/texture.h"

#include "model/scene.h"

#include <string.h>

Turbulence turbulence_default(void) {
    return (Turbulence){.octaves = 6, .lambda = 2.0f, .omega = 0.5f};
}

Pattern pattern_default(void) {
    return (Pattern){
        .type = PATTERN_PLAIN,
        .wave = WAVE_RAMP,
        .frequency = 1,
        .exponent = 1,
        .turbulence = turbulence_default(),
        .agate_turb = 1.0f,
        .brick_size = {8, 3, 4.5},
        .mortar = 0.5f,
        .quilted = {1.0f, 1.0f},
        .crackle = {.form = {-1, 1, 0}, .metric = 2},
        .facets = {.size = 0.1, .metric = 2},
        .picture = NO_INDEX,
        .slope = {.share = 1},
        .fractal = {.exponent = 2, .exterior = 1, .exterior_factor = 1, .interior_factor = 1},
        .function = NO_INDEX,
        .pigment = NO_INDEX,
        .object = NO_INDEX,
        .density = NO_INDEX,
    };
}

Picture picture_default(void) { return (Picture){.gamma = 1.0f, .repeat = {1, 1}}; }

Normal normal_default(void) {
    return (Normal){.pattern = pattern_default(), .amount = 0.5f, .accuracy = 0.02f};
}

Warp warp_default(WarpType type) {
    Warp warp;
    memset(&warp, 0, sizeof warp);
    warp.type = type;
    switch (type) {
    case WARP_TRANSFORM:
        warp.transform = transform_identity();
        break;
    case WARP_TURBULENCE:
        warp.turbulence = turbulence_default();
        break;
    case WARP_REPEAT:
        warp.repeat.flip = vec3(1, 1, 1);
        break;
    case WARP_BLACK_HOLE:
        warp.black_hole.strength = 1;
        warp.black_hole.falloff = 2;
        break;
    case WARP_CUBIC:
        break;
    case WARP_PLANAR:
    case WARP_SPHERICAL:
    case WARP_CYLINDRICAL:
    case WARP_TOROIDAL:
        warp.mapping.orientation = vec3(0, 0, 1);
        warp.mapping.major_radius = 1;
        break;
    }
    return warp;
}

Finish finish_default(void) {
    return (Finish){
        .ambient = {0.1f, 0.1f, 0.1f},
        .diffuse = 0.6f,
        .brilliance = 1.0f,
        .phong_size = 40.0f,
        .roughness = 0.05f,
        .reflection_falloff = 1.0f,
        .reflection_exponent = 1.0f,
    };
}

Interior interior_default(void) {
    return (Interior){.ior = 1.0f, .refraction = 1.0f, .dispersion = 1.0f, .dispersion_samples = 7};
}
