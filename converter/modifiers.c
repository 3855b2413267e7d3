// SPDX-License-Identifier: MIT
// What may follow the data of an object (facts: sdl 4.3): transforms, textures, interior, flags,
// bounded_by, clipped_by. Read in the order of writing, since a transform moves what is there.
#include "converter/nodes.h"

#include <math.h>

static bool parse_flag(Converter *cv, ObjectNode *node, int code) {
    Object *object = &node->object;
    switch (code) {
    case KW_no_shadow: // has no value in 3.7
        next_token(cv);
        object->no_shadow = true;
        return true;
    case KW_no_image:
        next_token(cv);
        object->no_image = parse_optional_bool(cv);
        return true;
    case KW_no_reflection:
        next_token(cv);
        object->no_reflection = parse_optional_bool(cv);
        return true;
    case KW_hollow:
        next_token(cv);
        object->hollow = parse_optional_bool(cv);
        node->hollow_set = true;
        return true;
    case KW_double_illuminate:
        next_token(cv);
        object->double_illuminate = parse_optional_bool(cv);
        node->double_set = true;
        return true;
    case KW_hierarchy: {
        Loc loc = here(cv);
        if (node->keyword != KW_blob && node->keyword != KW_mesh && node->keyword != KW_mesh2 &&
            node->keyword != KW_height_field)
            die_at(&loc, "Keyword 'hierarchy' cannot be used with this object");
        next_token(cv);
        parse_optional_bool(cv);
        return true;
    }
    case KW_no_radiosity:
        next_token(cv);
        parse_optional_bool(cv);
        return true;
    default:
        return false;
    }
}

static void die_misplaced(Converter *cv, const Token *token, const char *why) {
    Loc loc = token_loc(cv, token);
    die_at(&loc, "%s", why);
}

// Which root finder is taken makes no difference here.
static bool takes_sturm(int keyword) {
    static const int keywords[] = {KW_torus, KW_blob,       KW_cubic, KW_quartic, KW_poly,
                                   KW_lathe, KW_polynomial, KW_prism, KW_sor};
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; i++)
        if (keywords[i] == keyword)
            return true;
    return false;
}

static bool parse_rare_flag(Converter *cv, ObjectNode *node, const Token *token) {
    switch (token->code) {
    case KW_sturm:
        if (node->modelled && !takes_sturm(node->keyword))
            die_misplaced(cv, token, "'sturm' cannot be used with this object");
        next_token(cv);
        parse_optional_bool(cv);
        if (node->object.type == OBJECT_POLY)
            node->object.shape.poly.sturm = true;
        return true;
    case KW_split_union:
        if (node->keyword != KW_union && node->keyword != KW_composite && node->keyword != KW_merge)
            die_misplaced(cv, token, "'split_union' can only be used in a union");
        next_token(cv);
        node->no_split = (int)fmax(fmin(parse_float(cv), 2), -2) == 0;
        return true;
    case KW_cutaway_textures:
        if (node->keyword != KW_intersection && node->keyword != KW_difference)
            die_misplaced(cv, token,
                          "'cutaway_textures' can only be used in intersection and difference");
        next_token(cv);
        node->cutaway = keep_place(cv, token);
        return true;
    case KW_inverse:
        next_token(cv);
        if (node->surface) {
            Loc loc = token_loc(cv, token);
            warn_at(&loc, "'%s' has no inside: inverse has no effect", keyword_name(node->keyword));
            return true;
        }
        object_invert(cv, node);
        return true;
    case KW_uv_mapping:
        if (node->texture)
            die_misplaced(cv, token, "uv_mapping must stand before the texture of the object");
        next_token(cv);
        node->object.uv_mapping = true;
        return true;
    case KW_dtag:
        next_token(cv);
        parse_string(cv);
        return true;
    default:
        return false;
    }
}

// photons { target [F] | reflection F | refraction F | pass_through [F] | collect B }
static void parse_photons(Converter *cv) {
    expect(cv, '{', "photons");
    for (;;) {
        if (accept(cv, KW_target) || accept(cv, KW_pass_through) || accept(cv, KW_collect) ||
            accept(cv, KW_area_light))
            parse_optional_bool(cv);
        else if (accept(cv, KW_reflection) || accept(cv, KW_refraction))
            parse_float(cv);
        else
            break;
    }
    expect(cv, '}', "photons");
}

bool parse_photons_modifier(Converter *cv) {
    if (!accept(cv, KW_photons))
        return false;
    parse_photons(cv);
    return true;
}

// radiosity { { importance F }* }
void parse_importance_block(Converter *cv) {
    expect(cv, '{', "radiosity");
    while (accept(cv, KW_importance)) {
        Loc loc = here(cv);
        double importance = parse_float(cv);
        if (!(importance > 0 && importance <= 1))
            die_at(&loc, "Radiosity importance must be greater than 0.0 and at most 1.0");
    }
    expect(cv, '}', "radiosity");
}

static bool parse_radiosity_modifier(Converter *cv) {
    if (!accept(cv, KW_radiosity))
        return false;
    parse_importance_block(cv);
    return true;
}

// ---- bounded_by, clipped_by ------------------------------------------------------------------

// OBJECT* transforms. The transforms move all of them.
static ObjectNode *parse_bodies(Converter *cv, const char *where) {
    ObjectNode *first = NULL, *last = NULL;
    for (;;) {
        const Token *token = peek_token(cv);
        ObjectNode *body = parse_object(cv);
        if (!body)
            break;
        if (body->surface || body->texture || body->light)
            die_misplaced(cv, token,
                          arena_printf(cv->arena, "%s in '%s'",
                                       body->surface   ? "an object without an inside"
                                       : body->texture ? "an object with a texture"
                                                       : "a light source",
                                       where));
        if (last)
            last->next = body;
        else
            first = body;
        last = body;
    }
    if (!first)
        die_expected(cv, arena_printf(cv->arena, "an object in '%s'", where));
    Move move;
    while (parse_move(cv, &move))
        for (ObjectNode *body = first; body; body = body->next)
            object_move(cv, body, &move);
    return first;
}

static void append(Converter *cv, ObjectNode *node, ObjectNode **list, ObjectNode *more) {
    while (*list)
        list = &(*list)->next;
    *list = more;
    for (const ObjectNode *body = more; body; body = body->next)
        object_put_below(cv, node, body);
}

static bool parse_bound(Converter *cv, ObjectNode *node) {
    const Token *token = peek_token(cv);
    bool bound = token->code == KW_bounded_by;
    if (!bound && token->code != KW_clipped_by)
        return false;
    next_token(cv);
    object_unshare(cv, node); // the lists are about to grow
    expect(cv, '{', token->text);
    ObjectNode **mine = bound ? &node->bounds : &node->clips;
    ObjectNode **other = bound ? &node->clips : &node->bounds;
    const Token *inner = peek_token(cv);
    if (accept(cv, bound ? KW_clipped_by : KW_bounded_by)) {
        if (*mine)
            die_misplaced(cv, inner, "this object already has bodies of that kind");
        for (const ObjectNode *body = *other; body; body = body->next)
            append(cv, node, mine, object_copy(cv, body));
    } else {
        append(cv, node, mine, parse_bodies(cv, token->text));
    }
    expect(cv, '}', token->text);
    if (bound)
        node->bound_loc = keep_place(cv, token);
    else
        node->clip_loc = keep_place(cv, token);
    return true;
}

// ---- textures --------------------------------------------------------------------------------

static bool parse_texture_or_interior(Converter *cv, ObjectNode *node) {
    const Token *token = peek_token(cv);
    switch (token->code) {
    case KW_texture:
        next_token(cv);
        node->texture = texture_layer(cv, parse_texture_block(cv), node->texture, token);
        return true;
    case KW_interior_texture:
        next_token(cv);
        node->interior_texture =
            texture_layer(cv, parse_texture_block(cv), node->interior_texture, token);
        return true;
    case KW_interior:
        next_token(cv);
        node->interior = parse_interior_block(cv, node->interior);
        return true;
    case KW_material: {
        next_token(cv);
        MaterialNode material = {node->texture, node->interior_texture, node->interior};
        parse_material_block(cv, &material);
        node->texture = material.texture;
        node->interior_texture = material.interior_texture;
        node->interior = material.interior;
        return true;
    }
    default:
        return parse_partial_texture(cv, &node->texture);
    }
}

static bool parse_surface(Converter *cv, ObjectNode *node) {
    const TextureNode *before = node->texture;
    bool any = parse_texture_or_interior(cv, node);
    node->textured = node->textured || node->texture != before;
    return any;
}

// In version 1 an object's colour is what its pigment shows at low quality.
static bool set_quick_color(Converter *cv, ObjectNode *node, Color color) {
    if (!node->texture || !texture_is_plain(node->texture))
        return false;
    PatternNode pigment = *node->texture->pigment;
    pigment.quick_color = color;
    pigment.has_quick_color = true;
    TextureNode texture = *node->texture;
    texture.pigment = arena_copy(cv->arena, &pigment, sizeof pigment);
    node->texture = arena_copy(cv->arena, &texture, sizeof texture);
    return true;
}

static bool parse_object_modifier(Converter *cv, ObjectNode *node) {
    const Token *token = peek_token(cv);
    Move move;
    if (parse_move(cv, &move)) {
        object_move(cv, node, &move);
        return true;
    }
    if (node->keyword == KW_light_group) {
        if (!accept(cv, KW_global_lights))
            return parse_photons_modifier(cv);
        node->global_lights = parse_optional_bool(cv);
        return true;
    }
    if (parse_surface(cv, node) || parse_flag(cv, node, token->code) ||
        parse_rare_flag(cv, node, token) || parse_photons_modifier(cv) ||
        parse_radiosity_modifier(cv) || parse_bound(cv, node))
        return true;
    if (starts_color(cv)) {
        Loc loc = token_loc(cv, token);
        Color color = parse_color(cv);
        if (cv->version >= 150 || !set_quick_color(cv, node, color))
            warn_at(&loc, "a colour belongs into a pigment: it is ignored");
        return true;
    }
    return false;
}

void parse_object_modifiers(Converter *cv, ObjectNode *node) {
    while (parse_object_modifier(cv, node)) {
    }
    extent_bound(node);
    if (node->interior_texture && !node->texture) {
        Loc loc = here(cv);
        die_at(&loc, "interior_texture needs a texture as well");
    }
}
