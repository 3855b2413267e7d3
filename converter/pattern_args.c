// SPDX-License-Identifier: MIT
// What stands right behind a pattern's keyword (facts: sdl 4.6): numbers and vectors, images,
// functions, objects, and the items of list patterns.
#include "converter/nodes.h"

#include <math.h>

static void optional_float(Converter *cv) {
    optional_comma(cv);
    if (starts_expression(cv))
        parse_float(cv);
}

static void parse_gradient(Converter *cv, PatternNode *pattern) {
    Loc loc = here(cv);
    Vec3 v = parse_vector(cv);
    double length = vec_length(v);
    if (!(length > 0.0) || !isfinite(length))
        die_at(&loc, "the direction of a gradient must have a length");
    pattern->shape.gradient = vec_normalize(v);
}

// POV-Ray keeps the number of arms as a short.
static void parse_arms(Converter *cv, PatternNode *pattern) {
    Loc loc = here(cv);
    double arms = parse_float(cv);
    if (!(arms > INT16_MIN - 1 && arms < INT16_MAX + 1))
        die_at(&loc, "%g is no number of arms", arms);
    pattern->shape.arms = (int)arms;
}

// slope V | slope { [point_at] V [, F, F] [altitude V [, F, F]] }
static void parse_slope(Converter *cv) {
    if (!accept(cv, '{')) {
        parse_vector(cv);
        return;
    }
    accept(cv, KW_point_at);
    parse_vector(cv);
    optional_float(cv);
    optional_float(cv);
    if (accept(cv, KW_altitude)) {
        parse_vector(cv);
        optional_float(cv);
        optional_float(cv);
    }
    expect(cv, '}', "slope");
}

// julia UV, F | mandel F; magnet F comes before either of them.
static void parse_fractal(Converter *cv, int keyword) {
    if (keyword == KW_magnet) {
        parse_float(cv);
        if (!next_is(cv, KW_julia) && !next_is(cv, KW_mandel))
            die_expected(cv, "'mandel' or 'julia' after magnet");
        keyword = next_token(cv)->code;
    }
    if (keyword == KW_julia) {
        parse_uv(cv);
        optional_comma(cv);
    }
    parse_float(cv);
}

// object { OBJECT items }
static void parse_object_pattern(Converter *cv, PatternUse use, PatternNode *pattern) {
    expect(cv, '{', "object pattern");
    if (!parse_object(cv))
        die_expected(cv, "an object");
    pattern->map = parse_pattern_list(cv, use, pattern->info);
    expect(cv, '}', "object pattern");
}

// material_map { IMAGE options texture{}+ }
static void parse_material_map(Converter *cv, PatternNode *pattern) {
    ARRAY(const TextureNode *) textures = {0};
    Picture picture;
    expect(cv, '{', "material_map");
    parse_image(cv, &picture, false);
    parse_image_options(cv, &picture, NULL);
    picture.use = USE_PICTURE_INDEX;
    while (accept(cv, KW_texture)) {
        const TextureNode *texture = parse_texture_block(cv);
        array_push(&textures, texture);
    }
    if (textures.count == 0)
        die_expected(cv, "'texture'");
    expect(cv, '}', "material_map");
    MapItem *items = ARENA_ARRAY(cv->arena, MapItem, textures.count);
    for (size_t i = 0; i < textures.count; i++)
        items[i].node = textures.items[i];
    pattern->map = map_create(cv, MAP_TEXTURE, items, (uint32_t)textures.count);
    array_free(&textures);
    pattern->picture = arena_copy(cv->arena, &picture, sizeof picture);
}

// tiles { texture{} tile2 texture{} }: a checker whose first texture stands at 1.
static void parse_tiles(Converter *cv, PatternNode *pattern) {
    MapItem *items = ARENA_ARRAY(cv->arena, MapItem, 2);
    expect(cv, '{', "tiles");
    for (int i = 1; i >= 0; i--) {
        items[i].value = (float)i;
        if (i == 0)
            expect(cv, KW_tile2, "tiles");
        while (accept(cv, KW_texture))
            items[i].node = texture_layer(cv, parse_texture_block(cv), items[i].node, NULL);
        if (!items[i].node)
            items[i].node = cv->nodes->default_texture;
    }
    expect(cv, '}', "tiles");
    pattern->map = map_create(cv, MAP_TEXTURE, items, 2);
}

static void parse_body_pattern(Converter *cv, PatternUse use, PatternNode *pattern) {
    switch (pattern->info->keyword) {
    case KW_function:
        parse_function(cv);
        break;
    case KW_image_map:
    case KW_bump_map:
    case KW_image_pattern:
        pattern->picture = parse_image_block(cv, pattern->info->keyword, &pattern->amount);
        break;
    case KW_material_map:
        parse_material_map(cv, pattern);
        break;
    case KW_object:
        parse_object_pattern(cv, use, pattern);
        break;
    case KW_pigment_pattern:
        parse_pigment_block(cv, cv->nodes->default_texture->pigment);
        break;
    case KW_tiles:
        parse_tiles(cv, pattern);
        break;
    default:
        break;
    }
}

static void parse_number_pattern(Converter *cv, PatternNode *pattern) {
    switch (pattern->info->keyword) {
    case KW_density_file:
        expect(cv, KW_df3, "density_file");
        parse_required_file(cv, FILE_DENSITY);
        break;
    case KW_gradient:
        parse_gradient(cv, pattern);
        break;
    case KW_julia:
    case KW_magnet:
    case KW_mandel:
        parse_fractal(cv, pattern->info->keyword);
        break;
    case KW_slope:
        parse_slope(cv);
        break;
    case KW_spiral1:
    case KW_spiral2:
        parse_arms(cv, pattern);
        break;
    case KW_tiling:
        parse_float(cv);
        break;
    default:
        break;
    }
}

// In a normal a number is the depth; it may stand before and after the items of a list.
static void parse_depth(Converter *cv, PatternUse use, PatternNode *pattern) {
    if (use != USE_NORMAL)
        return;
    optional_comma(cv);
    if (starts_expression(cv))
        pattern->amount = (float)parse_float(cv);
}

void parse_pattern_arguments(Converter *cv, PatternUse use, PatternNode *pattern) {
    parse_number_pattern(cv, pattern);
    parse_body_pattern(cv, use, pattern);
    parse_depth(cv, use, pattern);
    if (pattern->info->list && pattern->info->keyword != KW_object) {
        pattern->map = parse_pattern_list(cv, use, pattern->info);
        parse_depth(cv, use, pattern);
    }
}
