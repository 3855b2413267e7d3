// SPDX-License-Identifier: MIT
// What stands right behind a pattern's keyword (facts: sdl 4.6): numbers and vectors, images,
// functions, objects, and the items of list patterns.
#include "converter/nodes.h"

#include <math.h>

static double optional_float(Converter *cv) {
    optional_comma(cv);
    return starts_expression(cv) ? parse_float(cv) : 0;
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

// [, F, F]: a range; an empty one counts as none.
static void parse_range(Converter *cv, double *low, double *high) {
    Loc loc = here(cv);
    *low = optional_float(cv);
    *high = optional_float(cv);
    if (*low == *high && *high != 0)
        warn_at(&loc, "the range is empty and does not count");
}

// slope V | slope { [point_at] V [, F, F] [altitude V [, F, F]] }
static void parse_slope_items(Converter *cv, SlopeShape *slope) {
    if (!accept(cv, '{')) {
        slope->slope = parse_vector(cv);
        return;
    }
    slope->point_at = accept(cv, KW_point_at);
    slope->slope = parse_vector(cv);
    parse_range(cv, &slope->low, &slope->high);
    Loc loc = here(cv);
    if (accept(cv, KW_altitude)) {
        if (slope->point_at)
            die_at(&loc, "'altitude' cannot be used with 'point_at'");
        slope->altitude = parse_vector(cv);
        parse_range(cv, &slope->altitude_low, &slope->altitude_high);
    }
    expect(cv, '}', "slope");
}

static void parse_slope(Converter *cv, PatternNode *pattern) {
    SlopeShape *slope = &pattern->shape.slope;
    Loc loc = here(cv);
    parse_slope_items(cv, slope);
    if (slope->point_at)
        return; // its vector is a place
    double steep = vec_length(slope->slope), high = vec_length(slope->altitude);
    if (!(steep + high > 0) || !isfinite(steep + high))
        die_at(&loc, "neither the slope nor the altitude has a length");
    if (steep != 0)
        slope->slope = vec_normalize(slope->slope);
    if (high != 0)
        slope->altitude = vec_normalize(slope->altitude);
    slope->share = steep / (float)(steep + high);
}

static int parse_iterations(Converter *cv) {
    Loc loc = here(cv);
    double count = parse_float(cv);
    if (!(count < FRACTAL_MAX_ITERATIONS + 1))
        die_at(&loc, "more than %d iterations", FRACTAL_MAX_ITERATIONS);
    return count > 0 ? (int)count : 0;
}

// julia UV, F | mandel F; magnet F comes before either of them.
static void parse_fractal(Converter *cv, PatternNode *pattern) {
    FractalShape *fractal = &pattern->shape.fractal;
    int keyword = pattern->info->keyword;
    if (keyword == KW_magnet) {
        Loc loc = here(cv);
        double magnet = parse_float(cv);
        if (!(magnet >= 1 && magnet < 3))
            die_at(&loc, "%g is no magnet: 1 and 2 are", magnet);
        fractal->magnet = (int)magnet;
        if (!next_is(cv, KW_julia) && !next_is(cv, KW_mandel))
            die_expected(cv, "'mandel' or 'julia' after magnet");
        keyword = next_token(cv)->code;
    }
    fractal->julia = keyword == KW_julia;
    if (fractal->julia) {
        fractal->c = parse_uv(cv);
        optional_comma(cv);
    }
    fractal->iterations = parse_iterations(cv);
}

// object { OBJECT transforms items }
static void parse_object_pattern(Converter *cv, PatternUse use, PatternNode *pattern) {
    expect(cv, '{', "object pattern");
    ObjectNode *object = parse_object(cv);
    if (!object)
        die_expected(cv, "an object");
    Move move;
    while (parse_move(cv, &move))
        object_move(cv, object, &move);
    pattern->object = object;
    pattern->map = parse_pattern_list(cv, use, pattern->info);
    expect(cv, '}', "object pattern");
}

// material_map { IMAGE options texture{}+ }
static void parse_material_map(Converter *cv, PatternNode *pattern) {
    ARRAY(const TextureNode *) textures = {0};
    Picture picture;
    expect(cv, '{', "material_map");
    parse_image(cv, &picture, false, PICTURE_POT);
    parse_image_options(cv, &picture, KW_material_map, NULL);
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
        if (i == 0) {
            if (!items[1].node)
                die_expected(cv, "'texture' (First texture missing from tiles)");
            expect(cv, KW_tile2, "tiles");
        }
        while (accept(cv, KW_texture))
            items[i].node = texture_layer(cv, parse_texture_block(cv), items[i].node, NULL);
    }
    if (!items[0].node)
        items[0].node = cv->nodes->default_texture;
    expect(cv, '}', "tiles");
    pattern->map = map_create(cv, MAP_TEXTURE, items, 2);
}

static void parse_function_pattern(Converter *cv, PatternNode *pattern) {
    Loc loc = here(cv);
    pattern->function = parse_function(cv);
    if (user_function_parameters(cv, pattern->function) != 3 ||
        user_function_width(cv, pattern->function) != 1)
        die_at(&loc, "the function of a pattern takes three numbers and gives one");
}

static void parse_body_pattern(Converter *cv, PatternUse use, PatternNode *pattern) {
    switch (pattern->info->keyword) {
    case KW_function:
        parse_function_pattern(cv, pattern);
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
        pattern->pigment = parse_pigment_block(cv, cv->nodes->default_texture->pigment);
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
        pattern->density = parse_required_file(cv, FILE_DENSITY);
        break;
    case KW_gradient:
        parse_gradient(cv, pattern);
        break;
    case KW_julia:
    case KW_magnet:
    case KW_mandel:
        parse_fractal(cv, pattern);
        break;
    case KW_slope:
        parse_slope(cv, pattern);
        break;
    case KW_spiral1:
    case KW_spiral2:
        parse_arms(cv, pattern);
        break;
    case KW_tiling:
        number_within(cv, "tiling number", 1, 27);
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
