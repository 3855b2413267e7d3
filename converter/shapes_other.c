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

static bool accept_any(Converter *cv, const int *codes, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (accept(cv, codes[i]))
            return true;
    return false;
}
#define ACCEPT_ANY(cv, codes) accept_any((cv), (codes), sizeof(codes) / sizeof *(codes))

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
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (shapes[i].keyword == keyword)
            return shapes[i].parse;
    return NULL;
}
