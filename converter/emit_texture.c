// SPDX-License-Identifier: MIT
// Textures on their way into the pool of the scene: stacks of layers, and patterns that choose
// among textures. Equal ones are stored once.
#include "converter/emit.h"

static void build_layers(Emitter *e, const TextureNode *node, bool no_bump_scale,
                         Texture *texture) {
    uint32_t count = 0;
    for (const TextureNode *layer = node; layer; layer = layer->below)
        count++;
    texture->layers = ARENA_ARRAY(e->cv->arena, Layer, count);
    texture->layer_count = count;
    Layer *to = texture->layers;
    for (const TextureNode *layer = node; layer; layer = layer->below, to++) {
        bool top = layer == node; // what comes from outside stops there
        to->pigment = emit_pigment(e, layer->pigment);
        to->finish = layer->finish->finish;
        emit_gaps(e, layer->finish->gaps);
        to->normal = NO_INDEX;
        if (layer->normal)
            to->normal =
                emit_normal(e, layer->normal, layer->no_bump_scale || (top && no_bump_scale));
    }
}

static uint64_t hash_texture(const Texture *texture) {
    uint64_t hash = pattern_hash(HASH_START, &texture->pattern);
    for (uint32_t i = 0; i < texture->layer_count; i++) {
        const Layer *layer = &texture->layers[i];
        hash = hash_bytes(hash, &layer->pigment, sizeof layer->pigment);
        hash = hash_bytes(hash, &layer->normal, sizeof layer->normal);
        hash = hash_bytes(hash, &layer->finish.ambient, sizeof layer->finish.ambient);
        hash = hash_bytes(hash, &layer->finish.diffuse, sizeof layer->finish.diffuse);
    }
    return hash_bytes(hash, texture->entries, texture->entry_count * sizeof *texture->entries);
}

static bool same_texture(const Emitter *e, uint32_t index, const void *record) {
    return texture_equal(&e->textures.items[index], record);
}

uint32_t store_texture(Emitter *e, const Texture *texture) {
    uint64_t hash = hash_texture(texture);
    uint32_t index = pool_keep(e, &e->texture_table, hash, texture, same_texture);
    if (index == e->textures.count)
        array_push(&e->textures, *texture);
    return index;
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

static uint32_t emit_flagged(Emitter *e, const TextureNode *node, bool no_bump_scale);

static void build_entries(Emitter *e, const MapNode *map, Texture *texture) {
    texture->entries = ARENA_ARRAY(e->cv->arena, IndexEntry, map->count);
    texture->entry_count = map->count;
    for (uint32_t i = 0; i < map->count; i++) {
        uint32_t index = emit_flagged(e, map->items[i].node, texture->no_bump_scale);
        texture->entries[i] = (IndexEntry){map->items[i].value, index};
    }
}

// uv_mapping: the inner texture stands in this one's record unless that has a pattern or
// transforms, which turn the normals inside.
static void build_uv(Emitter *e, const TextureNode *node, Texture *texture) {
    const MapNode *map = node->pattern.map;
    const TextureNode *inner = map->items[0].node;
    texture->uv_mapping = true;
    emit_warps(e, &node->pattern, &texture->pattern);
    if (texture_is_plain(inner))
        build_layers(e, inner, texture->no_bump_scale, texture);
    else
        build_entries(e, map, texture);
}

static uint32_t emit_flagged(Emitter *e, const TextureNode *node, bool no_bump_scale) {
    uint32_t index;
    NodeTable *known = &e->texture_nodes[no_bump_scale];
    if (node_find(known, node, &index))
        return index;
    enter_level(e->cv);
    const PatternInfo *info = node->pattern.info;
    Texture texture = {.pattern = pattern_default()};
    if (texture_is_plain(node)) {
        build_layers(e, node, no_bump_scale, &texture);
        index = store_texture(e, &texture);
    } else if (info->keyword != KW_uv_mapping && !pattern_is_modelled(&node->pattern)) {
        index = emit_flagged(e, middle_texture(e, node), no_bump_scale);
    } else {
        texture.no_bump_scale = no_bump_scale || node->no_bump_scale || node->pattern.no_bump_scale;
        if (info->keyword == KW_uv_mapping) {
            build_uv(e, node, &texture);
        } else {
            emit_pattern(e, &node->pattern, &texture.pattern);
            build_entries(e, node->pattern.map, &texture);
        }
        index = store_texture(e, &texture);
    }
    leave_level(e->cv);
    node_put(e, known, node, index);
    return index;
}

uint32_t emit_texture(Emitter *e, const TextureNode *node) { return emit_flagged(e, node, false); }
