// SPDX-License-Identifier: MIT
// light_source (facts: sdl 4.9, rendering 5). What is not modelled is noted.
#include "converter/nodes.h"

void parse_light_data(Converter *cv, ObjectNode *object) {
    LightNode *node = ARENA_NEW(cv->arena, LightNode);
    object->light = node;
    object->modelled = true;
    object->loc = NULL;
    node->light = light_default(LIGHT_POINT);
    node->light.location = parse_vector(cv);
    optional_comma(cv);
    if (starts_color(cv) || starts_expression(cv))
        node->light.color = parse_color3(cv); // none at all: black
}

void light_move(LightNode *node, const Move *move) {
    Light *light = &node->light;
    Vec3 *axis = light->area.axis;
    if (move->kind == MOVE_TRANSLATE) {
        light->location = vec_add(light->location, move->v);
        light->point_at = vec_add(light->point_at, move->v);
    } else if (move->kind == MOVE_SCALE) {
        light->location = vec_mul(light->location, move->v);
        light->point_at = vec_mul(light->point_at, move->v);
        axis[0] = vec_mul(axis[0], move->v);
        axis[1] = vec_mul(axis[1], move->v);
    } else {
        light->location = transform_point(&move->t, light->location);
        light->point_at = transform_point(&move->t, light->point_at);
        axis[0] = transform_dir(&move->t, axis[0]);
        axis[1] = transform_dir(&move->t, axis[1]);
    }
}

static ObjectNode *parse_body(Converter *cv, const char *where) {
    expect(cv, '{', where);
    ObjectNode *body = parse_object(cv);
    if (!body)
        die_expected(cv, arena_printf(cv->arena, "an object in '%s'", where));
    parse_object_modifiers(cv, body);
    expect(cv, '}', where);
    return body;
}

// The object stands around the light and throws no shadow.
static void parse_looks_like(Converter *cv, LightNode *node) {
    ObjectNode *body = parse_body(cv, "looks_like");
    Vec3 at = node->light.location;
    Move move = {.kind = MOVE_TRANSLATE, .v = at, .t = transform_translate(at)};
    object_move(cv, body, &move);
    body->object.no_shadow = true;
    node->looks_like = body;
}

static void need_first(Converter *cv, const ObjectNode *before, const Token *token) {
    Loc loc = token_loc(cv, token);
    if (before)
        die_at(&loc, "a light has only one '%s'", token->text);
}

// The colour of a light that has a color_map (a spectrum): its colours, each times its position.
static Rgb map_sum(const MapNode *map) {
    Rgb sum = {0};
    for (uint32_t i = 0; i < map->count; i++)
        sum = rgb_add(sum, rgb_scale(color_rgb(map->items[i].color), map->items[i].value));
    return sum;
}

static void need_direction(Converter *cv, const LightNode *node, const Token *token) {
    if (node->directed)
        return;
    Loc loc = token_loc(cv, token);
    die_at(&loc, "'%s' needs spotlight%s before it", token->text,
           token->code == KW_point_at ? ", cylinder or parallel" : " or cylinder");
}

static void set_kind(LightNode *node, LightType type) {
    Light plain = light_default(type);
    node->directed = true;
    node->light.type = type;
    node->light.radius = plain.radius;
    node->light.falloff = plain.falloff;
    node->light.tightness = plain.tightness;
}

static void parse_area_light(Converter *cv, LightNode *node, const Token *token) {
    AreaLight *area = &node->light.area;
    node->light.has_area = true;
    for (int i = 0; i < 2; i++) {
        area->axis[i] = parse_vector(cv);
        optional_comma(cv);
    }
    for (int i = 0; i < 2; i++) {
        double size = parse_float(cv);
        Loc loc = token_loc(cv, token);
        if (!(size >= 1 && size <= LIGHT_MAX_GRID))
            die_at(&loc, "an area_light has 1 to %d points a side, not %g", LIGHT_MAX_GRID, size);
        area->size[i] = (int)size;
        if (i == 0)
            optional_comma(cv);
    }
}

Light light_finished(const LightNode *node) {
    Light light = node->light;
    if (node->parallel && light.type == LIGHT_POINT)
        light.type = LIGHT_PARALLEL;
    light.parallel = node->parallel && light.type == LIGHT_SPOT;
    if (!light.has_area)
        light.area = area_light_default();
    light.area.circular |= light.area.orient;
    light.media_attenuation = node->attenuation && !node->no_interaction;
    return light;
}

static bool parse_kind(Converter *cv, LightNode *node, const Token *token) {
    switch (token->code) {
    case KW_spotlight:
        next_token(cv);
        set_kind(node, LIGHT_SPOT);
        return true;
    case KW_cylinder:
        next_token(cv);
        set_kind(node, LIGHT_CYLINDER);
        return true;
    case KW_parallel:
        next_token(cv);
        node->directed = node->parallel = true;
        return true;
    case KW_shadowless:
        next_token(cv);
        node->light.shadowless = true;
        return true;
    case KW_area_light:
        next_token(cv);
        parse_area_light(cv, node, token);
        return true;
    default:
        return false;
    }
}

static bool parse_number(Converter *cv, LightNode *node, const Token *token) {
    switch (token->code) {
    case KW_point_at:
        need_direction(cv, node, token);
        next_token(cv);
        node->light.point_at = parse_vector(cv);
        return true;
    case KW_radius:
        need_direction(cv, node, token);
        next_token(cv);
        node->light.radius = parse_float(cv);
        return true;
    case KW_falloff:
        need_direction(cv, node, token);
        next_token(cv);
        node->light.falloff = parse_float(cv);
        return true;
    case KW_tightness:
        need_direction(cv, node, token);
        next_token(cv);
        node->light.tightness = parse_float(cv);
        return true;
    case KW_fade_distance:
        next_token(cv);
        node->light.fade_distance = parse_float(cv);
        return true;
    case KW_fade_power:
        next_token(cv);
        node->light.fade_power = parse_float(cv);
        return true;
    case KW_adaptive:
        next_token(cv);
        node->light.area.adaptive = (int)parse_float(cv);
        return true;
    default:
        return false;
    }
}

static bool parse_rest(Converter *cv, LightNode *node, const Token *token) {
    switch (token->code) {
    case KW_jitter:
        next_token(cv);
        node->light.area.jitter = true;
        return true;
    case KW_circular:
        next_token(cv);
        node->light.area.circular = true;
        return true;
    case KW_orient:
        next_token(cv);
        node->light.area.orient = true;
        return true;
    case KW_area_illumination:
        next_token(cv);
        node->light.area.illumination = parse_optional_bool(cv);
        return true;
    case KW_media_interaction:
        next_token(cv);
        node->no_interaction = !parse_optional_bool(cv);
        return true;
    case KW_media_attenuation:
        next_token(cv);
        node->attenuation = parse_optional_bool(cv);
        return true;
    case KW_looks_like:
        need_first(cv, node->looks_like, token);
        next_token(cv);
        parse_looks_like(cv, node);
        return true;
    case KW_projected_through:
        need_first(cv, node->projected_through, token);
        next_token(cv);
        node->projected_through = parse_body(cv, "projected_through");
        return true;
    case KW_color_map:
    case KW_colour_map:
        next_token(cv);
        node->light.color = map_sum(parse_map(cv, MAP_COLOR, false));
        return true;
    default:
        return false;
    }
}

void parse_light_items(Converter *cv, ObjectNode *object) {
    object_unshare(cv, object);
    for (;;) {
        const Token *token = peek_token(cv);
        Move move;
        if (parse_move(cv, &move))
            object_move(cv, object, &move);
        else if (!parse_kind(cv, object->light, token) && !parse_number(cv, object->light, token) &&
                 !parse_rest(cv, object->light, token) && !parse_photons_modifier(cv))
            break;
    }
    if (object->light->looks_like)
        object->textured = object->light->looks_like->textured;
    const AreaLight *area = &object->light->light.area;
    if (area->circular &&
        (!object->light->light.has_area || area->size[0] < 2 || area->size[1] < 2)) {
        Loc loc = here(cv);
        die_at(&loc, "Circular area light must have more than 1 point per axis");
    }
    if (object->light->looks_like)
        object_put_below(cv, object, object->light->looks_like);
}
