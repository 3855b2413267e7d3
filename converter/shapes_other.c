// SPDX-License-Identifier: MIT
// The objects that are read in full but not modelled (facts: sdl 4.2): only their data, since
// modifiers are the same for all. Nothing of it is kept.
#include "converter/nodes.h"

static void floats(Converter *cv, int count) {
    for (int i = 0; i < count; i++) {
        if (i > 0)
            optional_comma(cv);
        parse_float(cv);
    }
}

static void vectors(Converter *cv, int count) {
    for (int i = 0; i < count; i++) {
        if (i > 0)
            optional_comma(cv);
        parse_vector(cv);
    }
}

// F(n) first, as a count of what follows. More than any scene has is a mistake, not a loop.
static int count_of(Converter *cv, const char *what, int least) {
    const Token *token = peek_token(cv);
    double count = parse_float(cv);
    if (count >= least && count <= 1e8) {
        optional_comma(cv);
        return (int)count;
    }
    Loc loc = token_loc(cv, token);
    die_at(&loc, "a %s needs at least %d points, %g is no such number", what, least, count);
}

static void uvs(Converter *cv, int count) {
    for (int i = 0; i < count; i++) {
        if (i > 0)
            optional_comma(cv);
        parse_uv(cv);
    }
}

static bool accept_any(Converter *cv, const int *codes, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (accept(cv, codes[i]))
            return true;
    return false;
}
#define ACCEPT_ANY(cv, codes) accept_any((cv), (codes), sizeof(codes) / sizeof *(codes))

static bool accept_spline_word(Converter *cv) {
    static const int kinds[] = {KW_linear_spline, KW_quadratic_spline, KW_cubic_spline,
                                KW_bezier_spline, KW_b_spline,         KW_natural_spline};
    return ACCEPT_ANY(cv, kinds);
}

// ---- blob
// -----------------------------------------------------------------------------------------------

static void parse_component_modifiers(Converter *cv) {
    const TextureNode *texture = NULL;
    Move move;
    while (parse_move(cv, &move) || parse_partial_texture(cv, &texture) ||
           (accept(cv, KW_texture) && (texture = parse_texture_block(cv)))) {
    }
}

// sphere { V, F, [strength] F mods } | cylinder { V, V, F, [strength] F mods }
static void parse_component(Converter *cv, int ends, const char *where) {
    expect(cv, '{', where);
    vectors(cv, ends);
    optional_comma(cv);
    parse_float(cv);
    optional_comma(cv);
    accept(cv, KW_strength);
    parse_float(cv);
    parse_component_modifiers(cv);
    expect(cv, '}', where);
}

static void parse_blob(Converter *cv, ObjectNode *object) {
    (void)object;
    for (;;) {
        if (accept(cv, KW_threshold)) {
            parse_float(cv);
        } else if (accept(cv, KW_sphere)) {
            parse_component(cv, 1, "sphere");
        } else if (accept(cv, KW_cylinder)) {
            parse_component(cv, 2, "cylinder");
        } else if (accept(cv, KW_component)) {
            floats(cv, 2);
            optional_comma(cv);
            parse_vector(cv);
        } else if (!accept(cv, ',')) {
            return;
        }
    }
}

// ---- meshes
// ---------------------------------------------------------------------------------------------

// texture { ID } | texture_list { ID ID ID }
static void parse_mesh_texture(Converter *cv) {
    if (accept(cv, KW_uv_vectors))
        uvs(cv, 3);
    if (accept(cv, KW_texture)) {
        parse_texture_block(cv);
    } else if (accept(cv, KW_texture_list)) {
        expect(cv, '{', "texture_list");
        while (accept_value(cv, VALUE_TEXTURE) ||
               (accept(cv, KW_texture) && parse_texture_block(cv)))
            optional_comma(cv);
        expect(cv, '}', "texture_list");
    }
}

static void parse_mesh(Converter *cv, ObjectNode *object) {
    (void)object;
    for (;;) {
        int code = peek_token(cv)->code;
        if (code == KW_triangle || code == KW_smooth_triangle) {
            next_token(cv);
            expect(cv, '{', "triangle");
            vectors(cv, code == KW_triangle ? 3 : 6);
            optional_comma(cv);
            parse_mesh_texture(cv);
            expect(cv, '}', "triangle");
        } else if (accept(cv, KW_inside_vector)) {
            parse_vector(cv);
        } else {
            return;
        }
    }
}

// { n, items }
static void parse_counted(Converter *cv, const char *where, bool uv) {
    expect(cv, '{', where);
    int count = count_of(cv, where, 0);
    if (uv)
        uvs(cv, count);
    else
        vectors(cv, count);
    optional_comma(cv);
    expect(cv, '}', where);
}

static void parse_counted_textures(Converter *cv) {
    expect(cv, '{', "texture_list");
    parse_float(cv);
    optional_comma(cv);
    while ((accept(cv, KW_texture) && parse_texture_block(cv)) || accept_value(cv, VALUE_TEXTURE))
        optional_comma(cv);
    expect(cv, '}', "texture_list");
}

// face_indices { n, { V [,] [F [,] F [,] F] }* }
static void parse_faces(Converter *cv) {
    expect(cv, '{', "face_indices");
    parse_float(cv);
    optional_comma(cv);
    while (!next_is(cv, '}')) {
        if (next_is(cv, '<'))
            parse_vector(cv);
        else
            parse_float(cv);
        optional_comma(cv);
    }
    expect(cv, '}', "face_indices");
}

static void parse_mesh2(Converter *cv, ObjectNode *object) {
    (void)object;
    for (;;) {
        const Token *token = peek_token(cv);
        switch (token->code) {
        case KW_vertex_vectors:
        case KW_normal_vectors:
        case KW_normal_indices:
        case KW_uv_indices:
            next_token(cv);
            parse_counted(cv, token->text, false);
            break;
        case KW_uv_vectors:
            next_token(cv);
            parse_counted(cv, token->text, true);
            break;
        case KW_texture_list:
            next_token(cv);
            parse_counted_textures(cv);
            break;
        case KW_face_indices:
            next_token(cv);
            parse_faces(cv);
            break;
        case KW_inside_vector:
            next_token(cv);
            parse_vector(cv);
            break;
        default:
            return;
        }
    }
}

// ---- functions and fractals
// -------------------------------------------------------------------------------

static void parse_contained_by(Converter *cv) {
    expect(cv, '{', "contained_by");
    if (accept(cv, KW_box)) {
        expect(cv, '{', "box");
        vectors(cv, 2);
    } else {
        expect(cv, KW_sphere, "contained_by");
        expect(cv, '{', "sphere");
        parse_vector(cv);
        optional_comma(cv);
        parse_float(cv);
    }
    expect(cv, '}', "contained_by");
    expect(cv, '}', "contained_by");
}

static bool parse_function_option(Converter *cv) {
    static const int numbers[] = {KW_threshold, KW_accuracy, KW_max_gradient, KW_max_trace};
    static const int words[] = {KW_all_intersections, KW_open};
    if (ACCEPT_ANY(cv, numbers)) {
        parse_float(cv);
    } else if (accept(cv, KW_evaluate)) {
        floats(cv, 3);
    } else if (accept(cv, KW_contained_by)) {
        parse_contained_by(cv);
    } else if (accept(cv, KW_precompute)) {
        parse_float(cv);
        while (accept(cv, ',') || accept(cv, KW_x) || accept(cv, KW_y) || accept(cv, KW_z)) {
        }
    } else if (!ACCEPT_ANY(cv, words)) {
        return false;
    }
    return true;
}

static void parse_function_body(Converter *cv, const char *where) {
    expect(cv, KW_function, where);
    parse_function(cv);
    optional_comma(cv);
}

static void parse_isosurface(Converter *cv, ObjectNode *object) {
    (void)object;
    parse_function_body(cv, "isosurface");
    while (parse_function_option(cv)) {
    }
}

static void parse_parametric(Converter *cv, ObjectNode *object) {
    (void)object;
    for (int i = 0; i < 3; i++)
        parse_function_body(cv, "parametric");
    uvs(cv, 2);
    while (parse_function_option(cv)) {
    }
}

static void parse_julia_fractal(Converter *cv, ObjectNode *object) {
    static const int words[] = {KW_sqr,   KW_cube,  KW_exp,          KW_reciprocal, KW_sin,
                                KW_asin,  KW_sinh,  KW_asinh,        KW_cos,        KW_acos,
                                KW_cosh,  KW_acosh, KW_tan,          KW_atan,       KW_tanh,
                                KW_atanh, KW_ln,    KW_hypercomplex, KW_quaternion};
    static const int numbers[] = {KW_max_iteration, KW_precision};
    double v[4];
    (void)object;
    parse_vector4(cv, v);
    for (;;) {
        if (ACCEPT_ANY(cv, numbers)) {
            parse_float(cv);
        } else if (accept(cv, KW_slice)) {
            parse_vector4(cv, v);
            optional_comma(cv);
            parse_float(cv);
        } else if (accept(cv, KW_pwr) || accept(cv, KW_pow)) {
            expect(cv, '(', "pwr");
            floats(cv, 2);
            expect(cv, ')', "pwr");
        } else if (!ACCEPT_ANY(cv, words)) {
            return;
        }
    }
}

// ---- polynomials
// ----------------------------------------------------------------------------------------

static void parse_coefficients(Converter *cv, int count, const char *where) {
    optional_comma(cv);
    expect(cv, '<', where);
    floats(cv, count);
    optional_comma(cv);
    expect(cv, '>', where);
}

// (order + 1)(order + 2)(order + 3) / 6 coefficients
static void parse_poly(Converter *cv, ObjectNode *object) {
    int order = 3;
    if (object->keyword == KW_quartic)
        order = 4;
    if (object->keyword == KW_poly) {
        const Token *token = peek_token(cv);
        double given = parse_float(cv);
        if (!(given >= 2 && given <= 35)) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "the order of a poly must be from 2 to 35");
        }
        order = (int)given;
    }
    parse_coefficients(cv, (order + 1) * (order + 2) * (order + 3) / 6,
                       keyword_name(object->keyword));
}

// F { xyz(F, F, F): F }*
static void parse_polynomial(Converter *cv, ObjectNode *object) {
    (void)object;
    parse_float(cv);
    optional_comma(cv);
    while (accept(cv, KW_xyz)) {
        expect(cv, '(', "xyz");
        floats(cv, 3);
        expect(cv, ')', "xyz");
        expect(cv, ':', "xyz");
        parse_float(cv);
        optional_comma(cv);
    }
}

static void parse_quadric(Converter *cv, ObjectNode *object) {
    (void)object;
    vectors(cv, 3);
    optional_comma(cv);
    parse_float(cv);
}

// ---- the rest
// -------------------------------------------------------------------------------------------

static void parse_height_field(Converter *cv, ObjectNode *object) {
    (void)object;
    Picture picture;
    parse_image(cv, &picture, false);
    for (;;) {
        if (accept(cv, KW_water_level))
            parse_float(cv);
        else if (!accept(cv, KW_smooth))
            return;
    }
}

static void parse_lathe(Converter *cv, ObjectNode *object) {
    (void)object;
    accept_spline_word(cv);
    uvs(cv, count_of(cv, "lathe", 2));
}

static void parse_sor(Converter *cv, ObjectNode *object) {
    (void)object;
    uvs(cv, count_of(cv, "sor", 4));
    optional_comma(cv);
    accept(cv, KW_open);
}

static void parse_prism(Converter *cv, ObjectNode *object) {
    (void)object;
    while (accept_spline_word(cv) || accept(cv, KW_linear_sweep) || accept(cv, KW_conic_sweep)) {
    }
    floats(cv, 2);
    optional_comma(cv);
    uvs(cv, count_of(cv, "prism", 3));
    optional_comma(cv);
    accept(cv, KW_open);
}

static void parse_polygon(Converter *cv, ObjectNode *object) {
    (void)object;
    vectors(cv, count_of(cv, "polygon", 3));
}

static void parse_smooth_triangle(Converter *cv, ObjectNode *object) {
    (void)object;
    vectors(cv, 6);
}

static void parse_sphere_sweep(Converter *cv, ObjectNode *object) {
    (void)object;
    if (!accept_spline_word(cv))
        die_expected(cv, "linear_spline, cubic_spline or b_spline");
    int count = count_of(cv, "sphere_sweep", 2);
    for (int i = 0; i < count; i++) {
        parse_vector(cv);
        optional_comma(cv);
        parse_float(cv);
        optional_comma(cv);
    }
    if (accept(cv, KW_tolerance))
        parse_float(cv);
}

static void parse_superellipsoid(Converter *cv, ObjectNode *object) {
    (void)object;
    parse_uv(cv);
}

static void parse_ovus(Converter *cv, ObjectNode *object) {
    (void)object;
    floats(cv, 2);
}

// ttf S | internal F; S [,] F [,] V
static void parse_text(Converter *cv, ObjectNode *object) {
    (void)object;
    if (accept(cv, KW_internal)) {
        parse_float(cv);
    } else {
        expect(cv, KW_ttf, "text");
        parse_required_file(cv, FILE_FONT);
    }
    optional_comma(cv);
    parse_string(cv);
    optional_comma(cv);
    parse_float(cv);
    optional_comma(cv);
    parse_vector(cv);
}

ParseShape *shape_other_parser(int keyword) {
    static const struct {
        int keyword;
        ParseShape *parse;
    } shapes[] = {
        {KW_blob, parse_blob},
        {KW_cubic, parse_poly},
        {KW_height_field, parse_height_field},
        {KW_isosurface, parse_isosurface},
        {KW_julia_fractal, parse_julia_fractal},
        {KW_lathe, parse_lathe},
        {KW_mesh, parse_mesh},
        {KW_mesh2, parse_mesh2},
        {KW_ovus, parse_ovus},
        {KW_parametric, parse_parametric},
        {KW_poly, parse_poly},
        {KW_polygon, parse_polygon},
        {KW_polynomial, parse_polynomial},
        {KW_prism, parse_prism},
        {KW_quadric, parse_quadric},
        {KW_quartic, parse_poly},
        {KW_smooth_triangle, parse_smooth_triangle},
        {KW_sor, parse_sor},
        {KW_sphere_sweep, parse_sphere_sweep},
        {KW_superellipsoid, parse_superellipsoid},
        {KW_text, parse_text},
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (shapes[i].keyword == keyword)
            return shapes[i].parse;
    return NULL;
}
