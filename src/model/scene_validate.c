// SPDX-License-Identifier: MIT
// What the renderer relies on, checked once, so that nothing after it has an error path. Every
// refusal names the field. The order is the order of scene.h.
#include "model/scene.h"

#include "base/diag.h"
#include "model/field_path.h"
#include "model/scene_check.h"
#include "model/scene_format.h"

#include <math.h>
#include <string.h>

// Coordinates may be as large as a product of crossed vectors, squared, still fits a double:
// |a x b|^2 <= 4 (1e60)^4 = 4e240 < 1e308.
static const double MAX_COORDINATE = 1e60;

// How far a direction's length may be from 1. Six written decimals give 1e-6 at most.
static const double UNIT_TOLERANCE = 1e-6;

enum { MAX_TRACE_LEVEL = 256, MAX_OCTAVES = 10 }; // POV-Ray's own limits

typedef struct {
    const Scene *scene;
    const char *file;
    const uint32_t *positions;
    bool *met;            // per object: already part of a tree
    uint8_t *pigment_met; // per pigment: 0 not yet, 1 on the way down, 2 good
} Check;

// ---- numbers --------------------------------------------------------------------------------

#define refuse(c, path, ...) path_die((c)->file, path, __VA_ARGS__)

static void check_numbers(const Check *c, const FieldPath *up, const char *name,
                          const double *values, int count) {
    for (int i = 0; i < count; i++) {
        // Also true for NaN.
        if (!(fabs(values[i]) <= MAX_COORDINATE)) {
            const FieldPath path = path_field(up, name);
            refuse(c, &path, "%g is out of range", values[i]);
        }
    }
}

static void check_floats(const Check *c, const FieldPath *up, const char *name, const float *values,
                         int count) {
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            const FieldPath path = path_field(up, name);
            refuse(c, &path, "%g is not a finite number", (double)values[i]);
        }
    }
}

static void check_float(const Check *c, const FieldPath *up, const char *name, float value) {
    check_floats(c, up, name, &value, 1);
}

static void check_rgb(const Check *c, const FieldPath *up, const char *name, Rgb value) {
    check_floats(c, up, name, (float[]){value.r, value.g, value.b}, 3);
}

static void check_color(const Check *c, const FieldPath *up, const char *name, Color value) {
    check_floats(c, up, name, (float[]){value.r, value.g, value.b, value.filter, value.transmit},
                 5);
}

static void check_vec3(const Check *c, const FieldPath *up, const char *name, Vec3 value) {
    check_numbers(c, up, name, &value.x, 3);
}

static void check_unit(const Check *c, const FieldPath *up, const char *name, Vec3 value) {
    const FieldPath path = path_field(up, name);
    check_vec3(c, up, name, value);
    if (!(fabs(vec_length(value) - 1) <= UNIT_TOLERANCE))
        refuse(c, &path, "its length is %g instead of 1", vec_length(value));
}

static void check_size(const Check *c, const FieldPath *up, const char *name, double value) {
    const FieldPath path = path_field(up, name);
    check_numbers(c, up, name, &value, 1);
    if (value < 0)
        refuse(c, &path, "%g is negative", value);
}

static void check_not_zero(const Check *c, const FieldPath *up, const char *name, double value) {
    const FieldPath path = path_field(up, name);
    check_numbers(c, up, name, &value, 1);
    if (value == 0)
        refuse(c, &path, "0 has no reciprocal");
}

static void check_range(const Check *c, const FieldPath *up, const char *name, int value, int low,
                        int high) {
    const FieldPath path = path_field(up, name);
    if (value < low || value > high)
        refuse(c, &path, "%d is not in the range %d to %d", value, low, high);
}

static void check_index(const Check *c, const FieldPath *path, uint32_t index, uint32_t count,
                        const char *what) {
    if (index >= count)
        refuse(c, path, "%u, but there %s %u %s%s", index, count == 1 ? "is" : "are", count, what,
               count == 1 ? "" : "s");
}

// matrix x inverse must be the identity, apart from the rounding of many products: that is far
// below a thousandth of the terms summed. Coordinates around 1 are taken as the least scale, since
// rounding leaves small numbers where 0 is meant.
static void check_transform(const Check *c, const FieldPath *up, const char *name,
                            const Transform *t) {
    const FieldPath path = path_field(up, name), matrix = path_field(&path, "matrix"),
                    inverse = path_field(&path, "inverse");
    check_numbers(c, &path, "matrix", &t->m[0][0], 16);
    check_numbers(c, &path, "inverse", &t->inv[0][0], 16);
    for (int i = 0; i < 4; i++) {
        double last = i == 3 ? 1 : 0;
        if (t->m[i][3] != last || t->inv[i][3] != last)
            refuse(c, &matrix, "it is not affine");
        for (int j = 0; j < 4; j++) {
            double sum = 0, terms = 1;
            for (int k = 0; k < 4; k++) {
                sum += t->m[i][k] * t->inv[k][j];
                terms += fabs(t->m[i][k] * t->inv[k][j]);
            }
            if (!(fabs(sum - (i == j ? 1 : 0)) <= 1e-3 * terms))
                refuse(c, &inverse, "it is not the inverse of the matrix");
        }
    }
}

// ---- settings, camera, lights ---------------------------------------------------------------

static void check_settings(const Check *c) {
    const FieldPath path = path_field(NULL, "settings");
    const Settings *s = &c->scene->settings;
    check_range(c, &path, "version", s->version, 0, 999);
    check_range(c, &path, "gamma_mode", (int)s->gamma_mode, GAMMA_NONE, GAMMA_SRGB);
    check_float(c, &path, "assumed_gamma", s->assumed_gamma);
    if (s->gamma_mode == GAMMA_POWER && !(s->assumed_gamma > 0)) {
        const FieldPath gamma = path_field(&path, "assumed_gamma");
        refuse(c, &gamma, "%g is not positive", (double)s->assumed_gamma);
    }
    check_color(c, &path, "background", s->background);
    check_rgb(c, &path, "ambient_light", s->ambient_light);
    check_rgb(c, &path, "irid_wavelength", s->irid_wavelength);
    check_range(c, &path, "max_trace_level", s->max_trace_level, 0, MAX_TRACE_LEVEL);
    check_float(c, &path, "adc_bailout", s->adc_bailout);
    check_range(c, &path, "noise_generator", s->noise_generator, 1, 3);
}

static void check_camera(const Check *c) {
    const FieldPath path = path_field(NULL, "camera");
    const Camera *camera = &c->scene->camera;
    check_range(c, &path, "type", (int)camera->type, CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC);
    check_vec3(c, &path, "location", camera->location);
    check_vec3(c, &path, "direction", camera->direction);
    check_vec3(c, &path, "up", camera->up);
    check_vec3(c, &path, "right", camera->right);
    check_numbers(c, &path, "angle", &camera->angle_deg, 1);
    if (!(vec_length(camera->direction) > 0)) {
        const FieldPath direction = path_field(&path, "direction");
        refuse(c, &direction, "it has no length");
    }
}

static void check_area_light(const Check *c, const FieldPath *path, const AreaLight *area) {
    check_vec3(c, path, "axis1", area->axis[0]);
    check_vec3(c, path, "axis2", area->axis[1]);
    check_range(c, path, "size1", area->size[0], 1, LIGHT_MAX_GRID);
    check_range(c, path, "size2", area->size[1], 1, LIGHT_MAX_GRID);
}

static void check_light(const Check *c, const FieldPath *path, const Light *light) {
    check_range(c, path, "type", (int)light->type, LIGHT_POINT, LIGHT_CYLINDER);
    check_vec3(c, path, "location", light->location);
    check_vec3(c, path, "point_at", light->point_at);
    check_rgb(c, path, "color", light->color);
    check_numbers(c, path, "fade_distance", &light->fade_distance, 1);
    check_numbers(c, path, "fade_power", &light->fade_power, 1);
    check_numbers(c, path, "radius", &light->radius, 1);
    check_numbers(c, path, "falloff", &light->falloff, 1);
    check_numbers(c, path, "tightness", &light->tightness, 1);
    if (light->has_area) {
        const FieldPath area = path_field(path, "area");
        check_area_light(c, &area, &light->area);
    }
    if (light->type != LIGHT_POINT &&
        !(vec_length(vec_sub(light->point_at, light->location)) > 0)) {
        const FieldPath point_at = path_field(path, "point_at");
        refuse(c, &point_at, "it is the light's location");
    }
}

// ---- textures -------------------------------------------------------------------------------

static void check_turbulence(const Check *c, const FieldPath *path, const Turbulence *turbulence) {
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

static void check_interior(const Check *c, const FieldPath *path, const Interior *interior) {
    check_not_zero(c, path, "ior", interior->ior);
    check_float(c, path, "caustics", interior->caustics);
    check_float(c, path, "fade_distance", interior->fade_distance);
    check_float(c, path, "fade_power", interior->fade_power);
    check_rgb(c, path, "fade_color", interior->fade_color);
}

static void check_sky_sphere(const Check *c) {
    const SkySphere *sky = &c->scene->sky_sphere;
    const FieldPath path = path_field(NULL, "sky_sphere");
    if (!c->scene->has_sky_sphere)
        return;
    if (sky->pigment_count == 0)
        refuse(c, &path, "it has no pigments");
    for (uint32_t i = 0; i < sky->pigment_count; i++) {
        const FieldPath item = path_item(&path, "pigments", i);
        check_index(c, &item, sky->pigments[i], c->scene->pigment_count, "pigment");
    }
    check_rgb(c, &path, "emission", sky->emission);
    check_transform(c, &path, "transform", &sky->transform);
}

// ---- objects --------------------------------------------------------------------------------

static void check_patch(const Check *c, const FieldPath *path, const PatchShape *patch) {
    if (patch->degree_u < 1 || patch->degree_u > SCENE_MAX_DEGREE || patch->degree_v < 1 ||
        patch->degree_v > SCENE_MAX_DEGREE)
        refuse(c, path, "the degrees %u and %u are not in the range 1 to %d", patch->degree_u,
               patch->degree_v, SCENE_MAX_DEGREE);
    check_range(c, path, "patch_type", patch->type, 0, 1);
    check_numbers(c, path, "flatness", &patch->flatness, 1);
    check_numbers(c, path, "uv", &patch->uv[0].u, 8);
    for (uint32_t i = 0; i <= patch->degree_u; i++) {
        for (uint32_t j = 0; j <= patch->degree_v; j++) {
            Vec3 p = patch->points[i * (patch->degree_v + 1) + j];
            const FieldPath row = path_item(path, "points", i);
            const FieldPath point = path_item(&row, NULL, j);
            // The path is made anyway, the check itself must be quick: there may be millions.
            if (!(fabs(p.x) <= MAX_COORDINATE && fabs(p.y) <= MAX_COORDINATE &&
                  fabs(p.z) <= MAX_COORDINATE))
                refuse(c, &point, "<%g, %g, %g> is out of range", p.x, p.y, p.z);
        }
    }
}

static void check_cone(const Check *c, const FieldPath *path, const ConeShape *cone) {
    check_vec3(c, path, "base", cone->base);
    check_vec3(c, path, "apex", cone->apex);
    check_size(c, path, "base_radius", cone->base_radius);
    check_size(c, path, "apex_radius", cone->apex_radius);
    if (!(vec_length(vec_sub(cone->apex, cone->base)) > 0))
        refuse(c, path, "base and apex are the same point");
}

static void check_box(const Check *c, const FieldPath *path, const BoxShape *box) {
    check_vec3(c, path, "low", box->low);
    check_vec3(c, path, "high", box->high);
    if (box->low.x > box->high.x || box->low.y > box->high.y || box->low.z > box->high.z)
        refuse(c, path, "'low' is above 'high'");
}

static void check_shape(const Check *c, const FieldPath *path, const Object *object) {
    switch (object->type) {
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
        break; // check_list goes on
    case OBJECT_PATCH:
        check_patch(c, path, &object->shape.patch);
        break;
    case OBJECT_PLANE:
        check_unit(c, path, "normal", object->shape.plane.normal);
        check_numbers(c, path, "distance", &object->shape.plane.distance, 1);
        break;
    case OBJECT_SPHERE:
        check_vec3(c, path, "center", object->shape.sphere.center);
        check_size(c, path, "radius", object->shape.sphere.radius);
        break;
    case OBJECT_BOX:
        check_box(c, path, &object->shape.box);
        break;
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        check_cone(c, path, &object->shape.cone);
        break;
    case OBJECT_TORUS:
        check_size(c, path, "major", object->shape.torus.major);
        check_size(c, path, "minor", object->shape.torus.minor);
        break;
    case OBJECT_DISC:
        check_vec3(c, path, "center", object->shape.disc.center);
        check_unit(c, path, "normal", object->shape.disc.normal);
        check_size(c, path, "radius", object->shape.disc.radius);
        check_size(c, path, "hole", object->shape.disc.hole);
        break;
    case OBJECT_TRIANGLE:
        check_numbers(c, path, "points", &object->shape.triangle.p[0].x, 9);
        break;
    }
}

static bool has_local_space(ObjectType type) {
    return type >= OBJECT_SPHERE && type <= OBJECT_DISC;
}

static void check_object(const Check *c, const FieldPath *path, const Object *object) {
    const FieldPath texture = path_field(path, "texture"), inside = path_field(path, "interior"),
                    inner = path_field(path, "interior_texture"),
                    transform = path_field(path, "transform");
    if ((int)object->type < OBJECT_UNION || object->type > OBJECT_TRIANGLE)
        refuse(c, path, "unknown object type %d", (int)object->type);
    if (object->texture != NO_INDEX)
        check_index(c, &texture, object->texture, c->scene->texture_count, "texture");
    if (object->interior_texture != NO_INDEX)
        check_index(c, &inner, object->interior_texture, c->scene->texture_count, "texture");
    if (object->interior != NO_INDEX)
        check_index(c, &inside, object->interior, c->scene->interior_count, "interior");
    if (object->has_transform && !has_local_space(object->type))
        refuse(c, &transform, "this type has no local space");
    if (object->has_transform)
        check_transform(c, path, "transform", &object->transform);
    if (object->clips.count > 0 && object->type == OBJECT_PATCH)
        refuse(c, path, "a patch cannot have 'clipped_by': put it into a union that has");
    check_shape(c, path, object);
}

// A list of objects and all that hangs below it. Each object may be met once, so the walk ends even
// if the lists lead back to themselves.
static void check_list(Check *c, const FieldPath *up, const char *name, const uint32_t *items,
                       uint32_t count, int depth) {
    if (depth > SCENE_MAX_DEPTH)
        refuse(c, up, "more than %d unions inside one another", SCENE_MAX_DEPTH);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t index = items[i];
        const FieldPath place = path_item(up, name, i);
        check_index(c, &place, index, c->scene->object_count, "object");
        const FieldPath path = path_item(up, name, c->positions ? c->positions[index] : i);
        if (c->met[index])
            refuse(c, &place, "object %u is used twice", index);
        c->met[index] = true;
        const Object *object = &c->scene->objects[index];
        check_object(c, &path, object);
        if (object_is_tree(object))
            check_list(c, &path, "children", object->shape.children.items,
                       object->shape.children.count, depth + 1);
        if (object->clips.count > 0)
            check_list(c, &path, "clipped_by", object->clips.items, object->clips.count, depth + 1);
    }
}

static void check_objects(Check *c) {
    const Scene *scene = c->scene;
    check_list(c, NULL, "objects", scene->roots, scene->root_count, 0);
    for (uint32_t i = 0; i < scene->object_count; i++)
        if (!c->met[i])
            refuse(c, NULL, "object %u is part of no tree", i);
}

// ---- the scene ------------------------------------------------------------------------------

static void check_scene(void *context) {
    Check *c = context;
    const Scene *scene = c->scene;
    check_settings(c);
    check_camera(c);
    check_sky_sphere(c);
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const FieldPath path = path_item(NULL, "lights", i);
        check_light(c, &path, &scene->lights[i]);
    }
    for (uint32_t i = 0; i < scene->pigment_count; i++) {
        const FieldPath path = path_item(NULL, "pigments", i);
        check_pigment(c, &path, i, 0);
    }
    for (uint32_t i = 0; i < scene->texture_count; i++) {
        const FieldPath path = path_item(NULL, "textures", i);
        check_texture(c, &path, &scene->textures[i]);
    }
    for (uint32_t i = 0; i < scene->interior_count; i++) {
        const FieldPath path = path_item(NULL, "interiors", i);
        check_interior(c, &path, &scene->interiors[i]);
    }
    check_objects(c);
}

void scene_validate_at(const Scene *scene, const char *file, const uint32_t *positions) {
    Arena *scratch = arena_create();
    Check c = {.scene = scene, .file = file, .positions = positions};
    c.met = ARENA_ARRAY(scratch, bool, scene->object_count);
    c.pigment_met = ARENA_ARRAY(scratch, uint8_t, scene->pigment_count);
    char *message = NULL;
    bool good = diag_catch(check_scene, &c, &message);
    arena_destroy(scratch);
    if (!good)
        diag_rethrow(message);
}

void scene_validate(const Scene *scene, const char *file) { scene_validate_at(scene, file, NULL); }
