// SPDX-License-Identifier: MIT
// Pigments, and the patterns of pigments, normals and textures, on their way into the scene. A
// pattern that is not modelled becomes one colour, the middle of its map (facts: textures 4.1).
#include "converter/emit.h"

#include <string.h>

// ---- what is not modelled --------------------------------------------------------------------

static Color mix(Color a, Color b, float w) {
    return (Color){a.r + w * (b.r - a.r), a.g + w * (b.g - a.g), a.b + w * (b.b - a.b),
                   a.filter + w * (b.filter - a.filter),
                   a.transmit + w * (b.transmit - a.transmit)};
}

static Color middle_color(Emitter *e, const PatternNode *pigment);

static Color item_color(Emitter *e, const MapNode *map, uint32_t i) {
    if (map->kind == MAP_COLOR)
        return map->items[i].color;
    return middle_color(e, map->items[i].node);
}

// Where `at` falls: the entry at or above it and the one below.
void map_bracket(const MapNode *map, float at, uint32_t *below, uint32_t *above) {
    uint32_t i = 0;
    while (i + 1 < map->count && at > map->items[i].value)
        i++;
    *above = i;
    *below = i > 0 && at < map->items[i].value ? i - 1 : i;
}

// The colour half way through the map; lists and averages: the mean.
static Color middle_color(Emitter *e, const PatternNode *pigment) {
    int keyword = pigment->info->keyword;
    if (keyword == 0 || keyword == KW_color)
        return pigment->color;
    if (keyword == KW_image_map)
        return (Color){0.5F, 0.5F, 0.5F, 0, 0};
    const MapNode *map = pigment->map ? pigment->map : map_default(e->cv, pigment->info);
    if (keyword == KW_average || pigment->info->list) {
        Color mean = item_color(e, map, 0);
        for (uint32_t i = 1; i < map->count; i++)
            mean = mix(mean, item_color(e, map, i), 1.0F / (float)(i + 1));
        return mean;
    }
    uint32_t below, above;
    map_bracket(map, 0.5F, &below, &above);
    Color a = item_color(e, map, below), b = item_color(e, map, above);
    float width = map->items[above].value - map->items[below].value;
    return width > 0 ? mix(a, b, (0.5F - map->items[below].value) / width) : b;
}

// ---- patterns --------------------------------------------------------------------------------

void emit_warps(Emitter *e, const PatternNode *node, Pattern *pattern) {
    uint32_t count = 0;
    for (const WarpNode *warp = node->warps; warp; warp = warp->next)
        count++;
    pattern->warps = ARENA_ARRAY(e->cv->arena, Warp, count);
    for (const WarpNode *warp = node->warps; warp; warp = warp->next)
        pattern->warps[pattern->warp_count++] = warp->warp;
}

// The members that the type looks at; the others keep their defaults, so that the scene file shows
// only what matters.
static void copy_shape(const Pattern *shape, Pattern *pattern) {
    pattern->wave = shape->wave;
    pattern->frequency = shape->frequency;
    pattern->phase = shape->phase;
    if (shape->wave == WAVE_POLY)
        pattern->exponent = shape->exponent;
    pattern->noise_generator = shape->noise_generator;
    // Octaves without an amount move nothing; agate looks at them all the same.
    const Vec3 amount = shape->turbulence.amount;
    bool moves = amount.x != 0 || amount.y != 0 || amount.z != 0;
    if (shape->has_turbulence && (moves || pattern->type == PATTERN_AGATE)) {
        pattern->has_turbulence = true;
        pattern->turbulence = shape->turbulence;
    }
    switch (pattern->type) {
    case PATTERN_GRADIENT:
        pattern->gradient = shape->gradient;
        break;
    case PATTERN_AGATE:
        pattern->has_turbulence = true;
        pattern->agate_turb = shape->agate_turb;
        break;
    case PATTERN_BRICK:
        pattern->brick_size = shape->brick_size;
        pattern->mortar = shape->mortar;
        break;
    case PATTERN_CRACKLE:
        pattern->crackle = shape->crackle;
        break;
    case PATTERN_FACETS:
        pattern->facets = shape->facets;
        break;
    case PATTERN_SLOPE:
        pattern->slope = shape->slope;
        break;
    case PATTERN_FRACTAL:
        pattern->fractal = shape->fractal;
        break;
    case PATTERN_DENSITY:
        pattern->density_between = shape->density_between;
        break;
    case PATTERN_QUILTED:
        memcpy(pattern->quilted, shape->quilted, sizeof pattern->quilted);
        break;
    case PATTERN_SPIRAL1:
    case PATTERN_SPIRAL2:
        pattern->arms = shape->arms;
        break;
    default:
        break;
    }
}

bool pattern_is_modelled(const PatternNode *node) {
    if (node->info->type == PATTERN_OBJECT && !object_is_there(node->object))
        return false;
    return node->info->type != PATTERN_MODELLED;
}

static uint32_t emit_picture(Emitter *e, const Picture *picture) {
    for (size_t i = 0; i < e->pictures.count; i++)
        if (picture_equal(&e->pictures.items[i], picture))
            return (uint32_t)i;
    array_push(&e->pictures, *picture);
    return (uint32_t)(e->pictures.count - 1);
}

static uint32_t emit_density(Emitter *e, const char *path) {
    for (size_t i = 0; i < e->densities.count; i++)
        if (strcmp(e->densities.items[i].path, path) == 0)
            return (uint32_t)i;
    const DensityFile density = {path};
    array_push(&e->densities, density);
    return (uint32_t)(e->densities.count - 1);
}

// What the pattern looks at besides the point.
static void emit_uses(Emitter *e, const PatternNode *node, Pattern *pattern) {
    switch (pattern->type) {
    case PATTERN_IMAGE:
    case PATTERN_IMAGE_MAP:
    case PATTERN_BUMP_MAP:
    case PATTERN_MATERIAL_MAP:
        pattern->picture = emit_picture(e, node->picture);
        break;
    case PATTERN_FUNCTION:
        pattern->function = emit_function(e, node->function);
        break;
    case PATTERN_PIGMENT:
        pattern->pigment = emit_pigment(e, node->pigment);
        break;
    case PATTERN_OBJECT:
        pattern->object = emit_hidden(e, node->object);
        break;
    case PATTERN_DENSITY:
        pattern->density = emit_density(e, node->density);
        break;
    default:
        break;
    }
}

void emit_pattern(Emitter *e, const PatternNode *node, Pattern *pattern) {
    *pattern = pattern_default();
    pattern->type = node->info->type;
    emit_uses(e, node, pattern);
    copy_shape(&node->shape, pattern);
    emit_warps(e, node, pattern);
}

uint64_t pattern_hash(uint64_t hash, const Pattern *p) {
    hash = hash_bytes(hash, &p->type, sizeof p->type);
    hash = hash_bytes(hash, &p->wave, sizeof p->wave);
    const float numbers[] = {p->frequency, p->phase, p->exponent};
    hash = hash_bytes(hash, numbers, sizeof numbers);
    const uint32_t uses[] = {p->picture, p->function, p->pigment, p->object, p->density};
    hash = hash_bytes(hash, uses, sizeof uses);
    hash = hash_bytes(hash, &p->turbulence.amount, sizeof p->turbulence.amount);
    for (uint32_t i = 0; i < p->warp_count; i++)
        if (p->warps[i].type == WARP_TRANSFORM)
            hash = hash_bytes(hash, &p->warps[i].transform, sizeof p->warps[i].transform);
    return hash;
}

// ---- pigments --------------------------------------------------------------------------------

static void copy_entries(Emitter *e, const PatternNode *node, Pigment *pigment) {
    const MapNode *map = node->map ? node->map : map_default(e->cv, node->info);
    pigment->entries = ARENA_ARRAY(e->cv->arena, MapEntry, map->count);
    pigment->entry_count = map->count;
    for (uint32_t i = 0; i < map->count; i++) {
        MapEntry *entry = &pigment->entries[i];
        entry->value = map->items[i].value;
        entry->pigment = NO_INDEX;
        if (map->kind == MAP_COLOR)
            entry->color = map->items[i].color;
        else
            entry->pigment = emit_pigment(e, map->items[i].node);
    }
}

static const char *pattern_text(Emitter *e, const PatternNode *node) {
    return arena_printf(e->cv->arena,
                        "the pattern '%s' is not modelled: one colour is shown, the middle of its "
                        "map",
                        keyword_name(node->info->keyword));
}

static void build_pigment(Emitter *e, const PatternNode *node, Pigment *pigment) {
    pigment->pattern = pattern_default();
    pigment->has_quick_color = node->has_quick_color;
    pigment->quick_color = node->quick_color;
    if (node->info->keyword == 0) // nothing was ever given: opaque black
        return;
    if (node->info->type == PATTERN_PLAIN) {
        pigment->color = node->color;
        return;
    }
    if (!pattern_is_modelled(node)) {
        emit_gap(e, node->loc, pattern_text(e, node));
        pigment->color = middle_color(e, node);
        return;
    }
    emit_pattern(e, node, &pigment->pattern);
    if (pigment->pattern.type != PATTERN_IMAGE_MAP)
        copy_entries(e, node, pigment);
}

// Field by field, since the padding of a struct may hold anything. What is left out here is rarely
// the only difference; same_pigment looks at all.
static uint64_t hash_pigment(const Pigment *p) {
    uint64_t hash = pattern_hash(HASH_START, &p->pattern);
    hash = hash_bytes(hash, &p->color, sizeof p->color);
    return hash_bytes(hash, p->entries, p->entry_count * sizeof *p->entries);
}

static bool same_pigment(const Emitter *e, uint32_t index, const void *record) {
    return pigment_equal(&e->pigments.items[index], record);
}

uint32_t store_pigment(Emitter *e, const Pigment *pigment) {
    uint64_t hash = hash_pigment(pigment);
    uint32_t index = pool_keep(e, &e->pigment_table, hash, pigment, same_pigment);
    if (index == e->pigments.count)
        array_push(&e->pigments, *pigment);
    return index;
}

uint32_t emit_pigment(Emitter *e, const PatternNode *node) {
    uint32_t index;
    if (node_find(&e->pigment_nodes, node, &index))
        return index;
    enter_level(e->cv);
    const PatternNode *inner = node;
    Pigment pigment = {0};
    for (; inner->info->keyword == KW_uv_mapping; inner = inner->map->items[0].node)
        pigment.uv_mapping = true;
    build_pigment(e, inner, &pigment);
    if (pigment.pattern.type == PATTERN_PLAIN)
        pigment.uv_mapping = false; // one colour is the same everywhere
    index = store_pigment(e, &pigment);
    leave_level(e->cv);
    node_put(e, &e->pigment_nodes, node, index);
    return index;
}
