// SPDX-License-Identifier: MIT
// The members of the structs of scene.h, for making random scenes and for comparing two: apart
// from the product's own tables.
#ifndef TESTS_SCENE_MEMBERS_H
#define TESTS_SCENE_MEMBERS_H

#define SETTINGS_MEMBERS(X)                                                                        \
    X(int, version)                                                                                \
    X(GammaMode, gamma_mode)                                                                       \
    X(float, assumed_gamma)                                                                        \
    X(Rgb, ambient_light)                                                                          \
    X(int, max_trace_level)                                                                        \
    X(float, adc_bailout)                                                                          \
    X(int, noise_generator)                                                                        \
    X(int, number_of_waves)                                                                        \
    X(Rgb, irid_wavelength)                                                                        \
    X(Color, background)
#define CAMERA_MEMBERS(X)                                                                          \
    X(CameraType, type)                                                                            \
    X(Vec3, location)                                                                              \
    X(Vec3, direction)                                                                             \
    X(Vec3, up)                                                                                    \
    X(Vec3, right)                                                                                 \
    X(double, angle_deg)                                                                           \
    X(double[2], spherical_deg)                                                                    \
    X(bool, has_blur)                                                                              \
    X(double, blur.aperture)                                                                       \
    X(double, blur.focal_distance)                                                                 \
    X(int, blur.samples)                                                                           \
    X(int, blur.min_samples)                                                                       \
    X(double, blur.confidence)                                                                     \
    X(double, blur.variance)                                                                       \
    X(bool, has_normal)                                                                            \
    X(uint32_t, normal)
#define LIGHT_MEMBERS(X)                                                                           \
    X(LightType, type)                                                                             \
    X(Vec3, location)                                                                              \
    X(Vec3, point_at)                                                                              \
    X(Rgb, color)                                                                                  \
    X(bool, shadowless)                                                                            \
    X(bool, parallel)                                                                              \
    X(double, radius)                                                                              \
    X(double, falloff)                                                                             \
    X(double, tightness)                                                                           \
    X(double, fade_distance)                                                                       \
    X(double, fade_power)                                                                          \
    X(bool, has_area)                                                                              \
    X(bool, media_attenuation)                                                                     \
    X(uint32_t, group)                                                                             \
    X(bool, has_projection)                                                                        \
    X(uint32_t, projection)
#define AREA_LIGHT_MEMBERS(X)                                                                      \
    X(Vec3[2], axis)                                                                               \
    X(int[2], size)                                                                                \
    X(int, adaptive) X(bool, circular) X(bool, orient) X(bool, jitter) X(bool, illumination)
#define TURBULENCE_MEMBERS(X, at)                                                                  \
    X(Vec3, at.amount) X(int, at.octaves) X(float, at.lambda) X(float, at.omega)
#define PATTERN_MEMBERS(X)                                                                         \
    X(PatternType, pattern.type)                                                                   \
    X(WaveType, pattern.wave)                                                                      \
    X(float, pattern.frequency)                                                                    \
    X(float, pattern.phase)                                                                        \
    X(float, pattern.exponent)                                                                     \
    X(int, pattern.noise_generator)                                                                \
    X(Vec3, pattern.gradient)                                                                      \
    X(float, pattern.agate_turb)                                                                   \
    X(int, pattern.arms)                                                                           \
    X(Vec3, pattern.brick_size)                                                                    \
    X(float, pattern.mortar)                                                                       \
    X(float[2], pattern.quilted)                                                                   \
    X(Vec3, pattern.crackle.form)                                                                  \
    X(double, pattern.crackle.metric)                                                              \
    X(double, pattern.crackle.offset)                                                              \
    X(bool, pattern.crackle.solid)                                                                 \
    X(Vec3, pattern.slope.slope)                                                                   \
    X(bool, pattern.slope.point_at)                                                                \
    X(double, pattern.slope.low)                                                                   \
    X(double, pattern.slope.high)                                                                  \
    X(Vec3, pattern.slope.altitude)                                                                \
    X(double, pattern.slope.altitude_low)                                                          \
    X(double, pattern.slope.altitude_high)                                                         \
    X(double, pattern.slope.share)                                                                 \
    X(int, pattern.fractal.exponent)                                                               \
    X(int, pattern.fractal.magnet)                                                                 \
    X(bool, pattern.fractal.julia)                                                                 \
    X(int, pattern.fractal.iterations)                                                             \
    X(Vec2, pattern.fractal.c)                                                                     \
    X(int, pattern.fractal.exterior)                                                               \
    X(int, pattern.fractal.interior)                                                               \
    X(double, pattern.fractal.exterior_factor)                                                     \
    X(double, pattern.fractal.interior_factor)                                                     \
    X(uint32_t, pattern.function)                                                                  \
    X(uint32_t, pattern.pigment)                                                                   \
    X(uint32_t, pattern.object)                                                                    \
    X(uint32_t, pattern.density)                                                                   \
    X(int, pattern.density_between)                                                                \
    X(uint32_t, pattern.picture)                                                                   \
    X(FacetsShape, pattern.facets)                                                                 \
    X(bool, pattern.has_turbulence)                                                                \
    TURBULENCE_MEMBERS(X, pattern.turbulence)                                                      \
    X(uint32_t, pattern.warp_count)
#define REPEAT_MEMBERS(X)                                                                          \
    X(int, repeat.axis) X(float, repeat.width) X(Vec3, repeat.offset) X(Vec3, repeat.flip)
#define BLACK_HOLE_MEMBERS(X)                                                                      \
    X(Vec3, black_hole.center)                                                                     \
    X(double, black_hole.radius)                                                                   \
    X(double, black_hole.strength)                                                                 \
    X(double, black_hole.falloff)                                                                  \
    X(bool, black_hole.inverse)                                                                    \
    X(bool, black_hole.repeat)                                                                     \
    X(Vec3, black_hole.repeat_size)                                                                \
    X(Vec3, black_hole.uncertainty)
#define MAPPING_MEMBERS(X)                                                                         \
    X(Vec3, mapping.orientation)                                                                   \
    X(double, mapping.distance) X(double, mapping.dist_exp) X(double, mapping.major_radius)
#define PIGMENT_MEMBERS(X)                                                                         \
    X(Color, color)                                                                                \
    X(uint32_t, entry_count) X(bool, uv_mapping) X(bool, has_quick_color) X(Color, quick_color)
#define FINISH_FLOATS(X)                                                                           \
    X(float, diffuse)                                                                              \
    X(float, diffuse_back)                                                                         \
    X(float, brilliance)                                                                           \
    X(float, crand)                                                                                \
    X(float, phong)                                                                                \
    X(float, phong_size)                                                                           \
    X(float, specular)                                                                             \
    X(float, roughness)                                                                            \
    X(float, metallic)                                                                             \
    X(float, reflection_falloff)                                                                   \
    X(float, reflection_exponent)                                                                  \
    X(float, reflection_metallic) X(float, irid) X(float, irid_thickness) X(float, irid_turbulence)
#define FINISH_MEMBERS(X)                                                                          \
    FINISH_FLOATS(X)                                                                               \
    X(Rgb, ambient)                                                                                \
    X(Rgb, emission)                                                                               \
    X(Rgb, reflection_min)                                                                         \
    X(Rgb, reflection_max) X(bool, reflection_fresnel) X(bool, conserve_energy)
#define INTERIOR_MEMBERS(X)                                                                        \
    X(float, ior)                                                                                  \
    X(float, caustics)                                                                             \
    X(float, fade_distance)                                                                        \
    X(float, fade_power)                                                                           \
    X(Rgb, fade_color)                                                                             \
    X(float, refraction)                                                                           \
    X(float, dispersion)                                                                           \
    X(int, dispersion_samples)
#define OBJECT_FLAGS(X)                                                                            \
    X(bool, no_shadow)                                                                             \
    X(bool, no_image)                                                                              \
    X(bool, no_reflection)                                                                         \
    X(bool, no_global_lights)                                                                      \
    X(bool, hollow) X(bool, inverse) X(bool, double_illuminate) X(bool, uv_mapping)
#define OBJECT_MEMBERS(X)                                                                          \
    OBJECT_FLAGS(X)                                                                                \
    X(ObjectType, type)                                                                            \
    X(uint32_t, texture)                                                                           \
    X(uint32_t, light_group)                                                                       \
    X(bool, difference)                                                                            \
    X(bool, cutaway)                                                                               \
    X(uint32_t, interior_texture) X(uint32_t, interior) X(bool, has_transform)
#define FOG_MEMBERS(X)                                                                             \
    X(FogType, type)                                                                               \
    X(double, distance)                                                                            \
    X(double, alt)                                                                                 \
    X(double, offset)                                                                              \
    X(Vec3, up)                                                                                    \
    X(Color, color)                                                                                \
    X(bool, has_turbulence)                                                                        \
    X(Turbulence, turbulence)                                                                      \
    X(float, turb_depth)
#define RAINBOW_MEMBERS(X)                                                                         \
    X(uint32_t, pigment)                                                                           \
    X(Vec3, direction)                                                                             \
    X(Vec3, right)                                                                                 \
    X(Vec3, up)                                                                                    \
    X(double, distance)                                                                            \
    X(double, angle_deg)                                                                           \
    X(double, width_deg)                                                                           \
    X(double, arc_deg)                                                                             \
    X(double, falloff_deg)                                                                         \
    X(double, jitter)

#endif
