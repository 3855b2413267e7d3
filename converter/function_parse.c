// SPDX-License-Identifier: MIT
// User functions (facts: sdl 2.7): the body's own small language, compiled to a postfix program for
// a stack of doubles.
//
//   OR     := AND { '|' AND }
//   AND    := COMPARE { '&' COMPARE }
//   COMPARE:= SUM { ('=' | '!=' | '<' | '<=' | '>' | '>=') SUM }
//   SUM    := PRODUCT { ('+' | '-') PRODUCT }
//   PRODUCT:= UNARY { ('*' | '/') UNARY }
//   UNARY  := { '+' | '-' } PRIMARY
//
// Comparisons are exact here. Bodies that are no formula (pigment, pattern, transform, spline,
// internal) are kept as what they are.
#include "converter/function.h"

#include <limits.h>
#include <math.h>
#include <string.h>

typedef struct {
    Converter *cv;
    Function *f;
    int codes[MAX_PARAMETERS]; // TOK_IDENTIFIER or KW_x and its like
    uint32_t names[MAX_PARAMETERS];
    uint32_t local_names[MAX_LOCALS];
    int local_count; // that are visible
    bool listed;     // there is a list of parameters
} Compiler;

static void parse_or(Compiler *c);

// ---- emitting ---------------------------------------------------------------------------------

static size_t emit(Compiler *c, Instruction instruction, int growth) {
    Function *f = c->f;
    list_push(c->cv, &f->code, instruction);
    f->depth += growth;
    if (f->depth > f->max_depth)
        f->max_depth = f->depth;
    if (f->depth >= MAX_STACK) {
        Loc loc = here(c->cv);
        die_at(&loc, "This function is too deeply nested");
    }
    return f->code.count - 1;
}

static void emit_constant(Compiler *c, double value) {
    emit(c, (Instruction){.op = OP_CONSTANT, .value = value}, 1);
}

static void emit_argument(Compiler *c, int index) {
    emit(c, (Instruction){.op = OP_ARGUMENT, .i = index}, 1);
}

// ---- calls ------------------------------------------------------------------------------------

static double to_radians(double v) { return v * (M_PI / 180.0); }
static double to_degrees(double v) { return v * (180.0 / M_PI); }
static double to_integer(double v) {
    return v > -2147483649.0 && v < 2147483648.0 ? trunc(v) : INT_MIN;
}
static double minimum(double a, double b) { return b < a ? b : a; }
static double maximum(double a, double b) { return b > a ? b : a; }
static double integer_divide(double a, double b) { return to_integer(a / b); }

static const struct {
    int code;
    double (*of)(double);
} unary_calls[] = {
    {KW_sin, sin},
    {KW_cos, cos},
    {KW_tan, tan},
    {KW_asin, asin},
    {KW_acos, acos},
    {KW_atan, atan},
    {KW_sinh, sinh},
    {KW_cosh, cosh},
    {KW_tanh, tanh},
    {KW_asinh, asinh},
    {KW_acosh, acosh},
    {KW_atanh, atanh},
    {KW_abs, fabs},
    {KW_sqrt, sqrt},
    {KW_radians, to_radians},
    {KW_degrees, to_degrees},
    {KW_floor, floor},
    {KW_ceil, ceil},
    {KW_int, to_integer},
    {KW_exp, exp},
    {KW_ln, log},
    {KW_log, log10},
};

static const struct {
    int code;
    double (*of)(double, double);
} binary_calls[] = {
    {KW_atan2, atan2},        {KW_pow, pow},     {KW_mod, fmod},
    {KW_div, integer_divide}, {KW_min, minimum}, {KW_max, maximum},
};

// ( OR )
static bool compile_unary_call(Compiler *c, int code) {
    for (size_t i = 0; i < sizeof unary_calls / sizeof *unary_calls; i++) {
        if (unary_calls[i].code != code)
            continue;
        expect(c->cv, '(', "function");
        parse_or(c);
        expect(c->cv, ')', "function");
        emit(c, (Instruction){.op = OP_CALL1, .one = unary_calls[i].of}, 0);
        return true;
    }
    return false;
}

// ( OR , OR ) and more of them for min and max
static bool compile_binary_call(Compiler *c, int code) {
    for (size_t i = 0; i < sizeof binary_calls / sizeof *binary_calls; i++) {
        if (binary_calls[i].code != code)
            continue;
        expect(c->cv, '(', "function");
        parse_or(c);
        expect(c->cv, ',', "function");
        do {
            parse_or(c);
            emit(c, (Instruction){.op = OP_CALL2, .two = binary_calls[i].of}, -1);
        } while ((code == KW_min || code == KW_max) && accept(c->cv, ','));
        expect(c->cv, ')', "function");
        return true;
    }
    return false;
}

// ( OR , OR , OR [, OR] )
static void compile_select(Compiler *c) {
    expect(c->cv, '(', "select");
    for (int i = 0; i < 3; i++) {
        parse_or(c);
        if (i < 2)
            expect(c->cv, ',', "select");
    }
    if (accept(c->cv, ',')) {
        parse_or(c);
        emit(c, (Instruction){.op = OP_SELECT4}, -3);
    } else {
        emit(c, (Instruction){.op = OP_SELECT3}, -2);
    }
    expect(c->cv, ')', "select");
}

// (sum|prod) ( NAME , OR , OR , OR )
static void compile_series(Compiler *c, Op op) {
    expect(c->cv, '(', "sum or prod");
    if (!next_is(c->cv, TOK_IDENTIFIER))
        die_expected(c->cv, "the name of the running index");
    if (c->local_count == MAX_LOCALS) {
        Loc loc = here(c->cv);
        die_at(&loc, "Sum and prod are nested too deeply (%d)", MAX_LOCALS);
    }
    uint32_t name = next_token(c->cv)->name;
    expect(c->cv, ',', "sum or prod");
    parse_or(c);
    expect(c->cv, ',', "sum or prod");
    parse_or(c);
    expect(c->cv, ',', "sum or prod");
    int slot = c->local_count++;
    c->local_names[slot] = name;
    if (c->local_count > c->f->locals)
        c->f->locals = c->local_count;
    size_t at = emit(c, (Instruction){.op = op, .i = slot}, -2);
    parse_or(c);
    c->f->code.items[at].length = c->f->code.count - at - 1;
    c->local_count--;
    expect(c->cv, ')', "sum or prod");
}

// ( OR [,] ... ) [ '.' member ]
static void compile_user_call(Compiler *c, const Function *user) {
    static const int members[][2] = {
        {KW_x, 0}, {KW_u, 0},    {KW_red, 0},   {KW_y, 1}, {KW_v, 1},      {KW_green, 1},
        {KW_z, 2}, {KW_blue, 2}, {KW_gray, -1}, {KW_t, 3}, {KW_filter, 3}, {KW_transmit, 4}};
    expect(c->cv, '(', "function call");
    for (int i = 0; i < user->parameter_count; i++) {
        if (i)
            optional_comma(c->cv);
        parse_or(c);
    }
    expect(c->cv, ')', "function call");
    int component = 0;
    if (function_width(user) > 1) {
        expect(c->cv, '.', "function of several components");
        size_t m = 0, count = sizeof members / sizeof *members;
        while (m < count && !next_is(c->cv, members[m][0]))
            m++;
        if (m == count)
            die_expected(c->cv, "x, y, z, t or a color component");
        next_token(c->cv);
        component = members[m][1];
    }
    if (user->calls >= c->f->calls)
        c->f->calls = user->calls + 1;
    if (c->f->calls > MAX_CALL_DEPTH) {
        Loc loc = here(c->cv);
        die_at(&loc, "Functions call functions too deeply (%d levels)", MAX_CALL_DEPTH);
    }
    emit(c, (Instruction){.op = OP_USER, .i = component, .user = user}, 1 - user->parameter_count);
}

// ---- primaries --------------------------------------------------------------------------------

// x and u, y and v, z: the parameter of either name, 0 if there is none.
static void compile_axis(Compiler *c, int code) {
    static const int groups[3][2] = {{KW_x, KW_u}, {KW_y, KW_v}, {KW_z, KW_z}};
    int group = code == KW_x || code == KW_u ? 0 : code == KW_z ? 2 : 1;
    for (int i = 0; i < c->f->parameter_count; i++) {
        if (c->codes[i] == groups[group][0] || c->codes[i] == groups[group][1]) {
            emit_argument(c, i);
            return;
        }
    }
    emit_constant(c, 0);
}

static void compile_identifier(Compiler *c, const Token *token) {
    Converter *cv = c->cv;
    for (int i = c->local_count; i-- > 0;) {
        if (c->local_names[i] == token->name) {
            next_token(cv);
            emit(c, (Instruction){.op = OP_LOCAL, .i = i}, 1);
            return;
        }
    }
    for (int i = 0; i < c->f->parameter_count; i++) {
        if (c->codes[i] == TOK_IDENTIFIER && c->names[i] == token->name) {
            next_token(cv);
            emit_argument(c, i);
            return;
        }
    }
    ValueType type = peek_value_type(cv);
    const Value *value;
    if ((value = accept_value(cv, VALUE_FLOAT)))
        emit_constant(c, value->c[0]);
    else if (type == VALUE_FUNCTION)
        compile_user_call(c, accept_value(cv, VALUE_FUNCTION)->node);
    else
        die_expected(cv, "a float, a parameter or a function in the function's body");
}

static void parse_primary(Compiler *c) {
    Converter *cv = c->cv;
    const Token *token = peek_token(cv);
    switch (token->code) {
    case TOK_NUMBER:
        emit_constant(c, next_token(cv)->number);
        return;
    case TOK_IDENTIFIER:
        compile_identifier(c, token);
        return;
    case '(':
        next_token(cv);
        parse_or(c);
        expect(cv, ')', "function");
        return;
    case KW_pi:
        next_token(cv);
        emit_constant(c, M_PI);
        return;
    case KW_clock:
        next_token(cv);
        emit_constant(c, (double)(float)cv->options->clock);
        return;
    case KW_x:
    case KW_y:
    case KW_z:
    case KW_u:
    case KW_v:
        next_token(cv);
        compile_axis(c, token->code);
        return;
    default:
        break;
    }
    if (token->code < KW_FIRST)
        die_expected(cv, "a number, a parameter or a function in the function's body");
    next_token(cv);
    if (token->code == KW_select)
        compile_select(c);
    else if (token->code == KW_sum || token->code == KW_prod)
        compile_series(c, token->code == KW_sum ? OP_SUM : OP_PRODUCT);
    else if (!compile_unary_call(c, token->code) && !compile_binary_call(c, token->code)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "'%s' cannot stand in a function's body", token->text);
    }
}

// ---- operators --------------------------------------------------------------------------------

static void parse_unary(Compiler *c) {
    bool negative = false;
    for (;;) {
        if (accept(c->cv, '-'))
            negative = !negative;
        else if (!accept(c->cv, '+'))
            break;
    }
    parse_primary(c);
    if (negative)
        emit(c, (Instruction){.op = OP_NEGATE}, 0);
}

// The binary operators, loosest first. ORDER precedence
static const struct {
    int code, level;
    Op op;
} operators[] = {
    {'|', 0, OP_OR},       {'&', 1, OP_AND},
    {'=', 2, OP_EQUAL},    {TOK_NE, 2, OP_NOT_EQUAL},
    {'<', 2, OP_LESS},     {TOK_LE, 2, OP_LESS_EQUAL},
    {'>', 2, OP_GREATER},  {TOK_GE, 2, OP_GREATER_EQUAL},
    {'+', 3, OP_ADD},      {'-', 3, OP_SUBTRACT},
    {'*', 4, OP_MULTIPLY}, {'/', 4, OP_DIVIDE},
};
enum { UNARY_LEVEL = 5 };

static void parse_binary(Compiler *c, int level) {
    if (level == UNARY_LEVEL) {
        parse_unary(c);
        return;
    }
    parse_binary(c, level + 1);
    for (size_t i = 0; i < sizeof operators / sizeof *operators;) {
        if (operators[i].level != level || !accept(c->cv, operators[i].code)) {
            i++;
            continue;
        }
        parse_binary(c, level + 1);
        emit(c, (Instruction){.op = operators[i].op}, -1);
        i = 0;
    }
}

static void parse_or(Compiler *c) {
    enter_level(c->cv);
    parse_binary(c, 0);
    leave_level(c->cv);
}

// ---- the declaration --------------------------------------------------------------------------

static bool is_axis(int code) {
    return code == KW_x || code == KW_y || code == KW_z || code == KW_u || code == KW_v;
}

// [ ( NAME [,] ... ) ]: without a list x, y, z.
static void parse_parameters(Compiler *c) {
    Converter *cv = c->cv;
    Function *f = c->f;
    if (!accept(cv, '(')) {
        static const int axes[3] = {KW_x, KW_y, KW_z};
        for (; f->parameter_count < 3; f->parameter_count++)
            c->codes[f->parameter_count] = axes[f->parameter_count];
        return;
    }
    c->listed = true;
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
        if (f->parameter_count == MAX_PARAMETERS)
            die_expected(cv, "no more than 256 parameters");
        next_token(cv);
        c->codes[f->parameter_count] = token->code;
        c->names[f->parameter_count++] = token->name;
        optional_comma(cv);
    } while (!accept(cv, ')'));
}

// How many arguments the built-in functions take: x, y, z and their own.
static const unsigned char internal_counts[] = {
    8, 8, 8, 8, 5, 5, 8, 7, 5, 4, 7, 4, 4, 4,  4, 9, 9, 6, 4, 7, 6, 9, 4, 4,  13, 10, 10,
    4, 4, 9, 4, 6, 7, 6, 9, 4, 4, 7, 4, 9, 8,  4, 4, 4, 7, 4, 6, 3, 4, 4, 10, 8,  9,  4,
    4, 4, 6, 3, 9, 9, 7, 4, 8, 7, 9, 4, 7, 10, 5, 3, 5, 6, 4, 4, 5, 9, 3, 3,  4,
};

// internal ( F )
static void parse_internal(Compiler *c) {
    Converter *cv = c->cv;
    Function *f = c->f;
    f->kind = BODY_INTERNAL;
    expect(cv, '(', "internal");
    const Token *start = peek_token(cv);
    double number = parse_float(cv);
    if (!(number >= 0 && number < sizeof internal_counts)) {
        Loc loc = token_loc(cv, start);
        die_at(&loc, "Function 'internal(%g)' does not exist", number);
    }
    f->internal = (int)number;
    if (!c->listed)
        f->parameter_count = internal_counts[f->internal];
    expect(cv, ')', "internal");
}

static bool parse_special(Compiler *c) {
    Converter *cv = c->cv;
    Function *f = c->f;
    if (accept(cv, KW_internal)) {
        parse_internal(c);
    } else if (accept(cv, KW_spline)) {
        f->kind = BODY_SPLINE;
        f->parameter_count = 1;
        f->spline = parse_spline(cv);
    } else if (next_is(cv, KW_transform) || next_is(cv, KW_pigment) || next_is(cv, KW_pattern)) {
        f->kind = next_is(cv, KW_transform) ? BODY_TRANSFORM
                  : next_is(cv, KW_pigment) ? BODY_PIGMENT
                                            : BODY_PATTERN;
        if (!parse_statement_value(cv, &f->value))
            die_expected(cv, "a function's body");
    } else {
        return false;
    }
    return true;
}

Function *parse_function(Converter *cv) {
    enter_level(cv);
    bool held = release_directives(cv);
    Compiler *c = ARENA_NEW(cv->arena, Compiler);
    c->cv = cv;
    Function *f = c->f = ARENA_NEW(cv->arena, Function);
    parse_parameters(c);
    f->loc = here(cv);
    expect(cv, '{', "function");
    accept(cv, TOK_STRING);
    if (!parse_special(c))
        parse_or(c);
    expect(cv, '}', "function");
    restore_directives(cv, held);
    leave_level(cv);
    return f;
}
