// SPDX-License-Identifier: MIT
// The tree of a formula as a program for registers: every operation has its operands in the lowest
// registers that are free. compile() leaves the value in a parameter's register or in `top`, and
// uses no register below `top` else.
//
// POV-Ray's shortcuts are part of the language, since they show in the last bit: a division by a
// constant is a product with its reciprocal, small whole powers are products.
#include "converter/function.h"

typedef struct {
    const FunctionReader *reader;
    LIST(FunctionStep) steps;
    int registers, stack, calls;
    int series[MAX_SERIES]; // registers of the running indices
} Compiler;

static int compile(Compiler *c, const Expr *e, int top);

static void claim(Compiler *c, int count, int stack) {
    c->registers = count > c->registers ? count : c->registers;
    c->stack = stack > c->stack ? stack : c->stack;
    if (c->registers > FUNCTION_MAX_STACK || c->stack > FUNCTION_MAX_STACK)
        die_at(&c->reader->loc, "This function is too deeply nested");
}

// -0 becomes 0: POV-Ray stores each constant once, finds it with ==, and has met 0 before.
static int emit(Compiler *c, FunctionOp op, int to, int a, int b, double value) {
    FunctionStep step = {.op = op, .to = to, .a = a, .b = b, .value = value == 0 ? 0 : value};
    list_push(c->reader->cv, &c->steps, step);
    claim(c, to + 1, to + 1);
    return (int)c->steps.count - 1;
}

static void emit_move(Compiler *c, int to, int from) {
    if (to != from)
        emit(c, FUNCTION_MOVE, to, from, 0, 0);
}

// The next step is where the jump at step `at` goes.
static void land(Compiler *c, int at) { c->steps.items[at].b = (int)c->steps.count; }

// The scene file has no infinities: they are made from what it has.
static void emit_constant(Compiler *c, int to, double value) {
    if (isfinite(value)) {
        emit(c, FUNCTION_CONSTANT, to, 0, 0, value);
        return;
    }
    emit(c, FUNCTION_CONSTANT, to, 0, 0, value < 0 ? -1e300 : 1e300);
    emit(c, FUNCTION_MULTIPLY_VALUE, to, to, 0, 1e300);
    if (isnan(value))
        emit(c, FUNCTION_SUBTRACT, to, to, to, 0);
}

// ---- chains -----------------------------------------------------------------------------------

// to = a (+ or *) value
static void emit_with_value(Compiler *c, FunctionOp op, int to, int a, double value) {
    if (isfinite(value)) {
        emit(c, op == FUNCTION_ADD ? FUNCTION_ADD_VALUE : FUNCTION_MULTIPLY_VALUE, to, a, 0, value);
        return;
    }
    int other = a == to ? to + 1 : to;
    emit_constant(c, other, value);
    emit(c, op, to, a, other, 0);
}

// to = a to a whole power of 2 to 8. Needs two more registers.
static void emit_power(Compiler *c, int to, int a, int power) {
    int square = to + 1, fourth = to + 2;
    emit(c, FUNCTION_MULTIPLY, power == 2 ? to : square, a, a, 0);
    if (power == 3)
        emit(c, FUNCTION_MULTIPLY, to, square, a, 0);
    if (power < 4)
        return;
    emit(c, FUNCTION_MULTIPLY, power == 4 ? to : fourth, square, square, 0);
    switch (power) {
    case 5:
        emit(c, FUNCTION_MULTIPLY, to, fourth, a, 0);
        break;
    case 6:
        emit(c, FUNCTION_MULTIPLY, to, fourth, square, 0);
        break;
    case 7:
        emit(c, FUNCTION_MULTIPLY, to, fourth, a, 0);
        emit(c, FUNCTION_MULTIPLY, to, to, square, 0);
        break;
    case 8:
        emit(c, FUNCTION_MULTIPLY, to, fourth, fourth, 0);
        break;
    default:
        break;
    }
}

// The operators that have a form of their own for a constant on the right; false: not this one.
static bool apply_constant(Compiler *c, FunctionOp op, int *a, int top, double value) {
    switch (op) {
    case FUNCTION_ADD:
    case FUNCTION_SUBTRACT:
        if (value == 0)
            return true;
        emit_with_value(c, FUNCTION_ADD, top, *a, op == FUNCTION_ADD ? value : -value);
        break;
    case FUNCTION_DIVIDE:
        if (value == 0)
            die_at(&c->reader->loc, "Division by zero in this function");
        if (value == 1)
            return true;
        emit_with_value(c, FUNCTION_MULTIPLY, top, *a, 1.0 / value);
        break;
    case FUNCTION_MULTIPLY:
        if (value == 1)
            return true;
        emit_with_value(c, op, top, *a, value);
        break;
    case FUNCTION_POW:
        if (value == 0)
            emit_constant(c, top, 1);
        else if (value >= 2 && value <= 8 && value == floor(value))
            emit_power(c, top, *a, (int)value);
        else
            return false;
        break;
    default:
        return false;
    }
    *a = top;
    return true;
}

// A constant on the left of the first operator.
static bool apply_to_constant(Compiler *c, FunctionOp op, double value, const Expr *right,
                              int top) {
    static const struct {
        FunctionOp op, with_value;
    } forms[] = {{FUNCTION_ADD, FUNCTION_ADD_VALUE},
                 {FUNCTION_SUBTRACT, FUNCTION_VALUE_SUBTRACT},
                 {FUNCTION_MULTIPLY, FUNCTION_MULTIPLY_VALUE},
                 {FUNCTION_DIVIDE, FUNCTION_VALUE_DIVIDE}};
    if (!isfinite(value) || right->kind == EXPR_CONSTANT)
        return false;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        if (forms[i].op == op) {
            emit(c, forms[i].with_value, top, compile(c, right, top), 0, value);
            return true;
        }
    }
    return false;
}

static int compile_chain(Compiler *c, const Expr *chain, int top) {
    const Link *link = chain->first->next;
    const Expr *first = chain->first->operand;
    int a = top;
    if (link && first->kind == EXPR_CONSTANT &&
        apply_to_constant(c, link->op, first->number, link->operand, top))
        link = link->next;
    else
        a = compile(c, first, top);
    for (; link; link = link->next) {
        const Expr *right = link->operand;
        if (right->kind == EXPR_CONSTANT && apply_constant(c, link->op, &a, top, right->number))
            continue;
        int b = compile(c, right, a == top ? top + 1 : top);
        emit(c, link->op, top, a, b, 0);
        a = top;
    }
    return a;
}

// ---- calls ------------------------------------------------------------------------------------

static const struct {
    int code;
    FunctionOp op;
} unary_calls[] = {
    {KW_sin, FUNCTION_SIN},     {KW_cos, FUNCTION_COS},     {KW_tan, FUNCTION_TAN},
    {KW_asin, FUNCTION_ASIN},   {KW_acos, FUNCTION_ACOS},   {KW_atan, FUNCTION_ATAN},
    {KW_sinh, FUNCTION_SINH},   {KW_cosh, FUNCTION_COSH},   {KW_tanh, FUNCTION_TANH},
    {KW_asinh, FUNCTION_ASINH}, {KW_acosh, FUNCTION_ACOSH}, {KW_atanh, FUNCTION_ATANH},
    {KW_abs, FUNCTION_ABS},     {KW_sqrt, FUNCTION_SQRT},   {KW_floor, FUNCTION_FLOOR},
    {KW_ceil, FUNCTION_CEIL},   {KW_int, FUNCTION_INT},     {KW_exp, FUNCTION_EXP},
    {KW_ln, FUNCTION_LN},       {KW_log, FUNCTION_LOG},     {KW_atan2, FUNCTION_ATAN2},
    {KW_pow, FUNCTION_POW},     {KW_mod, FUNCTION_MOD},     {KW_div, FUNCTION_DIV},
    {KW_min, FUNCTION_MIN},     {KW_max, FUNCTION_MAX},
};

// SELECT: condition, less, zero (or more), more. The branches meet with the value in `top`.
static void compile_select(Compiler *c, const Expr *call, int top) {
    const Expr *less = call->child->next, *zero = less->next, *more = zero->next;
    int condition = compile(c, call->child, top);
    int to_less = emit(c, FUNCTION_JUMP_NEGATIVE, 0, condition, 0, 0);
    int to_more = more ? emit(c, FUNCTION_JUMP_POSITIVE, 0, condition, 0, 0) : 0;
    emit_move(c, top, compile(c, zero, top));
    int end = emit(c, FUNCTION_JUMP, 0, 0, 0, 0), other_end = 0;
    land(c, to_less);
    emit_move(c, top, compile(c, less, top));
    if (more) {
        other_end = emit(c, FUNCTION_JUMP, 0, 0, 0, 0);
        land(c, to_more);
        emit_move(c, top, compile(c, more, top));
        land(c, other_end);
    }
    land(c, end);
}

// The sum in `top`, the running index and its limit after it.
static void compile_series(Compiler *c, const Expr *call, int top) {
    const Expr *from = call->child, *to = from->next, *term = to->next;
    bool sum = call->code == KW_sum;
    emit_constant(c, top, sum ? 0 : 1);
    emit_move(c, top + 1, compile(c, from, top + 1));
    emit_move(c, top + 2, compile(c, to, top + 2));
    int loop = emit(c, FUNCTION_WHILE, 0, top + 1, 0, 0);
    c->series[call->index] = top + 1;
    int value = compile(c, term, top + 3);
    emit(c, sum ? FUNCTION_ADD : FUNCTION_MULTIPLY, top, top, value, 0);
    emit(c, FUNCTION_NEXT, 0, top + 1, loop, 0);
    land(c, loop);
}

static void compile_call(Compiler *c, const Expr *call, int top) {
    switch (call->code) {
    case KW_select:
        compile_select(c, call, top);
        return;
    case KW_sum:
    case KW_prod:
        compile_series(c, call, top);
        return;
    case KW_radians:
        emit_with_value(c, FUNCTION_MULTIPLY, top, compile(c, call->child, top), M_PI / 180.0);
        return;
    case KW_degrees:
        emit_with_value(c, FUNCTION_MULTIPLY, top, compile(c, call->child, top), 180.0 / M_PI);
        return;
    default:
        break;
    }
    size_t i = 0;
    while (unary_calls[i].code != call->code)
        i++;
    const Expr *next = call->child->next;
    if (call->code == KW_pow && (!next || next->next)) {
        Loc loc = token_loc(c->reader->cv, call->token);
        die_at(&loc, "'pow' takes two arguments");
    }
    int a = compile(c, call->child, top);
    if (!next)
        emit(c, unary_calls[i].op, top, a, 0, 0);
    for (; next; next = next->next) {
        emit(c, unary_calls[i].op, top, a, compile(c, next, a == top ? top + 1 : top), 0);
        a = top;
    }
}

// top = the component of the value in top and the registers after it
static void emit_member(Compiler *c, int member, int top) {
    switch (member) {
    case MEMBER_GRAY:
        emit_with_value(c, FUNCTION_MULTIPLY, top, top, 0.297);
        emit_with_value(c, FUNCTION_MULTIPLY, top + 1, top + 1, 0.589);
        emit(c, FUNCTION_ADD, top, top, top + 1, 0);
        emit_with_value(c, FUNCTION_MULTIPLY, top + 2, top + 2, 0.114);
        emit(c, FUNCTION_ADD, top, top, top + 2, 0);
        break;
    case MEMBER_HEIGHT:
        emit_with_value(c, FUNCTION_MULTIPLY, top + 1, top + 1, 1.0 / 255.0);
        emit(c, FUNCTION_ADD, top, top, top + 1, 0);
        emit_with_value(c, FUNCTION_MULTIPLY, top, top, 0.996093);
        break;
    default:
        emit_move(c, top, top + member);
    }
}

static void compile_user(Compiler *c, const Expr *call, int top) {
    const UserFunction *user = call->user;
    const Function *f = &c->reader->cv->language->functions.items[user->index];
    int at = top;
    for (const Expr *argument = call->child; argument; argument = argument->next, at++)
        emit_move(c, at, compile(c, argument, at));
    if (user->calls >= c->calls)
        c->calls = user->calls + 1;
    if (c->calls > FUNCTION_MAX_CALLS) {
        Loc loc = token_loc(c->reader->cv, call->token);
        die_at(&loc, "Functions call functions too deeply (%d levels)", FUNCTION_MAX_CALLS);
    }
    bool vector = function_width(f) > 1;
    claim(c, top + (vector ? FUNCTION_WIDTH : 1), top + f->stack);
    emit(c, vector ? FUNCTION_CALL_VECTOR : FUNCTION_CALL, top, (int)user->index, top, 0);
    if (vector)
        emit_member(c, call->member, top);
}

// ---- all --------------------------------------------------------------------------------------

static int compile(Compiler *c, const Expr *e, int top) {
    switch (e->kind) {
    case EXPR_CONSTANT:
    case EXPR_ABSENT:
        emit_constant(c, top, e->number);
        return top;
    case EXPR_PARAMETER:
        return e->index;
    case EXPR_LOCAL:
        return c->series[e->index];
    case EXPR_GROUP:
        return compile(c, e->child, top);
    case EXPR_NEGATE:
        emit(c, FUNCTION_NEGATE, top, compile(c, e->child, top), 0, 0);
        return top;
    case EXPR_CHAIN:
        return compile_chain(c, e, top);
    case EXPR_CALL:
        compile_call(c, e, top);
        return top;
    case EXPR_USER:
        compile_user(c, e, top);
        return top;
    }
    return top;
}

int function_compile(const FunctionReader *reader, const Expr *body, Function *out) {
    Compiler c = {.reader = reader};
    claim(&c, reader->parameter_count, reader->parameter_count);
    int value = compile(&c, body, reader->parameter_count);
    emit(&c, FUNCTION_RETURN, 0, value, 0, 0);
    *out = function_default(FUNCTION_FORMULA);
    out->parameters = reader->parameter_count;
    out->registers = c.registers;
    out->stack = c.stack > c.registers ? c.stack : c.registers;
    out->steps = c.steps.items;
    out->step_count = (uint32_t)c.steps.count;
    return c.calls;
}
