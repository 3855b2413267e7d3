// SPDX-License-Identifier: MIT
// The body of a user function (facts: sdl 2.7): a small language of its own.
//
//   OR     := AND { '|' AND }
//   AND    := COMPARE { '&' COMPARE }
//   COMPARE:= SUM { ('=' | '!=' | '<' | '<=' | '>' | '>=') SUM }
//   SUM    := PRODUCT { ('+' | '-') PRODUCT }
//   PRODUCT:= UNARY { ('*' | '/') UNARY }
//   UNARY  := [ '+' | '-' ] PRIMARY
//
// Each level is kept as a chain of its operands, since that is what POV-Ray folds constants in.
#include "converter/function.h"

#include <string.h>

static Expr *parse_or(FunctionReader *r);

static Expr *expr_new(FunctionReader *r, ExprKind kind) {
    Expr *e = ARENA_NEW(r->cv->arena, Expr);
    e->kind = kind;
    return e;
}

static Expr *constant(FunctionReader *r, double value) {
    Expr *e = expr_new(r, EXPR_CONSTANT);
    e->number = value;
    return e;
}

static Expr *variable(FunctionReader *r, ExprKind kind, int index) {
    Expr *e = expr_new(r, kind);
    e->variable = true;
    e->index = index;
    return e;
}

// ---- calls ------------------------------------------------------------------------------------

typedef struct {
    int code, least, most;
} CallShape;

enum { ANY = 1 << 30 };
static const CallShape call_shapes[] = {
    {KW_sin, 1, 1},   {KW_cos, 1, 1},     {KW_tan, 1, 1},   {KW_asin, 1, 1},   {KW_acos, 1, 1},
    {KW_atan, 1, 1},  {KW_sinh, 1, 1},    {KW_cosh, 1, 1},  {KW_tanh, 1, 1},   {KW_asinh, 1, 1},
    {KW_acosh, 1, 1}, {KW_atanh, 1, 1},   {KW_abs, 1, 1},   {KW_sqrt, 1, 1},   {KW_radians, 1, 1},
    {KW_floor, 1, 1}, {KW_degrees, 1, 1}, {KW_ceil, 1, 1},  {KW_int, 1, 1},    {KW_exp, 1, 1},
    {KW_ln, 1, 1},    {KW_log, 1, 1},     {KW_atan2, 2, 2}, {KW_pow, 1, ANY},  {KW_mod, 2, 2},
    {KW_div, 2, 2},   {KW_min, 2, ANY},   {KW_max, 2, ANY}, {KW_select, 3, 4},
};

static const CallShape *find_call(int code) {
    for (size_t i = 0; i < sizeof call_shapes / sizeof *call_shapes; i++)
        if (call_shapes[i].code == code)
            return &call_shapes[i];
    return NULL;
}

// ( OR , OR ... ): at least and at most so many.
static void parse_arguments(FunctionReader *r, Expr *call, int least, int most, const char *where) {
    expect(r->cv, '(', where);
    Expr **end = &call->child;
    for (int count = 0; count < least || (count < most && next_is(r->cv, ',')); count++) {
        if (count > 0)
            expect(r->cv, ',', where);
        *end = parse_or(r);
        call->variable = call->variable || (*end)->variable;
        end = &(*end)->next;
    }
    expect(r->cv, ')', where);
}

// (sum|prod) ( NAME , OR , OR , OR )
static Expr *parse_series(FunctionReader *r, const Token *token) {
    Expr *call = expr_new(r, EXPR_CALL);
    *call = (Expr){.kind = EXPR_CALL, .code = token->code, .token = token, .variable = true};
    expect(r->cv, '(', "sum or prod");
    if (!next_is(r->cv, TOK_IDENTIFIER))
        die_expected(r->cv, "the name of the running index");
    if (r->series_count == MAX_SERIES) {
        Loc loc = here(r->cv);
        die_at(&loc, "Sum and prod are nested too deeply (%d)", MAX_SERIES);
    }
    uint32_t name = next_token(r->cv)->name;
    expect(r->cv, ',', "sum or prod");
    call->child = parse_or(r);
    expect(r->cv, ',', "sum or prod");
    call->child->next = parse_or(r);
    expect(r->cv, ',', "sum or prod");
    call->index = r->series_count++;
    r->series_names[call->index] = name;
    call->child->next->next = parse_or(r);
    r->series_count--;
    expect(r->cv, ')', "sum or prod");
    return call;
}

static int parse_member(FunctionReader *r) {
    static const int members[][2] = {{KW_x, 0},      {KW_u, 0},        {KW_red, 0},
                                     {KW_y, 1},      {KW_v, 1},        {KW_green, 1},
                                     {KW_z, 2},      {KW_blue, 2},     {KW_t, 3},
                                     {KW_filter, 3}, {KW_transmit, 4}, {KW_gray, MEMBER_GRAY}};
    const Token *token = peek_token(r->cv);
    for (size_t m = 0; m < sizeof members / sizeof *members; m++) {
        if (token->code == members[m][0]) {
            next_token(r->cv);
            return members[m][1];
        }
    }
    // Two that are no reserved words.
    for (int m = 0; token->code == TOK_IDENTIFIER && m < 2; m++) {
        static const char *const names[] = {"grey", "hf"};
        if (strcmp(token->text, names[m]) == 0 && !ahead_place(r->cv)) {
            next_token(r->cv);
            return m == 0 ? MEMBER_GRAY : MEMBER_HEIGHT;
        }
    }
    die_expected(r->cv, "x, y, z, t or a color component");
}

// ( OR , ... ) [ '.' member ]
static Expr *parse_user_call(FunctionReader *r, const Token *token, const UserFunction *user) {
    const Function *f = &r->cv->language->functions.items[user->index];
    Expr *call = expr_new(r, EXPR_USER);
    call->user = user;
    call->token = token;
    parse_arguments(r, call, f->parameters, f->parameters, "function call");
    if (function_width(f) > 1) {
        expect(r->cv, '.', "function of several components");
        call->member = parse_member(r);
    }
    return call;
}

// ---- primaries --------------------------------------------------------------------------------

// x and u, y and v, z: the parameter of either name, 0 if there is none.
static Expr *parse_axis(FunctionReader *r, int code) {
    static const int groups[3][2] = {{KW_x, KW_u}, {KW_y, KW_v}, {KW_z, KW_z}};
    int group = code == KW_x || code == KW_u ? 0 : code == KW_z ? 2 : 1;
    for (int i = r->parameter_count; i-- > 0;)
        if (r->codes[i] == groups[group][0] || r->codes[i] == groups[group][1])
            return variable(r, EXPR_PARAMETER, i);
    return variable(r, EXPR_ABSENT, 0);
}

static Expr *parse_identifier(FunctionReader *r, const Token *token) {
    Converter *cv = r->cv;
    for (int i = r->series_count; i-- > 0;) {
        if (r->series_names[i] == token->name) {
            next_token(cv);
            return variable(r, EXPR_LOCAL, i);
        }
    }
    for (int i = 0; i < r->parameter_count; i++) {
        if (r->codes[i] == TOK_IDENTIFIER && r->names[i] == token->name) {
            next_token(cv);
            return variable(r, EXPR_PARAMETER, i);
        }
    }
    ValueType type = peek_value_type(cv);
    const Value *value;
    if ((value = accept_value(cv, VALUE_FLOAT)))
        return constant(r, value->c[0]);
    if (type != VALUE_FUNCTION)
        die_expected(cv, "a float, a parameter or a function in the function's body");
    return parse_user_call(r, token, accept_value(cv, VALUE_FUNCTION)->node);
}

static Expr *parse_keyword(FunctionReader *r, const Token *token) {
    if (token->code < KW_FIRST)
        die_expected(r->cv, "a number, a parameter or a function in the function's body");
    next_token(r->cv);
    switch (token->code) {
    case KW_pi:
        return constant(r, M_PI);
    case KW_clock:
        return constant(r, (double)(float)r->cv->options->clock);
    case KW_x:
    case KW_y:
    case KW_z:
    case KW_u:
    case KW_v:
        return parse_axis(r, token->code);
    case KW_sum:
    case KW_prod:
        return parse_series(r, token);
    default:
        break;
    }
    const CallShape *shape = find_call(token->code);
    if (!shape) {
        Loc loc = token_loc(r->cv, token);
        die_at(&loc, "'%s' cannot stand in a function's body", token->text);
    }
    Expr *call = expr_new(r, EXPR_CALL);
    call->code = token->code;
    call->token = token;
    parse_arguments(r, call, shape->least, shape->most, token->text);
    return call;
}

static Expr *parse_primary(FunctionReader *r) {
    const Token *token = peek_token(r->cv);
    if (token->code == TOK_NUMBER)
        return constant(r, next_token(r->cv)->number);
    if (token->code == TOK_IDENTIFIER)
        return parse_identifier(r, token);
    if (token->code != '(')
        return parse_keyword(r, token);
    next_token(r->cv);
    Expr *group = expr_new(r, EXPR_GROUP);
    group->child = parse_or(r);
    group->variable = group->child->variable;
    expect(r->cv, ')', "function");
    return group;
}

// ---- operators --------------------------------------------------------------------------------

static Expr *parse_unary(FunctionReader *r) {
    if (accept(r->cv, '+'))
        return parse_primary(r);
    if (!accept(r->cv, '-'))
        return parse_primary(r);
    Expr *e = expr_new(r, EXPR_NEGATE);
    e->child = parse_primary(r);
    e->variable = e->child->variable;
    return e;
}

// The binary operators, loosest first. ORDER precedence
static const struct {
    int code, level;
    FunctionOp op;
} operators[] = {
    {'|', 0, FUNCTION_OR},       {'&', 1, FUNCTION_AND},
    {'=', 2, FUNCTION_EQUAL},    {TOK_NE, 2, FUNCTION_NOT_EQUAL},
    {'<', 2, FUNCTION_LESS},     {TOK_LE, 2, FUNCTION_LESS_EQUAL},
    {'>', 2, FUNCTION_GREATER},  {TOK_GE, 2, FUNCTION_GREATER_EQUAL},
    {'+', 3, FUNCTION_ADD},      {'-', 3, FUNCTION_SUBTRACT},
    {'*', 4, FUNCTION_MULTIPLY}, {'/', 4, FUNCTION_DIVIDE},
};
enum { UNARY_LEVEL = 5 };

static bool accept_operator(FunctionReader *r, int level, FunctionOp *op) {
    int code = peek_token(r->cv)->code;
    for (size_t i = 0; i < sizeof operators / sizeof *operators; i++) {
        if (operators[i].level == level && operators[i].code == code) {
            next_token(r->cv);
            *op = operators[i].op;
            return true;
        }
    }
    return false;
}

static Link *link_new(FunctionReader *r, FunctionOp op, Expr *operand) {
    Link *link = ARENA_NEW(r->cv->arena, Link);
    *link = (Link){.op = op, .operand = operand};
    return link;
}

static Expr *parse_binary(FunctionReader *r, int level) {
    if (level == UNARY_LEVEL)
        return parse_unary(r);
    Expr *first = parse_binary(r, level + 1), *chain = NULL;
    Link *last = NULL;
    for (FunctionOp op; accept_operator(r, level, &op); last = last->next) {
        if (!chain) {
            chain = expr_new(r, EXPR_CHAIN);
            last = chain->first = link_new(r, op, first);
            chain->variable = first->variable;
        }
        last->next = link_new(r, op, parse_binary(r, level + 1));
        chain->variable = chain->variable || last->next->operand->variable;
    }
    return chain ? chain : first;
}

static Expr *parse_or(FunctionReader *r) {
    enter_level(r->cv);
    Expr *e = parse_binary(r, 0);
    leave_level(r->cv);
    return e;
}

Expr *function_parse_body(FunctionReader *r) { return parse_or(r); }
