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

static void parse_parametric(Converter *cv, ObjectNode *object) {
    (void)object;
    for (int i = 0; i < 3; i++)
        parse_function_body(cv, "parametric");
    uvs(cv, 2);
    while (parse_function_option(cv)) {
    }
}

// V4 [,] F
static void parse_slice(Converter *cv) {
    double v[4];
    Loc loc = here(cv);
    parse_vector4(cv, v);
    if (v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0)
        die_at(&loc, "Slice vector is zero");
    optional_comma(cv);
    parse_float(cv);
}

static void parse_julia_fractal(Converter *cv, ObjectNode *object) {
    static const int words[] = {KW_sqr,  KW_cube,  KW_exp,  KW_reciprocal, KW_sin,  KW_asin,
                                KW_sinh, KW_asinh, KW_cos,  KW_acos,       KW_cosh, KW_acosh,
                                KW_tan,  KW_atan,  KW_tanh, KW_atanh,      KW_ln};
    static const int numbers[] = {KW_max_iteration, KW_precision};
    bool quaternion = true;
    const Token *function = NULL;
    double v[4];
    (void)object;
    parse_vector4(cv, v);
    for (;;) {
        const Token *token = peek_token(cv);
        if (ACCEPT_ANY(cv, numbers)) {
            parse_float(cv);
        } else if (accept(cv, KW_slice)) {
            parse_slice(cv);
        } else if (accept(cv, KW_pwr) || accept(cv, KW_pow)) {
            expect(cv, '(', "pwr");
            floats(cv, 2);
            expect(cv, ')', "pwr");
            function = token;
        } else if (accept(cv, KW_hypercomplex) || accept(cv, KW_quaternion)) {
            quaternion = token->code == KW_quaternion;
        } else if (ACCEPT_ANY(cv, words)) {
            function = token;
        } else {
            break;
        }
    }
    if (quaternion && function && function->code != KW_sqr && function->code != KW_cube) {
        Loc loc = token_loc(cv, function);
        die_at(&loc, "Illegal function: quaternion only supports sqr and cube");
    }
}

ParseShape *shape_other_parser(int keyword) {
    static const struct {
        int keyword;
        ParseShape *parse;
    } shapes[] = {
        {KW_julia_fractal, parse_julia_fractal},
        {KW_parametric, parse_parametric},
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (shapes[i].keyword == keyword)
            return shapes[i].parse;
    return NULL;
}
