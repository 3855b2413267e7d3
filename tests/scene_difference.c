// SPDX-License-Identifier: MIT
#include "random_scene.h"

#include "scene_members.h"
#include "tests/random_solid.h"

#include <string.h>

// Member by member, since the bytes between members say nothing.
#define COMPARE(Type, name)                                                                        \
    if (memcmp(&a->name, &b->name, sizeof(Type)) != 0)                                             \
        return #name;
#define COMPARE_ALL(a, b, count)                                                                   \
    if ((count) > 0 && memcmp(a, b, (size_t)(count) * sizeof *(a)) != 0)                           \
        return #a;
#define COMPARE_EACH(list, count, compare)                                                         \
    for (uint32_t i = 0; i < a->count; i++) {                                                      \
        const char *found = compare(&a->list[i], &b->list[i]);                                     \
        if (found)                                                                                 \
            return found;                                                                          \
    }

static const char *transform_difference(const Transform *a, const Transform *b) {
    COMPARE_ALL(a->m, b->m, 4)
    COMPARE_ALL(a->inv, b->inv, 4)
    return NULL;
}

static const char *settings_difference(const Settings *a, const Settings *b) {
    SETTINGS_MEMBERS(COMPARE)
    return NULL;
}

static const char *camera_difference(const Camera *a, const Camera *b) {
    CAMERA_MEMBERS(COMPARE)
    return NULL;
}

static const char *area_light_difference(const AreaLight *a, const AreaLight *b) {
    AREA_LIGHT_MEMBERS(COMPARE)
    return NULL;
}

static const char *light_difference(const Light *a, const Light *b) {
    LIGHT_MEMBERS(COMPARE)
    return a->has_area ? area_light_difference(&a->area, &b->area) : NULL;
}

static const char *warp_difference(const Warp *a, const Warp *b) {
    COMPARE(WarpType, type)
    switch (a->type) {
    case WARP_TRANSFORM:
        return transform_difference(&a->transform, &b->transform);
    case WARP_TURBULENCE:
        TURBULENCE_MEMBERS(COMPARE, turbulence)
        break;
    case WARP_REPEAT:
        REPEAT_MEMBERS(COMPARE)
        break;
    case WARP_BLACK_HOLE:
        BLACK_HOLE_MEMBERS(COMPARE)
        break;
    case WARP_CUBIC:
        break;
    case WARP_PLANAR:
    case WARP_SPHERICAL:
    case WARP_CYLINDRICAL:
    case WARP_TOROIDAL:
        MAPPING_MEMBERS(COMPARE)
        break;
    }
    return NULL;
}

static const char *pigment_difference(const Pigment *a, const Pigment *b) {
    PATTERN_MEMBERS(COMPARE)
    PIGMENT_MEMBERS(COMPARE)
    COMPARE_ALL(a->entries, b->entries, a->entry_count)
    COMPARE_EACH(pattern.warps, pattern.warp_count, warp_difference)
    return NULL;
}

static const char *finish_difference(const Finish *a, const Finish *b) {
    FINISH_MEMBERS(COMPARE)
    return NULL;
}

static const char *layer_difference(const Layer *a, const Layer *b) {
    COMPARE(uint32_t, pigment)
    COMPARE(uint32_t, normal)
    return finish_difference(&a->finish, &b->finish);
}

static const char *texture_difference(const Texture *a, const Texture *b) {
    COMPARE(uint32_t, layer_count)
    COMPARE(bool, uv_mapping)
    COMPARE(bool, no_bump_scale)
    COMPARE(uint32_t, entry_count)
    PATTERN_MEMBERS(COMPARE)
    COMPARE_ALL(a->entries, b->entries, a->entry_count)
    COMPARE_EACH(pattern.warps, pattern.warp_count, warp_difference)
    COMPARE_EACH(layers, layer_count, layer_difference)
    return NULL;
}

static const char *change_difference(const PaletteChange *a, const PaletteChange *b) {
    COMPARE(int, place)
    COMPARE(bool, transmit)
    COMPARE(float, value)
    return NULL;
}

static const char *picture_difference(const Picture *a, const Picture *b) {
    if ((a->path == NULL) != (b->path == NULL) || (a->path && strcmp(a->path, b->path) != 0))
        return "path";
    COMPARE(int, width)
    COMPARE(int, height)
    COMPARE(int, channels)
    COMPARE(uint32_t, value_count)
    if (a->value_count && memcmp(a->values, b->values, a->value_count * sizeof *a->values) != 0)
        return "values";
    COMPARE(PictureType, type)
    COMPARE(PictureDecode, decode)
    COMPARE(float, gamma)
    COMPARE(bool, to_working)
    COMPARE(PictureLayout, layout)
    COMPARE(PictureBetween, between)
    COMPARE(PictureUse, use)
    COMPARE(bool, once)
    COMPARE(Vec2, repeat)
    COMPARE(Vec2, offset)
    COMPARE(bool, has_filter)
    COMPARE(float, filter)
    COMPARE(bool, has_transmit)
    COMPARE(float, transmit)
    COMPARE(uint32_t, change_count)
    COMPARE_EACH(changes, change_count, change_difference)
    return NULL;
}

static const char *slope_difference(const SlopeEntry *a, const SlopeEntry *b) {
    COMPARE(float, value)
    COMPARE(double, height)
    COMPARE(double, slope)
    return NULL;
}

static const char *normal_difference(const Normal *a, const Normal *b) {
    PATTERN_MEMBERS(COMPARE)
    COMPARE(float, amount)
    COMPARE(float, accuracy)
    COMPARE(bool, uv_mapping)
    COMPARE(bool, no_bump_scale)
    COMPARE(uint32_t, slope_count)
    COMPARE(uint32_t, entry_count)
    COMPARE_ALL(a->entries, b->entries, a->entry_count)
    COMPARE_EACH(slopes, slope_count, slope_difference)
    COMPARE_EACH(pattern.warps, pattern.warp_count, warp_difference)
    return NULL;
}

static const char *interior_difference(const Interior *a, const Interior *b) {
    INTERIOR_MEMBERS(COMPARE)
    return NULL;
}

static const char *patch_difference(const PatchShape *a, const PatchShape *b) {
    COMPARE(uint32_t, degree_u)
    COMPARE(uint32_t, degree_v)
    COMPARE(int, type)
    COMPARE(double, flatness)
    COMPARE(int, u_steps)
    COMPARE(int, v_steps)
    COMPARE_ALL(a->uv, b->uv, 4)
    COMPARE_ALL(a->points, b->points, (a->degree_u + 1) * (a->degree_v + 1))
    if (!a->weights != !b->weights)
        return "weights";
    if (a->weights)
        COMPARE_ALL(a->weights, b->weights, (a->degree_u + 1) * (a->degree_v + 1))
    return NULL;
}

static const char *shape_difference(const Object *a, const Object *b) {
    switch (a->type) {
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
        COMPARE(uint32_t, shape.children.count)
        COMPARE_ALL(a->shape.children.items, b->shape.children.items, a->shape.children.count)
        break;
    case OBJECT_INSTANCE:
        COMPARE(uint32_t, shape.instance.definition)
        COMPARE(uint32_t, shape.instance.texture_count)
        COMPARE(uint32_t, shape.instance.interior_count)
        COMPARE_ALL(a->shape.instance.textures, b->shape.instance.textures,
                    2 * (size_t)a->shape.instance.texture_count)
        COMPARE_ALL(a->shape.instance.interiors, b->shape.instance.interiors,
                    2 * (size_t)a->shape.instance.interior_count)
        break;
    case OBJECT_PATCH:
        return patch_difference(&a->shape.patch, &b->shape.patch);
    case OBJECT_PLANE:
        COMPARE(PlaneShape, shape.plane)
        break;
    case OBJECT_SPHERE:
        COMPARE(SphereShape, shape.sphere)
        break;
    case OBJECT_BOX:
        COMPARE(BoxShape, shape.box)
        break;
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        COMPARE(Vec3, shape.cone.base)
        COMPARE(Vec3, shape.cone.apex)
        COMPARE(double, shape.cone.base_radius)
        COMPARE(double, shape.cone.apex_radius)
        COMPARE(bool, shape.cone.open)
        break;
    case OBJECT_TORUS:
        COMPARE(TorusShape, shape.torus)
        break;
    case OBJECT_DISC:
        COMPARE(DiscShape, shape.disc)
        break;
    case OBJECT_TRIANGLE:
        COMPARE(TriangleShape, shape.triangle)
        break;
    default:
        return solid_difference(a, b);
    }
    return NULL;
}

static const char *object_difference(const Object *a, const Object *b) {
    OBJECT_MEMBERS(COMPARE)
    COMPARE(uint32_t, clips.count)
    COMPARE_ALL(a->clips.items, b->clips.items, a->clips.count)
    COMPARE(bool, whole)
    COMPARE(bool, solid)
    COMPARE(uint32_t, bounds.count)
    COMPARE_ALL(a->bounds.items, b->bounds.items, a->bounds.count)
    const char *difference = transform_difference(&a->transform, &b->transform);
    return difference ? difference : shape_difference(a, b);
}

static const char *sky_difference(const Scene *scene_a, const Scene *scene_b) {
    const SkySphere *a = &scene_a->sky_sphere, *b = &scene_b->sky_sphere;
    if (!scene_a->has_sky_sphere)
        return NULL;
    COMPARE(uint32_t, pigment_count)
    COMPARE(Rgb, emission)
    COMPARE_ALL(a->pigments, b->pigments, a->pigment_count)
    return transform_difference(&a->transform, &b->transform);
}

static const char *fog_difference(const Fog *a, const Fog *b) {
    FOG_MEMBERS(COMPARE)
    return NULL;
}

static const char *rainbow_difference(const Rainbow *a, const Rainbow *b) {
    RAINBOW_MEMBERS(COMPARE)
    return NULL;
}

const char *scene_difference(const Scene *a, const Scene *b) {
    COMPARE(bool, has_sky_sphere)
    COMPARE(uint32_t, fog_count)
    COMPARE(uint32_t, rainbow_count)
    COMPARE(uint32_t, light_count)
    COMPARE(uint32_t, pigment_count)
    COMPARE(uint32_t, density_count)
    for (uint32_t i = 0; i < a->density_count; i++)
        if (strcmp(a->densities[i].path, b->densities[i].path) != 0)
            return "densities";
    COMPARE(uint32_t, picture_count)
    COMPARE(uint32_t, normal_count)
    COMPARE(uint32_t, texture_count)
    COMPARE(uint32_t, interior_count)
    COMPARE(uint32_t, object_count)
    COMPARE(uint32_t, root_count)
    COMPARE(uint32_t, projection_count)
    COMPARE_ALL(a->projections, b->projections, a->projection_count)
    COMPARE(uint32_t, definition_count)
    COMPARE_ALL(a->definitions, b->definitions, a->definition_count)
    COMPARE(uint32_t, requires_count)
    COMPARE_ALL(a->roots, b->roots, a->root_count)
    for (uint32_t i = 0; i < a->requires_count; i++)
        if (strcmp(a->requires[i], b -> requires[i]) != 0)
            return "requires";
    const char *difference = settings_difference(&a->settings, &b->settings);
    if (!difference)
        difference = camera_difference(&a->camera, &b->camera);
    if (!difference)
        difference = sky_difference(a, b);
    if (!difference)
        difference = pool_difference(a, b);
    if (difference)
        return difference;
    COMPARE_EACH(fogs, fog_count, fog_difference)
    COMPARE_EACH(rainbows, rainbow_count, rainbow_difference)
    COMPARE_EACH(lights, light_count, light_difference)
    COMPARE_EACH(pigments, pigment_count, pigment_difference)
    COMPARE_EACH(pictures, picture_count, picture_difference)
    COMPARE_EACH(normals, normal_count, normal_difference)
    COMPARE_EACH(textures, texture_count, texture_difference)
    COMPARE_EACH(interiors, interior_count, interior_difference)
    COMPARE_EACH(objects, object_count, object_difference)
    return NULL;
}
