// SPDX-License-Identifier: MIT
// The features that a scene needs from its renderer, by name.
#include "model/scene_requires.h"

#include "model/scene.h"

#include <string.h>

// ORDER feature: sorted by byte, so that features in order give a sorted list.
#define FEATURES(X)                                                                                \
    X(agate)                                                                                       \
    X(aoi)                                                                                         \
    X(area_light)                                                                                  \
    X(average)                                                                                     \
    X(bezier_patch)                                                                                \
    X(bicubic_patch)                                                                               \
    X(blob)                                                                                        \
    X(bounded_by)                                                                                  \
    X(box)                                                                                         \
    X(boxed)                                                                                       \
    X(bozo)                                                                                        \
    X(brick)                                                                                       \
    X(brilliance)                                                                                  \
    X(bump_map)                                                                                    \
    X(bumps)                                                                                       \
    X(camera_normal)                                                                               \
    X(caustics)                                                                                    \
    X(cells)                                                                                       \
    X(checker)                                                                                     \
    X(clipped_by)                                                                                  \
    X(cone)                                                                                        \
    X(conserve_energy)                                                                             \
    X(crackle)                                                                                     \
    X(crand)                                                                                       \
    X(cubic)                                                                                       \
    X(cutaway_textures)                                                                            \
    X(cylinder)                                                                                    \
    X(cylinder_camera)                                                                             \
    X(cylinder_light)                                                                              \
    X(cylindrical)                                                                                 \
    X(density_file)                                                                                \
    X(dents)                                                                                       \
    X(diffuse_back)                                                                                \
    X(disc)                                                                                        \
    X(dispersion)                                                                                  \
    X(double_illuminate)                                                                           \
    X(facets)                                                                                      \
    X(fisheye)                                                                                     \
    X(focal_blur)                                                                                  \
    X(fog)                                                                                         \
    X(fractal)                                                                                     \
    X(function)                                                                                    \
    X(gradient)                                                                                    \
    X(granite)                                                                                     \
    X(height_field)                                                                                \
    X(hexagon)                                                                                     \
    X(hollow)                                                                                      \
    X(image_map)                                                                                   \
    X(image_pattern)                                                                               \
    X(instance)                                                                                    \
    X(interior_fade)                                                                               \
    X(interior_texture)                                                                            \
    X(intersection)                                                                                \
    X(inverse)                                                                                     \
    X(irid)                                                                                        \
    X(isosurface)                                                                                  \
    X(lathe)                                                                                       \
    X(layered_texture)                                                                             \
    X(leopard)                                                                                     \
    X(light_fade)                                                                                  \
    X(light_group)                                                                                 \
    X(marble)                                                                                      \
    X(material_map)                                                                                \
    X(media_attenuation)                                                                           \
    X(merge)                                                                                       \
    X(mesh)                                                                                        \
    X(metallic)                                                                                    \
    X(no_image)                                                                                    \
    X(no_reflection)                                                                               \
    X(no_shadow)                                                                                   \
    X(normal)                                                                                      \
    X(normal_map)                                                                                  \
    X(object_pattern)                                                                              \
    X(omnimax)                                                                                     \
    X(onion)                                                                                       \
    X(orthographic)                                                                                \
    X(ovus)                                                                                        \
    X(panoramic)                                                                                   \
    X(parallel_light)                                                                              \
    X(parametric)                                                                                  \
    X(patch_solids)                                                                                \
    X(pattern_warp)                                                                                \
    X(pattern_wave)                                                                                \
    X(perspective)                                                                                 \
    X(phong)                                                                                       \
    X(pigment_map)                                                                                 \
    X(pigment_pattern)                                                                             \
    X(planar)                                                                                      \
    X(plane)                                                                                       \
    X(point_light)                                                                                 \
    X(poly)                                                                                        \
    X(polygon)                                                                                     \
    X(prism)                                                                                       \
    X(projected_through)                                                                           \
    X(quadric)                                                                                     \
    X(quilted)                                                                                     \
    X(radial)                                                                                      \
    X(rainbow)                                                                                     \
    X(rational_patch)                                                                              \
    X(reflection)                                                                                  \
    X(reflection_fresnel)                                                                          \
    X(refraction)                                                                                  \
    X(ripples)                                                                                     \
    X(shadowless_light)                                                                            \
    X(sky_sphere)                                                                                  \
    X(slope)                                                                                       \
    X(slope_map)                                                                                   \
    X(smooth_triangle)                                                                             \
    X(sor)                                                                                         \
    X(specular)                                                                                    \
    X(sphere)                                                                                      \
    X(sphere_sweep)                                                                                \
    X(spherical)                                                                                   \
    X(spherical_camera)                                                                            \
    X(spiral1)                                                                                     \
    X(spiral2)                                                                                     \
    X(spotlight)                                                                                   \
    X(square)                                                                                      \
    X(superellipsoid)                                                                              \
    X(text)                                                                                        \
    X(texture_map)                                                                                 \
    X(torus)                                                                                       \
    X(transparency)                                                                                \
    X(triangle)                                                                                    \
    X(triangular)                                                                                  \
    X(turbulence)                                                                                  \
    X(ultra_wide_angle)                                                                            \
    X(union)                                                                                       \
    X(uv_mapping)                                                                                  \
    X(warp_black_hole)                                                                             \
    X(warp_cubic)                                                                                  \
    X(warp_cylindrical)                                                                            \
    X(warp_planar)                                                                                 \
    X(warp_repeat)                                                                                 \
    X(warp_spherical)                                                                              \
    X(warp_toroidal)                                                                               \
    X(warp_turbulence)                                                                             \
    X(waves)                                                                                       \
    X(whole_union)                                                                                 \
    X(wood)                                                                                        \
    X(wrinkles)

typedef enum {
#define X(word) FEATURE_##word,
    FEATURES(X)
#undef X
        FEATURE_COUNT
} Feature;

static const char *const FEATURE_NAMES[] = {
#define X(word) #word,
    FEATURES(X)
#undef X
};

typedef struct {
    bool has[FEATURE_COUNT];
} FeatureSet;

static void need(FeatureSet *set, Feature feature, bool needed) { set->has[feature] |= needed; }

// ORDER pattern_type; a plain colour needs nothing.
static const Feature PATTERN_FEATURES[] = {
    FEATURE_COUNT,         FEATURE_checker,    FEATURE_gradient,        FEATURE_agate,
    FEATURE_boxed,         FEATURE_bozo,       FEATURE_brick,           FEATURE_cells,
    FEATURE_crackle,       FEATURE_cubic,      FEATURE_cylindrical,     FEATURE_dents,
    FEATURE_granite,       FEATURE_hexagon,    FEATURE_leopard,         FEATURE_marble,
    FEATURE_onion,         FEATURE_planar,     FEATURE_quilted,         FEATURE_radial,
    FEATURE_ripples,       FEATURE_spherical,  FEATURE_spiral1,         FEATURE_spiral2,
    FEATURE_square,        FEATURE_triangular, FEATURE_waves,           FEATURE_wood,
    FEATURE_wrinkles,      FEATURE_average,    FEATURE_bumps,           FEATURE_facets,
    FEATURE_image_pattern, FEATURE_image_map,  FEATURE_bump_map,        FEATURE_slope,
    FEATURE_aoi,           FEATURE_function,   FEATURE_pigment_pattern, FEATURE_object_pattern,
    FEATURE_density_file,  FEATURE_fractal,    FEATURE_material_map,
};
_Static_assert(sizeof PATTERN_FEATURES / sizeof *PATTERN_FEATURES == PATTERN_MODELLED,
               "a feature for each pattern");

// ORDER warp_type; transforms count as pattern_warp only.
static const Feature WARP_FEATURES[] = {
    FEATURE_pattern_warp,    FEATURE_warp_turbulence,  FEATURE_warp_repeat,
    FEATURE_warp_black_hole, FEATURE_warp_cubic,       FEATURE_warp_planar,
    FEATURE_warp_spherical,  FEATURE_warp_cylindrical, FEATURE_warp_toroidal};

// ORDER object_type; a patch is one of three (patch_feature).
static const Feature OBJECT_FEATURES[] = {
    FEATURE_union,
    FEATURE_merge,
    FEATURE_intersection,
    FEATURE_bicubic_patch,
    FEATURE_plane,
    FEATURE_sphere,
    FEATURE_box,
    FEATURE_cylinder,
    FEATURE_cone,
    FEATURE_torus,
    FEATURE_disc,
    FEATURE_triangle,
    FEATURE_quadric,
    FEATURE_poly,
    FEATURE_superellipsoid,
    FEATURE_lathe,
    FEATURE_sor,
    FEATURE_prism,
    FEATURE_sphere_sweep,
    FEATURE_blob,
    FEATURE_ovus,
    FEATURE_smooth_triangle,
    FEATURE_polygon,
    FEATURE_mesh,
    FEATURE_height_field,
    FEATURE_text,
    FEATURE_isosurface,
    FEATURE_parametric,
    FEATURE_instance,
};
_Static_assert(sizeof OBJECT_FEATURES / sizeof *OBJECT_FEATURES == OBJECT_TYPE_COUNT,
               "a feature for each type of object");

// ORDER camera_type
static const Feature CAMERA_FEATURES[] = {
    FEATURE_perspective,      FEATURE_orthographic,    FEATURE_fisheye,
    FEATURE_ultra_wide_angle, FEATURE_omnimax,         FEATURE_panoramic,
    FEATURE_cylinder_camera,  FEATURE_cylinder_camera, FEATURE_cylinder_camera,
    FEATURE_cylinder_camera,  FEATURE_spherical_camera};

static bool is_black(Rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }
static bool is_clear(Color c) { return c.filter != 0 || c.transmit != 0; }

static void collect_lights(const Scene *scene, FeatureSet *set) {
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        need(set, FEATURE_point_light, light->type == LIGHT_POINT);
        need(set, FEATURE_parallel_light, light->type == LIGHT_PARALLEL);
        need(set, FEATURE_spotlight, light->type == LIGHT_SPOT);
        need(set, FEATURE_cylinder_light, light->type == LIGHT_CYLINDER);
        need(set, FEATURE_area_light, light->has_area);
        need(set, FEATURE_shadowless_light, light->shadowless);
        need(set, FEATURE_light_group, light->group != 0);
        need(set, FEATURE_media_attenuation, light->media_attenuation);
        need(set, FEATURE_projected_through, light->has_projection);
        need(set, FEATURE_light_fade, light->fade_distance != 0 && light->fade_power > 0);
    }
}

static void collect_pattern(const Pattern *pattern, FeatureSet *set) {
    bool plain = pattern->type == PATTERN_PLAIN;
    if (!plain)
        need(set, PATTERN_FEATURES[pattern->type], true);
    need(set, FEATURE_pattern_wave, !plain && pattern->wave != WAVE_RAMP);
    need(set, FEATURE_pattern_warp, pattern->warp_count > 0);
    for (uint32_t j = 0; j < pattern->warp_count; j++)
        need(set, WARP_FEATURES[pattern->warps[j].type], true);
    need(set, FEATURE_turbulence, pattern->has_turbulence);
}

static void collect_pigments(const Scene *scene, FeatureSet *set) {
    for (uint32_t i = 0; i < scene->pigment_count; i++) {
        const Pigment *pigment = &scene->pigments[i];
        collect_pattern(&pigment->pattern, set);
        need(set, FEATURE_uv_mapping, pigment->uv_mapping);
        need(set, FEATURE_transparency,
             pigment->pattern.type == PATTERN_PLAIN && is_clear(pigment->color));
        for (uint32_t j = 0; j < pigment->entry_count; j++) {
            bool map = pigment->entries[j].pigment != NO_INDEX;
            need(set, FEATURE_pigment_map, map);
            need(set, FEATURE_transparency, !map && is_clear(pigment->entries[j].color));
        }
    }
}

static void collect_normals(const Scene *scene, FeatureSet *set) {
    for (uint32_t i = 0; i < scene->normal_count; i++) {
        const Normal *normal = &scene->normals[i];
        need(set, FEATURE_normal, true);
        collect_pattern(&normal->pattern, set);
        need(set, FEATURE_uv_mapping, normal->uv_mapping);
        need(set, FEATURE_normal_map, normal->entry_count > 0);
        need(set, FEATURE_slope_map, normal->slope_count > 0);
    }
}

static void collect_finish(const Finish *finish, FeatureSet *set) {
    need(set, FEATURE_brilliance, finish->brilliance != 1);
    need(set, FEATURE_diffuse_back, finish->diffuse_back != 0);
    need(set, FEATURE_crand, finish->crand != 0);
    need(set, FEATURE_phong, finish->phong != 0);
    need(set, FEATURE_specular, finish->specular != 0);
    need(set, FEATURE_metallic, finish->metallic != 0 || finish->reflection_metallic != 0);
    need(set, FEATURE_reflection,
         !is_black(finish->reflection_min) || !is_black(finish->reflection_max));
    need(set, FEATURE_reflection_fresnel, finish->reflection_fresnel);
    need(set, FEATURE_conserve_energy, finish->conserve_energy);
    need(set, FEATURE_irid, finish->irid != 0);
}

static void collect_textures(const Scene *scene, FeatureSet *set) {
    for (uint32_t i = 0; i < scene->texture_count; i++) {
        const Texture *texture = &scene->textures[i];
        need(set, FEATURE_layered_texture, texture->layer_count > 1);
        need(set, FEATURE_texture_map, texture->entry_count > 0);
        collect_pattern(&texture->pattern, set);
        need(set, FEATURE_uv_mapping, texture->uv_mapping);
        for (uint32_t j = 0; j < texture->layer_count; j++)
            collect_finish(&texture->layers[j].finish, set);
    }
    for (uint32_t i = 0; i < scene->interior_count; i++) {
        const Interior *interior = &scene->interiors[i];
        need(set, FEATURE_refraction, interior->ior != 1);
        need(set, FEATURE_caustics, interior->caustics != 0);
        need(set, FEATURE_dispersion, interior->dispersion != 1);
        need(set, FEATURE_interior_fade, interior->fade_distance != 0);
    }
}

static Feature patch_feature(const PatchShape *patch) {
    bool bicubic = patch->degree_u == 3 && patch->degree_v == 3;
    if (patch->weights)
        return FEATURE_rational_patch;
    return bicubic ? FEATURE_bicubic_patch : FEATURE_bezier_patch;
}

static Feature object_feature(const Object *object) {
    return object->type == OBJECT_PATCH ? patch_feature(&object->shape.patch)
                                        : OBJECT_FEATURES[object->type];
}

static void collect_objects(const Scene *scene, FeatureSet *set) {
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        need(set, object_feature(object), true);
        need(set, FEATURE_interior_texture, object->interior_texture != NO_INDEX);
        need(set, FEATURE_light_group, object->light_group != 0 || object->no_global_lights);
        need(set, FEATURE_no_shadow, object->no_shadow);
        need(set, FEATURE_no_image, object->no_image);
        need(set, FEATURE_no_reflection, object->no_reflection);
        need(set, FEATURE_hollow, object->hollow);
        need(set, FEATURE_inverse, object->inverse);
        need(set, FEATURE_clipped_by, object->clips.count > 0);
        need(set, FEATURE_bounded_by, object->bounds.count > 0);
        need(set, FEATURE_whole_union, object->whole);
        need(set, FEATURE_cutaway_textures, object->cutaway);
        need(set, FEATURE_patch_solids, object->solid);
        need(set, FEATURE_double_illuminate, object->double_illuminate);
        need(set, FEATURE_uv_mapping, object->uv_mapping);
    }
}

void scene_collect_requires(Scene *scene, Arena *arena) {
    FeatureSet set = {{false}};
    need(&set, CAMERA_FEATURES[scene->camera.type], true);
    need(&set, FEATURE_camera_normal, scene->camera.has_normal);
    need(&set, FEATURE_focal_blur, scene->camera.has_blur);
    need(&set, FEATURE_sky_sphere, scene->has_sky_sphere);
    need(&set, FEATURE_fog, scene->fog_count > 0);
    need(&set, FEATURE_rainbow, scene->rainbow_count > 0);
    collect_lights(scene, &set);
    collect_pigments(scene, &set);
    collect_normals(scene, &set);
    collect_textures(scene, &set);
    collect_objects(scene, &set);

    const char **words = ARENA_ARRAY(arena, const char *, FEATURE_COUNT);
    uint32_t count = 0;
    for (int i = 0; i < FEATURE_COUNT; i++)
        if (set.has[i])
            words[count++] = FEATURE_NAMES[i];
    scene->requires = words;
    scene->requires_count = count;
}

bool scene_requires_known(const char *word) {
    for (int i = 0; i < FEATURE_COUNT; i++)
        if (strcmp(word, FEATURE_NAMES[i]) == 0)
            return true;
    return false;
}
