// SPDX-License-Identifier: MIT
// finish{} (facts: sdl 4.7, rendering 4.4). Values are floats, as POV-Ray keeps them.
#include "converter/nodes.h"

#include <math.h>

// Which values are albedos: they are scaled at the end of the block, when brilliance, phong_size
// and roughness are known.
typedef struct {
    bool diffuse, phong, specular;
} Albedo;

static float number(Converter *cv) { return (float)parse_float(cv); }

static float optional_number(Converter *cv, float otherwise) {
    return starts_expression(cv) ? number(cv) : otherwise;
}

// { C3 [C3] { fresnel B | falloff F | exponent F | metallic [F] }* }
static void parse_reflection_block(Converter *cv, Finish *finish) {
    finish->reflection_max = parse_color3(cv);
    finish->reflection_min = finish->reflection_max;
    bool one = true;
    optional_comma(cv);
    if (starts_color(cv) || starts_expression(cv)) {
        finish->reflection_max = parse_color3(cv);
        one = false;
    }
    for (;;) {
        if (accept(cv, KW_fresnel)) {
            finish->reflection_fresnel = parse_optional_bool(cv);
            if (one && finish->reflection_fresnel)
                finish->reflection_min = rgb(0, 0, 0);
        } else if (accept(cv, KW_falloff)) {
            finish->reflection_falloff = number(cv);
        } else if (accept(cv, KW_exponent)) {
            finish->reflection_exponent = number(cv);
        } else if (accept(cv, KW_metallic)) {
            finish->reflection_metallic = optional_number(cv, 1);
        } else {
            break;
        }
    }
    expect(cv, '}', "reflection");
}

static void parse_reflection(Converter *cv, Finish *finish) {
    if (accept(cv, '{')) {
        parse_reflection_block(cv, finish);
        return;
    }
    finish->reflection_max = finish->reflection_min = parse_color3(cv);
}

// irid { F { thickness F | turbulence F }* }
static void parse_irid(Converter *cv, Finish *finish) {
    expect(cv, '{', "irid");
    finish->irid = number(cv);
    for (;;) {
        if (accept(cv, KW_thickness))
            finish->irid_thickness = number(cv);
        else if (accept(cv, KW_turbulence))
            finish->irid_turbulence = (float)parse_vector(cv).x;
        else
            break;
    }
    expect(cv, '}', "irid");
}

static void parse_subsurface(Converter *cv, FinishNode *node, const Token *token) {
    expect(cv, '{', "subsurface");
    while (accept(cv, KW_translucency) || accept(cv, KW_anisotropy))
        parse_color3(cv);
    expect(cv, '}', "subsurface");
    note_gap(cv, &node->gaps, token,
             "subsurface is not modelled: no light is scattered below the surface");
}

static bool accept_albedo(Converter *cv) { // once is enough
    bool any = false;
    while (accept(cv, KW_albedo))
        any = true;
    return any;
}

static bool parse_strength(Converter *cv, Finish *finish, Albedo *albedo, int code) {
    switch (code) {
    case KW_diffuse:
        next_token(cv);
        albedo->diffuse = accept_albedo(cv);
        finish->diffuse = number(cv);
        optional_comma(cv);
        finish->diffuse_back = optional_number(cv, 0);
        return true;
    case KW_phong:
        next_token(cv);
        albedo->phong = accept_albedo(cv);
        finish->phong = number(cv);
        return true;
    case KW_specular:
        next_token(cv);
        albedo->specular = accept_albedo(cv);
        finish->specular = number(cv);
        return true;
    default:
        return false;
    }
}

static void warn_rough(Converter *cv, const Token *token, float roughness) {
    if (roughness != 0.0F)
        return;
    Loc loc = token_loc(cv, token);
    warn_at(&loc, "a roughness of 0: the highlight covers all that is lit");
}

static bool parse_number(Converter *cv, FinishNode *node, int code) {
    Finish *finish = &node->finish;
    if (code == KW_reflection_exponent) {
        next_token(cv);
        finish->reflection_exponent = number(cv);
        return true;
    }
    float *to = NULL;
    switch (code) {
    case KW_brilliance:
        to = &finish->brilliance;
        break;
    case KW_phong_size:
        to = &finish->phong_size;
        break;
    case KW_roughness:
        to = &finish->roughness;
        break;
    case KW_crand:
        to = &finish->crand;
        break;
    case KW_ior:
        to = &node->ior;
        break;
    case KW_refraction:
        to = &node->refraction;
        break;
    case KW_caustics:
        to = &node->caustics;
        break;
    default:
        return false;
    }
    const Token *token = next_token(cv);
    *to = number(cv);
    if (code == KW_roughness)
        warn_rough(cv, token, finish->roughness);
    return true;
}

static bool parse_item(Converter *cv, FinishNode *node, Albedo *albedo) {
    const Token *token = peek_token(cv);
    Finish *finish = &node->finish;
    if (parse_strength(cv, finish, albedo, token->code) || parse_number(cv, node, token->code))
        return true;
    switch (token->code) {
    case KW_ambient:
        next_token(cv);
        finish->ambient = parse_color3(cv);
        return true;
    case KW_emission:
        next_token(cv);
        finish->emission = parse_color3(cv);
        return true;
    case KW_metallic:
        next_token(cv);
        finish->metallic = optional_number(cv, 1);
        return true;
    case KW_conserve_energy:
        next_token(cv);
        finish->conserve_energy = true;
        return true;
    case KW_reflection:
        next_token(cv);
        parse_reflection(cv, finish);
        return true;
    case KW_irid:
        next_token(cv);
        parse_irid(cv, finish);
        return true;
    case KW_subsurface:
        next_token(cv);
        parse_subsurface(cv, node, token);
        return true;
    default:
        return false;
    }
}

static void apply_albedo(Finish *finish, const Albedo *albedo) {
    if (albedo->diffuse) {
        double factor = (finish->brilliance + 1.0) / 2.0;
        finish->diffuse = (float)(finish->diffuse * factor);
        finish->diffuse_back = (float)(finish->diffuse_back * factor);
    }
    if (albedo->phong)
        finish->phong = (float)(finish->phong * (finish->phong_size + 1.0) / 2.0);
    if (albedo->specular) {
        double n = finish->roughness != 0.0F ? 1.0 / finish->roughness : 0.0;
        finish->specular =
            (float)(finish->specular * (n + 2.0) / (4.0 * (2.0 - pow(2.0, -n / 2.0))));
    }
}

const FinishNode *parse_finish_block(Converter *cv, const FinishNode *base) {
    expect(cv, '{', "finish");
    const Value *value = accept_value(cv, VALUE_FINISH);
    FinishNode node = value ? *(const FinishNode *)value->node : *base;
    Albedo albedo = {0};
    while (parse_item(cv, &node, &albedo)) {
    }
    expect(cv, '}', "finish");
    apply_albedo(&node.finish, &albedo);
    return arena_copy(cv->arena, &node, sizeof node);
}
