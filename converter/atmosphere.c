// SPDX-License-Identifier: MIT
// fog, rainbow, sky_sphere (facts: sdl 4.11, rendering 6).
#include "converter/nodes.h"

#include <math.h>

// ---- fog ----------------------------------------------------------------------------------------

static bool parse_fog_number(Converter *cv, Fog *fog, int code) {
    switch (code) {
    case KW_distance:
        next_token(cv);
        fog->distance = parse_float(cv);
        return true;
    case KW_fog_type: // of what is neither 1 nor 2 POV-Ray makes 1
        next_token(cv);
        fog->type = (int)fmax(0.0, fmin(parse_float(cv), 9.0)) == 2 ? FOG_GROUND : FOG_CONSTANT;
        return true;
    case KW_fog_alt:
        next_token(cv);
        fog->alt = parse_float(cv);
        return true;
    case KW_fog_offset:
        next_token(cv);
        fog->offset = parse_float(cv);
        return true;
    case KW_turb_depth:
        next_token(cv);
        fog->turb_depth = (float)parse_float(cv);
        return true;
    default:
        return false;
    }
}

static bool parse_fog_turbulence(Converter *cv, Fog *fog, int code) {
    Turbulence *turbulence = &fog->turbulence;
    switch (code) {
    case KW_turbulence:
        next_token(cv);
        turbulence->amount = parse_vector(cv);
        break;
    case KW_octaves:
        next_token(cv);
        turbulence->octaves = (int)fmax(1.0, fmin(parse_float(cv), 10.0));
        break;
    case KW_omega:
        next_token(cv);
        turbulence->omega = (float)parse_float(cv);
        break;
    case KW_lambda:
        next_token(cv);
        turbulence->lambda = (float)parse_float(cv);
        break;
    default:
        return false;
    }
    fog->has_turbulence = true;
    return true;
}

// C | distance F | fog_type F | fog_alt F | fog_offset F | up V | turbulence V | turb_depth F |
// octaves F | omega F | lambda F | transforms, which turn up | F
static bool parse_fog_item(Converter *cv, Fog *fog) {
    Move move;
    const Token *token = peek_token(cv);
    if (parse_fog_number(cv, fog, token->code) || parse_fog_turbulence(cv, fog, token->code))
        return true;
    if (accept(cv, KW_up)) {
        fog->up = parse_vector(cv);
        return true;
    }
    if (starts_color(cv)) {
        fog->color = parse_color(cv);
        return true;
    }
    if (starts_expression(cv)) { // old: the distance without its keyword
        fog->distance = parse_float(cv);
        return true;
    }
    if (!parse_move(cv, &move))
        return false;
    Loc loc = token_loc(cv, token);
    if (move.kind == MOVE_TRANSLATE)
        warn_at(&loc, "the up vector of a fog cannot be translated");
    else
        fog->up = transform_dir(&move.t, fog->up);
    return true;
}

static Vec3 unit_or_zero(Vec3 v) { return vec_length(v) > 0.0 ? vec_normalize(v) : v; }

FogNode *parse_fog_block(Converter *cv) {
    FogNode *node = ARENA_NEW(cv->arena, FogNode);
    expect(cv, '{', "fog");
    const Value *value = accept_value(cv, VALUE_FOG);
    node->fog = value ? ((const FogNode *)value->node)->fog : fog_default();
    while (parse_fog_item(cv, &node->fog)) {
    }
    expect(cv, '}', "fog");
    node->fog.up = unit_or_zero(node->fog.up);
    return node;
}

// ---- rainbow ------------------------------------------------------------------------------------

// The bow's colours are looked up as by a gradient along x.
static const PatternNode *bow_pigment(Converter *cv, const MapNode *map) {
    PatternNode pigment = pattern_node_default();
    pigment.info = pattern_find(KW_gradient);
    pigment.shape.gradient = vec3(1, 0, 0);
    pigment.map = map;
    return arena_copy(cv->arena, &pigment, sizeof pigment);
}

static double parse_bow_angle(Converter *cv, const Token *token) {
    double angle = parse_float(cv);
    Loc loc = token_loc(cv, token);
    if (!(angle >= 0.0 && angle <= 360.0))
        die_at(&loc, "the %s of a rainbow is 0 to 360 degrees, not %g", token->text, angle);
    return angle;
}

static bool parse_rainbow_number(Converter *cv, Rainbow *bow, const Token *token) {
    switch (token->code) {
    case KW_angle:
        next_token(cv);
        bow->angle_deg = parse_float(cv);
        return true;
    case KW_width:
        next_token(cv);
        bow->width_deg = parse_float(cv);
        return true;
    case KW_distance:
        next_token(cv);
        bow->distance = parse_float(cv);
        return true;
    case KW_jitter:
        next_token(cv);
        bow->jitter = parse_float(cv);
        return true;
    case KW_falloff_angle:
        next_token(cv);
        bow->falloff_deg = parse_bow_angle(cv, token);
        return true;
    case KW_arc_angle:
        next_token(cv);
        bow->arc_deg = parse_bow_angle(cv, token);
        return true;
    default:
        return false;
    }
}

static bool parse_rainbow_item(Converter *cv, RainbowNode *node) {
    const Token *token = peek_token(cv);
    if (parse_rainbow_number(cv, &node->rainbow, token))
        return true;
    switch (token->code) {
    case KW_direction:
        next_token(cv);
        node->rainbow.direction = parse_vector(cv);
        return true;
    case KW_up:
        next_token(cv);
        node->rainbow.up = parse_vector(cv);
        return true;
    case KW_color_map:
    case KW_colour_map:
        next_token(cv);
        node->pigment = bow_pigment(cv, parse_map(cv, MAP_COLOR, false));
        return true;
    default:
        return false;
    }
}

// The three directions of the bow from the two that were written.
static void turn_rainbow(Rainbow *bow, const Loc *loc) {
    const double near_zero = 1e-10; // POV-Ray's
    if (vec_dot(bow->direction, bow->direction) < near_zero)
        die_at(loc, "the direction of a rainbow must be given and not be 0");
    if (vec_dot(bow->up, bow->up) < near_zero)
        die_at(loc, "the up vector of a rainbow must not be 0");
    bow->direction = vec_normalize(bow->direction);
    bow->up = vec_normalize(bow->up);
    if (fabs(1.0 - fabs(vec_dot(bow->up, bow->direction))) < near_zero)
        die_at(loc, "the up vector of a rainbow must not point along its direction");
    Vec3 right = vec_cross(bow->up, bow->direction);
    bow->up = vec_normalize(vec_cross(bow->direction, right));
    bow->right = vec_normalize(right);
}

RainbowNode *parse_rainbow_block(Converter *cv) {
    RainbowNode *node = ARENA_NEW(cv->arena, RainbowNode);
    Rainbow *bow = &node->rainbow;
    Loc loc = here(cv);
    expect(cv, '{', "rainbow");
    const Value *value = accept_value(cv, VALUE_RAINBOW);
    if (value)
        *node = *(const RainbowNode *)value->node;
    else
        *bow = rainbow_default();
    bool falls_off = false;
    for (;;) {
        falls_off = falls_off || next_is(cv, KW_falloff_angle);
        if (!parse_rainbow_item(cv, node))
            break;
    }
    expect(cv, '}', "rainbow");
    if (!falls_off && bow->arc_deg != RAINBOW_ALL_AROUND)
        bow->falloff_deg = bow->arc_deg;
    if (bow->arc_deg != RAINBOW_ALL_AROUND && bow->arc_deg < bow->falloff_deg)
        die_at(&loc, "the arc_angle of a rainbow is smaller than its falloff_angle");
    turn_rainbow(bow, &loc);
    return node;
}

// ---- sky_sphere ---------------------------------------------------------------------------------

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
