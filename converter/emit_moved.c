// SPDX-License-Identifier: MIT
// Textures in the pool, moved with an object: what texture_moved() does to nodes, done to records,
// for copies that have no nodes of their own.
#include "converter/emit.h"

static void move_pattern(Emitter *e, Pattern *pattern, const Transform *move) {
    Warp warp = warp_default(WARP_TRANSFORM);
    warp.transform = *move;
    const Warp *rest = pattern->warps;
    uint32_t count = pattern->warp_count;
    if (count > 0 && rest->type == WARP_TRANSFORM) {
        warp.transform = transform_compose(&rest->transform, move);
        rest++, count--;
    }
    pattern->warps = ARENA_ARRAY(e->cv->arena, Warp, (size_t)count + 1);
    pattern->warps[0] = warp;
    for (uint32_t i = 0; i < count; i++)
        pattern->warps[i + 1] = rest[i];
    pattern->warp_count = count + 1;
}

// With uv_mapping it is the outer pattern that moves, which shows nothing.
static uint32_t move_pigment(Emitter *e, uint32_t index, const Transform *move) {
    Pigment pigment = e->pigments.items[index];
    if (pigment.uv_mapping || pigment.pattern.type == PATTERN_PLAIN)
        return index;
    move_pattern(e, &pigment.pattern, move);
    return store_pigment(e, &pigment);
}

static uint32_t move_normal(Emitter *e, uint32_t index, const Transform *move) {
    if (index == NO_INDEX || e->normals.items[index].uv_mapping)
        return index;
    Normal normal = e->normals.items[index];
    move_pattern(e, &normal.pattern, move);
    return store_normal(e, &normal);
}

static uint32_t move_layers(Emitter *e, uint32_t index, const Transform *move) {
    Texture texture = e->textures.items[index];
    Layer *layers =
        arena_copy(e->cv->arena, texture.layers, texture.layer_count * sizeof *texture.layers);
    bool moved = false;
    for (uint32_t i = 0; i < texture.layer_count; i++) {
        layers[i].pigment = move_pigment(e, layers[i].pigment, move);
        layers[i].normal = move_normal(e, layers[i].normal, move);
        moved = moved || layers[i].pigment != texture.layers[i].pigment ||
                layers[i].normal != texture.layers[i].normal;
    }
    texture.layers = layers;
    return moved ? store_texture(e, &texture) : index;
}

// A plain colour on a smooth surface is the same everywhere.
static bool stays(const Emitter *e, const Texture *texture) {
    bool still = !texture->uv_mapping && texture->layer_count > 0;
    for (uint32_t i = 0; still && i < texture->layer_count; i++)
        still = texture->layers[i].normal == NO_INDEX &&
                e->pigments.items[texture->layers[i].pigment].pattern.type == PATTERN_PLAIN;
    return still;
}

uint32_t emit_texture_moved(Emitter *e, uint32_t index, const Transform *move) {
    Texture texture = e->textures.items[index];
    if (stays(e, &texture))
        return index;
    if (!texture.uv_mapping && texture.layer_count > 0)
        return move_layers(e, index, move);
    move_pattern(e, &texture.pattern, move);
    return store_texture(e, &texture);
}
