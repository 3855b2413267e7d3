// SPDX-License-Identifier: MIT
// The least a program of statements needs, so that the language core is tested by itself: every
// `keyword { ... }` is read to its closing brace. Weak: where the real statements are linked, they
// are used instead.
#include "converter/language.h"

#define WEAK __attribute__((weak))

static const struct {
    int code;
    ValueType type;
} statements[] = {
    {KW_pigment, VALUE_PIGMENT},
    {KW_pattern, VALUE_PIGMENT},
    {KW_normal, VALUE_NORMAL},
    {KW_finish, VALUE_FINISH},
    {KW_texture, VALUE_TEXTURE},
    {KW_material, VALUE_MATERIAL},
    {KW_interior, VALUE_INTERIOR},
    {KW_media, VALUE_MEDIA},
    {KW_density, VALUE_DENSITY},
    {KW_color_map, VALUE_COLOR_MAP},
    {KW_colour_map, VALUE_COLOR_MAP},
    {KW_pigment_map, VALUE_PIGMENT_MAP},
    {KW_normal_map, VALUE_NORMAL_MAP},
    {KW_slope_map, VALUE_SLOPE_MAP},
    {KW_texture_map, VALUE_TEXTURE_MAP},
    {KW_density_map, VALUE_DENSITY_MAP},
    {KW_fog, VALUE_FOG},
    {KW_rainbow, VALUE_RAINBOW},
    {KW_sky_sphere, VALUE_SKY_SPHERE},
    {KW_camera, VALUE_CAMERA},
    {KW_transform, VALUE_TRANSFORM},
};

// Numbers inside the block are evaluated, so that what stands in them is tested too.
static void read_block(Converter *cv, const char *where) {
    double e[5];
    enter_level(cv);
    expect(cv, '{', where);
    while (!next_is(cv, '}')) {
        if (next_is(cv, TOK_EOF))
            expect(cv, '}', where);
        if (next_is(cv, '{'))
            read_block(cv, where);
        else if (next_is(cv, KW_function))
            next_token(cv), parse_function(cv);
        else if (accept(cv, '<')) // may be a list of 10 or 35 coefficients
            continue;
        else if (starts_string(cv))
            parse_string(cv);
        else if (starts_color(cv))
            parse_color(cv);
        else if (starts_expression(cv))
            parse_add(cv, e, 1);
        else
            next_token(cv);
    }
    expect(cv, '}', where);
    leave_level(cv);
}

WEAK bool parse_statement_value(Converter *cv, Value *out) {
    int code = peek_token(cv)->code;
    if (code < KW_FIRST || code >= KW_END)
        return false;
    *out = (Value){.type = VALUE_OBJECT};
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++) {
        if (statements[i].code == code)
            out->type = statements[i].type;
    }
    next_token(cv);
    if (out->type == VALUE_TRANSFORM && accept_value(cv, VALUE_TRANSFORM))
        return true;
    Transform *identity = ARENA_NEW(cv->arena, Transform);
    *identity = transform_identity();
    out->node = identity;
    read_block(cv, keyword_name(code));
    if (code == KW_texture) {
        bool held = hold_directives(cv);
        while (accept(cv, KW_texture)) {
            restore_directives(cv, held);
            read_block(cv, "texture");
            hold_directives(cv);
        }
        restore_directives(cv, held);
    }
    return true;
}

WEAK void parse_default_block(Converter *cv) { read_block(cv, "default"); }

WEAK void parse_scene_statements(Converter *cv) {
    while (!next_is(cv, TOK_EOF)) {
        Value value;
        if (accept_old_directive(cv) || accept_value(cv, VALUE_OBJECT))
            continue;
        if (next_is(cv, KW_global_settings)) {
            cv->gamma_set = true; // all test scenes say assumed_gamma 1
            cv->gamma = 1;
        }
        if (!parse_statement_value(cv, &value))
            die_expected(cv, "object or directive");
    }
}

WEAK bool object_extent(Converter *cv, const Value *value, Box *out) {
    (void)cv;
    (void)value;
    *out = (Box){{-1, -1, -1}, {1, 1, 1}};
    return true;
}

WEAK Scene *emit_scene(Converter *cv) { return ARENA_NEW(cv->arena, Scene); }
