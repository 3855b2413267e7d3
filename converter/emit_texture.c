// SPDX-License-Identifier: MIT
// Textures and pigments on their way into the pools of the scene. Equal ones are stored once. A
// pattern that is not modelled becomes one colour, the middle of its map (facts: textures 4.1).
#include "converter/emit.h"

#include <stdlib.h>
#include <string.h>

// ---- tables
// -------------------------------------------------------------------------------------------

static uint64_t hash_bytes(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * 0x100000001B3u; // FNV-1a
    return hash;
}
static const uint64_t HASH_START = 0xCBF29CE484222325u;

static void intern_grow(Emitter *e, InternTable *table) {
    InternTable grown = {.capacity = table->capacity ? 2 * table->capacity : 64,
                         .count = table->count};
    grown.entries = ARENA_ARRAY(e->cv->arena, struct InternEntry, grown.capacity);
    for (size_t i = 0; i < grown.capacity; i++)
        grown.entries[i].index = NO_INDEX;
    for (size_t i = 0; i < table->capacity; i++) {
        if (table->entries[i].index == NO_INDEX)
            continue;
        size_t slot = table->entries[i].hash & (grown.capacity - 1);
        while (grown.entries[slot].index != NO_INDEX)
            slot = (slot + 1) & (grown.capacity - 1);
        grown.entries[slot] = table->entries[i];
    }
    *table = grown;
}

// The record of that hash for which same(pool, index, record) holds, or NO_INDEX; then *slot is
// where it belongs.
static uint32_t intern_find(Emitter *e, InternTable *table, uint64_t hash, const void *record,
                            bool (*same)(const Emitter *, uint32_t, const void *), size_t *slot) {
    if (2 * (table->count + 1) > table->capacity)
        intern_grow(e, table);
    size_t mask = table->capacity - 1, at = hash & mask;
    for (; table->entries[at].index != NO_INDEX; at = (at + 1) & mask)
        if (table->entries[at].hash == hash && same(e, table->entries[at].index, record))
            return table->entries[at].index;
    *slot = at;
    return NO_INDEX;
}

static void intern_put(InternTable *table, size_t slot, uint64_t hash, uint32_t index) {
    table->entries[slot].hash = hash;
    table->entries[slot].index = index;
    table->count++;
}

static size_t node_slot(const NodeTable *table, const void *node) {
    size_t slot = ((uintptr_t)node >> 6) & (table->capacity - 1);
    while (table->entries[slot].node && table->entries[slot].node != node)
        slot = (slot + 1) & (table->capacity - 1);
    return slot;
}

static bool node_find(const NodeTable *table, const void *node, uint32_t *index) {
    if (table->capacity == 0)
        return false;
    size_t slot = node_slot(table, node);
    *index = table->entries[slot].index;
    return table->entries[slot].node != NULL;
}

static void node_put(Emitter *e, NodeTable *table, const void *node, uint32_t index) {
    if (2 * (table->count + 1) > table->capacity) {
        NodeTable grown = {.capacity = table->capacity ? 2 * table->capacity : 64,
                           .count = table->count};
        grown.entries = ARENA_ARRAY(e->cv->arena, struct NodeEntry, grown.capacity);
        for (size_t i = 0; i < table->capacity; i++)
            if (table->entries[i].node)
                grown.entries[node_slot(&grown, table->entries[i].node)] = table->entries[i];
        *table = grown;
    }
    table->entries[node_slot(table, node)] = (struct NodeEntry){node, index};
    table->count++;
}

// ---- what is not modelled
// ----------------------------------------------------------------------------

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
static void map_bracket(const MapNode *map, float at, uint32_t *below, uint32_t *above) {
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

// ---- pigments
// -------------------------------------------------------------------------------------------

static void copy_warps(Emitter *e, const PatternNode *node, Pattern *pattern) {
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
                        node->info->keyword == KW_image_map
                            ? "%s is not modelled: a plain grey is shown instead of the picture"
                            : "the pattern '%s' is not modelled: one colour is shown, the middle "
                              "of its map",
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
    if (node->info->type == PATTERN_MODELLED) {
        emit_gap(e, node->loc, pattern_text(e, node));
        pigment->color = middle_color(e, node);
        return;
    }
    Pattern *pattern = &pigment->pattern;
    pattern->type = node->info->type;
    copy_shape(&node->shape, pattern);
    copy_warps(e, node, pattern);
    copy_entries(e, node, pigment);
}

// Field by field, since the padding of a struct may hold anything. What is left out here is rarely
// the only difference; same_pigment looks at all.
static uint64_t hash_pigment(const Pigment *p) {
    const Pattern *q = &p->pattern;
    uint64_t hash = HASH_START;
    hash = hash_bytes(hash, &q->type, sizeof q->type);
    hash = hash_bytes(hash, &q->wave, sizeof q->wave);
    const float numbers[] = {q->frequency, q->phase, q->exponent};
    hash = hash_bytes(hash, numbers, sizeof numbers);
    hash = hash_bytes(hash, &q->turbulence.amount, sizeof q->turbulence.amount);
    hash = hash_bytes(hash, &p->color, sizeof p->color);
    hash = hash_bytes(hash, p->entries, p->entry_count * sizeof *p->entries);
    for (uint32_t i = 0; i < q->warp_count; i++)
        if (q->warps[i].type == WARP_TRANSFORM)
            hash = hash_bytes(hash, &q->warps[i].transform, sizeof q->warps[i].transform);
    return hash;
}

static bool same_pigment(const Emitter *e, uint32_t index, const void *record) {
    return pigment_equal(&e->pigments.items[index], record);
}

static uint32_t store_pigment(Emitter *e, const Pigment *pigment) {
    uint64_t hash = hash_pigment(pigment);
    size_t slot = 0;
    uint32_t index = intern_find(e, &e->pigment_table, hash, pigment, same_pigment, &slot);
    if (index != NO_INDEX)
        return index;
    index = (uint32_t)e->pigments.count;
    array_push(&e->pigments, *pigment);
    intern_put(&e->pigment_table, slot, hash, index);
    return index;
}

uint32_t emit_pigment(Emitter *e, const PatternNode *node) {
    uint32_t index;
    if (node_find(&e->pigment_nodes, node, &index))
        return index;
    const PatternNode *inner = node;
    Pigment pigment = {0};
    for (; inner->info->keyword == KW_uv_mapping; inner = inner->map->items[0].node)
        pigment.uv_mapping = true;
    build_pigment(e, inner, &pigment);
    if (pigment.pattern.type == PATTERN_PLAIN)
        pigment.uv_mapping = false; // one colour is the same everywhere
    index = store_pigment(e, &pigment);
    node_put(e, &e->pigment_nodes, node, index);
    return index;
}

// ---- textures
// ---------------------------------------------------------------------------------------------

static bool normal_shows(const PatternNode *normal) {
    if (!normal || normal->info->keyword == 0)
        return false;
    return normal->amount != 0.0F || (normal->map && normal->map->kind != MAP_SLOPE);
}

static void build_layers(Emitter *e, const TextureNode *node, Texture *texture) {
    uint32_t count = 0;
    for (const TextureNode *layer = node; layer; layer = layer->below)
        count++;
    texture->layers = ARENA_ARRAY(e->cv->arena, Layer, count);
    texture->layer_count = count;
    Layer *to = texture->layers;
    for (const TextureNode *layer = node; layer; layer = layer->below, to++) {
        to->pigment = emit_pigment(e, layer->pigment);
        to->finish = layer->finish->finish;
        emit_gaps(e, layer->finish->gaps);
        if (layer->finish->refraction != 1.0F)
            emit_gap(e, layer->finish->refraction_loc,
                     "refraction as a factor of light is not modelled: what is seen through the "
                     "object is not dimmed by it");
        // In a declaration or a default the pattern may still come; on an object it must be there.
        if (layer->normal && layer->normal->info->keyword == 0)
            die_at(layer->normal->block_loc, "No normal type given: a normal needs a pattern");
        if (normal_shows(layer->normal))
            emit_gap(e, layer->normal->block_loc, "normal is not modelled: the surface is smooth");
    }
}

static uint64_t hash_texture(const Texture *texture) {
    uint64_t hash = HASH_START;
    for (uint32_t i = 0; i < texture->layer_count; i++) {
        const Layer *layer = &texture->layers[i];
        hash = hash_bytes(hash, &layer->pigment, sizeof layer->pigment);
        hash = hash_bytes(hash, &layer->finish.ambient, sizeof layer->finish.ambient);
        hash = hash_bytes(hash, &layer->finish.diffuse, sizeof layer->finish.diffuse);
    }
    return hash;
}

static bool same_rgb(Rgb a, Rgb b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

static bool same_finish(const Finish *a, const Finish *b) {
    return same_rgb(a->ambient, b->ambient) && same_rgb(a->emission, b->emission) &&
           a->diffuse == b->diffuse && a->diffuse_back == b->diffuse_back &&
           a->brilliance == b->brilliance && a->crand == b->crand && a->phong == b->phong &&
           a->phong_size == b->phong_size && a->specular == b->specular &&
           a->roughness == b->roughness && a->metallic == b->metallic &&
           same_rgb(a->reflection_min, b->reflection_min) &&
           same_rgb(a->reflection_max, b->reflection_max) &&
           a->reflection_falloff == b->reflection_falloff &&
           a->reflection_exponent == b->reflection_exponent &&
           a->reflection_metallic == b->reflection_metallic &&
           a->reflection_fresnel == b->reflection_fresnel &&
           a->conserve_energy == b->conserve_energy && a->irid == b->irid &&
           a->irid_thickness == b->irid_thickness && a->irid_turbulence == b->irid_turbulence;
}

static bool same_texture(const Emitter *e, uint32_t index, const void *record) {
    const Texture *a = &e->textures.items[index], *b = record;
    if (a->layer_count != b->layer_count || a->uv_mapping != b->uv_mapping)
        return false;
    for (uint32_t i = 0; i < a->layer_count; i++)
        if (a->layers[i].pigment != b->layers[i].pigment ||
            !same_finish(&a->layers[i].finish, &b->layers[i].finish))
            return false;
    return true;
}

// The texture in the middle of the map of a patterned one.
static const TextureNode *middle_texture(Emitter *e, const TextureNode *node) {
    const MapNode *map = node->pattern.map;
    emit_gap(e, node->pattern.loc,
             arena_printf(e->cv->arena,
                          "a texture with '%s' is not modelled: one texture is shown, the middle "
                          "of its map",
                          keyword_name(node->pattern.info->keyword)));
    if (!map || map->kind != MAP_TEXTURE)
        return e->cv->nodes->default_texture;
    uint32_t below, above;
    map_bracket(map, 0.5F, &below, &above);
    return map->items[above].node;
}

uint32_t emit_texture(Emitter *e, const TextureNode *node) {
    uint32_t index;
    if (node_find(&e->texture_nodes, node, &index))
        return index;
    Texture texture = {0};
    const TextureNode *plain = node;
    while (!texture_is_plain(plain)) {
        if (plain->pattern.info->keyword == KW_uv_mapping) {
            texture.uv_mapping = true;
            plain = plain->pattern.map->items[0].node;
        } else {
            plain = middle_texture(e, plain);
        }
    }
    build_layers(e, plain, &texture);
    uint64_t hash = hash_texture(&texture);
    size_t slot;
    index = intern_find(e, &e->texture_table, hash, &texture, same_texture, &slot);
    if (index == NO_INDEX) {
        index = (uint32_t)e->textures.count;
        array_push(&e->textures, texture);
        intern_put(&e->texture_table, slot, hash, index);
    }
    node_put(e, &e->texture_nodes, node, index);
    return index;
}
