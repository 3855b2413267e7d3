// SPDX-License-Identifier: MIT
// The contents of pigment{}, normal{}, density{} and of a patterned texture{}: one pattern, then
// modifiers in any order (facts: sdl 4.6, textures 1.2, 1.6). A pattern keyword changes only the
// kind and the few fields that belong to it; everything else stays as the base had it.
#include "converter/nodes.h"

#include <string.h>

#define OTHER PATTERN_MODELLED

static const PatternInfo patterns[] = {
    {.keyword = 0, .type = PATTERN_PLAIN}, // no pattern: black
    {.keyword = KW_color, .type = PATTERN_PLAIN},
    {.keyword = KW_agate, .type = PATTERN_AGATE},
    {.keyword = KW_aoi, .type = PATTERN_AOI},
    {.keyword = KW_average, .type = PATTERN_AVERAGE},
    {.keyword = KW_boxed, .type = PATTERN_BOXED},
    {.keyword = KW_bozo, .type = PATTERN_BOZO},
    {.keyword = KW_brick, .type = PATTERN_BRICK, .list = 2, .still = true},
    {.keyword = KW_bump_map, .type = PATTERN_BUMP_MAP, .still = true},
    {.keyword = KW_bumps, .type = PATTERN_BOZO},
    {.keyword = KW_cells, .type = PATTERN_CELLS},
    {.keyword = KW_checker, .type = PATTERN_CHECKER, .list = 2, .still = true},
    {.keyword = KW_crackle, .type = PATTERN_CRACKLE},
    {.keyword = KW_cubic, .type = PATTERN_CUBIC, .list = 6, .still = true},
    {.keyword = KW_cylindrical, .type = PATTERN_CYLINDRICAL},
    {.keyword = KW_density_file, .type = PATTERN_DENSITY},
    {.keyword = KW_dents, .type = PATTERN_DENTS},
    {.keyword = KW_facets, .type = PATTERN_FACETS},
    {.keyword = KW_function, .type = PATTERN_FUNCTION},
    {.keyword = KW_gradient, .type = PATTERN_GRADIENT},
    {.keyword = KW_granite, .type = PATTERN_GRANITE},
    {.keyword = KW_hexagon, .type = PATTERN_HEXAGON, .list = 3, .still = true},
    {.keyword = KW_image_map, .type = PATTERN_IMAGE_MAP, .still = true},
    {.keyword = KW_image_pattern, .type = PATTERN_IMAGE, .still = true},
    {.keyword = KW_julia, .type = PATTERN_FRACTAL},
    {.keyword = KW_leopard, .type = PATTERN_LEOPARD},
    {.keyword = KW_magnet, .type = PATTERN_FRACTAL},
    {.keyword = KW_mandel, .type = PATTERN_FRACTAL},
    {.keyword = KW_marble, .type = PATTERN_MARBLE, .triangle = true},
    {.keyword = KW_material_map, .type = PATTERN_MATERIAL_MAP, .still = true},
    {.keyword = KW_object, .type = PATTERN_OBJECT, .list = 2, .still = true},
    {.keyword = KW_onion, .type = PATTERN_ONION},
    {.keyword = KW_pavement, .type = OTHER},
    {.keyword = KW_pigment_pattern, .type = PATTERN_PIGMENT},
    {.keyword = KW_planar, .type = PATTERN_PLANAR},
    {.keyword = KW_quilted, .type = PATTERN_QUILTED, .still = true},
    {.keyword = KW_radial, .type = PATTERN_RADIAL},
    {.keyword = KW_ripples, .type = PATTERN_RIPPLES},
    {.keyword = KW_slope, .type = PATTERN_SLOPE},
    {.keyword = KW_spherical, .type = PATTERN_SPHERICAL},
    {.keyword = KW_spiral1, .type = PATTERN_SPIRAL1, .triangle = true},
    {.keyword = KW_spiral2, .type = PATTERN_SPIRAL2, .triangle = true},
    {.keyword = KW_spotted, .type = PATTERN_BOZO},
    {.keyword = KW_square, .type = PATTERN_SQUARE, .list = 4, .still = true},
    {.keyword = KW_tiles, .type = PATTERN_CHECKER, .still = true},
    {.keyword = KW_tiling, .type = OTHER},
    {.keyword = KW_triangular, .type = PATTERN_TRIANGULAR, .list = 6, .still = true},
    {.keyword = KW_uv_mapping, .type = OTHER},
    {.keyword = KW_waves, .type = PATTERN_WAVES},
    {.keyword = KW_wood, .type = PATTERN_WOOD, .triangle = true},
    {.keyword = KW_wrinkles, .type = PATTERN_WRINKLES},
};

const PatternInfo *pattern_find(int keyword) {
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++)
        if (patterns[i].keyword == keyword)
            return &patterns[i];
    return NULL;
}

static const char *use_name(PatternUse use) {
    static const char *const names[] = {"pigment", "normal", "texture", "density"};
    return names[use];
}

PatternNode pattern_node_default(void) {
    return (PatternNode){
        .info = pattern_find(0), .shape = pattern_default(), .amount = 0.5F, .accuracy = 0.02F};
}

static bool pattern_fits(PatternUse use, int keyword) {
    switch (keyword) {
    case 0:
    case KW_color:
        return false; // no keywords of patterns
    case KW_image_map:
        return use == USE_PIGMENT;
    case KW_bump_map:
    case KW_facets:
        return use == USE_NORMAL;
    case KW_material_map:
    case KW_tiles:
        return use == USE_TEXTURE;
    default:
        return true;
    }
}

// uv_mapping: the rest of the block is one inner item, evaluated at (u, v, 0); the transforms of
// the outer one no longer count (facts: textures 1.5).
static void parse_uv_mapping(Converter *cv, PatternUse use, PatternNode *pattern) {
    static const MapKind kinds[] = {MAP_PIGMENT, MAP_NORMAL, MAP_TEXTURE, MAP_DENSITY};
    const TextureNode *standard = cv->nodes->default_texture;
    MapItem *item = ARENA_NEW(cv->arena, MapItem);
    switch (use) {
    case USE_PIGMENT:
        item->node = parse_pigment_body(cv, standard->pigment);
        break;
    case USE_NORMAL:
        item->node = parse_normal_body(cv, standard->normal);
        break;
    case USE_TEXTURE:
        item->node = parse_texture_body(cv);
        break;
    case USE_DENSITY:
        item->node = parse_density_body(cv, NULL);
        break;
    }
    pattern->map = map_create(cv, kinds[use], item, 1);
}

static bool parse_wave(Converter *cv, PatternNode *pattern, int code) {
    switch (code) {
    case KW_ramp_wave:
        pattern->shape.wave = WAVE_RAMP;
        break;
    case KW_triangle_wave:
        pattern->shape.wave = WAVE_TRIANGLE;
        break;
    case KW_sine_wave:
        pattern->shape.wave = WAVE_SINE;
        break;
    case KW_scallop_wave:
        pattern->shape.wave = WAVE_SCALLOP;
        break;
    case KW_cubic_wave:
        pattern->shape.wave = WAVE_CUBIC;
        break;
    case KW_poly_wave:
        pattern->shape.wave = WAVE_POLY;
        break;
    default:
        return false;
    }
    next_token(cv);
    if (code == KW_poly_wave && starts_expression(cv))
        pattern->shape.exponent = (float)parse_float(cv);
    return true;
}

static bool map_fits(PatternUse use, MapKind kind) {
    switch (kind) {
    case MAP_COLOR:
        return use == USE_PIGMENT || use == USE_DENSITY;
    case MAP_PIGMENT:
        return use == USE_PIGMENT;
    case MAP_SLOPE:
    case MAP_NORMAL:
        return use == USE_NORMAL;
    case MAP_TEXTURE:
        return use == USE_TEXTURE;
    case MAP_DENSITY:
        return use == USE_DENSITY;
    }
    return false;
}

static bool parse_map_modifier(Converter *cv, PatternUse use, PatternNode *pattern) {
    const Token *token = peek_token(cv);
    MapKind kind;
    if (!map_keyword(token->code, &kind))
        return false;
    int keyword = pattern->info->keyword;
    Loc loc = here(cv);
    if (!map_fits(use, kind))
        die_at(&loc, "'%s' cannot be used in '%s'", token->text, use_name(use));
    if (pattern->info->list || keyword == KW_image_map || keyword == KW_color)
        die_at(&loc, "'%s' cannot be used with '%s'", token->text,
               keyword == KW_color ? "one colour" : keyword_name(keyword));
    next_token(cv);
    pattern->map = parse_map(cv, kind, keyword == KW_average);
    return true;
}

static bool parse_float_into(Converter *cv, float *value) {
    next_token(cv);
    *value = (float)parse_float(cv);
    return true;
}

// Members of single patterns, each after its keyword.
static bool parse_shape_modifier(Converter *cv, PatternNode *pattern, int code) {
    Pattern *shape = &pattern->shape;
    bool facets = pattern->info->type == PATTERN_FACETS;
    switch (code) {
    case KW_agate_turb:
        shape->has_turbulence = true;
        return parse_float_into(cv, &shape->agate_turb);
    case KW_mortar:
        return parse_float_into(cv, &shape->mortar);
    case KW_control0:
        return parse_float_into(cv, &shape->quilted[0]);
    case KW_control1:
        return parse_float_into(cv, &shape->quilted[1]);
    case KW_brick_size:
        next_token(cv);
        shape->brick_size = parse_vector(cv);
        return true;
    case KW_form:
        next_token(cv);
        if (pattern->info->keyword == KW_pavement)
            parse_pavement_number(cv, pattern, code);
        else
            shape->crackle.form = parse_vector(cv);
        return true;
    case KW_metric: // a vector, of which one component counts
        next_token(cv);
        *(facets ? &shape->facets.metric : &shape->crackle.metric) = parse_vector(cv).x;
        return true;
    case KW_coords:
        next_token(cv);
        shape->facets.coords = parse_float(cv);
        return true;
    case KW_size:
        next_token(cv);
        shape->facets.size = parse_float(cv);
        return true;
    case KW_offset:
        next_token(cv);
        shape->crackle.offset = parse_float(cv);
        return true;
    case KW_solid:
        next_token(cv);
        shape->crackle.solid = true;
        return true;
    default:
        return false;
    }
}

// What a fractal shows of a point: TYPE, FACTOR. pavement: TYPE.
static void parse_ground(Converter *cv, PatternNode *pattern, bool exterior) {
    FractalShape *fractal = &pattern->shape.fractal;
    Loc loc = here(cv);
    double type = parse_float(cv);
    int most = exterior ? 8 : 6;
    if (pattern->info->keyword == KW_pavement)
        return;
    if (!(type > -1 && type < most + 1))
        die_at(&loc, "%g is not one of the types 0 to %d", type, most);
    optional_comma(cv);
    *(exterior ? &fractal->exterior : &fractal->interior) = (int)type;
    *(exterior ? &fractal->exterior_factor : &fractal->interior_factor) = parse_float(cv);
}

static void parse_exponent(Converter *cv, PatternNode *pattern) {
    Loc loc = here(cv);
    double exponent = parse_float(cv);
    bool good = exponent >= 2 && exponent < FRACTAL_MAX_EXPONENT + 1;
    if (!good)
        warn_at(&loc, "%g is no exponent of a fractal (2 to %d): 2 is taken", exponent,
                FRACTAL_MAX_EXPONENT);
    pattern->shape.fractal.exponent = good ? (int)exponent : 2;
}

static void parse_density_interpolation(Converter *cv, PatternNode *pattern) {
    double between = parse_float(cv);
    pattern->shape.density_between = between > -1 && between < 1 ? 0 : between < 2 ? 1 : 2;
}

// Members of single patterns, each after its keyword.
static bool parse_number_modifier(Converter *cv, PatternNode *pattern, int code) {
    switch (code) {
    case KW_exponent:
        next_token(cv);
        parse_exponent(cv, pattern);
        return true;
    case KW_interpolate:
        next_token(cv);
        parse_density_interpolation(cv, pattern);
        return true;
    case KW_number_of_sides: // of pavement
    case KW_number_of_tiles:
    case KW_pattern:
        next_token(cv);
        parse_pavement_number(cv, pattern, code);
        return true;
    case KW_interior:
    case KW_exterior:
        next_token(cv);
        parse_ground(cv, pattern, code == KW_exterior);
        return true;
    default:
        return false;
    }
}

// Written twice, the numbers are joined bit by bit, as POV-Ray keeps them.
static void parse_noise_generator(Converter *cv, Pattern *shape) {
    Loc loc = here(cv);
    double number = parse_float(cv);
    if (!(number > -1 && number < 4))
        die_at(&loc, "noise_generator must be 0, 1, 2 or 3");
    shape->noise_generator |= (int)number;
}

static void parse_accuracy(Converter *cv, PatternNode *pattern) {
    Loc loc = here(cv);
    pattern->accuracy = (float)parse_float(cv);
    if (pattern->accuracy == 0)
        die_at(&loc, "the accuracy of a normal must not be 0");
}

void parse_quick_color(Converter *cv, PatternNode *pattern) {
    pattern->quick_color = parse_color(cv);
    Color q = pattern->quick_color;
    pattern->has_quick_color = q.r != -1.0F && q.g != -1.0F && q.b != -1.0F;
}

static bool parse_modifier(Converter *cv, PatternUse use, PatternNode *pattern) {
    Move move;
    int code = peek_token(cv)->code;
    switch (code) {
    case KW_warp:
        next_token(cv);
        parse_warp(cv, pattern);
        return true;
    case KW_noise_generator:
        next_token(cv);
        parse_noise_generator(cv, &pattern->shape);
        return true;
    case KW_frequency:
        next_token(cv);
        pattern->shape.frequency = (float)parse_float(cv);
        return true;
    case KW_phase:
        next_token(cv);
        pattern->shape.phase = (float)parse_float(cv);
        return true;
    case KW_quick_color:
    case KW_quick_colour:
        if (use != USE_PIGMENT)
            return false;
        next_token(cv);
        parse_quick_color(cv, pattern);
        return true;
    case KW_bump_size:
        if (use != USE_NORMAL)
            return false;
        next_token(cv);
        pattern->amount = (float)parse_float(cv);
        return true;
    case KW_accuracy:
        if (use != USE_NORMAL)
            return false;
        next_token(cv);
        parse_accuracy(cv, pattern);
        return true;
    case KW_no_bump_scale:
        next_token(cv);
        pattern->no_bump_scale = true;
        return true;
    default:
        break;
    }
    check_modifier_fits(cv, pattern->info);
    if (parse_wave(cv, pattern, code) || parse_map_modifier(cv, use, pattern) ||
        parse_turbulence(cv, pattern) || parse_shape_modifier(cv, pattern, code) ||
        parse_number_modifier(cv, pattern, code))
        return true;
    if (parse_move(cv, &move)) {
        pattern_move(cv, pattern, &move.t);
        return true;
    }
    return false;
}

// What a keyword sets besides the kind: the members that only this pattern has.
static void begin_pattern(PatternNode *pattern, const PatternInfo *info) {
    const Pattern standard = pattern_default();
    Pattern *shape = &pattern->shape;
    bool brick = info->type == PATTERN_BRICK && pattern->info->type == PATTERN_BRICK;
    pattern->info = info;
    pattern->picture = NULL;
    pattern->function = NULL;
    pattern->pigment = NULL;
    pattern->object = NULL;
    pattern->density = NULL;
    if (info->triangle)
        shape->wave = WAVE_TRIANGLE;
    if (info->still)
        shape->frequency = 0;
    shape->agate_turb = standard.agate_turb;
    if (!brick) {
        shape->brick_size = standard.brick_size;
        shape->mortar = standard.mortar;
    }
    memcpy(shape->quilted, standard.quilted, sizeof shape->quilted);
    shape->crackle = standard.crackle;
    shape->facets = standard.facets;
    shape->slope = standard.slope;
    shape->fractal = standard.fractal;
    shape->density_between = 0;
    if (info->list)
        pattern->accuracy = normal_default().accuracy;
    shape->arms = standard.arms;
    shape->gradient = standard.gradient;
    if (info->type == PATTERN_AGATE)
        shape->has_turbulence = true;
}

bool parse_pattern_start(Converter *cv, PatternUse use, PatternNode *pattern) {
    const Token *token = peek_token(cv);
    const PatternInfo *info = pattern_find(token->code);
    if ((use == USE_PIGMENT || use == USE_DENSITY) && starts_color(cv)) {
        pattern->info = pattern_find(KW_color);
        pattern->loc = NULL;
        pattern->color = parse_color(cv);
        return true;
    }
    if (!info || !pattern_fits(use, token->code))
        return false;
    next_token(cv);
    begin_pattern(pattern, info);
    pattern->loc = keep_place(cv, token);
    pattern->pavement[0] = 3, pattern->pavement[1] = pattern->pavement[2] = 1;
    if (info->keyword == KW_uv_mapping)
        parse_uv_mapping(cv, use, pattern);
    else
        parse_pattern_arguments(cv, use, pattern);
    return true;
}

void parse_pattern(Converter *cv, PatternUse use, PatternNode *pattern) {
    enter_level(cv);
    parse_pattern_start(cv, use, pattern);
    while (parse_modifier(cv, use, pattern)) {
    }
    if (pattern->info->keyword == KW_pavement)
        check_pavement(pattern);
    leave_level(cv);
}
