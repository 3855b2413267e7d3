// SPDX-License-Identifier: MIT
// POV-Ray 3.7's defaults (facts: rendering 1.1, 4.4; sdl 4.12). They serve twice: the converter
// starts from them, and the scene file leaves out what equals them.
#include "model/scene.h"

Settings settings_default(void) {
    return (Settings){
        .version = 370,
        .gamma_mode = GAMMA_POWER,
        .assumed_gamma = 1.0f,
        .ambient_light = {1.0f, 1.0f, 1.0f},
        .max_trace_level = 5,
        .adc_bailout = (float)(1.0 / 255.0),
        .noise_generator = 2,
        .number_of_waves = 10,
        .irid_wavelength = {0.70f, 0.52f, 0.48f},
        .background = {.transmit = 1.0f},
    };
}

FocalBlur focal_blur_default(void) {
    return (FocalBlur){.focal_distance = 1, .confidence = 0.9, .variance = 1.0 / 10000.0};
}

Camera camera_default(void) {
    return (Camera){
        .type = CAMERA_PERSPECTIVE,
        .direction = {0, 0, 1},
        .up = {0, 1, 0},
        .right = {1.33, 0, 0},
        .angle_deg = 90,
        .spherical_deg = {360, 180},
        .blur = focal_blur_default(),
    };
}

AreaLight area_light_default(void) { return (AreaLight){.size = {1, 1}, .adaptive = 100}; }

Light light_default(LightType type) {
    Light light = {.type = type, .point_at = {0, 0, 1}, .area = area_light_default()};
    if (type == LIGHT_SPOT)
        light.radius = 30, light.falloff = 45;
    else if (type == LIGHT_CYLINDER)
        light.radius = 0.75, light.falloff = 1;
    return light;
}

Fog fog_default(void) {
    return (Fog){.up = {0, 1, 0}, .turbulence = turbulence_default(), .turb_depth = 0.5f};
}

Rainbow rainbow_default(void) {
    return (Rainbow){.pigment = NO_INDEX,
                     .right = {1, 0, 0},
                     .up = {0, 1, 0},
                     .distance = 1e7,
                     .arc_deg = RAINBOW_ALL_AROUND,
                     .falloff_deg = RAINBOW_ALL_AROUND};
}
