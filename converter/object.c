// SPDX-License-Identifier: MIT
// Objects as the statements build them: creation, lazy copies, transforms, inversion, and the entry
// of every object statement (facts: sdl 4.1, 4.2, 4.4).
//
// A copy shares its children and points with the original until one of the two is changed; so a
// declared tree may be used a thousand times, and grow by itself in a loop, at little cost.
#include "converter/nodes.h"

#include "base/array.h"

static bool object_type(int keyword, ObjectType *type) {
    static const struct {
        int keyword;
        ObjectType type;
    } types[] = {
        {KW_union, OBJECT_UNION},
        {KW_composite, OBJECT_UNION},
        {KW_light_group, OBJECT_UNION},
        {KW_merge, OBJECT_MERGE},
        {KW_intersection, OBJECT_INTERSECTION},
        {KW_difference, OBJECT_INTERSECTION},
        {KW_bicubic_patch, OBJECT_PATCH},
        {KW_plane, OBJECT_PLANE},
        {KW_sphere, OBJECT_SPHERE},
        {KW_box, OBJECT_BOX},
        {KW_cylinder, OBJECT_CYLINDER},
        {KW_cone, OBJECT_CONE},
        {KW_torus, OBJECT_TORUS},
        {KW_disc, OBJECT_DISC},
        {KW_triangle, OBJECT_TRIANGLE},
        {KW_quadric, OBJECT_QUADRIC},
        {KW_cubic, OBJECT_POLY},
        {KW_quartic, OBJECT_POLY},
        {KW_poly, OBJECT_POLY},
        {KW_polynomial, OBJECT_POLY},
        {KW_superellipsoid, OBJECT_SUPERELLIPSOID},
        {KW_lathe, OBJECT_LATHE},
        {KW_sor, OBJECT_SOR},
        {KW_prism, OBJECT_PRISM},
        {KW_sphere_sweep, OBJECT_SPHERE_SWEEP},
        {KW_blob, OBJECT_BLOB},
        {KW_ovus, OBJECT_OVUS},
        {KW_smooth_triangle, OBJECT_SMOOTH_TRIANGLE},
        {KW_polygon, OBJECT_POLYGON},
        {KW_mesh, OBJECT_MESH},
        {KW_mesh2, OBJECT_MESH},
        {KW_height_field, OBJECT_HEIGHT_FIELD},
        {KW_text, OBJECT_TEXT},
        {KW_isosurface, OBJECT_ISOSURFACE},
        {KW_parametric, OBJECT_PARAMETRIC},
    };
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (types[i].keyword == keyword) {
            *type = types[i].type;
            return true;
        }
    return false;
}

static bool keyword_is_surface(int keyword) {
    return keyword == KW_bicubic_patch || keyword == KW_triangle || keyword == KW_smooth_triangle ||
           keyword == KW_mesh || keyword == KW_mesh2 || keyword == KW_polygon ||
           keyword == KW_parametric;
}

static ObjectNode *object_create(Converter *cv, int keyword) {
    ObjectNode *object = ARENA_NEW(cv->arena, ObjectNode);
    ObjectType type;
    object->keyword = keyword;
    object->surface = keyword_is_surface(keyword);
    object->modelled = object_type(keyword, &type);
    if (object->modelled)
        object->object = object_default(type);
    return object;
}

ObjectNode *object_copy(Converter *cv, const ObjectNode *object) {
    check_limits(cv, 1);
    ObjectNode *copy = arena_copy(cv->arena, object, sizeof *object);
    copy->next = NULL;
    copy->shared = true;
    return copy;
}

void object_count(Converter *cv, uint64_t *count, const ObjectNode *object) {
    uint64_t limit = limit_of(cv, LIMIT_OBJECTS);
    *count += 1 + object->below; // each below the limit
    if (*count <= limit)
        return;
    Loc loc = here(cv);
    die_at(&loc, "Too many objects: more than %llu with all copies counted %s",
           (unsigned long long)limit, limit_hint(cv, LIMIT_OBJECTS));
}

void object_put_below(Converter *cv, ObjectNode *parent, const ObjectNode *part) {
    object_count(cv, &parent->below, part);
    check_depth(cv, part->depth + 1, "objects");
    parent->lit = parent->lit || part->lit || part->light;
    if (parent->depth <= part->depth)
        parent->depth = part->depth + 1;
}

void object_add_child(Converter *cv, ObjectNode *parent, ObjectNode *child) {
    object_put_below(cv, parent, child);
    child->next = NULL;
    if (parent->last)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
}

// Copies a list of siblings and returns its head; *last is its end.
static ObjectNode *copy_list(Converter *cv, const ObjectNode *list, ObjectNode **last) {
    ObjectNode *first = NULL, *end = NULL;
    for (; list; list = list->next) {
        ObjectNode *copy = object_copy(cv, list);
        if (end)
            end->next = copy;
        else
            first = copy;
        end = copy;
    }
    if (last)
        *last = end;
    return first;
}

// The children take the transforms, the first written first.
static void catch_up(Converter *cv, ObjectNode *object, const LateMove *late) {
    ARRAY(Move *) moves = {0};
    for (; late; late = late->before)
        array_push(&moves, late->move);
    for (size_t i = moves.count; i > 0; i--)
        for (ObjectNode *child = object->first; child; child = child->next)
            object_move(cv, child, moves.items[i - 1]);
    array_free(&moves);
}

void object_unshare(Converter *cv, ObjectNode *object) {
    if (!object->shared)
        return;
    object->shared = false;
    object->first = copy_list(cv, object->first, &object->last);
    object->bounds = copy_list(cv, object->bounds, NULL);
    object->clips = copy_list(cv, object->clips, NULL);
    if (object->modelled && object->object.type == OBJECT_PATCH) {
        PatchShape *patch = &object->object.shape.patch;
        size_t count = (size_t)(patch->degree_u + 1) * (patch->degree_v + 1);
        patch->points = arena_copy(cv->arena, patch->points, count * sizeof *patch->points);
    }
    if (object->has_textures)
        object->textures = arena_copy(cv->arena, object->textures,
                                      object->texture_count * sizeof *object->textures);
    if (object->light) {
        object->light = arena_copy(cv->arena, object->light, sizeof *object->light);
        if (object->light->looks_like)
            object->light->looks_like = object_copy(cv, object->light->looks_like);
        if (object->light->projected_through)
            object->light->projected_through = object_copy(cv, object->light->projected_through);
    }
    const LateMove *late = object->late;
    object->late = NULL;
    catch_up(cv, object, late);
}

// A copy of a tree of some size takes transforms as a whole: if there are many such copies the
// scene has the tree once (emit_instance.c), else its children take them when they are asked for.
enum { LATE_LEAST = 8 };

static bool moves_late(const Converter *cv, const ObjectNode *object) {
    return object->shared && keyword_is_csg(object->keyword) && object->below >= LATE_LEAST &&
           !object->lit && !object->bounds && !object->clips && !cv->options->patch_solids;
}

static void move_late(Converter *cv, ObjectNode *object, Move *move) {
    if (!move->kept) {
        Move kept = {.kind = move->kind, .v = move->v, .t = move->t};
        move->kept = arena_copy(cv->arena, &kept, sizeof kept);
        move->kept->kept = move->kept;
    }
    const LateMove late = {object->late, move->kept};
    object->late = arena_copy(cv->arena, &late, sizeof late);
}

static void move_children(Converter *cv, ObjectNode *object, Move *move) {
    object_unshare(cv, object);
    for (ObjectNode *child = object->first; child; child = child->next)
        object_move(cv, child, move);
    for (ObjectNode *bound = object->bounds; bound; bound = bound->next)
        object_move(cv, bound, move);
    for (ObjectNode *clip = object->clips; clip; clip = clip->next)
        object_move(cv, clip, move);
}

void object_move(Converter *cv, ObjectNode *object, Move *move) {
    if (moves_late(cv, object))
        move_late(cv, object, move);
    else
        move_children(cv, object, move);
    if (!object->object.uv_mapping) {
        object->texture = texture_moved(cv, object->texture, move);
        object->interior_texture = texture_moved(cv, object->interior_texture, move);
        for (uint32_t i = 0; object->has_textures && i < object->texture_count; i++)
            object->textures[i] = texture_moved(cv, object->textures[i], move);
    }
    if (object->light) {
        light_move(object->light, move);
        if (object->light->looks_like)
            object_move(cv, object->light->looks_like, move);
        if (object->light->projected_through)
            object_move(cv, object->light->projected_through, move);
    }
    shape_move(object, move);
    extent_move(object, move);
}

// The inverse of a union or merge is the intersection of the inverses; that of an intersection is
// the merge of them: its inner walls are gone (measured).
static void invert_csg(Converter *cv, ObjectNode *object) {
    object->flipped = !object->flipped;
    bool becomes_merge = object->keyword == KW_intersection || object->keyword == KW_difference;
    object_unshare(cv, object);
    for (ObjectNode *child = object->first; child; child = child->next)
        if (!child->surface && !child->light)
            object_invert(cv, child);
    object->textured = object->difference = false;
    object->keyword = becomes_merge ? KW_merge : KW_intersection;
    object->object.type = becomes_merge ? OBJECT_MERGE : OBJECT_INTERSECTION;
}

void object_invert(Converter *cv, ObjectNode *object) {
    if (patch_solid_invert(cv, object))
        return;
    if (keyword_is_csg(object->keyword)) {
        invert_csg(cv, object);
    } else if (object->keyword == KW_plane) {
        PlaneShape *plane = &object->object.shape.plane;
        plane->normal = vec_neg(plane->normal);
        plane->distance = -plane->distance;
    } else {
        object->object.inverse = !object->object.inverse;
    }
}

// ---- statements ------------------------------------------------------------------------------

static bool starts_statement(int code) {
    return shape_parser(code) || solid_parser(code) || shape_other_parser(code) ||
           keyword_is_csg(code) || code == KW_object || code == KW_light_source ||
           code == KW_light_group;
}

// object { OBJECT modifiers }
static ObjectNode *parse_object_statement(Converter *cv) {
    ObjectNode *object = parse_object(cv);
    if (!object)
        die_expected(cv, "an object");
    return object;
}

// Whatever stands in the braces before the modifiers. One name alone makes the statement a copy of
// that object, of whatever kind.
static ObjectNode *parse_data(Converter *cv, const Token *token) {
    int code = token->code;
    const Value *value;
    if (code == KW_object)
        return parse_object_statement(cv);
    if (code != KW_light_group && (value = accept_value(cv, VALUE_OBJECT)))
        return object_copy(cv, value->node);
    ObjectNode *object = object_create(cv, code);
    if (!object->modelled || cv->options->patch_solids)
        object->loc = keep_place(cv, token);
    if (code == KW_light_source)
        parse_light_data(cv, object);
    else if (keyword_is_csg(code) || code == KW_light_group)
        parse_csg_data(cv, object);
    else if (shape_parser(code))
        shape_parser(code)(cv, object);
    else if (solid_parser(code))
        solid_parser(code)(cv, object);
    else
        shape_other_parser(code)(cv, object);
    if (object->modelled && !object->light && !shape_is_finite(&object->object)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "a number of this %s is not finite", token->text);
    }
    return object;
}

ObjectNode *parse_object(Converter *cv) {
    const Value *value = accept_value(cv, VALUE_OBJECT);
    if (value)
        return object_copy(cv, value->node);
    const Token *token = peek_token(cv);
    if (!starts_statement(token->code))
        return NULL;
    enter_level(cv);
    next_token(cv);
    expect(cv, '{', token->text);
    ObjectNode *object = parse_data(cv, token);
    bool is_copy = object->shared;
    if (token->code == KW_light_source && object->light)
        parse_light_items(cv, object);
    else
        parse_object_modifiers(cv, object);
    object->difference = object->difference || (token->code == KW_difference && !is_copy);
    if (!next_is(cv, '}') && starts_statement(peek_token(cv)->code))
        die_expected(cv, arena_printf(cv->arena, "a modifier or '}' in '%s'", token->text));
    expect(cv, '}', token->text);
    leave_level(cv);
    return object;
}
