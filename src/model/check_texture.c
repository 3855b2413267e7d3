// SPDX-License-Identifier: MIT
// Pigments and textures, as scene_validate.c checks the rest.
#include "model/check.h"
#include "model/scene_format.h"

#include <math.h>
#include <string.h>

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
    case PATTERN_OBJECT:
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
    const FieldPath crackle = path_field(path, "crackle"), facets = path_field(path, "facets");
    check_float(c, path, "agate_turb", pattern->agate_turb);
    check_vec3(c, path, "brick_size", pattern->brick_size);
    check_float(c, path, "mortar", pattern->mortar);
    check_floats(c, path, "quilted", pattern->quilted, 2);
    check_vec3(c, &crackle, "form", pattern->crackle.form);
    check_numbers(c, &crackle, "metric", &pattern->crackle.metric, 1);
    check_numbers(c, &crackle, "offset", &pattern->crackle.offset, 1);
    check_numbers(c, &facets, "size", &pattern->facets.size, 1);
    check_numbers(c, &facets, "coords", &pattern->facets.coords, 1);
    check_numbers(c, &facets, "metric", &pattern->facets.metric, 1);
    for (int i = 0; i < 3; i++) {
        const FieldPath size = path_field(path, "brick_size");
        if (pattern->type == PATTERN_BRICK && vec_get(pattern->brick_size, i) == 0)
            refuse(c, &size, "0 has no reciprocal");
    }
}

static void check_slope(const Check *c, const FieldPath *up, const SlopeShape *slope) {
    const FieldPath path = path_field(up, "slope");
    check_vec3(c, &path, "slope", slope->slope);
    check_numbers(c, &path, "low", &slope->low, 1);
    check_numbers(c, &path, "high", &slope->high, 1);
    check_vec3(c, &path, "altitude", slope->altitude);
    check_numbers(c, &path, "altitude_low", &slope->altitude_low, 1);
    check_numbers(c, &path, "altitude_high", &slope->altitude_high, 1);
    check_numbers(c, &path, "share", &slope->share, 1);
}

static void check_fractal(const Check *c, const FieldPath *up, const FractalShape *fractal) {
    const FieldPath path = path_field(up, "fractal");
    check_range(c, &path, "exponent", fractal->exponent, 2, FRACTAL_MAX_EXPONENT);
    check_range(c, &path, "magnet", fractal->magnet, 0, 2);
    check_range(c, &path, "iterations", fractal->iterations, 0, FRACTAL_MAX_ITERATIONS);
    check_numbers(c, &path, "c", &fractal->c.u, 2);
    check_range(c, &path, "exterior", fractal->exterior, 0, 8);
    check_range(c, &path, "interior", fractal->interior, 0, 6);
    check_numbers(c, &path, "exterior_factor", &fractal->exterior_factor, 1);
    check_numbers(c, &path, "interior_factor", &fractal->interior_factor, 1);
}

// The index of what the pattern looks at: there when it needs it, and good when it is there.
static void check_use(const Check *c, const FieldPath *up, bool needed, uint32_t index,
                      uint32_t count, const char *name) {
    const FieldPath path = path_field(up, name);
    if (needed || index != NO_INDEX)
        check_index(c, &path, index, count, name);
}

static void check_pattern_uses(const Check *c, const FieldPath *path, const Pattern *pattern) {
    PatternType type = pattern->type;
    bool picture = type == PATTERN_IMAGE || type == PATTERN_IMAGE_MAP || type == PATTERN_BUMP_MAP ||
                   type == PATTERN_MATERIAL_MAP;
    check_use(c, path, picture, pattern->picture, c->scene->picture_count, "picture");
    check_use(c, path, type == PATTERN_OBJECT, pattern->object, c->scene->projection_count,
              "object");
    check_use(c, path, type == PATTERN_DENSITY, pattern->density, c->scene->density_count,
              "density");
    check_use(c, path, type == PATTERN_PIGMENT, pattern->pigment, c->scene->pigment_count,
              "pigment");
    check_use(c, path, type == PATTERN_FUNCTION, pattern->function, c->scene->function_count,
              "function");
    check_range(c, path, "density_interpolate", pattern->density_between, 0, 2);
    check_slope(c, path, &pattern->slope);
    check_fractal(c, path, &pattern->fractal);
    const FieldPath function = path_field(path, "function");
    if (type == PATTERN_FUNCTION) {
        const Function *f = &c->scene->functions[pattern->function];
        if (f->parameters != 3 || function_width(f) != 1)
            refuse(c, &function, "it is not one of three numbers to one");
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
    check_pattern_uses(c, path, pattern);
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

// ---- maps -----------------------------------------------------------------------------------

// The weights of an average are of no use when they add up to nothing.
static void check_weights(const Check *c, const FieldPath *path, float sum) {
    const FieldPath map = path_field(path, "map");
    if (sum == 0 || !isfinite(sum))
        refuse(c, &map, "the weights add up to %g", (double)sum);
}

// Records refer to records of their pool through maps: a good one is looked at once, and one that
// is met again on the way down leads to itself. False: it was looked at before.
static bool enter_record(const Check *c, const FieldPath *path, const CheckPool *pool,
                         uint32_t index, int depth) {
    check_index(c, path, index, pool->count, pool->name);
    if (pool->met[index] == 2)
        return false;
    if (pool->met[index] == 1)
        refuse(c, path, "%s %u is part of itself", pool->name, index);
    if (depth > SCENE_MAX_DEPTH)
        refuse(c, path, "more than %d %s maps inside one another", SCENE_MAX_DEPTH, pool->name);
    pool->met[index] = 1;
    return true;
}

// How many records one point can make the renderer look at: two entries of a map, all of an
// average. Maps that share their entries multiply it while the file stays small.
typedef struct {
    bool all;
    double sum, first, second; // of all entries; the two largest
    double own;                // of what the pattern itself looks at
} Cost;

static void cost_add(Cost *cost, double entry) {
    cost->sum += entry;
    if (entry > cost->first)
        cost->second = cost->first, cost->first = entry;
    else if (entry > cost->second)
        cost->second = entry;
}

static void leave_record(const Check *c, const FieldPath *path, const CheckPool *pool,
                         uint32_t index, const Cost *cost) {
    static const double MOST = 1e5;
    double total = 1 + cost->own + (cost->all ? cost->sum : cost->first + cost->second);
    if (total > MOST)
        refuse(c, path, "%g evaluations at each point are more than %g", total, MOST);
    pool->cost[index] = total;
    pool->met[index] = 2;
}

static void check_entry_count(const Check *c, const FieldPath *path, PatternType type,
                              uint32_t count) {
    const FieldPath map = path_field(path, "map");
    uint32_t least = least_entries(type);
    if (count == 0)
        refuse(c, &map, "it is empty");
    if (count < least)
        refuse(c, &map, "%u entries, but the pattern has %u values", count, least);
}

// The pigment or function that the pattern of a record of that pool looks at.
static void check_inner(const Check *c, const FieldPath *path, const CheckPool *pool,
                        uint32_t index, const Pattern *pattern, int depth, Cost *cost) {
    const FieldPath pigment = path_field(path, "pigment"), function = path_field(path, "function");
    const FieldPath object = path_field(path, "object");
    if (pattern->type == PATTERN_PIGMENT) {
        check_pigment(c, &pigment, pattern->pigment, depth + 1);
        cost->own = c->pigments.cost[pattern->pigment];
        check_nest(pool, index, c->pigments.nesting[pattern->pigment]);
    } else if (pattern->type == PATTERN_FUNCTION) {
        check_nest(pool, index, check_function_use(c, &function, pattern->function, depth + 1));
        cost->own = c->functions.cost[pattern->function];
    } else if (pattern->type == PATTERN_OBJECT) {
        check_nest(pool, index, check_projection_use(c, &object, pattern->object, depth + 1));
        cost->own = c->projections.cost[pattern->object];
    }
}

// Patterns that stand in one kind of record only: the kind, or NULL.
static const char *only_in(PatternType type) {
    switch (type) {
    case PATTERN_BUMPS:
    case PATTERN_FACETS:
    case PATTERN_BUMP_MAP:
        return "normal";
    case PATTERN_IMAGE_MAP:
        return "pigment";
    case PATTERN_MATERIAL_MAP:
        return "texture";
    default:
        return NULL;
    }
}

static void check_place(const Check *c, const FieldPath *up, PatternType kind,
                        const CheckPool *pool) {
    const FieldPath type = path_field(up, "type");
    const char *place = only_in(kind);
    if (place && strcmp(place, pool->name) != 0)
        refuse(c, &type, "this pattern is for %ss only", place);
}

static void check_picture_values(const Check *c, const FieldPath *path, const Picture *picture) {
    const FieldPath channels = path_field(path, "channels"), values = path_field(path, "values"),
                    file = path_field(path, "path");
    check_range(c, path, "width", picture->width, 1, PICTURE_MAX_SIDE);
    check_range(c, path, "height", picture->height, 1, PICTURE_MAX_SIDE);
    if (picture->channels != 1 && picture->channels != 4)
        refuse(c, &channels, "%d is neither 1 nor 4", picture->channels);
    if (picture->value_count !=
        (uint32_t)picture->width * (uint32_t)picture->height * (uint32_t)picture->channels)
        refuse(c, &values, "%u entries, expected %d x %d x %d", picture->value_count,
               picture->width, picture->height, picture->channels);
    if (picture->path)
        refuse(c, &file, "it has values");
    for (uint32_t i = 0; i < picture->value_count; i++)
        if (!(picture->values[i] >= 0.0 && picture->values[i] <= 65535.0))
            refuse(c, &values, "entry %u is not from 0 to 65535", i);
}

static void check_picture(const Check *c, const FieldPath *path, const Picture *picture) {
    const FieldPath repeat = path_field(path, "repeat"), file = path_field(path, "path");
    check_range(c, path, "type", (int)picture->type, PICTURE_PNG, PICTURE_VALUES);
    if (picture->type == PICTURE_VALUES)
        check_picture_values(c, path, picture);
    else if (!picture->path || !picture->path[0])
        refuse(c, &file, "it is missing");
    check_range(c, path, "decode", (int)picture->decode, DECODE_NONE, DECODE_SRGB);
    check_range(c, path, "layout", (int)picture->layout, LAYOUT_PLANAR, LAYOUT_TORUS);
    check_range(c, path, "interpolate", (int)picture->between, BETWEEN_NONE, BETWEEN_NORMALIZED);
    check_range(c, path, "use", (int)picture->use, USE_PICTURE_COLOR, USE_PICTURE_ALPHA);
    check_not_zero(c, path, "gamma", picture->gamma);
    check_numbers(c, path, "offset", &picture->offset.u, 2);
    check_numbers(c, path, "repeat", &picture->repeat.u, 2);
    if (!(picture->repeat.u > 0 && picture->repeat.v > 0))
        refuse(c, &repeat, "it is not positive");
    check_float(c, path, "filter", picture->filter);
    check_float(c, path, "transmit", picture->transmit);
    for (uint32_t i = 0; i < picture->change_count; i++) {
        const FieldPath item = path_item(path, "palette", i);
        check_range(c, &item, "place", picture->changes[i].place, 0, 255);
        check_float(c, &item, "value", picture->changes[i].value);
    }
}

void check_pigment(const Check *c, const FieldPath *path, uint32_t index, int depth) {
    if (!enter_record(c, path, &c->pigments, index, depth))
        return;
    const Pigment *pigment = &c->scene->pigments[index];
    const FieldPath map = path_field(path, "map");
    PatternType kind = pigment->pattern.type;
    bool bare = kind == PATTERN_PLAIN || kind == PATTERN_IMAGE_MAP; // no map
    Cost cost = {.all = kind == PATTERN_AVERAGE};
    float weights = 0;
    check_pattern(c, path, &pigment->pattern);
    check_inner(c, path, &c->pigments, index, &pigment->pattern, depth, &cost);
    check_color(c, path, "color", pigment->color);
    check_color(c, path, "quick_color", pigment->quick_color);
    check_place(c, path, kind, &c->pigments);
    if (bare && pigment->entry_count > 0)
        refuse(c, &map, "a plain pigment has none");
    for (uint32_t i = 0; i < pigment->entry_count; i++) {
        const MapEntry *entry = &pigment->entries[i];
        const FieldPath item = path_item(path, "map", i);
        const FieldPath inner = path_field(&item, "pigment");
        check_float(c, &item, "value", entry->value);
        check_color(c, &item, "color", entry->color);
        weights += entry->value;
        if (entry->pigment != NO_INDEX) {
            check_pigment(c, &inner, entry->pigment, depth + 1);
            cost_add(&cost, c->pigments.cost[entry->pigment]);
            check_nest(&c->pigments, index, c->pigments.nesting[entry->pigment]);
        }
    }
    if (kind == PATTERN_AVERAGE)
        check_weights(c, path, weights);
    if (!bare)
        check_entry_count(c, path, kind, pigment->entry_count);
    leave_record(c, path, &c->pigments, index, &cost);
}

// ---- normals --------------------------------------------------------------------------------

static void check_normal(const Check *c, const FieldPath *path, uint32_t index, int depth) {
    if (!enter_record(c, path, &c->normals, index, depth))
        return;
    const Normal *normal = &c->scene->normals[index];
    const FieldPath type = path_field(path, "type"), map = path_field(path, "slope_map");
    PatternType kind = normal->pattern.type;
    Cost cost = {.all = kind == PATTERN_AVERAGE};
    float weights = 0;
    check_pattern(c, path, &normal->pattern);
    check_inner(c, path, &c->normals, index, &normal->pattern, depth, &cost);
    check_place(c, path, kind, &c->normals);
    if (kind == PATTERN_PLAIN)
        refuse(c, &type, "a normal needs a pattern");
    check_float(c, path, "amount", normal->amount);
    check_not_zero(c, path, "accuracy", normal->accuracy);
    for (uint32_t i = 0; i < normal->slope_count; i++) {
        const FieldPath item = path_item(path, "slope_map", i);
        check_float(c, &item, "value", normal->slopes[i].value);
        check_numbers(c, &item, "height", &normal->slopes[i].height, 1);
        check_numbers(c, &item, "slope", &normal->slopes[i].slope, 1);
    }
    if (normal->slope_count > 0 && normal->entry_count > 0)
        refuse(c, &map, "it does not go with 'map'");
    for (uint32_t i = 0; i < normal->entry_count; i++) {
        const FieldPath item = path_item(path, "map", i);
        const FieldPath inner = path_field(&item, "normal");
        check_float(c, &item, "value", normal->entries[i].value);
        weights += normal->entries[i].value;
        check_normal(c, &inner, normal->entries[i].index, depth + 1);
        cost_add(&cost, c->normals.cost[normal->entries[i].index]);
    }
    if (kind == PATTERN_AVERAGE)
        check_weights(c, path, weights);
    if (kind == PATTERN_AVERAGE || normal->entry_count > 0)
        check_entry_count(c, path, kind, normal->entry_count);
    leave_record(c, path, &c->normals, index, &cost);
}

// ---- textures -------------------------------------------------------------------------------

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
    check_float(c, path, "roughness", f->roughness);
    check_float(c, path, "metallic", f->metallic);
    check_rgb(c, path, "reflection_min", f->reflection_min);
    check_rgb(c, path, "reflection_max", f->reflection_max);
    check_float(c, path, "reflection_falloff", f->reflection_falloff);
    check_float(c, path, "reflection_exponent", f->reflection_exponent);
    check_float(c, path, "reflection_metallic", f->reflection_metallic);
    check_float(c, path, "irid", f->irid);
    check_float(c, path, "irid_thickness", f->irid_thickness);
    check_float(c, path, "irid_turbulence", f->irid_turbulence);
}

static void check_layers(const Check *c, const FieldPath *path, const Texture *texture) {
    for (uint32_t i = 0; i < texture->layer_count; i++) {
        const Layer *layer = &texture->layers[i];
        const FieldPath item = path_item(path, "layers", i);
        const FieldPath pigment = path_field(&item, "pigment");
        const FieldPath finish = path_field(&item, "finish");
        const FieldPath normal = path_field(&item, "normal");
        check_index(c, &pigment, layer->pigment, c->scene->pigment_count, "pigment");
        if (layer->normal != NO_INDEX)
            check_index(c, &normal, layer->normal, c->scene->normal_count, "normal");
        check_finish(c, &finish, &layer->finish);
    }
}

static void check_texture(const Check *c, const FieldPath *path, uint32_t index, int depth) {
    if (!enter_record(c, path, &c->textures, index, depth))
        return;
    const Texture *texture = &c->scene->textures[index];
    const FieldPath map = path_field(path, "map");
    PatternType kind = texture->pattern.type;
    Cost cost = {.all = kind == PATTERN_AVERAGE};
    float weights = 0;
    check_pattern(c, path, &texture->pattern);
    check_inner(c, path, &c->textures, index, &texture->pattern, depth, &cost);
    check_place(c, path, kind, &c->textures);
    if (kind == PATTERN_PLAIN && texture->layer_count == 0 && texture->entry_count == 0)
        refuse(c, path, "it has no layers");
    if (texture->layer_count > 0 && (kind != PATTERN_PLAIN || texture->entry_count > 0))
        refuse(c, path, "'layers' do not go with a pattern");
    if (kind == PATTERN_PLAIN &&
        (texture->entry_count > 1 || (texture->entry_count == 1 && !texture->uv_mapping)))
        refuse(c, &map, "without a pattern there is one entry, and only with 'uv_mapping'");
    check_layers(c, path, texture);
    for (uint32_t i = 0; i < texture->entry_count; i++) {
        const FieldPath item = path_item(path, "map", i);
        const FieldPath inner = path_field(&item, "texture");
        check_float(c, &item, "value", texture->entries[i].value);
        weights += texture->entries[i].value;
        check_texture(c, &inner, texture->entries[i].index, depth + 1);
        cost_add(&cost, c->textures.cost[texture->entries[i].index]);
    }
    if (kind == PATTERN_AVERAGE)
        check_weights(c, path, weights);
    if (kind != PATTERN_PLAIN)
        check_entry_count(c, path, kind, texture->entry_count);
    cost_add(&cost, texture->layer_count);
    leave_record(c, path, &c->textures, index, &cost);
}

typedef void CheckRecord(const Check *c, const FieldPath *path, uint32_t index, int depth);

static void check_pool(const Check *c, const CheckPool *pool, const char *name,
                       CheckRecord *check) {
    for (uint32_t i = 0; i < pool->count; i++) {
        const FieldPath path = path_item(NULL, name, i);
        check(c, &path, i, 0);
    }
}

void check_texture_pools(const Check *c) {
    for (uint32_t i = 0; i < c->scene->density_count; i++) {
        const FieldPath path = path_item(NULL, "densities", i), file = path_field(&path, "path");
        if (!c->scene->densities[i].path || !c->scene->densities[i].path[0])
            refuse(c, &file, "it is missing");
    }
    for (uint32_t i = 0; i < c->scene->picture_count; i++) {
        const FieldPath path = path_item(NULL, "pictures", i);
        check_picture(c, &path, &c->scene->pictures[i]);
    }
    check_pool(c, &c->pigments, "pigments", check_pigment);
    check_pool(c, &c->normals, "normals", check_normal);
    check_pool(c, &c->textures, "textures", check_texture);
}
