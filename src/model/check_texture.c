// SPDX-License-Identifier: MIT
// Pigments and textures, as scene_validate.c checks the rest.
#include "model/check.h"
#include "model/scene_format.h"

#include <math.h>

enum { MAX_OCTAVES = 10 }; // POV-Ray's own limit

void check_turbulence(const Check *c, const FieldPath *path, const Turbulence *turbulence) {
    check_vec3(c, path, "amount", turbulence->amount);
    check_range(c, path, "octaves", turbulence->octaves, 1, MAX_OCTAVES);
    check_float(c, path, "lambda", turbulence->lambda);
    check_float(c, path, "omega", turbulence->omega);
}

static void check_repeat(const Check *c, const FieldPath *path, const RepeatWarp *repeat) {
    const FieldPath flip = path_field(path, "flip");
    check_range(c, path, "axis", repeat->axis, 0, 2);
    check_not_zero(c, path, "width", repeat->width);
    check_vec3(c, path, "offset", repeat->offset);
    for (int i = 0; i < 3; i++)
        if (fabs(vec_get(repeat->flip, i)) != 1)
            refuse(c, &flip, "%g is neither 1 nor -1", vec_get(repeat->flip, i));
}

static void check_black_hole(const Check *c, const FieldPath *path, const BlackHoleWarp *hole) {
    check_vec3(c, path, "center", hole->center);
    check_size(c, path, "radius", hole->radius);
    check_numbers(c, path, "strength", &hole->strength, 1);
    check_numbers(c, path, "falloff", &hole->falloff, 1);
    if (hole->repeat)
        check_vec3(c, path, "repeat_size", hole->repeat_size);
    check_vec3(c, path, "uncertainty", hole->uncertainty);
}

static void check_mapping(const Check *c, const FieldPath *path, const MappingWarp *mapping) {
    check_unit(c, path, "orientation", mapping->orientation);
    check_numbers(c, path, "distance", &mapping->distance, 1);
    check_numbers(c, path, "dist_exp", &mapping->dist_exp, 1);
    check_numbers(c, path, "major_radius", &mapping->major_radius, 1);
}

static void check_warp(const Check *c, const FieldPath *path, const Warp *warp) {
    check_range(c, path, "type", (int)warp->type, WARP_TRANSFORM, WARP_TOROIDAL);
    switch (warp->type) {
    case WARP_TRANSFORM:
        check_transform(c, path, "transform", &warp->transform);
        break;
    case WARP_TURBULENCE:
        check_turbulence(c, path, &warp->turbulence);
        break;
    case WARP_REPEAT:
        check_repeat(c, path, &warp->repeat);
        break;
    case WARP_BLACK_HOLE:
        check_black_hole(c, path, &warp->black_hole);
        break;
    case WARP_CUBIC:
        break;
    case WARP_PLANAR:
    case WARP_SPHERICAL:
    case WARP_CYLINDRICAL:
    case WARP_TOROIDAL:
        check_mapping(c, path, &warp->mapping);
        break;
    }
}

// How many entries the map of a list pattern has, one for each of its values; others: 1 at least.
static uint32_t least_entries(PatternType type) {
    switch (type) {
    case PATTERN_CHECKER:
    case PATTERN_BRICK:
        return 2;
    case PATTERN_HEXAGON:
        return 3;
    case PATTERN_SQUARE:
        return 4;
    case PATTERN_CUBIC:
    case PATTERN_TRIANGULAR:
        return 6;
    default:
        return 1;
    }
}

// The members that belong to one pattern each, whether it is that pattern or not: they are few.
static void check_pattern_shape(const Check *c, const FieldPath *path, const Pattern *pattern) {
    const FieldPath crackle = path_field(path, "crackle");
    check_float(c, path, "agate_turb", pattern->agate_turb);
    check_vec3(c, path, "brick_size", pattern->brick_size);
    check_float(c, path, "mortar", pattern->mortar);
    check_floats(c, path, "quilted", pattern->quilted, 2);
    check_vec3(c, &crackle, "form", pattern->crackle.form);
    check_numbers(c, &crackle, "metric", &pattern->crackle.metric, 1);
    check_numbers(c, &crackle, "offset", &pattern->crackle.offset, 1);
    for (int i = 0; i < 3; i++) {
        const FieldPath size = path_field(path, "brick_size");
        if (pattern->type == PATTERN_BRICK && vec_get(pattern->brick_size, i) == 0)
            refuse(c, &size, "0 has no reciprocal");
    }
}

static void check_pattern(const Check *c, const FieldPath *path, const Pattern *pattern) {
    check_range(c, path, "type", (int)pattern->type, PATTERN_PLAIN, PATTERN_MODELLED - 1);
    check_range(c, path, "wave", (int)pattern->wave, WAVE_RAMP, WAVE_POLY);
    check_float(c, path, "frequency", pattern->frequency);
    check_float(c, path, "phase", pattern->phase);
    check_float(c, path, "exponent", pattern->exponent);
    check_range(c, path, "noise_generator", pattern->noise_generator, 0, 3);
    check_pattern_shape(c, path, pattern);
    if (pattern->type == PATTERN_GRADIENT)
        check_unit(c, path, "gradient", pattern->gradient);
    else
        check_vec3(c, path, "gradient", pattern->gradient);
    for (uint32_t i = 0; i < pattern->warp_count; i++) {
        const FieldPath warp = path_item(path, "warps", i);
        check_warp(c, &warp, &pattern->warps[i]);
    }
    if (pattern->has_turbulence) {
        const FieldPath turbulence = path_field(path, "turbulence");
        check_turbulence(c, &turbulence, &pattern->turbulence);
    }
}

static void check_weights(const Check *c, const FieldPath *path, const Pigment *pigment) {
    float sum = 0;
    for (uint32_t i = 0; i < pigment->entry_count; i++)
        sum += pigment->entries[i].value;
    const FieldPath map = path_field(path, "map");
    if (sum == 0 || !isfinite(sum))
        refuse(c, &map, "the weights add up to %g", (double)sum);
}

// Pigments refer to pigments through maps: a good one is looked at once, and one that is met again
// on the way down leads to itself.
static void check_pigment(Check *c, const FieldPath *path, uint32_t index, int depth) {
    const Pigment *pigment = &c->scene->pigments[index];
    if (c->pigment_met[index] == 2)
        return;
    if (c->pigment_met[index] == 1)
        refuse(c, path, "pigment %u is part of itself", index);
    if (depth > SCENE_MAX_DEPTH)
        refuse(c, path, "more than %d pigment maps inside one another", SCENE_MAX_DEPTH);
    c->pigment_met[index] = 1;
    check_pattern(c, path, &pigment->pattern);
    check_color(c, path, "color", pigment->color);
    check_color(c, path, "quick_color", pigment->quick_color);
    bool plain = pigment->pattern.type == PATTERN_PLAIN;
    if (plain != (pigment->entry_count == 0)) {
        const FieldPath map = path_field(path, "map");
        refuse(c, &map, plain ? "a plain pigment has none" : "it is empty");
    }
    for (uint32_t i = 0; i < pigment->entry_count; i++) {
        const MapEntry *entry = &pigment->entries[i];
        const FieldPath item = path_item(path, "map", i);
        const FieldPath inner = path_field(&item, "pigment");
        check_float(c, &item, "value", entry->value);
        check_color(c, &item, "color", entry->color);
        if (entry->pigment != NO_INDEX) {
            check_index(c, &inner, entry->pigment, c->scene->pigment_count, "pigment");
            check_pigment(c, &inner, entry->pigment, depth + 1);
        }
    }
    if (pigment->pattern.type == PATTERN_AVERAGE)
        check_weights(c, path, pigment);
    uint32_t least = least_entries(pigment->pattern.type);
    if (!plain && pigment->entry_count < least) {
        const FieldPath map = path_field(path, "map");
        refuse(c, &map, "%u entries, but the pattern has %u values", pigment->entry_count, least);
    }
    c->pigment_met[index] = 2;
}

static void check_finish(const Check *c, const FieldPath *path, const Finish *f) {
    check_rgb(c, path, "ambient", f->ambient);
    check_rgb(c, path, "emission", f->emission);
    check_float(c, path, "diffuse", f->diffuse);
    check_float(c, path, "diffuse_back", f->diffuse_back);
    check_float(c, path, "brilliance", f->brilliance);
    check_float(c, path, "crand", f->crand);
    check_float(c, path, "phong", f->phong);
    check_float(c, path, "phong_size", f->phong_size);
    check_float(c, path, "specular", f->specular);
    check_not_zero(c, path, "roughness", f->roughness);
    check_float(c, path, "metallic", f->metallic);
    check_rgb(c, path, "reflection_min", f->reflection_min);
    check_rgb(c, path, "reflection_max", f->reflection_max);
    check_float(c, path, "reflection_falloff", f->reflection_falloff);
    check_not_zero(c, path, "reflection_exponent", f->reflection_exponent);
    check_float(c, path, "reflection_metallic", f->reflection_metallic);
    check_float(c, path, "irid", f->irid);
    check_float(c, path, "irid_thickness", f->irid_thickness);
    check_float(c, path, "irid_turbulence", f->irid_turbulence);
}

static void check_texture(const Check *c, const FieldPath *path, const Texture *texture) {
    if (texture->layer_count == 0)
        refuse(c, path, "it has no layers");
    for (uint32_t i = 0; i < texture->layer_count; i++) {
        const FieldPath layer = path_item(path, "layers", i);
        const FieldPath pigment = path_field(&layer, "pigment");
        const FieldPath finish = path_field(&layer, "finish");
        check_index(c, &pigment, texture->layers[i].pigment, c->scene->pigment_count, "pigment");
        check_finish(c, &finish, &texture->layers[i].finish);
    }
}

void check_pigments(Check *c) {
    for (uint32_t i = 0; i < c->scene->pigment_count; i++) {
        const FieldPath path = path_item(NULL, "pigments", i);
        check_pigment(c, &path, i, 0);
    }
}

void check_textures(const Check *c) {
    for (uint32_t i = 0; i < c->scene->texture_count; i++) {
        const FieldPath path = path_item(NULL, "textures", i);
        check_texture(c, &path, &c->scene->textures[i]);
    }
}
