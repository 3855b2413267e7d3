// SPDX-License-Identifier: MIT
// The top level of a scene, the values of #declare, and #default (facts: sdl 3.2, 3.6, 4.1).
#include "converter/nodes.h"

// ---- values ----------------------------------------------------------------------------------

static Value node_value(ValueType type, const void *node) {
    return (Value){.type = type, .node = (void *)(uintptr_t)node};
}

// texture{} texture{} ...: all of them are one layered texture. Directives that follow must not run
// before the value is stored.
static const TextureNode *parse_layers(Converter *cv) {
    const TextureNode *texture = parse_texture_block(cv);
    for (;;) {
        bool held = hold_directives(cv);
        const Token *token = peek_token(cv);
        bool more = token->code == KW_texture;
        if (more)
            next_token(cv);
        restore_directives(cv, held);
        if (!more)
            return texture;
        texture = texture_layer(cv, parse_texture_block(cv), texture, token);
    }
}

static Value parse_texture_part(Converter *cv, int code) {
    const TextureNode *standard = cv->nodes->default_texture;
    if (code == KW_pigment)
        return node_value(VALUE_PIGMENT, parse_pigment_block(cv, standard->pigment));
    if (code == KW_pattern) { // the body of a function: a pattern without colours
        PatternNode node = pattern_node_default();
        expect(cv, '{', "pattern");
        parse_pattern(cv, USE_PIGMENT, &node);
        expect(cv, '}', "pattern");
        return node_value(VALUE_PIGMENT, arena_copy(cv->arena, &node, sizeof node));
    }
    if (code == KW_normal)
        return node_value(VALUE_NORMAL, parse_normal_block(cv, standard->normal));
    return node_value(VALUE_FINISH, parse_finish_block(cv, standard->finish));
}

static bool parse_keyword_value(Converter *cv, int code, Value *out) {
    MapKind kind;
    if (map_keyword(code, &kind)) {
        static const ValueType types[] = {VALUE_COLOR_MAP,  VALUE_SLOPE_MAP,   VALUE_PIGMENT_MAP,
                                          VALUE_NORMAL_MAP, VALUE_TEXTURE_MAP, VALUE_DENSITY_MAP};
        next_token(cv);
        *out = node_value(types[kind], parse_map(cv, kind, false));
        return true;
    }
    switch (code) {
    case KW_pigment:
    case KW_pattern:
    case KW_normal:
    case KW_finish:
        next_token(cv);
        *out = parse_texture_part(cv, code);
        return true;
    case KW_texture:
        next_token(cv);
        *out = node_value(VALUE_TEXTURE, parse_layers(cv));
        return true;
    case KW_material: {
        MaterialNode material = {0};
        next_token(cv);
        parse_material_block(cv, &material);
        *out = node_value(VALUE_MATERIAL, arena_copy(cv->arena, &material, sizeof material));
        return true;
    }
    case KW_interior:
        next_token(cv);
        *out = node_value(VALUE_INTERIOR, parse_interior_block(cv, NULL));
        return true;
    case KW_media:
        next_token(cv);
        *out = node_value(VALUE_MEDIA, parse_media_block(cv));
        return true;
    case KW_density:
        next_token(cv);
        *out = node_value(VALUE_DENSITY, parse_density_block(cv));
        return true;
    default:
        return false;
    }
}

static bool parse_world_value(Converter *cv, int code, Value *out) {
    switch (code) {
    case KW_fog:
        next_token(cv);
        *out = node_value(VALUE_FOG, parse_fog_block(cv));
        return true;
    case KW_rainbow:
        next_token(cv);
        *out = node_value(VALUE_RAINBOW, parse_rainbow_block(cv));
        return true;
    case KW_sky_sphere:
        next_token(cv);
        *out = node_value(VALUE_SKY_SPHERE, parse_sky_sphere_block(cv));
        return true;
    case KW_camera:
        next_token(cv);
        *out = node_value(VALUE_CAMERA, parse_camera_block(cv));
        return true;
    case KW_transform: {
        next_token(cv);
        Transform t = parse_transform(cv);
        *out = node_value(VALUE_TRANSFORM, arena_copy(cv->arena, &t, sizeof t));
        return true;
    }
    default:
        return false;
    }
}

bool parse_statement_value(Converter *cv, Value *out) {
    ValueType type = peek_value_type(cv);
    if (type >= VALUE_PIGMENT) {
        const Value *value = accept_value(cv, type);
        if (value)
            *out = *value;
        return value != NULL;
    }
    if (type != VALUE_NONE)
        return false;
    int code = peek_token(cv)->code;
    if (parse_keyword_value(cv, code, out) || parse_world_value(cv, code, out))
        return true;
    ObjectNode *object = parse_object(cv);
    if (object)
        *out = node_value(VALUE_OBJECT, object);
    return object != NULL;
}

// ---- #default --------------------------------------------------------------------------------

static void set_default_texture(Converter *cv, const Token *token, const TextureNode *texture) {
    if (!texture_is_plain(texture) || texture->below) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "the default texture must be plain and of one layer");
    }
    cv->nodes->default_texture = texture;
}

void parse_default_block(Converter *cv) {
    Nodes *nodes = cv->nodes;
    nodes->in_default = true;
    expect(cv, '{', "#default");
    for (;;) {
        const Token *token = peek_token(cv);
        if (accept(cv, KW_texture)) {
            set_default_texture(cv, token, parse_texture_block(cv));
        } else if (parse_partial_texture(cv, &nodes->default_texture)) {
        } else if (accept(cv, KW_camera)) {
            nodes->default_camera = *parse_camera_block(cv);
        } else if (accept(cv, KW_radiosity)) {
            parse_importance_block(cv);
        } else {
            break;
        }
    }
    expect(cv, '}', "#default");
    nodes->in_default = false;
}

// ---- the top level ---------------------------------------------------------------------------

static void add_root(Converter *cv, ObjectNode *object) {
    Nodes *nodes = cv->nodes;
    RootNode *root = ARENA_NEW(cv->arena, RootNode);
    *root = (RootNode){.object = object, .default_texture = nodes->default_texture};
    object_count(cv, &nodes->object_count, object);
    if (nodes->last)
        nodes->last->next = root;
    else
        nodes->first = root;
    nodes->last = root;
}

static void parse_scene_camera(Converter *cv, const Token *token) {
    bool again = cv->nodes->camera && cv->version >= 350 && !cv->options->clockless;
    if (again) {
        Loc loc = token_loc(cv, token);
        warn_at(&loc, "there was a camera before: this one replaces it");
    }
    cv->nodes->camera = parse_camera_block(cv);
    if (!cv->nodes->first_camera)
        cv->nodes->first_camera = cv->nodes->camera;
}

static void parse_background(Converter *cv) {
    expect(cv, '{', "background");
    cv->nodes->settings.background = parse_color(cv);
    expect(cv, '}', "background");
}

static void parse_sky_sphere(Converter *cv, const Token *token) {
    if (cv->nodes->sky_sphere) {
        Loc loc = token_loc(cv, token);
        warn_at(&loc, "there was a sky_sphere before: this one replaces it");
    }
    cv->nodes->sky_sphere = parse_sky_sphere_block(cv);
}

static void parse_atmosphere(Converter *cv, const Token *token) {
    const Gap **gaps = &cv->nodes->gaps;
    if (token->code == KW_media) {
        parse_media_block(cv);
        note_gap(cv, gaps, token, "media is not modelled: the air is clear");
    } else if (token->code == KW_rainbow) {
        RainbowNode *node = parse_rainbow_block(cv);
        node->next = cv->nodes->rainbows;
        cv->nodes->rainbows = node;
    } else {
        FogNode *node = parse_fog_block(cv);
        node->next = cv->nodes->fogs;
        cv->nodes->fogs = node;
    }
}

static bool parse_world(Converter *cv) {
    const Token *token = peek_token(cv);
    switch (token->code) {
    case KW_camera:
        next_token(cv);
        parse_scene_camera(cv, token);
        return true;
    case KW_background:
        next_token(cv);
        parse_background(cv);
        return true;
    case KW_global_settings:
        next_token(cv);
        parse_global_settings(cv);
        return true;
    case KW_sky_sphere:
        next_token(cv);
        parse_sky_sphere(cv, token);
        return true;
    case KW_fog:
    case KW_rainbow:
    case KW_media:
        next_token(cv);
        parse_atmosphere(cv, token);
        return true;
    case KW_max_trace_level:
    case KW_max_intersections:
        return parse_number_setting(cv, token);
    default:
        return false;
    }
}

void parse_scene_statements(Converter *cv) {
    nodes_begin(cv);
    while (!next_is(cv, TOK_EOF)) {
        ObjectNode *object = parse_object(cv);
        if (object)
            add_root(cv, object);
        else if (!parse_world(cv) && !accept_old_directive(cv))
            die_expected(cv, "an object, a directive or a statement of the top level");
    }
}
