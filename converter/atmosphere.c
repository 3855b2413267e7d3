// SPDX-License-Identifier: MIT
// fog, rainbow, sky_sphere (facts: sdl 4.11, rendering 6).
#include "converter/nodes.h"

#include <math.h>

static bool parse_fog_item(Converter *cv, double *distance) {
    Move move;
    switch (peek_token(cv)->code) {
    case KW_distance:
        next_token(cv);
        *distance = parse_float(cv);
        return true;
    case KW_fog_type:
    case KW_fog_alt:
    case KW_fog_offset:
    case KW_turb_depth:
    case KW_octaves:
    case KW_omega:
    case KW_lambda:
        next_token(cv);
        parse_float(cv);
        return true;
    case KW_up:
    case KW_turbulence:
        next_token(cv);
        parse_vector(cv);
        return true;
    default:
        break;
    }
    if (starts_color(cv)) {
        parse_color(cv);
        return true;
    }
    if (starts_expression(cv)) { // old: the distance without its keyword
        *distance = parse_float(cv);
        return true;
    }
    return parse_move(cv, &move) || accept(cv, ',');
}

// A fog of distance 0 does nothing: its place stays unset.
const AtmosphereNode *parse_fog_block(Converter *cv) {
    AtmosphereNode *node = ARENA_NEW(cv->arena, AtmosphereNode);
    const Token *token = peek_token(cv);
    expect(cv, '{', "fog");
    const Value *value = accept_value(cv, VALUE_FOG);
    double distance = value && ((const AtmosphereNode *)value->node)->loc ? 1.0 : 0.0;
    while (parse_fog_item(cv, &distance)) {
    }
    expect(cv, '}', "fog");
    node->loc = fabs(distance) > 0.0 ? keep_place(cv, token) : NULL;
    return node;
}

static bool parse_rainbow_item(Converter *cv) {
    switch (peek_token(cv)->code) {
    case KW_direction:
    case KW_up:
        next_token(cv);
        parse_vector(cv);
        return true;
    case KW_angle:
    case KW_width:
    case KW_distance:
    case KW_jitter:
    case KW_falloff_angle:
    case KW_arc_angle:
        next_token(cv);
        parse_float(cv);
        return true;
    case KW_color_map:
    case KW_colour_map:
        next_token(cv);
        parse_map(cv, MAP_COLOR, false);
        return true;
    default:
        return accept(cv, ',');
    }
}

const AtmosphereNode *parse_rainbow_block(Converter *cv) {
    AtmosphereNode *node = ARENA_NEW(cv->arena, AtmosphereNode);
    node->loc = keep_place(cv, peek_token(cv));
    expect(cv, '{', "rainbow");
    accept_value(cv, VALUE_RAINBOW);
    while (parse_rainbow_item(cv)) {
    }
    expect(cv, '}', "rainbow");
    return node;
}

// { [ID] { pigment{} | emission C3 | transforms }+ }: later pigments lie above.
const SkySphereNode *parse_sky_sphere_block(Converter *cv) {
    SkySphereNode *node = ARENA_NEW(cv->arena, SkySphereNode);
    *node = (SkySphereNode){.emission = rgb(1, 1, 1), .transform = transform_identity()};
    expect(cv, '{', "sky_sphere");
    const Value *value = accept_value(cv, VALUE_SKY_SPHERE);
    if (value)
        *node = *(const SkySphereNode *)value->node;
    for (;;) {
        Move move;
        if (accept(cv, KW_pigment)) {
            PigmentList *top = ARENA_NEW(cv->arena, PigmentList);
            top->pigment = parse_pigment_block(cv, cv->nodes->default_texture->pigment);
            top->next = node->top;
            node->top = top;
        } else if (accept(cv, KW_emission)) {
            node->emission = parse_color3(cv);
        } else if (parse_move(cv, &move)) {
            node->transform = transform_compose(&node->transform, &move.t);
        } else {
            break;
        }
    }
    if (!node->top)
        die_expected(cv, "'pigment' in 'sky_sphere'");
    expect(cv, '}', "sky_sphere");
    return node;
}
