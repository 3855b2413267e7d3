// SPDX-License-Identifier: MIT
// texture{} before version 3.0: what belongs to its pigment, normal and finish may stand in it
// without a block of its own (facts: sdl 1.7). Patterned textures are not known there.
#include "converter/nodes.h"

// The parts of the top layer while they are edited.
typedef struct {
    TextureNode top;
    PatternNode pigment, normal;
    FinishNode finish;
} OldTexture;

static void take_apart(const TextureNode *texture, OldTexture *old) {
    old->top = *texture;
    old->pigment = *texture->pigment;
    old->finish = *texture->finish;
    old->normal = texture->normal ? *texture->normal : pattern_node_default();
}

static const TextureNode *put_together(Converter *cv, const OldTexture *old) {
    TextureNode top = old->top;
    top.pigment = arena_copy(cv->arena, &old->pigment, sizeof old->pigment);
    top.finish = arena_copy(cv->arena, &old->finish, sizeof old->finish);
    if (top.normal)
        top.normal = arena_copy(cv->arena, &old->normal, sizeof old->normal);
    return arena_copy(cv->arena, &top, sizeof top);
}

static bool is_among(int code, const int *words) {
    for (; *words; words++)
        if (*words == code)
            return true;
    return false;
}

// ---- pigment --------------------------------------------------------------------------------

static bool parse_old_pigment(Converter *cv, PatternNode *pigment) {
    static const int patterns[] = {KW_agate,  KW_bozo,       KW_granite,   KW_leopard,
                                   KW_marble, KW_mandel,     KW_onion,     KW_spotted,
                                   KW_wood,   KW_gradient,   KW_checker,   KW_hexagon,
                                   KW_square, KW_triangular, KW_image_map, 0};
    int code = peek_token(cv)->code;
    MapKind kind;
    if (is_among(code, patterns) || starts_color(cv)) {
        WaveType wave = pigment->shape.wave; // marble and wood are no triangles here
        parse_pattern_start(cv, USE_PIGMENT, pigment);
        pigment->shape.wave = wave;
        return true;
    }
    if (map_keyword(code, &kind) && kind == MAP_COLOR) {
        next_token(cv);
        pigment->map = parse_map(cv, kind, false);
        return true;
    }
    if (accept(cv, KW_quick_color) || accept(cv, KW_quick_colour)) {
        parse_quick_color(cv, pigment);
        return true;
    }
    return parse_turbulence(cv, pigment);
}

// ---- normal ---------------------------------------------------------------------------------

static bool parse_old_normal(Converter *cv, OldTexture *old) {
    static const int words[] = {KW_bumps,    KW_dents,     KW_ripples, KW_waves, KW_wrinkles,
                                KW_bump_map, KW_frequency, KW_phase,   0};
    const Token *token = peek_token(cv);
    int code = token->code;
    if (!is_among(code, words))
        return false;
    if (!old->top.normal) {
        old->top.normal = &old->normal;
        old->normal.block_loc = keep_place(cv, token);
    }
    if (accept(cv, KW_frequency))
        old->normal.shape.frequency = (float)parse_float(cv);
    else if (accept(cv, KW_phase))
        old->normal.shape.phase = (float)parse_float(cv);
    else
        parse_pattern_start(cv, USE_NORMAL, &old->normal);
    return true;
}

// ---- finish ---------------------------------------------------------------------------------

static float *finish_number(FinishNode *node, int code) {
    Finish *finish = &node->finish;
    switch (code) {
    case KW_brilliance:
        return &finish->brilliance;
    case KW_diffuse:
        return &finish->diffuse;
    case KW_phong:
        return &finish->phong;
    case KW_phong_size:
        return &finish->phong_size;
    case KW_specular:
        return &finish->specular;
    case KW_roughness:
        return &finish->roughness;
    case KW_crand:
        return &finish->crand;
    case KW_ior:
        return &node->ior;
    case KW_refraction:
        return &node->refraction;
    default:
        return NULL;
    }
}

static bool parse_old_finish(Converter *cv, FinishNode *node) {
    Finish *finish = &node->finish;
    float *number = finish_number(node, peek_token(cv)->code);
    if (number) {
        next_token(cv);
        *number = (float)parse_float(cv);
    } else if (accept(cv, KW_ambient)) {
        float grey = (float)parse_float(cv);
        finish->ambient = rgb(grey, grey, grey);
    } else if (accept(cv, KW_reflection)) {
        float grey = (float)parse_float(cv);
        finish->reflection_max = finish->reflection_min = rgb(grey, grey, grey);
        finish->reflection_falloff = 1;
    } else if (accept(cv, KW_metallic)) {
        finish->metallic = 1;
    } else if (starts_expression(cv)) { // a number alone
        finish->crand = (float)parse_float(cv);
    } else {
        return false;
    }
    return true;
}

// ---- texture --------------------------------------------------------------------------------

static bool parse_block(Converter *cv, OldTexture *old) {
    if (accept(cv, KW_pigment)) {
        old->pigment = *parse_pigment_block(cv, &old->pigment);
    } else if (accept(cv, KW_normal)) {
        old->normal = *parse_normal_block(cv, old->top.normal ? &old->normal : NULL);
        old->top.normal = &old->normal;
    } else if (accept(cv, KW_finish)) {
        old->finish = *parse_finish_block(cv, &old->finish);
    } else {
        return false;
    }
    return true;
}

// A move takes all layers along; a texture's name begins anew.
static bool parse_whole(Converter *cv, OldTexture *old) {
    Move move;
    if (parse_move(cv, &move)) {
        take_apart(texture_moved(cv, put_together(cv, old), &move), old);
        return true;
    }
    const Token *token = peek_token(cv);
    const Value *value = accept_value(cv, VALUE_TEXTURE);
    if (!value)
        return false;
    if (!texture_is_plain(value->node)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "a patterned texture cannot take the place of a plain one");
    }
    take_apart(value->node, old);
    return true;
}

const TextureNode *parse_old_items(Converter *cv, const TextureNode *texture) {
    OldTexture old;
    take_apart(texture, &old);
    while (parse_block(cv, &old) || parse_old_pigment(cv, &old.pigment) ||
           parse_old_normal(cv, &old) || parse_whole(cv, &old) ||
           parse_old_finish(cv, &old.finish)) {
    }
    if (cv->version >= 150 && !cv->nodes->in_default && old.pigment.info->keyword == 0)
        die_expected(cv, "a pigment");
    return put_together(cv, &old);
}
