// SPDX-License-Identifier: MIT
// interior{}, media{} and material{} (facts: sdl 4.8, textures 1.2).
#include "converter/nodes.h"

#include <math.h>

static float parse_dispersion(Converter *cv) {
    Loc loc = here(cv);
    float dispersion = (float)parse_float(cv);
    if (!(dispersion > 0.0F && isfinite(dispersion)))
        die_at(&loc, "The dispersion must be positive");
    return dispersion;
}

static bool parse_interior_number(Converter *cv, InteriorNode *node, int code) {
    Interior *interior = &node->interior;
    switch (code) {
    case KW_ior:
        next_token(cv);
        interior->ior = (float)parse_float(cv);
        node->bends = interior->ior != 0.0F;
        return true;
    case KW_caustics:
        next_token(cv);
        interior->caustics = (float)(parse_float(cv) * 45.0);
        return true;
    case KW_fade_distance:
        next_token(cv);
        interior->fade_distance = (float)parse_float(cv);
        return true;
    case KW_fade_power:
        next_token(cv);
        interior->fade_power = (float)parse_float(cv);
        return true;
    case KW_fade_color:
    case KW_fade_colour:
        next_token(cv);
        interior->fade_color = parse_color3(cv);
        return true;
    case KW_refraction: // the finish of a plain texture replaces it
        next_token(cv);
        interior->refraction = (float)parse_float(cv);
        return true;
    case KW_dispersion_samples:
        next_token(cv);
        interior->dispersion_samples =
            (int)number_within(cv, "number of dispersion samples", 2, INTERIOR_MAX_DISPERSION);
        return true;
    case KW_dispersion:
        next_token(cv);
        interior->dispersion = parse_dispersion(cv);
        return true;
    default:
        return false;
    }
}

static bool parse_interior_item(Converter *cv, InteriorNode *node) {
    const Token *token = peek_token(cv);
    if (parse_interior_number(cv, node, token->code))
        return true;
    if (accept(cv, KW_media))
        parse_media_block(cv);
    else if (!accept_value(cv, VALUE_MEDIA))
        return false;
    note_gap(cv, &node->gaps, token, "media is not modelled: the inside is clear");
    return true;
}

const InteriorNode *parse_interior_block(Converter *cv, const InteriorNode *base) {
    InteriorNode node = {.interior = interior_default()};
    expect(cv, '{', "interior");
    const Value *value = accept_value(cv, VALUE_INTERIOR);
    if (value)
        node = *(const InteriorNode *)value->node;
    else if (base)
        node = *base;
    while (parse_interior_item(cv, &node)) {
    }
    expect(cv, '}', "interior");
    return arena_copy(cv->arena, &node, sizeof node);
}

// scattering { F C3 { eccentricity F | extinction F }* }
static void parse_scattering(Converter *cv) {
    expect(cv, '{', "scattering");
    double type = parse_float(cv);
    optional_comma(cv);
    parse_color3(cv);
    for (;;) {
        const Token *token = peek_token(cv);
        if (!accept(cv, KW_eccentricity) && !accept(cv, KW_extinction))
            break;
        if (token->code == KW_eccentricity && !(type >= 5 && type < 6)) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "Eccentricity cannot be used with this scattering type: only with 5");
        }
        optional_comma(cv);
        parse_float(cv);
    }
    expect(cv, '}', "scattering");
}

// samples F [, F]: least and most
static void parse_samples(Converter *cv) {
    double least = floor(number_within(cv, "number of samples", 1, 1e9));
    optional_comma(cv);
    Loc loc = here(cv);
    if (starts_expression(cv) && !(floor(parse_float(cv)) >= least))
        die_at(&loc, "Maximum number of samples per interval smaller than minimum number");
}

static bool parse_media_item(Converter *cv) {
    Move move;
    switch (peek_token(cv)->code) {
    case KW_method:
        next_token(cv);
        number_within(cv, "sample method", 1, 3);
        return true;
    case KW_intervals:
        next_token(cv);
        number_within(cv, "number of intervals", 1, 1e9);
        return true;
    case KW_jitter:
    case KW_aa_threshold:
    case KW_aa_level:
    case KW_confidence:
    case KW_variance:
    case KW_ratio:
        next_token(cv);
        parse_float(cv);
        return true;
    case KW_samples:
        next_token(cv);
        parse_samples(cv);
        return true;
    case KW_collect:
        next_token(cv);
        parse_optional_bool(cv);
        return true;
    case KW_absorption:
    case KW_emission:
        next_token(cv);
        parse_color3(cv);
        return true;
    case KW_scattering:
        next_token(cv);
        parse_scattering(cv);
        return true;
    case KW_density:
        next_token(cv);
        parse_density_block(cv);
        return true;
    default:
        return accept_value(cv, VALUE_DENSITY) || parse_move(cv, &move);
    }
}

const MediaNode *parse_media_block(Converter *cv) {
    MediaNode *node = ARENA_NEW(cv->arena, MediaNode);
    node->loc = keep_place(cv, peek_token(cv));
    expect(cv, '{', "media");
    accept_value(cv, VALUE_MEDIA);
    while (parse_media_item(cv)) {
    }
    expect(cv, '}', "media");
    return node;
}

void parse_material_block(Converter *cv, MaterialNode *material) {
    const Token *start = peek_token(cv);
    expect(cv, '{', "material");
    const Value *value = accept_value(cv, VALUE_MATERIAL);
    if (value) {
        const MaterialNode *named = value->node;
        if (named->texture)
            material->texture = texture_layer(cv, named->texture, material->texture, start);
        if (named->interior_texture)
            material->interior_texture =
                texture_layer(cv, named->interior_texture, material->interior_texture, start);
        if (named->interior)
            material->interior = named->interior;
    }
    for (;;) {
        Move move;
        const Token *token = peek_token(cv);
        if (accept(cv, KW_texture))
            material->texture =
                texture_layer(cv, parse_texture_block(cv), material->texture, token);
        else if (accept(cv, KW_interior_texture))
            material->interior_texture =
                texture_layer(cv, parse_texture_block(cv), material->interior_texture, token);
        else if (accept(cv, KW_interior))
            material->interior = parse_interior_block(cv, material->interior);
        else if (parse_move(cv, &move))
            material->texture = texture_moved(cv, material->texture, &move);
        else
            break;
    }
    expect(cv, '}', "material");
}
