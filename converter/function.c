// SPDX-License-Identifier: MIT
// Declarations of user functions, and their values while the scene is read. All that is declared is
// kept in one list, in the scene's own form, so that one machine runs them here and in the
// renderer.
#include "converter/function.h"

#include "converter/probing.h"
#include "noise/noise.h"

#include <string.h>

// ---- the declaration --------------------------------------------------------------------------

static bool is_axis(int code) {
    return code == KW_x || code == KW_y || code == KW_z || code == KW_u || code == KW_v;
}

// [ ( NAME [,] ... ) ]: without a list x, y, z. True: there is a list.
static bool parse_parameters(FunctionReader *r) {
    Converter *cv = r->cv;
    if (!accept(cv, '(')) {
        static const int axes[3] = {KW_x, KW_y, KW_z};
        memcpy(r->codes, axes, sizeof axes);
        r->parameter_count = 3;
        return false;
    }
    do {
        const Token *token = peek_token(cv);
        bool fresh = token->code == TOK_IDENTIFIER && !ahead_place(cv);
        if (!fresh && !is_axis(token->code)) {
            Loc loc = token_loc(cv, token);
            die_at(&loc,
                   "Expected 'parameter identifier', %s found instead: a function's "
                   "parameter must be a new name or one of x y z u v",
                   token_describe(cv, token));
        }
        if (r->parameter_count == FUNCTION_MAX_PARAMETERS)
            die_expected(cv, "no more than 256 parameters");
        next_token(cv);
        r->codes[r->parameter_count] = token->code;
        r->names[r->parameter_count++] = token->name;
        optional_comma(cv);
    } while (!accept(cv, ')'));
    return true;
}

// internal ( F ): a formula of one step.
static void parse_internal(FunctionReader *r, Function *out) {
    Converter *cv = r->cv;
    expect(cv, '(', "internal");
    const Token *start = peek_token(cv);
    double number = parse_float(cv);
    int count = number >= 0 && number < FUNCTION_INTERNAL_COUNT
                    ? function_internal_arguments((int)number)
                    : 0;
    if (count == 0) {
        Loc loc = token_loc(cv, start);
        die_at(&loc, "Function 'internal(%g)' does not exist", number);
    }
    expect(cv, ')', "internal");
    *out = function_default(FUNCTION_FORMULA);
    out->parameters = out->registers = out->stack = count;
    out->steps = ARENA_ARRAY(cv->arena, FunctionStep, 2);
    out->step_count = 2;
    out->steps[0] = (FunctionStep){.op = FUNCTION_INTERNAL, .a = (int)number};
    out->steps[1] = (FunctionStep){.op = FUNCTION_RETURN};
}

// pigment { }, pattern { }: which of them it is is kept by number.
static void parse_pigment_function(FunctionReader *r, FunctionType type, Function *out) {
    Converter *cv = r->cv;
    Language *l = cv->language;
    Value value;
    if (!parse_statement_value(cv, &value))
        die_expected(cv, "a function's body");
    *out = function_default(type);
    out->stack = 3;
    out->pigment = (uint32_t)l->function_pigments.count;
    FunctionPigment pigment = {.node = value.node, .loc = r->loc};
    list_push(cv, &l->function_pigments, pigment);
}

// A body that is no formula; false: it is one.
static bool parse_special(FunctionReader *r, bool listed, Function *out) {
    Converter *cv = r->cv;
    if (accept(cv, KW_internal)) {
        parse_internal(r, out);
        return true;
    }
    int code = peek_token(cv)->code;
    if (code != KW_spline && code != KW_transform && code != KW_pigment && code != KW_pattern)
        return false;
    if (listed) {
        Loc loc = here(cv);
        die_at(&loc, "Function parameters for %s functions are not allowed", keyword_name(code));
    }
    if (code == KW_spline) {
        next_token(cv);
        *out = function_default(FUNCTION_SPLINE);
        out->stack = 1;
        out->spline = *parse_spline(cv);
    } else if (code == KW_transform) {
        next_token(cv);
        *out = function_default(FUNCTION_TRANSFORM);
        out->stack = 3;
        out->transform = parse_transform(cv);
    } else {
        parse_pigment_function(r, code == KW_pigment ? FUNCTION_PIGMENT : FUNCTION_PATTERN, out);
    }
    return true;
}

UserFunction *parse_function(Converter *cv) {
    enter_level(cv);
    bool held = release_directives(cv);
    FunctionReader *r = ARENA_NEW(cv->arena, FunctionReader);
    r->cv = cv;
    bool listed = parse_parameters(r);
    UserFunction *user = ARENA_NEW(cv->arena, UserFunction);
    user->loc = r->loc = here(cv);
    expect(cv, '{', "function");
    accept(cv, TOK_STRING);
    Function f;
    if (!parse_special(r, listed, &f)) {
        Expr *body = function_parse_body(r);
        function_fold(cv, body);
        user->calls = function_compile(r, body, &f);
    }
    expect(cv, '}', "function");
    user->index = (uint32_t)cv->language->functions.count;
    list_push(cv, &cv->language->functions, f);
    restore_directives(cv, held);
    leave_level(cv);
    return user;
}

// ---- evaluation -------------------------------------------------------------------------------

static const Function *code_of(const Converter *cv, const UserFunction *user) {
    return &cv->language->functions.items[user->index];
}

uint32_t user_function_number(const UserFunction *user) { return user->index; }

int user_function_parameters(const Converter *cv, const UserFunction *user) {
    return code_of(cv, user)->parameters;
}

int user_function_width(const Converter *cv, const UserFunction *user) {
    return function_width(code_of(cv, user));
}

// The pigment of a function, ready to be asked.
static const Probe *pigment_probe(const void *world, uint32_t pigment, uint32_t *index) {
    Converter *cv = (Converter *)(uintptr_t)world;
    const FunctionPigment *asked = &cv->language->function_pigments.items[pigment];
    const char *gap;
    const Probe *probe = probing_pigment(cv, asked->node, index, &gap);
    if (!probe)
        die_at(&asked->loc, "The value of this function is needed to read this scene: %s", gap);
    return probe;
}

static void pigment_value(const void *world, uint32_t pigment, Vec3 p,
                          double color[FUNCTION_WIDTH]) {
    uint32_t index;
    const Probe *probe = pigment_probe(world, pigment, &index);
    probe_color(probe, index, p, color);
}

static double pattern_value(const void *world, uint32_t pigment, Vec3 p) {
    uint32_t index;
    const Probe *probe = pigment_probe(world, pigment, &index);
    return probe_pattern(probe, index, p);
}

// What the functions of the scene being read are to the machine.
static FunctionPool function_pool(Converter *cv) {
    static const FunctionHooks hooks = {pigment_value, pattern_value};
    noise_prepare();
    return (FunctionPool){.functions = cv->language->functions.items,
                          .noise_generator = cv->noise_generator,
                          .hooks = &hooks,
                          .world = cv};
}

int user_function_evaluate(Converter *cv, const UserFunction *user, const double *arguments,
                           double e[5]) {
    const FunctionPool pool = function_pool(cv);
    uint64_t budget = FUNCTION_BUDGET;
    int width = function_vector(&pool, user->index, arguments, e, &budget);
    if (budget == 0)
        die_at(&user->loc, "The evaluation of this function has run too long");
    check_limits(cv, (FUNCTION_BUDGET - budget) / 8 + 1);
    return width;
}
