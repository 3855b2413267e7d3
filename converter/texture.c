// SPDX-License-Identifier: MIT
// texture{}, its layers, and pigment{} and normal{} with their names (facts: sdl 4.5, 4.6,
// textures 1.1-1.4). A texture is a chain of layers from the top down; an edit makes new nodes, so
// that a texture used by many objects stays one node until it is changed.
#include "converter/nodes.h"

#include <stdint.h>

bool texture_is_plain(const TextureNode *texture) { return texture->pattern.info->keyword == 0; }

static const PatternNode *copy_pattern(Converter *cv, const PatternNode *pattern) {
    return arena_copy(cv->arena, pattern, sizeof *pattern);
}

static TextureNode *copy_texture(Converter *cv, const TextureNode *texture) {
    return arena_copy(cv->arena, texture, sizeof *texture);
}

// ---- pigment, normal, density ----------------------------------------------------------------

const PatternNode *parse_pigment_body(Converter *cv, const PatternNode *base) {
    const Value *value = accept_value(cv, VALUE_PIGMENT);
    PatternNode node = value ? *(const PatternNode *)value->node : *base;
    parse_pattern(cv, USE_PIGMENT, &node);
    return copy_pattern(cv, &node);
}

const PatternNode *parse_normal_body(Converter *cv, const PatternNode *base) {
    const Token *token = peek_token(cv);
    const Value *value = accept_value(cv, VALUE_NORMAL);
    PatternNode node = value  ? *(const PatternNode *)value->node
                       : base ? *base
                              : pattern_node_default();
    node.block_loc = keep_place(cv, token);
    parse_pattern(cv, USE_NORMAL, &node);
    return copy_pattern(cv, &node);
}

const PatternNode *parse_density_body(Converter *cv, const PatternNode *base) {
    const Value *value = accept_value(cv, VALUE_DENSITY);
    PatternNode node = value  ? *(const PatternNode *)value->node
                       : base ? *base
                              : pattern_node_default();
    parse_pattern(cv, USE_DENSITY, &node);
    return copy_pattern(cv, &node);
}

const PatternNode *parse_pigment_block(Converter *cv, const PatternNode *base) {
    expect(cv, '{', "pigment");
    const PatternNode *node = parse_pigment_body(cv, base);
    expect(cv, '}', "pigment");
    return node;
}

const PatternNode *parse_normal_block(Converter *cv, const PatternNode *base) {
    expect(cv, '{', "normal");
    const PatternNode *node = parse_normal_body(cv, base);
    expect(cv, '}', "normal");
    return node;
}

const PatternNode *parse_density_block(Converter *cv) {
    expect(cv, '{', "density");
    const PatternNode *node = parse_density_body(cv, NULL);
    expect(cv, '}', "density");
    return node;
}

// ---- layers ----------------------------------------------------------------------------------

static Color filter_to_transmit(Color c) {
    c.transmit += c.filter;
    c.filter = 0;
    return c;
}

// Up to version 3.1 what lies above another layer lets light through unfiltered.
static const PatternNode *unfiltered_pigment(Converter *cv, const PatternNode *pigment) {
    PatternNode node = *pigment;
    node.color = filter_to_transmit(node.color);
    if (node.map && node.map->kind == MAP_COLOR) {
        MapItem *items =
            arena_copy(cv->arena, node.map->items, node.map->count * sizeof *node.map->items);
        for (uint32_t i = 0; i < node.map->count; i++)
            items[i].color = filter_to_transmit(items[i].color);
        MapNode map = *node.map;
        map.items = items;
        node.map = arena_copy(cv->arena, &map, sizeof map);
    }
    return copy_pattern(cv, &node);
}

const TextureNode *texture_layer(Converter *cv, const TextureNode *top, const TextureNode *below,
                                 const Token *token) {
    if (!below || !top)
        return below ? below : top;
    if (!texture_is_plain(top) || !texture_is_plain(below)) {
        Loc loc = token ? token_loc(cv, token) : here(cv);
        die_at(&loc, "a patterned texture cannot be a layer over or under another texture");
    }
    const TextureNode *first = NULL, **link = &first; // where the next copy hangs
    for (const TextureNode *t = top; t; t = t->below) {
        TextureNode *copy = copy_texture(cv, t);
        if (cv->version <= 310)
            copy->pigment = unfiltered_pigment(cv, copy->pigment);
        *link = copy;
        link = &copy->below;
    }
    *link = below;
    return first;
}

static const PatternNode *moved_pattern(Converter *cv, const PatternNode *pattern,
                                        const Transform *t) {
    PatternNode node = *pattern;
    pattern_move(cv, &node, t);
    return copy_pattern(cv, &node);
}

const TextureNode *texture_moved(Converter *cv, const TextureNode *texture, Move *move) {
    if (!texture)
        return NULL;
    size_t slot = ((uintptr_t)texture / 64) % MOVE_CACHE;
    if (move->cache[slot].from == texture)
        return move->cache[slot].to;
    TextureNode *first = NULL, *last = NULL;
    for (const TextureNode *t = texture; t; t = t->below) {
        TextureNode *copy = copy_texture(cv, t);
        if (texture_is_plain(t)) {
            copy->pigment = moved_pattern(cv, t->pigment, &move->t);
            copy->normal = t->normal ? moved_pattern(cv, t->normal, &move->t) : NULL;
        } else {
            pattern_move(cv, &copy->pattern, &move->t);
        }
        if (last)
            last->below = copy;
        else
            first = copy;
        last = copy;
    }
    move->cache[slot].from = texture;
    move->cache[slot].to = first;
    return first;
}

// ---- texture ---------------------------------------------------------------------------------

// pigment{}, normal{} or finish{}: edits the top layer only.
static bool parse_part(Converter *cv, const TextureNode **texture) {
    int code = peek_token(cv)->code;
    if (code != KW_pigment && code != KW_normal && code != KW_finish)
        return false;
    next_token(cv);
    TextureNode *top = copy_texture(cv, *texture);
    if (code == KW_pigment)
        top->pigment = parse_pigment_block(cv, top->pigment);
    else if (code == KW_normal)
        top->normal =
            parse_normal_block(cv, top->normal ? top->normal : cv->nodes->default_texture->normal);
    else
        top->finish = parse_finish_block(cv, top->finish);
    *texture = top;
    return true;
}

// The name of a pigment, normal or finish without its block.
static bool parse_bare_part(Converter *cv, const TextureNode **texture) {
    ValueType type = peek_value_type(cv);
    if (type != VALUE_PIGMENT && type != VALUE_NORMAL && type != VALUE_FINISH)
        return false;
    TextureNode *top = copy_texture(cv, *texture);
    const Value *value = accept_value(cv, type);
    if (!value)
        die_expected(cv, "a pigment, normal or finish");
    if (type == VALUE_PIGMENT) {
        top->pigment = value->node;
    } else if (type == VALUE_FINISH) {
        top->finish = value->node;
    } else {
        top->normal = value->node;
    }
    *texture = top;
    return true;
}

// Transforms and no_bump_scale. That alone does not make the texture another one: *flag.
static const TextureNode *parse_moves(Converter *cv, const TextureNode *texture, bool *flag) {
    Move move;
    for (;;) {
        if (parse_move(cv, &move))
            texture = texture_moved(cv, texture, &move);
        else if (accept(cv, KW_no_bump_scale))
            *flag = true;
        else
            return texture;
    }
}

// Nothing of a plain texture was given, so it may be a patterned one.
static const TextureNode *parse_patterned(Converter *cv, const TextureNode *base) {
    TextureNode node = *base;
    node.pattern = pattern_node_default();
    parse_pattern(cv, USE_TEXTURE, &node.pattern);
    const PatternInfo *info = node.pattern.info;
    if (info->keyword == 0)
        return base;
    if (!info->list && (!node.pattern.map || node.pattern.map->kind != MAP_TEXTURE))
        die_at(node.pattern.loc, "a texture with '%s' needs a texture_map",
               keyword_name(info->keyword));
    node.below = NULL;
    return copy_texture(cv, &node);
}

// Before version 3.0: of the patterned ones only tiles and material_map.
static const TextureNode *parse_old_texture(Converter *cv, const TextureNode *texture, bool named,
                                            bool *flag) {
    if (!named && (next_is(cv, KW_tiles) || next_is(cv, KW_material_map)))
        texture = parse_patterned(cv, texture);
    if (texture_is_plain(texture)) {
        while (parse_bare_part(cv, &texture)) {
        }
        texture = parse_old_items(cv, texture);
    }
    return parse_moves(cv, texture, flag);
}

const TextureNode *parse_texture_body(Converter *cv) {
    const Value *value = accept_value(cv, VALUE_TEXTURE);
    const TextureNode *base = value ? value->node : cv->nodes->default_texture;
    enter_level(cv);
    const TextureNode *texture = base;
    bool no_bump_scale = false;
    if (cv->version < 300) {
        texture = parse_old_texture(cv, texture, value != NULL, &no_bump_scale);
    } else if (texture_is_plain(texture)) {
        while (parse_bare_part(cv, &texture)) {
        }
        const TextureNode *before;
        do {
            before = texture;
            while (parse_part(cv, &texture)) {
            }
            texture = parse_moves(cv, texture, &no_bump_scale);
        } while (texture != before);
        if (texture == base)
            texture = parse_patterned(cv, base);
    } else {
        texture = parse_moves(cv, texture, &no_bump_scale);
    }
    leave_level(cv);
    if (no_bump_scale) {
        TextureNode *copy = copy_texture(cv, texture);
        copy->no_bump_scale = true;
        texture = copy;
    }
    return texture;
}

const TextureNode *parse_texture_block(Converter *cv) {
    expect(cv, '{', "texture");
    const TextureNode *texture = parse_texture_body(cv);
    expect(cv, '}', "texture");
    return texture;
}

bool parse_partial_texture(Converter *cv, const TextureNode **texture) {
    const Token *token = peek_token(cv);
    if (token->code != KW_pigment && token->code != KW_normal && token->code != KW_finish)
        return false;
    if (!*texture)
        *texture = cv->nodes->default_texture;
    else if (!texture_is_plain(*texture))
        texture_layer(cv, cv->nodes->default_texture, *texture, token);
    while (parse_part(cv, texture)) {
    }
    return true;
}
